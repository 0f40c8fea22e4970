// What a device's row says of its robot: urdf = "FILE", or a table with what the file lacks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config-gen/read/row.hpp"
#include "config-gen/urdf/urdf_reader.hpp"

namespace flexrf::config_gen {

struct RobotRow {
  std::optional<std::string> file;  // as it is written; none: which has been said
  std::vector<std::string> packages;
  UrdfRow urdf;
};

// `key` is there. `device`: the row's name, as "arm".
RobotRow read_robot_row(Row& row, const std::string& key, const std::string& device,
                        Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
