#include "image/helper/address_setting.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <optional>

#include "image/helper/answer.hpp"
#include "image/helper/named_lines.hpp"

namespace flexrf::helper {
namespace {

constexpr unsigned shortest_prefix = 8;
constexpr unsigned longest_prefix = 30;

struct Network {
  std::uint32_t address = 0;
  unsigned prefix = 32;

  std::uint32_t mask() const noexcept { return ~std::uint32_t{0} << (32 - prefix); }
  std::uint32_t base() const noexcept { return address & mask(); }
  bool has(std::uint32_t other) const noexcept { return (other & mask()) == base(); }
  /// It stands for the network, or for all in it.
  bool is_reserved(std::uint32_t other) const noexcept {
    return other == base() || other == (base() | ~mask());
  }
};

std::optional<std::uint32_t> parse_address(std::string_view text) {
  in_addr address{};
  // It would take what stands before a NUL.
  if (text.find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
  if (inet_pton(AF_INET, std::string{text}.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

std::optional<Network> parse_network(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const std::optional<std::uint32_t> address = parse_address(text.substr(0, slash));
  const std::string_view digits = text.substr(slash + 1);
  Network network;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), network.prefix);
  if (!address || error != std::errc{} || end != digits.data() + digits.size() ||
      network.prefix < shortest_prefix || network.prefix > longest_prefix)
    return std::nullopt;
  network.address = *address;
  return network;
}

/// This host, loopback, link-local (which needs no setting), groups and what is reserved (RFC 6890).
bool is_for_hosts(std::uint32_t address) noexcept {
  const std::uint32_t first = address >> 24;
  return first != 0 && first != 127 && first < 224 && (address >> 16) != 0xa9fe;
}

}  // namespace

const char* name_of(AddressWay way) noexcept {
  constexpr std::array<const char*, 3> names = {"image", "dhcp", "fixed"};
  return names[static_cast<std::size_t>(way)];
}

std::variant<AddressSetting, std::string> parse_setting(std::string_view address, std::string_view gateway) {
  AddressSetting setting{AddressWay::fixed, std::string{address}, std::string{gateway}};
  if (address == "image" || address == "dhcp") {
    if (!gateway.empty()) return "a gateway is set with a fixed address alone; leave it out";
    return AddressSetting{address == "dhcp" ? AddressWay::dhcp : AddressWay::image, {}, {}};
  }
  const std::optional<Network> network = parse_network(address);
  if (!network)
    return "'address' is " + in_quotes(address) +
           "; it is 'dhcp', 'image' (as this version says), or as 192.168.1.10/24, with a prefix of 8 to 30";
  if (!is_for_hosts(network->address))
    return in_quotes(address) + " is no address for a machine; take one of the machine's network";
  if (network->is_reserved(network->address))
    return in_quotes(address) + " stands for the whole network; take another one of it";
  if (gateway.empty()) return setting;
  const std::optional<std::uint32_t> next = parse_address(gateway);
  if (!next) return "'gateway' is " + in_quotes(gateway) + "; it is as 192.168.1.1, or empty";
  if (!network->has(*next) || network->is_reserved(*next) || *next == network->address)
    return "the gateway " + in_quotes(gateway) + " is none of the other machines in the network of " +
           in_quotes(address);
  return setting;
}

std::string network_file(std::string_view interface, const AddressSetting& setting) {
  std::string text = "# Set at the panel.\n[Match]\nName=";
  text.append(interface).append("\n\n[Network]\n");
  if (setting.way == AddressWay::fixed) {
    text.append("Address=").append(setting.address).append("\n");
    if (!setting.gateway.empty()) text.append("Gateway=").append(setting.gateway).append("\n");
    text.append("LinkLocalAddressing=no\n");
  } else {
    text.append("DHCP=ipv4\nLinkLocalAddressing=ipv4\n");
  }
  text.append("IPv6AcceptRA=no\nLLMNR=no\nMulticastDNS=no\nLLDP=no\nEmitLLDP=no\n");
  if (setting.way == AddressWay::dhcp)
    text.append(
        "\n[DHCPv4]\nClientIdentifier=mac\nUseDNS=no\nUseNTP=no\nUseHostname=no\nUseRoutes=no\nUseGateway="
        "yes\n");
  return text;
}

AddressSetting setting_in(std::string_view network_file) {
  const NamedLines lines = NamedLines::of(network_file);
  const std::string address = lines.text("Address");
  if (address.empty()) return {AddressWay::dhcp, {}, {}};
  return {AddressWay::fixed, address, lines.text("Gateway")};
}

bool share_network(std::string_view one, std::string_view other) {
  const std::optional<Network> first = parse_network(one);
  const std::optional<Network> second = parse_network(other);
  return first && second && (first->has(second->address) || second->has(first->address));
}

}  // namespace flexrf::helper
