// The generated base class of a unit, and the function that constructs the author's class.
#include "config-gen/emit/component.hpp"
#include "config-gen/emit/port_emit.hpp"

namespace flexrf::config_gen {
namespace {

struct Blocks {
  BlockText configuration, runtime, feedback;
};

Blocks blocks_of(const Model& model, const UnitType& unit) {
  return {block_text(model, unit.class_name, Space(unit.space), "Configuration", unit.position,
                     {&unit.configuration}),
          block_text(model, unit.class_name, Space(unit.space), "Runtime", unit.position, {&unit.runtime}),
          block_text(model, unit.class_name, Space(unit.space), "Feedback", unit.position, {&unit.feedback})};
}

Ports ports_of(const UnitType& unit) {
  return {unit.inputs, unit.outputs, unit.devices};
}

void declare_members(const Model& model, const UnitType& unit, const Blocks& blocks, Text& out) {
  const Space space(unit.space);
  Text members;
  declare_ports(model, space, ports_of(unit), members);
  for (const DevicePort& port : unit.devices) {
    const Interface& interface = model.interfaces[port.interface];
    members << "  " << space.of(interface, interface.class_name) << "* " << port.name << " = nullptr;  ///< "
            << comment_text(port.summary) << "\n";
  }
  if (unit.cell_access) members << "  " << space.runtime() << "CellAccess cell;\n";
  if (!blocks.configuration.empty()) members << "  Configuration configuration;\n";
  if (!blocks.runtime.empty()) members << "  Runtime runtime;\n";
  if (!blocks.feedback.empty()) members << "  Feedback feedback;\n";
  if (!members.str().empty()) out << "\n protected:\n" << members.str();
}

}  // namespace

std::string unit_base_header(const Model& model, const UnitType& unit) {
  const Blocks blocks = blocks_of(model, unit);
  const Space space(unit.space);
  const std::string runtime(space.runtime());
  std::set<std::string> system, own{"runtime/unit/unit.hpp"};
  for (const BlockText* block : {&blocks.configuration, &blocks.runtime, &blocks.feedback}) {
    if (!block->empty()) add_includes(model, block->plain, system, own);
  }
  add_port_includes(model, ports_of(unit), own);
  if (unit.cell_access) own.insert("runtime/executive/cell_access.hpp");

  Text out;
  out << generated_note(unit.file) << "#pragma once\n\n"
      << include_lines(system, own) << "\n"
      << space.open() << "\n";
  for (const BlockText* block : {&blocks.configuration, &blocks.runtime, &blocks.feedback}) {
    if (!block->empty()) define_struct(model, block->plain, out), out << "\n";
  }
  out << "/// " << comment_text(unit.summary) << "\nclass " << unit.base_class << " : public " << runtime
      << "Unit {\n public:\n";
  if (!blocks.configuration.empty())
    out << "  using Configuration = " << blocks.configuration.plain.name << ";\n";
  if (!blocks.runtime.empty()) out << "  using Runtime = " << blocks.runtime.plain.name << ";\n";
  if (!blocks.feedback.empty()) out << "  using Feedback = " << blocks.feedback.plain.name << ";\n";
  if (!blocks.runtime.empty()) {
    out << "\n  /// May refuse a set of runtime parameters as a whole; its cause goes to who asked. Between "
           "two steps.\n"
        << "  virtual " << runtime << "Status accept(const Runtime& /*proposed*/) { return {}; }\n";
  }
  out << "\n  void connect(const " << runtime << "UnitBinding& binding) noexcept final;\n"
      << "  const " << runtime << "ComponentType& component_type() const noexcept final;\n"
      << "  " << runtime << "ParameterMemory parameter_memory() noexcept final;\n";
  if (unit.cell_access)
    out << "  " << runtime << "CellAccess* cell_access() noexcept final { return &cell; }\n";
  declare_input_counters(space, ports_of(unit), out);
  if (!blocks.runtime.empty())
    out << "  " << runtime << "Status accept_runtime(const void* proposed) noexcept final;\n";
  declare_members(model, unit, blocks, out);
  out << "};\n\nextern const " << runtime << "ComponentType " << unit_component_name(unit) << ";\n"
      << runtime << "Unit* " << unit_construct_name(unit) << "(void* storage);\n\n"
      << space.close();
  return out.take();
}

std::string unit_base_source(const Model& model, const UnitType& unit) {
  const Blocks blocks = blocks_of(model, unit);
  const Space space(unit.space);
  const std::string runtime(space.runtime());
  Text out;
  out << generated_note(unit.file) << "#include \"" << unit.base_header
      << "\"\n\n#include <cstddef>\n#include <type_traits>\n\n"
      << space.open() << "\n";
  Text local;
  for (const BlockText* block : {&blocks.configuration, &blocks.runtime, &blocks.feedback}) {
    if (block->empty()) continue;
    define_descriptor(model, block->plain, out);
    out << "\n";
    define_parameters(*block, false, local);
  }
  define_ports(model, space, unit.name + "_unit_ports", ports_of(unit), local);
  if (!local.str().empty()) out << "namespace {\n\n" << local.str() << "\n}  // namespace\n\n";
  const bool has_ports = !ports_of(unit).empty();
  out << "constinit const " << runtime << "ComponentType " << unit_component_name(unit) << "{\n    \""
      << unit.name << "\", " << string_literal(unit.summary) << ",\n    "
      << block_initialiser(blocks.configuration) << ",\n    " << block_initialiser(blocks.runtime)
      << ",\n    " << block_initialiser(blocks.feedback) << ",\n    "
      << (has_ports ? unit.name + "_unit_ports" : "{}") << "};\n\n";

  out << "void " << unit.base_class << "::connect(const " << runtime << "UnitBinding& "
      << (has_ports ? "binding" : "/*binding*/") << ") noexcept {\n";
  connect_ports(ports_of(unit), {}, out);
  for (std::size_t i = 0; i < unit.devices.size(); ++i) {
    out << "  " << unit.devices[i].name << " = static_cast<"
        << space.of(model.interfaces[unit.devices[i].interface],
                    model.interfaces[unit.devices[i].interface].class_name)
        << "*>(*binding.devices[" << i << "]);\n";
  }
  out << "}\n\nconst " << runtime << "ComponentType& " << unit.base_class
      << "::component_type() const noexcept { return " << unit_component_name(unit) << "; }\n\n"
      << runtime << "ParameterMemory " << unit.base_class << "::parameter_memory() noexcept {\n  return {"
      << (blocks.configuration.empty() ? "nullptr" : "&configuration") << ", "
      << (blocks.runtime.empty() ? "nullptr" : "&runtime") << ", "
      << (blocks.feedback.empty() ? "nullptr" : "&feedback") << "};\n}\n";
  define_input_counters(space, unit.base_class, ports_of(unit), out);
  if (!blocks.runtime.empty()) {
    out << "\n"
        << runtime << "Status " << unit.base_class << "::accept_runtime(const void* proposed) noexcept {\n"
        << "  return accept(*static_cast<const Runtime*>(proposed));\n}\n";
  }
  out << "\n" << space.close();
  return out.take();
}

std::string unit_construct_source(const UnitType& unit) {
  const std::string row = short_path(unit.file) + ": class " + unit.class_name;
  const Space space(unit.space);
  Text out;
  out << generated_note(unit.file) << "#include <new>\n#include <type_traits>\n\n"
      << include_line(unit.header) << "\n"
      << space.open() << "\n"
      << "static_assert(std::is_base_of_v<" << unit.base_class << ", " << unit.class_name
      << ">,\n              " << string_literal(row + " must derive from " + unit.base_class) << ");\n"
      << "static_assert(!std::is_abstract_v<" << unit.class_name << ">,\n              "
      << string_literal(row + " must have step()") << ");\n\n"
      << space.runtime() << "Unit* " << unit_construct_name(unit) << "(void* storage) { return new (storage) "
      << unit.class_name << "; }\n\n"
      << space.close();
  return out.take();
}

}  // namespace flexrf::config_gen
