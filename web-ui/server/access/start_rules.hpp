// What must be there before the panel listens somewhere.
#pragma once

#include <string>

#include "base/status.hpp"
#include "web-ui/server/access/address.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::panel {

struct Exposure {
  Address address;             ///< where it would listen
  bool has_users = false;      ///< --panel-users is given
  bool secure = false;         ///< by TLS
  bool insecure_http = false;  ///< --insecure-http
};

/// Other addresses than loopback ones need passwords, and TLS unless --insecure-http: invalid_argument says
/// what is missing and how to get it.
Status check_exposure(const Exposure& exposure);

/// The users of --panel-users, at least one. Blocks.
Result<Users> users_to_start_with(const std::string& file);

}  // namespace flexrf::panel
