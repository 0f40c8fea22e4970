// A component's type with ranges that the application's table narrowed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/executive/application.hpp"

namespace flexrf {

/// Stands in for the type that the component's own table made, so that every check sees the narrower range.
/// Made before the start, unchanged and in its place from then on.
class NarrowedType {
 public:
  /// Passes over ranges of other components, and those of parameters that the chosen driver does not have.
  NarrowedType(const ComponentType& type, std::uint16_t component, std::span<const NarrowedRange> ranges);
  NarrowedType(const NarrowedType&) = delete;
  NarrowedType& operator=(const NarrowedType&) = delete;

  const ComponentType& type() const noexcept { return type_; }

 private:
  std::vector<ParameterDescriptor> configuration_;
  std::vector<ParameterDescriptor> runtime_;
  ComponentType type_;
};

}  // namespace flexrf
