// What unit bases, interface bases and driver bases have in common: parameter blocks, ComponentType.
#pragma once

#include <string>
#include <vector>

#include "config-gen/emit/plain_struct.hpp"
#include "config-gen/emit/text.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

// One block of parameters of a component: its struct, and what is declared beside.
struct BlockText {
  PlainStruct plain;
  std::vector<const Parameter*> parameters;
  bool empty() const { return parameters.empty(); }
};
// `what`: "Configuration", "Runtime" or "Feedback".
BlockText block_text(const Model& model, const std::string& class_name, const Space& space,
                     std::string_view what, const Position& position,
                     const std::vector<const ParameterBlock*>& blocks);

// The array of ParameterDescriptors; local to its file unless `exported`.
void define_parameters(const BlockText& block, bool exported, Text& out);
// "{&jog_runtime_descriptor, jog_runtime_parameters}", or "{}".
std::string block_initialiser(const BlockText& block);

// Of a driver: the struct Options of its base; the table, and the function that fills the struct.
void declare_options(const Driver& driver, const std::string& prefix, Text& out);
void define_options(const Driver& driver, const std::string& prefix, Text& out);

// The generated base classes and their sources, as files of a target.
std::string unit_base_header(const Model& model, const UnitType& unit);
std::string unit_base_source(const Model& model, const UnitType& unit);
std::string unit_construct_source(const UnitType& unit);
std::string interface_base_header(const Model& model, const Interface& interface);
std::string interface_base_source(const Model& model, const Interface& interface);
std::string driver_base_header(const Model& model, const Driver& driver);
std::string driver_base_source(const Model& model, const Driver& driver);
std::string driver_construct_source(const Model& model, const Driver& driver);

// Names that the generated code gives.
std::string unit_component_name(const UnitType& unit);    // jog_unit_component
std::string unit_construct_name(const UnitType& unit);    // construct_jog_unit
std::string driver_component_name(const Driver& driver);  // simulated_arm_driver_component
std::string driver_construct_name(const Driver& driver);  // construct_simulated_arm_driver
std::string driver_options_name(const Driver& driver);    // simulated_arm_driver_options
// The bytes of the author's class, as the application says it. The class may be outside of the namespace,
// where only the rules of look-up find it: of those of flexrf::user define_size() names the size there.
std::string size_name(const UnitType& unit);
std::string size_name(const Driver& driver);
void define_size(const UnitType& unit, Text& out);
void define_size(const Driver& driver, Text& out);
std::string block_struct_name(const std::string& class_name, std::string_view what);
BlockText driver_configuration(const Model& model, const Driver& driver);
// Of a driver that has some of its own: the interface's, then those. Else empty.
BlockText driver_runtime(const Model& model, const Driver& driver);
BlockText driver_feedback(const Model& model, const Driver& driver);

// What a device's resource is in C++.
std::string resource_type(Resource::Reader reader);
std::string resource_header(Resource::Reader reader);

}  // namespace flexrf::config_gen
