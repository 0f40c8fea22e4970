#include "web-ui/server/access/start_rules.hpp"

namespace flexrf::panel {

Status check_exposure(const Exposure& exposure) {
  if (exposure.address.is_loopback()) return {};
  if (!exposure.has_users)
    return Status::error(
        StatusCode::invalid_argument,
        "--panel: other machines may see the panel only with passwords: `./flexrf password` makes "
        "one, --panel-users FILE names the file; or listen at 127.0.0.1");
  if (!exposure.secure && !exposure.insecure_http)
    return Status::error(
        StatusCode::invalid_argument,
        "--panel: other machines may see the panel only by TLS: docs/panel-access.md tells how to "
        "make a certificate; or accept with --insecure-http that everybody on the way can read "
        "passwords");
  return {};
}

Result<Users> users_to_start_with(const std::string& file) {
  Result<Users> users = read_users(file);
  if (users && users->list.empty())
    return Status::error(
        StatusCode::invalid_argument,
        "%s: there is no user in it; `./flexrf password` adds one, or leave --panel-users away",
        file.c_str());
  return users;
}

}  // namespace flexrf::panel
