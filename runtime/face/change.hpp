// From what somebody names and writes to a request that the component's thread understands, and what its
// answer means.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/face/directory.hpp"
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

/// Presses that one request may count.
inline constexpr std::uint64_t most_presses = 100;

/// Finds "gain", "gains[2]", "limits.low" in a block, and reads its value into `structure`, which is as the
/// block's type says and else untouched. The refusal names the nearest known name, the driver that such a
/// parameter belongs to where the device has another, or what is wrong.
std::optional<Refusal> read_parameter(const ParameterBlock& block, const char* kind,
                                      const ComponentEntry& component, std::string_view path,
                                      JsonElement value, void* structure, ParameterPlace& found) noexcept;

// Each adds to a request; nothing is sent. `role` rises to what the parameters need.

/// A change for each member of `values`.
std::optional<Refusal> add_values(const ComponentEntry& component, JsonObject values,
                                  ParameterRequest& request, Role& role) noexcept;
/// The name of a hold or setting without a value.
std::optional<Refusal> add_name(const ComponentEntry& component, std::string_view path,
                                ParameterRequest& request, Role& role) noexcept;
/// So many presses of a button; makes it a request of the kind press.
std::optional<Refusal> add_presses(const ComponentEntry& component, std::string_view path,
                                   std::uint64_t count, ParameterRequest& request, Role& role) noexcept;

/// What an answer that is no acceptance tells who asked.
Refusal refusal_of(const ParameterAnswer& answer, const ComponentEntry& component) noexcept;
/// There was none within this time.
Refusal no_answer(const ComponentEntry& component, Duration waited) noexcept;

}  // namespace flexrf
