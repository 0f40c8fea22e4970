#include "runtime/blackboard/doorbell.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

namespace flexrf {
namespace {

long futex(const std::atomic<std::uint32_t>& word, int operation, std::uint32_t value,
           const timespec* deadline) noexcept {
  static_assert(sizeof(word) == sizeof(std::uint32_t));
  return syscall(SYS_futex, &word, operation | FUTEX_PRIVATE_FLAG, value, deadline, nullptr,
                 FUTEX_BITSET_MATCH_ANY);
}

}  // namespace

void Doorbell::wake() noexcept {
  // May run in a signal handler, between a call and its look at errno.
  const int error = errno;
  if (event_descriptor_ >= 0) {
    const std::uint64_t one = 1;
    // A full counter refuses, and is readable all the same.
    [[maybe_unused]] const ssize_t written = write(event_descriptor_, &one, sizeof(one));
  } else {
    futex(word_, FUTEX_WAKE, 1, nullptr);
  }
  errno = error;
}

bool Doorbell::announce(std::uint32_t heard) noexcept {
  std::uint32_t expected = heard;
  return word_.compare_exchange_strong(expected, heard | asleep, std::memory_order_seq_cst);
}

void Doorbell::settle() noexcept {
  word_.fetch_and(~asleep, std::memory_order_seq_cst);
  if (event_descriptor_ < 0) return;
  // After clearing: who rings from now on does not write. Who saw the bit may still write later, which only
  // makes the next sleep short.
  std::uint64_t rings = 0;
  [[maybe_unused]] const ssize_t count = read(event_descriptor_, &rings, sizeof(rings));
}

bool Doorbell::wait(std::uint32_t heard, Time deadline) noexcept {
  if (!announce(heard)) return true;
  timespec until{};
  const bool forever = deadline == Time::max();
  if (!forever) {
    const std::int64_t at = nanoseconds(deadline) > 0 ? nanoseconds(deadline) : 0;
    until.tv_sec = static_cast<time_t>(at / 1'000'000'000);
    until.tv_nsec = static_cast<long>(at % 1'000'000'000);
  }
  bool timed_out = false;
  while (!timed_out && word_.load(std::memory_order_seq_cst) == (heard | asleep)) {
    timed_out = futex(word_, FUTEX_WAIT_BITSET, heard | asleep, forever ? nullptr : &until) != 0 &&
                errno == ETIMEDOUT;
  }
  return word_.fetch_and(~asleep, std::memory_order_seq_cst) != (heard | asleep);
}

}  // namespace flexrf
