#include "web-ui/server/surroundings.hpp"

#include "runtime/log/log.hpp"

namespace flexrf::panel {

Watch::~Watch() {
  const Duration taken = MonotonicClock::now() - begin_;
  if (taken <= surroundings_.settings.slow_call) return;
  ++surroundings_.slow_calls;
  static LogLimit limit;
  log_warning(limit, "panel", "{} kept the server for {:.1} ms", what_, seconds(taken) * 1e3);
}

void Surroundings::note_refusal(std::string_view address, const char* why) noexcept {
  static LogLimit limit;
  log_warning(limit, "panel", "{} was not let in by TLS: {}", address, why);
}

}  // namespace flexrf::panel
