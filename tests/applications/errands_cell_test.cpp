// A process and a stream socket in a running cell, on their real drivers.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>

#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

class Visitor {
 public:
  explicit Visitor(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    CHECK(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }
  ~Visitor() { ::close(socket_); }
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;

  void say(const std::string& line) {
    const std::string text = line + "\n";
    CHECK(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size()));
  }
  /// Whether a line is heard within some time.
  bool hears(const std::string& line, int milliseconds) {
    while (heard_.find(line + "\n") == std::string::npos) {
      pollfd wanted{socket_, POLLIN, 0};
      char bytes[256];
      if (::poll(&wanted, 1, milliseconds) != 1) return false;
      const ssize_t count = ::recv(socket_, bytes, sizeof bytes, 0);
      if (count <= 0) return false;
      heard_.append(bytes, static_cast<std::size_t>(count));
    }
    return true;
  }

 private:
  int socket_;
  std::string heard_;
};

constexpr int patience = 60'000;  // ms

std::int64_t told(Running& cell, const char* slot, const char* field) {
  const nlohmann::json value = cell.newest(slot);
  return value.is_null() ? 0 : value.at(field).get<std::int64_t>();
}

std::uint16_t port_of(Running& cell) {
  CHECK(wait_until([&] { return told(cell, "door.feedback", "port") > 0; }));
  return static_cast<std::uint16_t>(told(cell, "door.feedback", "port"));
}

pid_t program_of(Running& cell) {
  CHECK(wait_until([&] { return told(cell, "helper.feedback", "id") > 0; }));
  return static_cast<pid_t>(told(cell, "helper.feedback", "id"));
}

void visitors_speak_to_a_program_through_the_cell() {
  Running cell(application::application);
  Visitor first(port_of(cell));
  Visitor second(port_of(cell));
  first.say("from the first");
  CHECK(first.hears("from the first", patience));
  second.say("from the second");
  CHECK(second.hears("from the second", patience));
  const pid_t program = program_of(cell);
  CHECK_EQUAL(cell.stop().exit_code, 0);
  // Reaped by the helper, or waiting for whoever has it now: in no case does it run.
  CHECK(wait_until([&] { return ::kill(program, 0) != 0; }));
}

void a_program_that_was_killed_is_there_again() {
  Running cell(application::application);
  Visitor visitor(port_of(cell));
  visitor.say("before");
  CHECK(visitor.hears("before", patience));
  const pid_t program = program_of(cell);
  ::kill(program, SIGKILL);
  CHECK(wait_until([&] {
    const std::int64_t id = told(cell, "helper.feedback", "id");
    return told(cell, "helper.feedback", "runs") == 2 && id > 0 && id != program;
  }));
  visitor.say("after");
  CHECK(visitor.hears("after", patience));
  CHECK_EQUAL(cell.stop().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(visitors_speak_to_a_program_through_the_cell),
      TEST_APART(a_program_that_was_killed_is_there_again),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
