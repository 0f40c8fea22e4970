// MotionPermit: somebody else on this machine says whether anything may move.
#pragma once

#include <string>

#include "base/time.hpp"
#include "runtime/executive/control.hpp"

namespace flexrf {

/// The word stands in a file: `permitted` in its first line, else that line says why not. Whoever writes it
/// replaces the file by another one (rename), so that nobody reads half a word. No such file, or one that
/// cannot be read, permits nothing: who has not spoken yet has not agreed. A word outlives whoever wrote it,
/// and the application, too.
/// One non-real-time thread.
class MotionPermit {
 public:
  static constexpr Duration interval = std::chrono::milliseconds{100};

  /// `file` empty: nobody is asked. `application`: under which name the log tells of it.
  MotionPermit(Control& control, const char* application, std::string file)
      : control_(&control), application_(application), file_(std::move(file)) {}

  /// Reads it, where `interval` is over. Each change stands in the log.
  void observe(Time now) noexcept;

 private:
  Control* control_;
  const char* application_;
  std::string file_;
  Time looked_at_{};  // no time: not yet
  Status word_;       // ok: permitted
};

}  // namespace flexrf
