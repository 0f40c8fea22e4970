#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config-gen/model/model.hpp"
#include "config-gen/read/eds.hpp"

namespace flexrf::config_gen {

// A device that is described by an EDS file, and the driver that asks something of it.
struct EdsUse {
  const Eds& eds;
  std::string file;                                             // as the row names it
  Position named_at;                                            // in the row
  const std::vector<NeededObject>& objects;                     // of the driver
  std::function<const Literal*(const std::string&)> parameter;  // of the configuration, by name
};

// Does the device have the objects, with the type, the access and the value that the driver counts on?
void check_eds(const EdsUse& use, Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
