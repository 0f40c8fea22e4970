// The words by which states are shown.
#include "runtime/executive/control.hpp"
#include "runtime/executive/state.hpp"

namespace flexrf {

const char* name_of(Life life) noexcept {
  switch (life) {
    case Life::created:
      return "created";
    case Life::initialised:
      return "initialised";
    case Life::running:
      return "running";
    case Life::stopped:
      return "stopped";
    case Life::fault:
      return "fault";
    case Life::waiting:
      return "waiting";
  }
  return "unknown";
}

const char* name_of(Mode mode) noexcept {
  switch (mode) {
    case Mode::starting:
      return "starting";
    case Mode::running:
      return "running";
    case Mode::finishing:
      return "finishing";
    case Mode::stopping:
      return "stopping";
    case Mode::safe:
      return "safe";
    case Mode::ended:
      return "ended";
  }
  return "unknown";
}

const char* phrase_of(Mode mode) noexcept {
  return mode == Mode::safe ? "in its safe state" : name_of(mode);
}

const char* phrase_of_motion(const Control& control) noexcept {
  if (control.motion_stopped()) return "motion is stopped";
  return control.may_move() ? "actuators may move" : "waits for Start";
}

const char* name_of(EndCause cause) noexcept {
  switch (cause) {
    case EndCause::none:
      return "none";
    case EndCause::end_of_input:
      return "end of input";
    case EndCause::virtual_time_over:
      return "virtual time over";
    case EndCause::signal:
      return "signal";
    case EndCause::requested:
      return "requested";
    case EndCause::fault:
      return "fault";
  }
  return "unknown";
}

const char* name_of(DriverKind kind) noexcept {
  switch (kind) {
    case DriverKind::mock:
      return "mock";
    case DriverKind::simulated:
      return "simulated";
    case DriverKind::real:
      return "real";
  }
  return "unknown";
}

}  // namespace flexrf
