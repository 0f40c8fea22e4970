#include "runtime/executive/narrowed_type.hpp"

#include <algorithm>
#include <cstring>

namespace flexrf {

NarrowedType::NarrowedType(const ComponentType& type, std::uint16_t component,
                           std::span<const NarrowedRange> ranges)
    : configuration_(type.configuration.parameters.begin(), type.configuration.parameters.end()),
      runtime_(type.runtime.parameters.begin(), type.runtime.parameters.end()),
      type_(type) {
  type_.configuration.parameters = configuration_;
  type_.runtime.parameters = runtime_;
  for (const NarrowedRange& range : ranges) {
    if (range.component != component) continue;
    std::vector<ParameterDescriptor>& parameters =
        range.kind == ParameterKind::configuration ? configuration_ : runtime_;
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&range](const ParameterDescriptor& parameter) {
          return std::strcmp(parameter.field->name, range.parameter) == 0;
        });
    if (found == parameters.end()) continue;
    found->has_range = true;
    found->minimum = range.minimum;
    found->maximum = range.maximum;
  }
}

}  // namespace flexrf
