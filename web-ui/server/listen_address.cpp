#include "web-ui/server/listen_address.hpp"

#include <charconv>
#include <optional>

namespace flexrf::panel {
namespace {

Status wrong(std::string_view text, const char* what) {
  return Status::error(StatusCode::invalid_argument,
                       "--panel %.*s: %s; give ADDRESS:PORT with a numeric address, as 127.0.0.1:8080 or "
                       "[::1]:8080, or off",
                       static_cast<int>(text.size()), text.data(), what);
}

}  // namespace

bool ListenAddress::is_loopback() const noexcept {
  const std::optional<Address> parsed = Address::parse(address);
  return parsed && parsed->is_loopback();
}

bool ListenAddress::is_any() const noexcept {
  const std::optional<Address> parsed = Address::parse(address);
  return parsed == Address::parse("0.0.0.0") || parsed == Address::parse("::");
}

std::string ListenAddress::text() const {
  const bool is_version_6 = address.find(':') != std::string::npos;
  return (is_version_6 ? "[" + address + "]" : address) + ":" + std::to_string(port);
}

Result<ListenAddress> parse_listen_address(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return wrong(text, "there is no port");
  std::string_view address = text.substr(0, colon);
  const std::string_view port = text.substr(colon + 1);
  ListenAddress result;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), result.port);
  if (error != std::errc{} || end != port.data() + port.size()) {
    return wrong(text, "the port is no number from 0 to 65535");
  }
  if (address == "localhost") address = "127.0.0.1";
  if (address.starts_with('[') && address.ends_with(']')) address = address.substr(1, address.size() - 2);
  if (!Address::parse(address)) return wrong(text, "this is no numeric address");
  result.address = address;
  return result;
}

}  // namespace flexrf::panel
