// VirtualChip: the lines of a chip that exists in memory only.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <string_view>

#include "hal/gpio/chip/interface/virtual_line.hpp"

namespace flexrf {

/// Has every line that is asked for by a name, up to `capacity`. Any thread, but none that is real-time.
class VirtualChip {
 public:
  static constexpr std::size_t capacity = 64;

  /// Made when it is named for the first time; null when there are `capacity` already.
  VirtualLine* line(std::string_view name);
  /// `chip`: as the operator knows it.
  Result<GpioLine*> request(const GpioLineSettings& settings, const char* chip);
  void release(GpioLine* line) noexcept;

  void set_present(bool on) noexcept { present_.store(on, std::memory_order_release); }
  bool is_present() const noexcept { return present_.load(std::memory_order_acquire); }
  std::uint32_t requested() const noexcept { return requested_.load(std::memory_order_relaxed); }

 private:
  struct Entry {
    std::array<char, 32> name{};
    VirtualLine line;
    bool taken = false;
  };
  Entry* entry(std::string_view name) noexcept;

  std::mutex mutex_;
  std::array<Entry, capacity> entries_;
  std::size_t count_ = 0;
  std::atomic<bool> present_{true};
  std::atomic<std::uint32_t> requested_{0};
};

}  // namespace flexrf
