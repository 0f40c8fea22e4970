// TroubleLog: what a device tells as its trouble() stands in the log, too.
#pragma once

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {

/// Of devices that are in no fault while they are away: who reads only the log, or comes later, sees when
/// something was wrong, and that it no longer is. The device's thread.
class TroubleLog {
 public:
  /// Once a cycle. `name`: of the device; lives for ever. A device that was never well has `time_to_begin`
  /// before the log says that it is not there. A trouble that comes and goes is said once a second.
  void look(const char* name, const Status& trouble, Time now) noexcept {
    was_well_ = was_well_ || trouble.is_ok();
    if (!was_well_ && !has_had_time(now)) return;
    if (trouble.code() == told_) return;
    told_ = trouble.code();
    if (trouble.is_ok()) {
      log_warning(ends_, name, "it is well again");
    } else {
      log_warning(begins_, name, "{}", trouble.cause());
    }
  }

  static constexpr Duration time_to_begin = std::chrono::seconds(1);

 private:
  bool has_had_time(Time now) noexcept {
    if (began_ == Time{}) began_ = now;
    return now - began_ >= time_to_begin;
  }

  bool was_well_ = false;
  Time began_{};  // the first look
  StatusCode told_ = StatusCode::ok;
  LogLimit begins_;
  LogLimit ends_;
};

}  // namespace flexrf
