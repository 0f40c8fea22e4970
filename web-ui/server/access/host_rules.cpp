#include "web-ui/server/access/host_rules.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <climits>

#include "base/ascii.hpp"

namespace flexrf::panel {
namespace {

constexpr std::size_t longest_name = 253;  // RFC 1035

bool is_name_character(char character) noexcept {
  const char letter = lower_case(character);
  return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '-' ||
         letter == '.' || letter == '_';
}

bool is_name(std::string_view text) noexcept {
  return !text.empty() && text.size() <= longest_name && text.front() != '.' && text.back() != '.' &&
         text.find("..") == std::string_view::npos &&
         std::all_of(text.begin(), text.end(), is_name_character);
}

/// Browsers take it for an IPv4 address and for nothing else (WHATWG URL Standard, "ends in a number").
bool ends_in_number(std::string_view name) noexcept {
  return name.substr(name.rfind('.') + 1).find_first_not_of("0123456789") == std::string_view::npos;
}

struct Authority {
  std::string_view name;  // of an IPv6 address without brackets
  bool in_brackets = false;
  std::uint16_t port = 0;
};

/// "name", "name:port", "[address]:port" and nothing else: no user, path, blank or empty port.
std::optional<Authority> parse_authority(std::string_view text, std::uint16_t default_port) noexcept {
  Authority authority;
  authority.port = default_port;
  std::string_view rest;
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    authority.name = text.substr(1, end - 1);
    authority.in_brackets = true;
    if (authority.name.find('%') != std::string_view::npos ||
        authority.name.find(':') == std::string_view::npos || !Address::parse(authority.name))
      return std::nullopt;
    rest = text.substr(end + 1);
  } else {
    const std::size_t colon = text.find(':');
    authority.name = text.substr(0, colon);
    if (!is_name(authority.name)) return std::nullopt;
    if (colon != std::string_view::npos) rest = text.substr(colon);
  }
  if (rest.empty()) return authority;
  if (rest.front() != ':') return std::nullopt;
  rest.remove_prefix(1);
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), authority.port);
  if (error != std::errc{} || end != rest.data() + rest.size() || authority.port == 0) return std::nullopt;
  return authority;
}

}  // namespace

HostRules::HostRules(bool secure, std::vector<std::string> names)
    : secure_(secure), names_(std::move(names)) {}

std::vector<std::string> HostRules::names_of_machine() {
  char text[HOST_NAME_MAX + 1] = {};
  if (gethostname(text, sizeof(text) - 1) != 0 || !is_name(text)) return {};
  std::string name = text;
  std::string label = name.substr(0, name.find('.'));
  std::vector<std::string> names{name, label + ".local"};
  if (label != name) names.push_back(std::move(label));
  return names;
}

Status HostRules::check_name(std::string_view name) {
  const std::optional<Address> literal = Address::parse(name);
  if (is_name(name) && (!ends_in_number(name) || (literal && literal->is_version_4()))) return {};
  return Status::error(StatusCode::invalid_argument,
                       "'%.*s' is no host: a name of letters, digits, dashes and dots, as cell7.example.org, "
                       "or an IPv4 address, as 203.0.113.7, without port",
                       static_cast<int>(std::min<std::size_t>(name.size(), 60)), name.data());
}

std::optional<std::string> HostRules::name_in(std::string_view host) {
  const std::optional<Authority> authority = parse_authority(host, 1);
  if (!authority) return std::nullopt;
  return std::string{authority->name};
}

bool HostRules::allows_host(std::string_view host, const Address& local_end) const noexcept {
  const std::optional<Authority> authority = parse_authority(host, 1);
  if (!authority) return false;
  if (const std::optional<Address> literal = Address::parse(authority->name); literal == local_end)
    return true;
  // An IPv4 address has one way to be written, so that it compares as names do.
  const auto is_it = [&](std::string_view name) { return equal_without_case(authority->name, name); };
  return is_it("localhost") || std::any_of(names_.begin(), names_.end(), is_it) ||
         std::any_of(declared_.begin(), declared_.end(), is_it);
}

bool HostRules::allows_origin(std::string_view origin, std::string_view host) const noexcept {
  if (origin.empty()) return true;
  const std::string_view scheme = secure_ ? "https://" : "http://";
  if (!origin.starts_with(scheme)) return false;
  const std::uint16_t default_port = secure_ ? 443 : 80;
  const std::optional<Authority> from = parse_authority(origin.substr(scheme.size()), default_port);
  const std::optional<Authority> ours = parse_authority(host, default_port);
  return from && ours && from->port == ours->port && from->in_brackets == ours->in_brackets &&
         equal_without_case(from->name, ours->name);
}

}  // namespace flexrf::panel
