#include "hal/gpio/chip/linux/linux_gpio_chip.hpp"

#include <chrono>
#include <string_view>

#include "base/text.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// How soon a lost line is looked after, and how often it is asked for.
constexpr std::chrono::milliseconds keeping_interval{50};

}  // namespace

LinuxGpioChip::~LinuxGpioChip() {
  stop();
}

Status LinuxGpioChip::initialise() {
  stop();
  const std::string chip{text_view(configuration.chip)};
  if (const Status status = LibraryLine::probe(chip.c_str()); !status) return status;
  {
    const std::lock_guard lock(mutex_);
    chip_ = chip;
    trouble_ = {};
  }
  return keeper_.begin<LinuxGpioChip, &LinuxGpioChip::keep>(name(), *this);
}

void LinuxGpioChip::stop() {
  keeper_.end();
}

void LinuxGpioChip::receive(const Tick& /*tick*/) noexcept {
  feedback.lines = counters_.lines.load(std::memory_order_relaxed);
  feedback.losses = counters_.losses.load(std::memory_order_relaxed);
  feedback.present = counters_.away.load(std::memory_order_relaxed) == 0;
}

Result<GpioLine*> LinuxGpioChip::request(const GpioLineSettings& settings) {
  const std::lock_guard lock(mutex_);
  Result<std::unique_ptr<LibraryLine>> line = LibraryLine::request(chip_.c_str(), settings);
  if (!line) return line.status();
  lines_.push_back(std::make_unique<LinuxGpioLine>(settings, std::move(*line), counters_));
  return static_cast<GpioLine*>(lines_.back().get());
}

void LinuxGpioChip::release(GpioLine* line) noexcept {
  const std::lock_guard lock(mutex_);
  std::erase_if(lines_, [line](const std::unique_ptr<LinuxGpioLine>& one) { return one.get() == line; });
}

/// A line that is lost says so by a word of its own: a cycle must not wait to wake somebody.
void LinuxGpioChip::keep() {
  while (keeper_.wait(keeping_interval)) {
    const std::lock_guard lock(mutex_);
    look_after_lines();
  }
}

/// Each reason is told once, however often and by however many lines it is met.
void LinuxGpioChip::look_after_lines() {
  Status trouble;
  for (const std::unique_ptr<LinuxGpioLine>& line : lines_) {
    const Status status = line->keep(chip_.c_str());
    if (!status) trouble = status;
  }
  if (trouble.code() == trouble_.code()) return;
  // Lines that were let go of meanwhile are not there again.
  if (trouble && !lines_.empty())
    log_info(name(), "the lines of GPIO chip {} are there again", std::string_view(chip_));
  if (!trouble)
    log_warning(name(), "a line was lost and is asked for until it is back: {}",
                std::string_view(trouble.cause()));
  trouble_ = trouble;
}

}  // namespace flexrf
