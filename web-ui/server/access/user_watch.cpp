#include "web-ui/server/access/user_watch.hpp"

#include <utility>

#include "runtime/log/log.hpp"

namespace flexrf::panel {

std::optional<Users> UserFileWatch::update(Time now) {
  if (!watch_.has_changed(now)) return std::nullopt;
  Result<Users> users = read_users(watch_.file());
  if (users) return std::move(*users);
  log_warning("panel", "who may log in stays as it was: {}", users.status().cause());
  return std::nullopt;
}

}  // namespace flexrf::panel
