#include "hal/gpio/chip/linux/linux_gpio_line.hpp"

namespace flexrf {

LinuxGpioLine::LinuxGpioLine(const GpioLineSettings& settings, std::unique_ptr<LibraryLine> line,
                             GpioLineCounters& counters)
    : name_(settings.name), settings_(settings), counters_(&counters), given_(line.release()) {
  settings_.name = name_.c_str();
  counters_->lines.fetch_add(1);
}

LinuxGpioLine::~LinuxGpioLine() {
  if (wanted_ || returned_.load() != nullptr) counters_->away.fetch_sub(1);
  counters_->lines.fetch_sub(1);
  for (LibraryLine* line : {given_.load(), returned_.load(), line_}) delete line;
}

Status LinuxGpioLine::keep(const char* chip) {
  if (LibraryLine* lost = returned_.exchange(nullptr, std::memory_order_acq_rel); lost != nullptr) {
    delete lost;
    wanted_ = true;
  }
  if (!wanted_) return {};
  Result<std::unique_ptr<LibraryLine>> line = LibraryLine::request(chip, settings_);
  if (!line) return line.status();
  wanted_ = false;
  counters_->away.fetch_sub(1);
  given_.store((*line).release(), std::memory_order_release);
  return {};
}

void LinuxGpioLine::receive(Time /*now*/) noexcept {
  if (line_ == nullptr) line_ = given_.exchange(nullptr, std::memory_order_acq_rel);
  if (line_ == nullptr) return;
  const int value = line_->value();
  if (value < 0) return lose();
  level_ = value > 0;
}

std::optional<GpioEdge> LinuxGpioLine::next_edge() noexcept {
  GpioEdge edge;
  if (line_ == nullptr || line_->next_edge(edge) != 1) return std::nullopt;
  return edge;
}

bool LinuxGpioLine::set(bool on) noexcept {
  if (line_ == nullptr) return false;
  if (line_->set(on) == 0) return true;
  lose();
  return false;
}

void LinuxGpioLine::lose() noexcept {
  level_.reset();
  counters_->losses.fetch_add(1);
  counters_->away.fetch_add(1);
  returned_.store(line_, std::memory_order_release);
  line_ = nullptr;
}

}  // namespace flexrf
