// The part of descriptor.json that places widgets.
#pragma once

#include <nlohmann/json.hpp>

#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

nlohmann::ordered_json widgets_json(const Model& model);

}  // namespace flexrf::config_gen
