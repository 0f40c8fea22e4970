#include "web-ui/server/access/password_helper.hpp"

#include <fcntl.h>
#include <grp.h>
#include <linux/capability.h>
#include <sched.h>
#include <sodium.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

#include "web-ui/server/access/password.hpp"

namespace flexrf::panel {
namespace {

constexpr int exit_failure = 1;
constexpr uid_t nobody = 65534;
constexpr int modest = 10;                // as nice: whatever the machine does goes first
constexpr rlim_t processor_seconds = 60;  // it needs a tenth of one, and 10 where a PC is emulated

bool limit(__rlimit_resource resource, rlim_t value) noexcept {
  const rlimit both{value, value};
  return setrlimit(resource, &both) == 0;
}

/// What the process occupies now, and what hashing takes, with something to spare.
bool limit_memory() noexcept {
#if FLEXRF_SANITIZER
  return true;  // a sanitizer's shadow alone is larger than any limit
#else
  unsigned long pages = 0;
  std::FILE* const file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return false;
  const bool is_read = std::fscanf(file, "%lu", &pages) == 1;
  std::fclose(file);
  const auto page = static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  return is_read && limit(RLIMIT_AS, pages * page + password_memory + (rlim_t{16} << 20));
#endif
}

void offer_to_out_of_memory_killer() noexcept {
  const int file = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  // If it fails, the kernel chooses by size, as always.
  [[maybe_unused]] const ssize_t written = write(file, "1000", 4);
  close(file);
}

bool drop_capabilities() noexcept {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> none{};
  return syscall(SYS_capset, &header, none.data()) == 0;
}

bool give_up_rights() noexcept {
  prctl(PR_SET_NAME, "password-check");
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const sched_param ordinary{};
  bool given_up = sched_setscheduler(0, SCHED_OTHER, &ordinary) == 0;
  setpriority(PRIO_PROCESS, 0, modest);
  offer_to_out_of_memory_killer();
  if (geteuid() == 0)
    given_up = given_up && setgroups(0, nullptr) == 0 && setresgid(nobody, nobody, nobody) == 0 &&
               setresuid(nobody, nobody, nobody) == 0;
  given_up = given_up && drop_capabilities() && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
             prctl(PR_SET_DUMPABLE, 0) == 0;
  return given_up && limit(RLIMIT_CORE, 0) && limit(RLIMIT_FSIZE, 0) &&
         limit(RLIMIT_CPU, processor_seconds) && limit_memory();
}

}  // namespace

std::optional<int> run_password_helper(int argument_count, char** arguments) {
  if (argument_count != 2 || std::strcmp(arguments[1], password_helper_argument) != 0) return std::nullopt;
  if (!give_up_rights() || sodium_init() < 0) return exit_failure;
  std::array<char, longest_hash + longest_password + 2> input{};
  std::size_t size = 0;
  while (size < input.size()) {
    const ssize_t count = read(STDIN_FILENO, input.data() + size, input.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return exit_failure;
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  const std::string_view text(input.data(), size);
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos || !is_password_hash(text.substr(0, end))) return exit_failure;
  const bool is_right = is_right_password(std::string{text.substr(0, end)}, text.substr(end + 1));
  sodium_memzero(input.data(), input.size());
  return is_right ? exit_right_password : exit_wrong_password;
}

}  // namespace flexrf::panel
