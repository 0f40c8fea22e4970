#include "web-ui/server/surroundings.hpp"

#include "runtime/log/log.hpp"

namespace flexrf::panel {

void Surroundings::note(std::string_view what, Duration taken) noexcept {
  if (taken <= settings.slow_call) return;
  ++slow_calls;
  static LogLimit limit;
  log_warning(limit, "panel", "{} kept the server for {:.1} ms", what, seconds(taken) * 1e3);
}

void Surroundings::note_refusal(std::string_view address, const char* why) noexcept {
  static LogLimit limit;
  log_warning(limit, "panel", "{} was not let in by TLS: {}", address, why);
}

}  // namespace flexrf::panel
