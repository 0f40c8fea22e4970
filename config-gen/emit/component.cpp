#include "config-gen/emit/component.hpp"

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

std::string bound(const Literal& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.value)) {
    return double_literal(static_cast<double>(*integer));
  }
  if (const auto* real = std::get_if<double>(&value.value)) return double_literal(*real);
  if (const auto* flag = std::get_if<bool>(&value.value)) return *flag ? "1.0" : "0.0";
  return "0.0";
}

std::string role_name(PanelRole role) {
  switch (role) {
    case PanelRole::viewer:
      return "viewer";
    case PanelRole::op:
      return "operator_";
    case PanelRole::engineer:
      return "engineer";
    case PanelRole::admin:
      return "admin";
  }
  return "";
}

const char* kind_name(Need::Of of) {
  return of == Need::Of::motion ? "motion" : of == Need::Of::runtime ? "runtime" : "feedback";
}

std::string needs_name(const BlockText& block, std::size_t parameter) {
  return block.plain.identifier + "_needs_" + std::to_string(parameter);
}

void define_needs(const BlockText& block, Text& out) {
  const std::string runtime(block.plain.space.runtime());
  for (std::size_t i = 0; i < block.parameters.size(); ++i) {
    const std::vector<Need>& needs = block.parameters[i]->needs;
    if (needs.empty()) continue;
    out << "constexpr " << runtime << "CommandNeed " << needs_name(block, i) << "[" << needs.size()
        << "] = {\n";
    for (const Need& need : needs) {
      out << "    {" << runtime << "CommandNeed::Kind::" << kind_name(need.of) << ", "
          << string_literal(need.field) << ", " << need.numbers << "ULL, " << string_literal(need.reason)
          << "},\n";
    }
    out << "};\n";
  }
}

}  // namespace

std::string block_struct_name(const std::string& class_name, std::string_view what) {
  return class_name + std::string(what);
}

namespace {

std::string block_summary(const std::string& class_name, std::string_view what) {
  return what == "Configuration" ? "Configuration of " + class_name + ": read at initialise()."
         : what == "Runtime"     ? "Runtime parameters of " + class_name + ", in force for a step."
                                 : "Feedback of " + class_name + ", published after each step.";
}

BlockText driver_block(const Model& model, const Driver& driver, std::string_view what,
                       const ParameterBlock& own, const ParameterBlock& before) {
  BlockText block;
  if (own.empty()) return block;
  const Interface& interface = model.interfaces[driver.interface];
  const Space space(driver.space);
  block.plain = plain_struct(model, block_struct_name(driver.class_name, what), space,
                             block_summary(driver.class_name, what), driver.position, own,
                             space.of(interface, block_struct_name(interface.class_name, what)), before);
  for (const ParameterBlock* part : {&before, &own})
    for (const Parameter& parameter : part->parameters) block.parameters.push_back(&parameter);
  return block;
}

}  // namespace

BlockText block_text(const Model& model, const std::string& class_name, const Space& space,
                     std::string_view what, const Position& position,
                     const std::vector<const ParameterBlock*>& blocks) {
  BlockText block;
  block.plain = plain_struct(model, block_struct_name(class_name, what), space,
                             block_summary(class_name, what), position, blocks);
  for (const ParameterBlock* part : blocks) {
    for (const Parameter& parameter : part->parameters) block.parameters.push_back(&parameter);
  }
  return block;
}

void define_parameters(const BlockText& block, bool exported, Text& out) {
  if (block.empty()) return;
  const std::string& name = block.plain.identifier;
  define_needs(block, out);
  const std::string runtime(block.plain.space.runtime());
  out << (exported ? "constinit const" : "constexpr") << " " << runtime << "ParameterDescriptor " << name
      << "_parameters[" << block.parameters.size() << "] = {\n";
  for (std::size_t i = 0; i < block.parameters.size(); ++i) {
    const Parameter& parameter = *block.parameters[i];
    const bool persist = parameter.kind == Parameter::Kind::runtime && parameter.persist;
    out << "    {&" << name << "_fields[" << i << "], " << bool_literal(parameter.low.has_value()) << ", "
        << bool_literal(persist) << ", " << runtime << "Role::" << role_name(parameter.role) << ", "
        << (parameter.low ? bound(*parameter.low) : "0.0") << ", "
        << (parameter.high ? bound(*parameter.high) : "0.0") << ", " << string_literal(parameter.widget)
        << ", " << string_literal(parameter.label) << ", " << string_literal(parameter.menu) << ", "
        << (parameter.needs.empty() ? std::string("{}") : needs_name(block, i)) << "},\n";
  }
  out << "};\n";
}

std::string block_initialiser(const BlockText& block) {
  if (block.empty()) return "{}";
  return "{&" + block.plain.identifier + "_descriptor, " + block.plain.identifier + "_parameters}";
}

std::string unit_component_name(const UnitType& unit) {
  return unit.name + "_unit_component";
}
std::string unit_construct_name(const UnitType& unit) {
  return "construct_" + unit.name + "_unit";
}
std::string driver_component_name(const Driver& driver) {
  return driver.stem + "_driver_component";
}
std::string driver_construct_name(const Driver& driver) {
  return "construct_" + driver.stem + "_driver";
}
std::string driver_options_name(const Driver& driver) {
  return driver.stem + "_driver_options";
}
std::string size_name(const UnitType& unit) {
  return unit.space == user_space ? std::string(user_space) + "::" + unit.name + "_unit_size"
                                  : "sizeof(" + unit.class_name + ")";
}
std::string size_name(const Driver& driver) {
  return driver.space == user_space ? std::string(user_space) + "::" + driver.stem + "_driver_size"
                                    : "sizeof(" + driver.class_name + ")";
}
void define_size(const UnitType& unit, Text& out) {
  if (unit.space == user_space)
    out << "constexpr std::size_t " << unit.name << "_unit_size = sizeof(" << unit.class_name << ");\n";
}
void define_size(const Driver& driver, Text& out) {
  if (driver.space == user_space)
    out << "constexpr std::size_t " << driver.stem << "_driver_size = sizeof(" << driver.class_name << ");\n";
}

BlockText driver_configuration(const Model& model, const Driver& driver) {
  const Interface& interface = model.interfaces[driver.interface];
  return block_text(model, driver.class_name, Space(driver.space), "Configuration", driver.position,
                    {&interface.configuration, &driver.configuration});
}

BlockText driver_runtime(const Model& model, const Driver& driver) {
  return driver_block(model, driver, "Runtime", driver.runtime, model.interfaces[driver.interface].runtime);
}
BlockText driver_feedback(const Model& model, const Driver& driver) {
  return driver_block(model, driver, "Feedback", driver.feedback,
                      model.interfaces[driver.interface].feedback);
}

std::string resource_type(Resource::Reader reader) {
  switch (reader) {
    case Resource::Reader::urdf:
      return "KinematicChain";
    case Resource::Reader::register_map:
      return "ModbusRegisterMap";
  }
  return "";
}

std::string resource_header(Resource::Reader reader) {
  switch (reader) {
    case Resource::Reader::urdf:
      return "motion/kinematic_chain.hpp";
    case Resource::Reader::register_map:
      return "hal/modbus/link/interface/register_map.hpp";
  }
  return "";
}

}  // namespace flexrf::config_gen
