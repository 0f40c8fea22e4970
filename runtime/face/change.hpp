// From what a client names and writes to a request that the component's thread understands.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/face/directory.hpp"
#include "runtime/face/refusal.hpp"
#include "runtime/json/json_reader.hpp"
#include "runtime/parameters/request.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {

/// A parameter, or a part of one, that a path names.
struct ParameterPlace {
  const ParameterDescriptor* parameter = nullptr;
  std::uint16_t index = no_parameter;  ///< in its block
  FieldPlace place;

  std::uint32_t offset() const noexcept { return place.offset - parameter->field->offset; }
};

/// "gain", "gains[2]", "limits.low" in a block; the refusal names the nearest known name.
std::optional<Refusal> find_parameter(const ParameterBlock& block, const char* kind,
                                      const ComponentEntry& component, std::string_view path,
                                      ParameterPlace& found) noexcept;

/// Adds a change for each member of `values`. `role` rises to what they need. Nothing is sent.
std::optional<Refusal> add_values(const ComponentEntry& component, JsonObject values,
                                  ParameterRequest& request, Role& role) noexcept;

/// Adds the name of a button, hold or setting without a value.
std::optional<Refusal> add_name(const ComponentEntry& component, std::string_view path,
                                ParameterRequest& request, Role& role) noexcept;

/// What an answer that is no acceptance tells the client.
Refusal refusal_of(const ParameterAnswer& answer, const ComponentEntry& component) noexcept;

}  // namespace flexrf
