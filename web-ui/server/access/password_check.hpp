// Asks a process of its own whether a password is right; nobody waits meanwhile.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "base/status.hpp"
#include "base/time.hpp"

namespace flexrf::panel {

/// One check at a time. The server's thread.
///
/// The process is this executable once more, whose main() calls run_password_helper(). It is made by
/// posix_spawn, which shares memory until the new program begins: fork() would mark all memory of a running
/// cell copy-on-write, and every real-time thread would pay with page faults. The child inherits neither
/// locked memory nor descriptors, signal handlers, environment or real-time policy.
class PasswordCheck {
 public:
  static constexpr Duration time_limit = std::chrono::seconds{30};

  enum class Outcome : std::uint8_t {
    none,    ///< nothing is under way, or it still is
    right,   ///<
    wrong,   ///<
    failed,  ///< it could not be found out
  };

  explicit PasswordCheck(std::string executable = "/proc/self/exe") : executable_(std::move(executable)) {}
  ~PasswordCheck();  ///< ends what is under way
  PasswordCheck(const PasswordCheck&) = delete;
  PasswordCheck& operator=(const PasswordCheck&) = delete;

  /// busy: one is under way. invalid_argument: the texts are too long. unavailable: no process could be made.
  Status start(std::string_view hash, std::string_view password, Time now);
  bool is_busy() const noexcept { return child_ > 0; }
  /// Tells an outcome once; ends a check that takes too long. Does not block.
  Outcome update(Time now) noexcept;

 private:
  std::string executable_;
  pid_t child_ = 0;
  Time deadline_{};
};

}  // namespace flexrf::panel
