// Claiming a PC: its first password, for whoever can read the code on its console.
#pragma once

#include <string>
#include <utility>

#include "base/status.hpp"
#include "base/time.hpp"
#include "image/claim/claim_code.hpp"
#include "web-ui/server/access/address.hpp"
#include "web-ui/server/access/login_limits.hpp"

namespace flexrf::claim {

/// What a person typed.
struct Wish {
  std::string code;
  std::string user;
  std::string password;
  std::string repeated;
};

/// What became of it, for that person.
struct Answer {
  unsigned status = 200;  ///< of HTTP: 200 claimed, 400 to be typed anew, 403 wrong code, 429 too early, 503
  std::string text;       ///< what to do; empty when it is claimed
  unsigned wait_s = 0;    ///< with 429
};

/// A guesser in the network must not lock out the person at the PC. A wrong code therefore delays only the
/// address that it came from. The code is replaced after `tries` wrong ones, but not before `shortest_life`;
/// by then one of 2^50 codes was guessed with a probability of 10^-10. One thread.
class Claim {
 public:
  /// Wrong codes until there is a new one.
  static constexpr unsigned tries = 100'000;
  /// How long a code that was shown can be typed.
  static constexpr Duration shortest_life = std::chrono::minutes{2};

  explicit Claim(std::string users_file) : users_file_(std::move(users_file)) {}

  /// Blocks for some 0.1 s when the code is right, and 64 MiB are needed.
  Answer attempt(const Wish& wish, const panel::Address& address, Time now);
  bool is_done() const noexcept { return is_done_; }
  /// The one that counts now: it has to be shown.
  const ClaimCode& code() const noexcept { return code_; }

 private:
  std::string users_file_;
  ClaimCode code_;
  Time shown_since_{};  // 0: not known before the first attempt
  unsigned failures_ = 0;
  bool is_done_ = false;
  panel::LoginLimits limits_;
};

}  // namespace flexrf::claim
