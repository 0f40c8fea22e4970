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

bool Standstill::judge(Duration missed) noexcept {
  const Duration limit = cell_->standstill_limit();
  if (limit.count() == 0 || missed < limit) return false;
  Control& control = cell_->control();
  const Mode mode = control.mode();
  if ((mode != Mode::running && mode != Mode::finishing) || control.is_on_break()) return false;
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
  log_error(name_, "{} stood still for {:.2} s (standstill_limit {:.2} s){}",
            StaticText{state_ == nullptr ? "the process" : "this thread"}, seconds(missed), seconds(limit),
            StaticText{actuates_ ? "; motion is stopped: clear the stop and give Start" : ""});
  return true;
}

}  // namespace flexrf
