#include "hal/robot_arm/melfa_mxt/melfa_mxt.hpp"

#include <cstdio>
#include <string>

namespace flexrf {

Status MelfaMxt::open_link() {
  const std::string address{configuration.address_view()};
  std::snprintf(where_.data(), where_.size(), "the controller at %s:%u", address.c_str(),
                unsigned{configuration.port});
  return link_.open(address.c_str(), configuration.port, configuration.local_port);
}

}  // namespace flexrf
