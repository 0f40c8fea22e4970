#include "runtime/realtime/rights.hpp"

#include <grp.h>
#include <linux/capability.h>
#include <malloc.h>
#include <pthread.h>
#include <pwd.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <vector>

#include "runtime/realtime/process_statistics.hpp"

namespace flexrf {

namespace {

constexpr const char* group_name = "flexrf";
constexpr int usual_priority_limit = 49;

bool holds_capability(unsigned capability) noexcept {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[2]{};
  if (syscall(SYS_capget, &header, data) != 0) return false;
  return (data[capability / 32].effective & (1U << (capability % 32))) != 0;
}

rlim_t limit_of(__rlimit_resource resource) noexcept {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 ? limit.rlim_cur : 0;
}

/// Whether the kernel grants the priority when asked; the thread is afterwards what it was.
bool tries_priority(int priority) noexcept {
  int policy = SCHED_OTHER;
  sched_param before{};
  if (pthread_getschedparam(pthread_self(), &policy, &before) != 0) return false;
  sched_param wanted{};
  wanted.sched_priority = priority;
  if (sched_setscheduler(0, SCHED_FIFO, &wanted) != 0) return false;
  return sched_setscheduler(0, policy, &before) == 0;
}

class Text {
 public:
  Text(char* text, std::size_t capacity) noexcept : text_(text), capacity_(capacity) {}
  [[gnu::format(printf, 2, 3)]] void print(const char* format, ...) noexcept {
    va_list arguments;
    va_start(arguments, format);
    const int wanted = std::vsnprintf(text_ + size_, capacity_ - size_, format, arguments);
    va_end(arguments);
    if (wanted > 0) size_ = std::min(size_ + static_cast<std::size_t>(wanted), capacity_ - 1);
  }

 private:
  char* text_;
  std::size_t capacity_;
  std::size_t size_ = 0;
};

struct User {
  char name[64];
  uid_t id;
  bool in_group;  ///< this process is in the group that the limits are for
};

User this_user() {
  User user{{}, geteuid(), false};
  std::vector<char> buffer(16384);
  passwd entry{};
  passwd* found = nullptr;
  if (getpwuid_r(user.id, &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr)
    std::snprintf(user.name, sizeof(user.name), "%s", found->pw_name);
  else
    std::snprintf(user.name, sizeof(user.name), "%u", user.id);
  group group_entry{};
  group* group_found = nullptr;
  if (getgrnam_r(group_name, &group_entry, buffer.data(), buffer.size(), &group_found) == 0 &&
      group_found != nullptr)
    user.in_group = getegid() == group_found->gr_gid || group_member(group_found->gr_gid) != 0;
  return user;
}

/// A limit as a person reads it.
struct Amount {
  explicit Amount(rlim_t bytes) noexcept {
    if (bytes == RLIM_INFINITY)
      std::snprintf(text, sizeof(text), "unlimited");
    else
      std::snprintf(text, sizeof(text), "%llu KiB", static_cast<unsigned long long>(bytes / 1024));
  }
  char text[32];
};

void write_ways(Text& text, const RightsReport& report, const User& user, int priority) {
  text.print("Grant it in one of these ways, as root:\n");
  text.print("  - by limits:\n");
  if (user.in_group)
    text.print(
        "      (user %s is in group %s already: log in again, or see whether the file below is there)\n",
        user.name, group_name);
  else
    text.print("      groupadd --force %s\n      usermod --append --groups %s %s\n", group_name, group_name,
               user.name);
  text.print("    and into /etc/security/limits.d/90-flexrf.conf, in force after the next login:\n");
  const int priority_limit = std::max(priority, usual_priority_limit);
  if (report.priority_missing) text.print("      @%s - rtprio %d\n", group_name, priority_limit);
  if (report.lock_missing) text.print("      @%s - memlock unlimited\n", group_name);
  char executable[256];
  const ssize_t length = readlink("/proc/self/exe", executable, sizeof(executable) - 1);
  executable[length > 0 ? length : 0] = '\0';
  text.print("  - by capabilities of the executable:\n      setcap %s%s%s=ep %s\n",
             report.priority_missing ? "cap_sys_nice" : "",
             report.priority_missing && report.lock_missing ? "," : "",
             report.lock_missing ? "cap_ipc_lock" : "", executable);
  text.print("  - by systemd, in the [Service] section of its unit:\n");
  if (report.priority_missing) text.print("      LimitRTPRIO=%d\n", priority_limit);
  if (report.lock_missing) text.print("      LimitMEMLOCK=infinity\n");
}

}  // namespace

Status RightsReport::status() const noexcept {
  if (is_complete()) return {};
  return Status::error(StatusCode::not_permitted, "%s", summary);
}

RightsReport probe_rights(const RightsNeeded& needed) {
  RightsReport report;
  const rlim_t priority_limit = limit_of(RLIMIT_RTPRIO);
  const rlim_t lock_limit = limit_of(RLIMIT_MEMLOCK);
  const bool may_by_nice = holds_capability(CAP_SYS_NICE);
  const bool may_by_limit = priority_limit >= static_cast<rlim_t>(std::max(needed.priority, 0));
  report.priority_missing = needed.priority > 0 && !tries_priority(needed.priority);
  report.lock_missing =
      needed.locked_bytes > 0 && !holds_capability(CAP_IPC_LOCK) && lock_limit < needed.locked_bytes;
  if (report.is_complete()) return report;

  const User user = this_user();
  Text text(report.text, sizeof(report.text));
  Text summary(report.summary, sizeof(report.summary));
  summary.print("missing right:");
  if (report.priority_missing) {
    text.print("Missing right: real-time priority %d (SCHED_FIFO) for user %s.\n", needed.priority,
               user.name);
    if (may_by_nice || may_by_limit) {
      summary.print(" SCHED_FIFO priority %d (refused by the control group)", needed.priority);
      text.print(
          "  The limit or capability is there, but the kernel refuses: the control group has no real-time\n"
          "  budget (cpu.rt_runtime_us), or a container forbids it. Start outside of it, or give it one.\n");
    } else {
      summary.print(" SCHED_FIFO priority %d (RLIMIT_RTPRIO %llu, no CAP_SYS_NICE)", needed.priority,
                    static_cast<unsigned long long>(priority_limit));
      text.print("  RLIMIT_RTPRIO is %llu and the process does not hold CAP_SYS_NICE.\n",
                 static_cast<unsigned long long>(priority_limit));
    }
  }
  if (report.lock_missing) {
    summary.print("%s %s of locked memory (RLIMIT_MEMLOCK %s, no CAP_IPC_LOCK)",
                  report.priority_missing ? "," : "", Amount(needed.locked_bytes).text,
                  Amount(lock_limit).text);
    text.print("Missing right: %s of locked memory for user %s.\n", Amount(needed.locked_bytes).text,
               user.name);
    text.print("  RLIMIT_MEMLOCK is %s and the process does not hold CAP_IPC_LOCK.\n",
               Amount(lock_limit).text);
  }
  write_ways(text, report, user, needed.priority);
  return report;
}

Status lock_all_memory() noexcept {
#if FLEXRF_SANITIZER
  return {};
#else
  // What was freed stays with the process: giving pages back would unlock them, taking them again faults.
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    const int cause = errno;
    return Status::error(cause == EINVAL ? StatusCode::internal : StatusCode::not_permitted,
                         "memory cannot be locked: %s; RLIMIT_MEMLOCK is %s%s", strerrordesc_np(cause),
                         Amount(limit_of(RLIMIT_MEMLOCK)).text,
                         holds_capability(CAP_IPC_LOCK) ? "" : " and CAP_IPC_LOCK is not held");
  }
  const auto statistics = read_process_statistics();
  if (!statistics) return statistics.status();
  if (statistics->locked == 0)
    return Status::error(StatusCode::internal, "mlockall was accepted, but no memory is locked (VmLck is 0)");
  // Whether what comes later is locked too can only be tried.
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const sample = mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (sample == MAP_FAILED)
    return Status::error(StatusCode::not_permitted,
                         "no more memory can be mapped and locked; RLIMIT_MEMLOCK is %s",
                         Amount(limit_of(RLIMIT_MEMLOCK)).text);
  unsigned char resident = 0;
  const int error = mincore(sample, page, &resident) == 0 ? 0 : errno;
  munmap(sample, page);
  if (error != 0)
    return Status::error(
        error == EPERM ? StatusCode::not_permitted : StatusCode::internal,
        "whether new memory is locked cannot be found out: mincore(): %s; a filter of system "
        "calls, as a service or a container has, has to let mincore through",
        strerrordesc_np(error));
  if ((resident & 1) == 0)
    return Status::error(StatusCode::internal, "mlockall was accepted, but new memory is not faulted in");
  return {};
#endif
}

}  // namespace flexrf
