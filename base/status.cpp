#include "base/status.hpp"

namespace flexrf {

const char* name_of(StatusCode code) noexcept {
  switch (code) {
    case StatusCode::ok:
      return "ok";
    case StatusCode::invalid_argument:
      return "invalid argument";
    case StatusCode::out_of_range:
      return "out of range";
    case StatusCode::not_found:
      return "not found";
    case StatusCode::busy:
      return "busy";
    case StatusCode::timeout:
      return "timeout";
    case StatusCode::unavailable:
      return "unavailable";
    case StatusCode::not_permitted:
      return "not permitted";
    case StatusCode::device_fault:
      return "device fault";
    case StatusCode::closed:
      return "closed";
    case StatusCode::internal:
      return "internal";
  }
  return "unknown";
}

}  // namespace flexrf
