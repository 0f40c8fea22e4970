// Whether it is an admin who asks.
#pragma once

#include <string>
#include <utility>

#include "base/time.hpp"
#include "image/helper/answer.hpp"
#include "web-ui/server/access/login_limits.hpp"

namespace flexrf::helper {

/// One thread. Needs prepare_cryptography() before.
class AdminCheck {
 public:
  explicit AdminCheck(std::string users_file) : users_file_(std::move(users_file)) {}

  /// Blocks for some 0.1 s and needs 64 MiB meanwhile: the password is checked against what stands in the
  /// file now. All who ask share the delays after wrong ones: they come through one application, which could
  /// name any other party.
  Answer check(const std::string& user, const std::string& password, Time now);

 private:
  std::string users_file_;
  panel::LoginLimits limits_;
};

}  // namespace flexrf::helper
