#include "hal/gpio/lines/interface/digital_line.hpp"

#include <algorithm>

namespace flexrf {

Status DigitalLine::open(GpioChip& chip, const DigitalLineSettings& settings) {
  close();
  settings_ = settings;
  if (settings.name.empty() || settings.name.size() >= name_.size()) {
    return Status::error(StatusCode::invalid_argument,
                         "its line is not named; set configuration.line as gpioinfo shows it");
  }
  if (settings.emergency_stop && is_output()) {
    return Status::error(StatusCode::invalid_argument,
                         "an emergency stop is an input: set configuration.direction = \"input\"");
  }
  name_ = {};
  std::copy(settings.name.begin(), settings.name.end(), name_.begin());
  const Result<GpioLine*> line = chip.request(
      {name_.data(), settings.direction, settings.bias, settings.active_low, settings.safe_value});
  if (!line) return line.status();
  chip_ = &chip;
  line_ = *line;
  return {};
}

void DigitalLine::close() noexcept {
  if (line_ != nullptr) chip_->release(line_);
  line_ = nullptr;
  present_ = false;
  permits_ = false;
  edges_count_ = 0;
  seen_ = missed_ = dropped_ = 0;
  commanded_.reset();
}

void DigitalLine::receive(Time now) noexcept {
  if (line_ == nullptr) return;
  line_->receive(now);
  const std::optional<bool> level = line_->level();
  went_off_ = false;
  if (!level) {
    present_ = false;
    permits_ = false;
    return;
  }
  if (!present_) come_back(*level, now);
  if (is_output()) return;
  // An edge may be younger than the level that was read before it.
  if (!take_edges()) filter_.put(*level, now);
  filter_.settle(now);
  permits_ = *level && !went_off_ && filter_.on();
}

void DigitalLine::come_back(bool level, Time now) noexcept {
  present_ = true;
  filter_.reset(settings_.debounce);
  filter_.put(level, now);
  last_edge_ = level;
  on_ = settings_.safe_value;
  since_ = now;
  commanded_.reset();
}

bool DigitalLine::take_edges() noexcept {
  bool any = false;
  // A contact that chatters as fast as it is read does not hold up the cycle: the rest is for the next one.
  for (std::size_t taken = 0; taken < edges_.size(); ++taken) {
    const std::optional<GpioEdge> edge = line_->next_edge();
    if (!edge) break;
    any = true;
    ++seen_;
    const bool missed = last_edge_ == edge->on;
    if (missed) {
      // It was the opposite in between, too short for the kernel to see.
      ++missed_;
      filter_.put(!edge->on, edge->at);
    }
    last_edge_ = edge->on;
    went_off_ = went_off_ || !edge->on || missed;
    filter_.put(edge->on, edge->at);
    keep({edge->on, nanoseconds(edge->at)});
  }
  return any;
}

/// The newest are kept.
void DigitalLine::keep(const DigitalEdge& edge) noexcept {
  if (edges_count_ == edges_.size()) {
    edges_first_ = (edges_first_ + 1) % edges_.size();
    --edges_count_;
    ++dropped_;
  }
  edges_[(edges_first_ + edges_count_++) % edges_.size()] = edge;
}

std::optional<DigitalState> DigitalLine::state() const noexcept {
  if (!present_) return std::nullopt;
  if (is_output()) return DigitalState{on_, nanoseconds(since_)};
  return DigitalState{filter_.on(), nanoseconds(filter_.since())};
}

std::optional<DigitalEdge> DigitalLine::read_edge() noexcept {
  if (edges_count_ == 0) return std::nullopt;
  const DigitalEdge edge = edges_[edges_first_];
  edges_first_ = (edges_first_ + 1) % edges_.size();
  --edges_count_;
  return edge;
}

void DigitalLine::command(bool on) noexcept {
  if (is_output() && present_) commanded_ = on;
}

void DigitalLine::send(Time now) noexcept {
  if (commanded_ && *commanded_ != on_ && line_->set(*commanded_)) {
    on_ = *commanded_;
    since_ = now;
  }
  commanded_.reset();
}

/// False while the chip is away, as the output is unknown then, and until the chip knows that it has the
/// value. The chip comes back with the safe value.
bool DigitalLine::make_safe() noexcept {
  commanded_.reset();
  if (!is_output()) return true;
  if (!present_ || !line_->set(settings_.safe_value)) return false;
  on_ = settings_.safe_value;
  return line_->is_set();
}

Time DigitalLine::next_event() const noexcept {
  if (line_ == nullptr) return Time::max();
  return std::min(line_->next_event(), filter_.settles_at());
}

void DigitalLine::fill(DigitalIoFeedback& feedback) const noexcept {
  const std::optional<DigitalState> now = state();
  feedback.present = present_;
  feedback.on = now && now->on;
  feedback.edges = seen_;
  feedback.missed_edges = missed_;
  feedback.dropped_edges = dropped_;
}

}  // namespace flexrf
