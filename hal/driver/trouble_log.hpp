// TroubleLog: what a device tells as its trouble() stands in the log, too.
#pragma once

#include "base/status.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {

/// Of devices that are in no fault while they are away: who reads only the log, or comes later, sees when
/// something was wrong, and that it no longer is. The device's thread.
class TroubleLog {
 public:
  /// Once a cycle. `name`: of the device; lives for ever. That it was not there yet, before nothing was wrong
  /// for the first time, is not said. What comes and goes is said once a second.
  void look(const char* name, const Status& trouble) noexcept {
    if (!was_well_ && !trouble.is_ok()) return;
    was_well_ = true;
    if (trouble.code() == told_) return;
    told_ = trouble.code();
    if (trouble.is_ok()) {
      log_warning(ends_, name, "it is well again");
    } else {
      log_warning(begins_, name, "{}", trouble.cause());
    }
  }

 private:
  bool was_well_ = false;
  StatusCode told_ = StatusCode::ok;
  LogLimit begins_;
  LogLimit ends_;
};

}  // namespace flexrf
