// What is declared of a component's parameters, and where their values live.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

enum class ParameterKind : std::uint8_t { configuration, runtime, feedback };

/// Least role that may change a parameter or press an action. Ascending rights.
enum class Role : std::uint8_t { viewer, operator_, engineer, admin };
constexpr const char* name_of(Role role) noexcept {
  constexpr const char* names[] = {"viewer", "operator", "engineer", "admin"};
  return names[static_cast<std::size_t>(role)];
}

/// What must be so for a button or a hold to have an effect, as its table says (`needs`).
struct CommandNeed {
  enum class Kind : std::uint8_t { motion, runtime, feedback };
  Kind kind;
  const char* field;      ///< its path; of motion: ""
  std::uint64_t numbers;  ///< bit n: a boolean (0, 1) or an enumeration of this number will do
  const char* reason;     ///< "state must be ready or held": what the operator reads
};

/// One declared parameter: a field of its block's struct, with what the panel and the checks need beside.
struct ParameterDescriptor {
  const FieldDescriptor* field;
  bool has_range;
  bool persist;  ///< runtime only: saved to and restored from the configuration file
  Role role;
  double minimum;  ///< for every element; valid when has_range
  double maximum;
  const char* widget;                       ///< "" chooses by kind and type
  const char* label;                        ///< "" makes one from the name
  const char* menu;                         ///< "" for none
  std::span<const CommandNeed> needs = {};  ///< all of them; of buttons and holds
};

/// All parameters of one kind of a component type. They are the fields of one plain struct.
struct ParameterBlock {
  const TypeDescriptor* type = nullptr;  ///< null when the component has none of this kind
  std::span<const ParameterDescriptor> parameters;
};

/// A port, for reports, references and the panel.
struct PortDescriptor {
  enum class Direction : std::uint8_t { input, output, queue_input, queue_output, device };
  const char* name;
  Direction direction;
  const char* type;  ///< data type, or interface
  const char* summary;
  /// Through it a person operates the unit: `operated` in the table of its type or interface.
  bool operated = false;
};

/// A type of unit, or a driver of a device: what config-gen knows of it from its table.
struct ComponentType {
  const char* name;
  const char* summary;
  ParameterBlock configuration;
  ParameterBlock runtime;
  ParameterBlock feedback;
  std::span<const PortDescriptor> ports;
};

/// Where the values of one component live. Null where it has none of the kind.
struct ParameterMemory {
  void* configuration = nullptr;
  void* runtime = nullptr;
  void* feedback = nullptr;
};

}  // namespace flexrf
