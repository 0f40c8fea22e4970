#include "web-ui/server/access/login_body.hpp"

#include <simdjson.h>

#include <cstddef>

namespace flexrf::panel {
namespace {

constexpr std::size_t longest_body = 1024;
constexpr std::size_t most_members = 2;

}  // namespace

bool read_login_body(std::string_view text, LoginBody& body) {
  if (text.size() > longest_body) return false;
  simdjson::dom::parser parser;
  simdjson::dom::object members;
  std::string_view user;
  std::string_view password;
  // With no more members than these two, neither stands there twice.
  if (parser.parse(text.data(), text.size()).get(members) != simdjson::SUCCESS ||
      members.size() != most_members || members["user"].get(user) != simdjson::SUCCESS ||
      members["password"].get(password) != simdjson::SUCCESS)
    return false;
  body.user = user;
  body.password = password;
  return true;
}

}  // namespace flexrf::panel
