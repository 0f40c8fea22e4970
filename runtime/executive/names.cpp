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
      return "in its safe state";
    case Mode::ended:
      return "ended";
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
