// LinuxGpioLine: a line of the kernel's, and what happens when its chip goes away.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "hal/gpio/chip/linux/gpio_library.hpp"

namespace flexrf {

/// What the lines of a chip tell it. Any thread.
struct GpioLineCounters {
  std::atomic<std::uint32_t> lines{0};
  std::atomic<std::uint32_t> away{0};
  std::atomic<std::uint32_t> losses{0};
};

/// The thread of the line's device uses it; the chip's keeper, another thread, asks the kernel for it again
/// when it was lost, which blocks and allocates. The line goes back and forth between the two by two words.
class LinuxGpioLine final : public GpioLine {
 public:
  LinuxGpioLine(const GpioLineSettings& settings, std::unique_ptr<LibraryLine> line,
                GpioLineCounters& counters);
  LinuxGpioLine(const LinuxGpioLine&) = delete;
  LinuxGpioLine& operator=(const LinuxGpioLine&) = delete;
  ~LinuxGpioLine();

  // ---- the keeper's

  /// Takes back a line that was lost, and asks for it again.
  /// @returns why it cannot be had; ok: it was not lost, or is back.
  Status keep(const char* chip);

  // ---- GpioLine

  void receive(Time now) noexcept override;
  std::optional<bool> level() const noexcept override { return level_; }
  std::optional<GpioEdge> next_edge() noexcept override;
  bool set(bool on) noexcept override;
  int descriptor() const noexcept override { return line_ == nullptr ? -1 : line_->descriptor(); }

 private:
  void lose() noexcept;

  std::string name_;
  GpioLineSettings settings_;
  GpioLineCounters* counters_;
  std::atomic<LibraryLine*> given_{nullptr};     // by the keeper
  std::atomic<LibraryLine*> returned_{nullptr};  // to it
  bool wanted_ = false;                          // the keeper's: it has taken back what was lost
  LibraryLine* line_ = nullptr;                  // the device's thread's
  std::optional<bool> level_;
};

}  // namespace flexrf
