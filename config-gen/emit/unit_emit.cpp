// The generated base class of a unit, and the function that constructs the author's class.
#include <algorithm>

#include "config-gen/emit/component.hpp"

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

std::string port_type(const Model& model, const Space& space, const char* kind, Index type) {
  return std::string(space.runtime()) + kind + "<" + space.of(model.types[type], model.types[type].name) +
         ">";
}

std::string input_type(const Model& model, const Space& space, const InputPort& port) {
  return port_type(model, space, port.queue ? "QueueInput" : port.range ? "InputRange" : "Input", port.type);
}

std::string output_type(const Model& model, const Space& space, const OutputPort& port) {
  return port_type(model, space, port.queue ? "QueueOutput" : "Output", port.type);
}

bool has_slot_inputs(const UnitType& unit) {
  return std::any_of(unit.inputs.begin(), unit.inputs.end(),
                     [](const InputPort& port) { return !port.queue; });
}

// Reports ask each input by its number what it has read.
void define_input_counters(const UnitType& unit, Text& out) {
  if (!has_slot_inputs(unit)) return;
  out << "\n"
      << Space(unit.space).runtime() << "InputCounters " << unit.base_class
      << "::input_counters(std::size_t input, std::size_t member) const noexcept {\n  switch (input) {\n";
  std::size_t number = 0;
  for (const InputPort& port : unit.inputs) {
    if (!port.queue) out << "    case " << number++ << ": return " << port.name << ".counters(member);\n";
  }
  out << "    default: return {};\n  }\n}\n";
}

void declare_members(const Model& model, const UnitType& unit, const Blocks& blocks, Text& out) {
  const Space space(unit.space);
  Text members;
  for (const InputPort& port : unit.inputs) {
    members << "  " << input_type(model, space, port) << " " << port.name << ";  ///< "
            << comment_text(port.summary) << "\n";
  }
  for (const OutputPort& port : unit.outputs) {
    members << "  " << output_type(model, space, port) << " " << port.name << ";  ///< "
            << comment_text(port.summary) << "\n";
  }
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
  for (const InputPort& port : unit.inputs) own.insert(type_header(model.types[port.type]));
  for (const OutputPort& port : unit.outputs) own.insert(type_header(model.types[port.type]));
  for (const DevicePort& port : unit.devices) own.insert(model.interfaces[port.interface].header);
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
  if (has_slot_inputs(unit)) {
    out << "  " << runtime
        << "InputCounters input_counters(std::size_t input, std::size_t member) const noexcept final;\n";
  }
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
  define_ports(model, unit, local);
  if (!local.str().empty()) out << "namespace {\n\n" << local.str() << "\n}  // namespace\n\n";
  const bool has_ports = !unit.inputs.empty() || !unit.outputs.empty() || !unit.devices.empty();
  out << "constinit const " << runtime << "ComponentType " << unit_component_name(unit) << "{\n    \""
      << unit.name << "\", " << string_literal(unit.summary) << ",\n    "
      << block_initialiser(blocks.configuration) << ",\n    " << block_initialiser(blocks.runtime)
      << ",\n    " << block_initialiser(blocks.feedback) << ",\n    "
      << (has_ports ? unit.name + "_unit_ports" : "{}") << "};\n\n";

  out << "void " << unit.base_class << "::connect(const " << runtime << "UnitBinding& "
      << (has_ports ? "binding" : "/*binding*/") << ") noexcept {\n";
  std::size_t slots = 0, queues = 0, outputs = 0, queue_outputs = 0;
  for (const InputPort& port : unit.inputs) {
    if (port.queue) {
      out << "  " << port.name << ".connect(binding.queue_inputs[" << queues++ << "]);\n";
    } else {
      out << "  " << port.name << ".connect(binding.context, binding.inputs[" << slots++ << "]);\n";
    }
  }
  for (const OutputPort& port : unit.outputs) {
    const bool queue = port.queue;
    out << "  " << port.name << ".connect(binding.context, binding." << (queue ? "queue_outputs" : "outputs")
        << "[" << (queue ? queue_outputs++ : outputs++) << "]);\n";
  }
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
  define_input_counters(unit, out);
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
