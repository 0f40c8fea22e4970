// Addresses as the tables write them, and what is in the way of having one.
#include "hal/socket/address/socket_address.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

int family_of(const char* text, int kind, bool listen) {
  const Result<std::vector<SocketAddress>> found = resolve(text, kind, listen);
  return found ? found->front().family() : -1;
}

StatusCode refusal_of(const std::string& text, bool listen = false) {
  return resolve(text, SOCK_STREAM, listen).status().code();
}

void addresses_are_read(void**) {
  assert_int_equal(family_of("tcp:192.168.1.20:5000", SOCK_STREAM, false), AF_INET);
  assert_int_equal(family_of("udp:127.0.0.1:1", SOCK_DGRAM, false), AF_INET);
  assert_int_equal(family_of("tcp:[::1]:5000", SOCK_STREAM, false), AF_INET6);
  assert_int_equal(family_of("unix:/run/cell.sock", SOCK_STREAM, true), AF_UNIX);
  assert_int_equal(family_of("unix:@name", SOCK_DGRAM, false), AF_UNIX);
  // Only who listens may leave the host or the port open.
  assert_int_equal(family_of("tcp:127.0.0.1:0", SOCK_STREAM, true), AF_INET);
  assert_int_not_equal(family_of("tcp::5000", SOCK_STREAM, true), -1);
  assert_true(refusal_of("tcp:127.0.0.1:0") == StatusCode::invalid_argument);
  assert_true(refusal_of("tcp::5000") == StatusCode::invalid_argument);
}

bool run_what_is_no_address_is_refused() {
  for (const char* const text :
       {"", "127.0.0.1:5000", "tcp:", "tcp:host", "tcp:host:", "tcp:host:x", "tcp:h:65536", "tcp:h:123456",
        "tcp:::1:5000", "udp:127.0.0.1:5000", "unix:", "unix:name", "unix:/", "unix:@"}) {
    if (refusal_of(text) != StatusCode::invalid_argument) return false;
  }
  return refusal_of("unix:/" + std::string(200, 'x')) == StatusCode::invalid_argument;
}

/// Longer than a part of a name may be, so that no name service is asked.
bool run_a_name_that_nobody_can_have_is_told() {
  const std::string name(80, 'x');
  const Status status = resolve("tcp:" + name + ":5000", SOCK_STREAM, false).status();
  return status.code() == StatusCode::not_found && std::string(status.cause()).find(name) == 1;
}

struct Folder {
  char path[32] = "/tmp/flexrf-address-XXXXXX";
  bool made = mkdtemp(path) != nullptr;
  ~Folder() { rmdir(path); }
};

int listener_at(const std::string& text, Status& status) {
  const Result<std::vector<SocketAddress>> own = resolve(text, SOCK_STREAM, true);
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  status = bind_to(descriptor, own->front(), text);
  if (status) ::listen(descriptor, 1);
  return descriptor;
}

bool run_a_path_is_taken_over_only_from_the_dead() {
  const Folder folder;
  if (!folder.made) return false;
  const std::string text = std::string("unix:") + folder.path + "/socket";
  Status status;
  const int first = listener_at(text, status);
  if (!status) return false;
  const int second = listener_at(text, status);
  const bool refused = status.code() == StatusCode::busy;
  // As a process leaves it that was killed: nobody listens, and the path is there.
  ::close(first);
  const int third = listener_at(text, status);
  const bool taken_over = status.is_ok();
  ::close(second);
  ::close(third);
  remove_path(resolve(text, SOCK_STREAM, true)->front());
  return refused && taken_over && ::access(text.c_str() + 5, F_OK) != 0;
}

bool run_a_file_is_not_removed() {
  const Folder folder;
  const std::string path = std::string(folder.path) + "/file";
  const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  if (!folder.made || file < 0) return false;
  ::close(file);
  const Result<std::vector<SocketAddress>> own = resolve("unix:" + path, SOCK_STREAM, true);
  Status status;
  const int refused = listener_at("unix:" + path, status);
  ::close(refused);
  remove_path(own->front());
  const bool kept = ::access(path.c_str(), F_OK) == 0;
  ::unlink(path.c_str());
  return kept && !status;
}

/// In a process of its own, which is nobody's, as root may write everywhere.
bool run_a_folder_of_others_is_told() {
  constexpr uid_t nobody = 65534;
  const Folder folder;
  if (!folder.made || ::chmod(folder.path, S_IRUSR | S_IXUSR) != 0) return false;
  const pid_t process = ::fork();
  if (process == 0) {
    if (::geteuid() == 0 && ::setuid(nobody) != 0) ::_exit(2);
    const std::string text = std::string("unix:") + folder.path + "/socket";
    Status status;
    listener_at(text, status);
    const std::string cause = status.cause();
    ::_exit(status.code() == StatusCode::not_permitted && cause.find(text) == 0 &&
                    cause.find("others' folders need a right") != std::string::npos
                ? 0
                : 1);
  }
  int end = 1;
  return process > 0 && ::waitpid(process, &end, 0) == process && end == 0;
}

template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

}  // namespace

int main() {
#define CASE(name) \
  { #name, judged < run_##name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      cmocka_unit_test(addresses_are_read),
      CASE(what_is_no_address_is_refused),
      CASE(a_name_that_nobody_can_have_is_told),
      CASE(a_path_is_taken_over_only_from_the_dead),
      CASE(a_file_is_not_removed),
      CASE(a_folder_of_others_is_told),
  };
#undef CASE
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
