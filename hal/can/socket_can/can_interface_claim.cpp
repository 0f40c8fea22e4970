#include "hal/can/socket_can/can_interface_claim.hpp"

#include <map>

namespace flexrf {
namespace {

/// Never destroyed: a bus that lives until the process ends releases its interface after static objects.
std::map<std::string, std::string>& buses() {
  static auto* const by_interface = new std::map<std::string, std::string>;
  return *by_interface;
}

}  // namespace

Status CanInterfaceClaim::take(const std::string& interface, const std::string& bus) {
  release();
  const auto [owner, is_free] = buses().emplace(interface, bus);
  if (!is_free)
    return Status::error(StatusCode::invalid_argument,
                         "the CAN interface %s is that of bus `%s` already: give each bus its own, or put "
                         "the devices of both on one bus",
                         interface.c_str(), owner->second.c_str());
  interface_ = interface;
  return {};
}

void CanInterfaceClaim::release() {
  if (!interface_.empty()) buses().erase(interface_);
  interface_.clear();
}

}  // namespace flexrf
