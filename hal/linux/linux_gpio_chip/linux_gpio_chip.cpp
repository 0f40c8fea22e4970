#include "hal/linux/linux_gpio_chip/linux_gpio_chip.hpp"

#include <pthread.h>

#include <chrono>
#include <csignal>

#include "runtime/core/text.hpp"

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
    stopping_ = false;
  }
  // The signals that end the application are for others to take.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  keeper_ = std::thread([this] { keep(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return {};
}

void LinuxGpioChip::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stopped_.notify_all();
  if (keeper_.joinable()) keeper_.join();
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
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    for (const std::unique_ptr<LinuxGpioLine>& line : lines_) line->keep(chip_.c_str());
    stopped_.wait_for(lock, keeping_interval);
  }
}

}  // namespace flexrf
