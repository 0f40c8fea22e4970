#include "hal/operator/evdev/evdev_port.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// How soon a device that was lost is looked for, and how often.
constexpr std::chrono::milliseconds keeping_interval{50};
/// However fast they come, a cycle ends. The kernel keeps 64 of most devices.
constexpr int most_events_per_cycle = 256;

}  // namespace

Status EvdevPort::begin(const EvdevRequest& request) {
  end();
  request_ = request;
  losses_ = overflows_ = 0;
  trouble_ = StatusCode::ok;
  news_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (news_ < 0)
    return Status::error(StatusCode::internal, "no event descriptor for an input device: %s",
                         std::strerror(errno));
  Result<std::unique_ptr<EvdevDevice>> device = EvdevDevice::open(request_);
  if (!device) return device.status();
  kept_ = std::move(*device);
  given_.store(kept_.get(), std::memory_order_release);
  ring();
  const Status status = keeper_.begin<EvdevPort, &EvdevPort::keep>(request_.owner, *this);
  if (!status) end();
  return status;
}

void EvdevPort::end() {
  keeper_.end();
  device_ = nullptr;
  given_.store(nullptr, std::memory_order_relaxed);
  returned_.store(false, std::memory_order_relaxed);
  kept_.reset();
  if (news_ >= 0) close(news_);
  news_ = -1;
}

const EvdevDevice* EvdevPort::begin_cycle() noexcept {
  events_ = 0;
  if (device_ != nullptr && !unfinished_) return nullptr;
  std::uint64_t count = 0;
  static_cast<void>(!read(news_, &count, sizeof(count)));  // none is as good
  unfinished_ = false;
  if (device_ != nullptr || given_.load(std::memory_order_relaxed) == nullptr) return nullptr;
  device_ = given_.exchange(nullptr, std::memory_order_acquire);
  return device_;
}

bool EvdevPort::next(input_event& event) noexcept {
  if (device_ == nullptr) return false;
  if (events_ == most_events_per_cycle) {
    unfinished_ = true;
    ring();
    return false;
  }
  const int result = device_->next(event);
  if (result < 0) lose(-result);
  ++events_;
  return result > 0;
}

std::uint32_t EvdevPort::overflows() const noexcept {
  return overflows_ + (device_ == nullptr ? 0 : device_->overflows());
}

int EvdevPort::descriptor() const noexcept {
  return device_ == nullptr || unfinished_ ? news_ : device_->descriptor();
}

void EvdevPort::lose(int error) noexcept {
  log_warning(request_.owner, "input device {} is gone ({})", std::string_view(device_->path()),
              std::string_view(error == ENODEV ? "unplugged" : "it cannot be read"));
  overflows_ += device_->overflows();
  ++losses_;
  device_ = nullptr;
  returned_.store(true, std::memory_order_release);
}

/// A device that is lost says so by a word of its own: a cycle must not wait to wake somebody.
void EvdevPort::keep() {
  while (keeper_.wait(keeping_interval)) look_after();
}

void EvdevPort::look_after() {
  if (returned_.exchange(false, std::memory_order_acquire)) kept_.reset();
  if (kept_ != nullptr) return;
  Result<std::unique_ptr<EvdevDevice>> device = EvdevDevice::open(request_);
  if (!device) {
    // Each reason once, however often it is tried; that it is not there yet is known.
    const StatusCode code = device.status().code();
    if (code != trouble_ && code != StatusCode::not_found)
      log_warning(request_.owner, "{}", std::string_view(device.status().cause()));
    trouble_ = code;
    return;
  }
  trouble_ = StatusCode::ok;
  kept_ = std::move(*device);
  log_info(request_.owner, "input device {} is there", std::string_view(kept_->path()));
  given_.store(kept_.get(), std::memory_order_release);
  ring();
}

void EvdevPort::ring() noexcept {
  constexpr std::uint64_t one = 1;
  static_cast<void>(!write(news_, &one, sizeof(one)));  // one that counts already is as good
}

}  // namespace flexrf
