// What decides an interface's IPv4 address.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace flexrf::helper {

enum class AddressWay : std::uint8_t {
  image,  ///< the files of the version that runs
  dhcp,
  fixed
};
const char* name_of(AddressWay way) noexcept;

struct AddressSetting {
  AddressWay way = AddressWay::image;
  std::string address;  ///< fixed: "192.168.1.10/24"
  std::string gateway;  ///< fixed: "192.168.1.1", or none

  bool operator==(const AddressSetting&) const = default;
};

/// `address`: "image", "dhcp", or IPv4 with the length of its network's prefix (8 to 30); `gateway`: IPv4
/// within that network, or empty. The setting, or what is wrong, with what to do.
std::variant<AddressSetting, std::string> parse_setting(std::string_view address, std::string_view gateway);

/// For systemd-networkd (systemd.network(5)); of a setting other than `image`.
std::string network_file(std::string_view interface, const AddressSetting& setting);
/// What such a file sets.
AddressSetting setting_in(std::string_view network_file);

/// Of two as "192.168.1.10/24"; false for what is none.
bool share_network(std::string_view one, std::string_view other);

}  // namespace flexrf::helper
