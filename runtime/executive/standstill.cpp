#include "runtime/executive/standstill.hpp"

#include <algorithm>
#include <cstdio>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

bool owns_actuator(const Cell& cell, std::uint16_t thread) noexcept {
  const Application& application = cell.application();
  for (std::size_t i = 0; i < application.devices.size(); ++i) {
    const bool concerned = thread == no_index || application.devices[i].thread == thread;
    if (concerned && cell.driver(static_cast<std::uint16_t>(i)).actuates) return true;
  }
  return false;
}

}  // namespace

Standstill::Standstill(Cell& cell, std::uint16_t thread) noexcept
    : cell_(&cell),
      name_(thread == no_index ? cell.application().name : cell.application().threads[thread].name),
      state_(thread == no_index ? nullptr : &cell.application().thread_states[thread]),
      actuates_(owns_actuator(cell, thread)) {}

bool Standstill::judge(Time from, Time to) noexcept {
  const Duration missed = to - std::max(from, cell_->control().judged_from());
  if (!is_limit_reached(missed)) return false;
  tell(missed, state_ == nullptr ? "the process stood still" : "this thread stood still");
  return true;
}

bool Standstill::judge_release(Time nominal, Time ended, bool overrun) noexcept {
  if (!overrun || !actuates_ || !cell_->control().may_move()) {
    late_since_ = Time::max();
    return false;
  }
  late_since_ = std::max(std::min(late_since_, nominal), cell_->control().judged_from());
  const Duration late = ended - late_since_;
  if (!is_limit_reached(late)) return false;
  late_since_ = Time::max();
  tell(late, "each step of this thread ended too late");
  return true;
}

bool Standstill::is_limit_reached(Duration missed) const noexcept {
  const Duration limit = cell_->standstill_limit();
  if (limit.count() == 0 || missed < limit) return false;
  const Mode mode = cell_->control().mode();
  return mode == Mode::running || mode == Mode::finishing;
}

void Standstill::tell(Duration missed, const char* what) noexcept {
  Control& control = cell_->control();
  if (state_ == nullptr) {
    control.note_standstill(missed);
  } else if (missed.count() > state_->longest_standstill.load(std::memory_order_relaxed)) {
    state_->longest_standstill.store(missed.count(), std::memory_order_relaxed);
  }
  control.note_fault();
  if (actuates_) {
    char who[longest_who];
    std::snprintf(who, sizeof(who), "FlexRF: %s stood still", name_);
    cell_->stop_motion(who);
  }
  log_error(name_, "{} for {:.2} s (standstill_limit {:.2} s){}", StaticText{what}, seconds(missed),
            seconds(cell_->standstill_limit()),
            StaticText{actuates_ ? "; motion is stopped: clear the stop and give Start" : ""});
}

}  // namespace flexrf
