#include "web-ui/server/access/user_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>

#include "base/nearest_name.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "web-ui/server/access/password.hpp"

namespace flexrf::panel {
namespace {

constexpr std::array roles{Role::viewer, Role::operator_, Role::engineer, Role::admin};

constexpr const char* header =
    "# Who may log in to the panel: name:role:password, the password as Argon2id leaves it.\n"
    "# Made by `./flexrf password`; read anew when it changes. Keep it from others' eyes.\n";

int width(std::string_view text) noexcept {
  return static_cast<int>(std::min<std::size_t>(text.size(), 60));
}

Status damaged(const std::string& file, std::size_t line, const char* what) {
  return Status::error(StatusCode::invalid_argument,
                       "%s:%zu: %s (a line is name:role:password; `./flexrf password` writes it)",
                       file.c_str(), line, what);
}

Status take_line(std::string_view line, const std::string& file, std::size_t number, Users& users) {
  const std::size_t first = line.find(':');
  const std::size_t second = first == std::string_view::npos ? first : line.find(':', first + 1);
  if (second == std::string_view::npos) return damaged(file, number, "two colons are expected");
  const std::string_view name = line.substr(0, first);
  const std::string_view hash = line.substr(second + 1);
  if (const Status status = check_user_name(name); !status) return damaged(file, number, status.cause());
  const Result<Role> role = parse_role(line.substr(first + 1, second - first - 1));
  if (!role) return damaged(file, number, role.status().cause());
  if (!is_password_hash(hash)) return damaged(file, number, "the password is damaged or of a foreign kind");
  if (users.find(name) != nullptr) return damaged(file, number, "this user has a line already");
  if (users.list.size() == Users::most) return damaged(file, number, "there are 64 users already");
  users.list.push_back({std::string{name}, *role, std::string{hash}});
  return {};
}

}  // namespace

const User* Users::find(std::string_view name) const noexcept {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const User& user) { return user.name == name; });
  return found == list.end() ? nullptr : &*found;
}

User* Users::find(std::string_view name) noexcept {
  return const_cast<User*>(std::as_const(*this).find(name));
}

Result<Role> parse_role(std::string_view text) {
  NearestName nearest(text);
  for (const Role role : roles) {
    if (text == name_of(role)) return role;
    nearest.offer(name_of(role));
  }
  const std::string_view best = nearest.best();
  return Status::error(StatusCode::invalid_argument,
                       "unknown role '%.*s'%s%.*s%s: viewer, operator, engineer or admin", width(text),
                       text.data(), best.empty() ? "" : ", did you mean '", width(best), best.data(),
                       best.empty() ? "" : "'?");
}

Status check_user_name(std::string_view name) {
  const auto is_good = [](char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           (character >= '0' && character <= '9') || character == '.' || character == '-' || character == '_';
  };
  if (!name.empty() && name.size() <= Users::longest_name && std::all_of(name.begin(), name.end(), is_good))
    return {};
  return Status::error(StatusCode::invalid_argument,
                       "'%.*s' cannot be a user's name: 1 to 31 letters, digits, dots, dashes, underscores",
                       width(name), name.data());
}

Result<Users> parse_users(std::string_view text, const std::string& file) {
  Users users;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.starts_with('#')) continue;
    if (const Status status = take_line(line, file, number, users); !status) return status;
  }
  return users;
}

std::string users_text(const Users& users) {
  std::string text = header;
  for (const User& user : users.list)
    text += user.name + ":" + name_of(user.role) + ":" + user.password_hash + "\n";
  return text;
}

Result<Users> read_users(const std::string& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0 && (status.st_mode & mode_t{077}) != 0)
    return Status::error(StatusCode::not_permitted,
                         "'%s' holds passwords and others may read it: chmod 600 '%s'", file.c_str(),
                         file.c_str());
  const Result<std::string> text = read_file(file);
  if (!text) return text.status();
  return parse_users(*text, file);
}

Status write_users(const std::string& file, const Users& users) {
  return replace_file(file, users_text(users), 0600);
}

}  // namespace flexrf::panel
