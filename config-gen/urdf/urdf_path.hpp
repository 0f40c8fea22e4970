// Which of a URDF's joints are the arm's. Private to config-gen/urdf.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config-gen/urdf/urdf_document.hpp"
#include "config-gen/urdf/urdf_reader.hpp"

namespace flexrf::config_gen {

struct UrdfPath {
  UrdfTransform start;                       // the first joint's parent link, in the base frame
  std::vector<const DocumentJoint*> joints;  // from there to the tool, fixed ones too
};

// As read_urdf() says; nothing where there is none, which is then in `diagnostics`.
std::optional<UrdfPath> find_path(UrdfDocument& document, const UrdfRow& row, Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
