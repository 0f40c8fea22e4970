// What a client sends to log in.
#pragma once

#include <string>
#include <string_view>

namespace flexrf::panel {

struct LoginBody {
  std::string user;
  std::string password;
};

/// The text is one JSON object with the texts "user" and "password", once each, and nothing else; at most 1
/// KiB. The server's thread.
bool read_login_body(std::string_view text, LoginBody& body);

}  // namespace flexrf::panel
