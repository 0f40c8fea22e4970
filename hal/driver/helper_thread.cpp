#include "hal/driver/helper_thread.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "runtime/realtime/signals.hpp"

namespace flexrf {

Status HelperThread::begin(const char* name, void (*work)(void*), void* owner) noexcept {
  if (thread_.is_started())
    return Status::error(StatusCode::busy, "the helper thread of %s runs already", name);
  ending_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (ending_ < 0) {
    return Status::error(StatusCode::unavailable, "no event descriptor for the helper thread of %s: %s", name,
                         std::strerror(errno));
  }
  ThreadSettings settings;
  settings.name = name;
  settings.stack_size = stack_size;
  // The signals that end the application are for others to take.
  const signals::Blocked blocked;
  const Status status = thread_.start(settings, work, owner);
  if (!status) end();
  return status;
}

void HelperThread::end() noexcept {
  if (thread_.is_started()) {
    constexpr std::uint64_t one = 1;
    static_cast<void>(!write(ending_, &one, sizeof(one)));  // an eventfd that counts nothing takes it
    thread_.join();
  }
  if (ending_ >= 0) close(ending_);
  ending_ = -1;
}

bool HelperThread::wait(Duration longest, std::span<pollfd> sources) noexcept {
  std::array<pollfd, most_sources + 1> all{};
  const std::size_t count = std::min(sources.size(), most_sources);
  std::copy_n(sources.begin(), count, all.begin());
  all[count] = {ending_, POLLIN, 0};
  const timespec time{.tv_sec = static_cast<time_t>(longest / std::chrono::seconds{1}),
                      .tv_nsec = static_cast<long>((longest % std::chrono::seconds{1}).count())};
  // Interrupted, as by a debugger, it has waited less: nobody counts on more.
  if (ppoll(all.data(), count + 1, &time, nullptr) < 0) return true;
  std::copy_n(all.begin(), count, sources.begin());
  return all[count].revents == 0;
}

}  // namespace flexrf
