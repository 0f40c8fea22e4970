// The file of who may log in: a line per user.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"
#include "runtime/core/parameter_descriptor.hpp"

namespace flexrf::panel {

struct User {
  std::string name;
  Role role = Role::viewer;
  std::string password_hash;  ///< as hash_password() makes it
  bool operator==(const User&) const = default;
};

/// Lines `name:role:hash`, comments from '#', in the order of the file.
struct Users {
  static constexpr std::size_t most = 64;
  static constexpr std::size_t longest_name = 31;

  std::vector<User> list;

  const User* find(std::string_view name) const noexcept;
  User* find(std::string_view name) noexcept;
};

/// "viewer", "operator", "engineer", "admin".
/// invalid_argument names the roles there are, and the nearest.
Result<Role> parse_role(std::string_view text);
/// Letters, digits, '.', '-', '_', at most longest_name; invalid_argument says so.
Status check_user_name(std::string_view name);

/// `file` is for messages only. invalid_argument: file, line, what is wrong and what to do.
Result<Users> parse_users(std::string_view text, const std::string& file);
/// With a comment that says what the file is.
std::string users_text(const Users& users);

/// not_found: there is no such file. not_permitted: others may read it, or we may not. Blocks.
Result<Users> read_users(const std::string& file);
/// Replaces the file, which only its owner can read then. Blocks.
Status write_users(const std::string& file, const Users& users);

}  // namespace flexrf::panel
