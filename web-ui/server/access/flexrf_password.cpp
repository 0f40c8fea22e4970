// flexrf-password: who may log in to the panel, and with which password.

#include <cstdio>
#include <string>
#include <string_view>

#include "base/standard_descriptors.hpp"
#include "web-ui/server/access/panel_access.hpp"
#include "web-ui/server/access/password.hpp"
#include "web-ui/server/access/secret_prompt.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace {

using flexrf::Result;
using flexrf::Role;
using flexrf::Status;
using flexrf::StatusCode;
using flexrf::panel::User;
using flexrf::panel::Users;

constexpr const char* usage =
    "flexrf-password [--role ROLE] [--user NAME] FILE    sets a password, adds the user if need be\n"
    "flexrf-password --list FILE                         users and roles\n"
    "flexrf-password --remove NAME FILE\n"
    "The password is asked for, or is one line of standard input when that is no terminal. ROLE is viewer, "
    "operator,\n"
    "engineer or admin (default: as it was, admin for a new user); NAME is `admin` unless given. FILE is "
    "what the\n"
    "application gets as --panel-users; only its owner can read it.\n"
    "Exit code: 0; 1 wrong usage, a password that is too short, a file that cannot be read or written.\n";

struct Request {
  enum class Act { set, list, remove };
  Act act = Act::set;
  std::string user = "admin";
  std::string role;  // empty: as it was
  std::string file;
};

Result<Request> parse(int argument_count, char** arguments) {
  Request request;
  for (int i = 1; i < argument_count; ++i) {
    const std::string_view argument = arguments[i];
    const bool takes_value = argument == "--role" || argument == "--user" || argument == "--remove";
    if (takes_value && i + 1 == argument_count)
      return Status::error(StatusCode::invalid_argument, "%s needs a value", arguments[i]);
    if (argument == "--role") {
      request.role = arguments[++i];
    } else if (argument == "--user") {
      request.user = arguments[++i];
    } else if (argument == "--remove") {
      request.act = Request::Act::remove;
      request.user = arguments[++i];
    } else if (argument == "--list") {
      request.act = Request::Act::list;
    } else if (argument.starts_with("-") || !request.file.empty()) {
      return Status::error(StatusCode::invalid_argument, "unexpected '%s'", arguments[i]);
    } else {
      request.file = argument;
    }
  }
  if (request.file.empty()) return Status::error(StatusCode::invalid_argument, "which file?");
  if (request.act != Request::Act::set && !request.role.empty())
    return Status::error(StatusCode::invalid_argument, "--role goes with setting a password only");
  return request;
}

Status set(const Request& request, Users& users) {
  if (const Status status = flexrf::panel::check_user_name(request.user); !status) return status;
  User* user = users.find(request.user);
  Role role = user != nullptr ? user->role : Role::admin;
  if (!request.role.empty()) {
    const Result<Role> wanted = flexrf::panel::parse_role(request.role);
    if (!wanted) return wanted.status();
    role = *wanted;
  }
  if (user == nullptr && users.list.size() == Users::most)
    return Status::error(StatusCode::invalid_argument, "there are %zu users already; --remove one",
                         Users::most);
  const Result<std::string> password = flexrf::panel::read_new_secret(request.user);
  if (!password) return password.status();
  if (const Status status = flexrf::panel::check_password(*password); !status) return status;
  Result<std::string> hash = flexrf::panel::hash_password(*password);
  if (!hash) return hash.status();
  if (user == nullptr) user = &users.list.emplace_back();
  *user = {request.user, role, std::move(*hash)};
  if (const Status status = flexrf::panel::write_users(request.file, users); !status) return status;
  std::fprintf(stderr, "%s may log in as %s, at once where the panel runs with this file: %s\n",
               request.user.c_str(), flexrf::name_of(role), request.file.c_str());
  return {};
}

Status remove(const Request& request, Users& users) {
  const std::size_t removed =
      std::erase_if(users.list, [&](const User& user) { return user.name == request.user; });
  if (removed == 0)
    return Status::error(StatusCode::not_found, "there is no user '%s' in %s; --list shows who is",
                         request.user.c_str(), request.file.c_str());
  return flexrf::panel::write_users(request.file, users);
}

Status serve(const Request& request) {
  Result<Users> users = flexrf::panel::read_users(request.file);
  if (!users && !(request.act == Request::Act::set && users.status().code() == StatusCode::not_found))
    return users.status();
  Users known = users ? std::move(*users) : Users{};
  if (request.act == Request::Act::set) return set(request, known);
  if (request.act == Request::Act::remove) return remove(request, known);
  for (const User& user : known.list)
    std::printf("%-31s %s\n", user.name.c_str(), flexrf::name_of(user.role));
  return {};
}

}  // namespace

int main(int argument_count, char** arguments) {
  flexrf::hold_standard_descriptors();
  if (argument_count == 2 && std::string_view{arguments[1]} == "--help") {
    std::fputs(usage, stdout);
    return 0;
  }
  const Result<Request> request = parse(argument_count, arguments);
  if (!request) {
    std::fprintf(stderr, "flexrf-password: %s\n%s", request.status().cause(), usage);
    return 1;
  }
  if (!flexrf::panel::prepare_cryptography()) {
    std::fputs("flexrf-password: this system has no source of randomness\n", stderr);
    return 1;
  }
  const Status status = serve(*request);
  if (!status) std::fprintf(stderr, "flexrf-password: %s\n", status.cause());
  return status ? 0 : 1;
}
