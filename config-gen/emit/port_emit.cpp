#include "config-gen/emit/port_emit.hpp"

#include <algorithm>

#include "config-gen/emit/component.hpp"

namespace flexrf::config_gen {
namespace {

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

bool has_slot_inputs(const Ports& ports) {
  return std::any_of(ports.inputs.begin(), ports.inputs.end(),
                     [](const InputPort& port) { return !port.queue; });
}

void define_port(std::string_view runtime, std::string_view name, std::string_view direction,
                 std::string_view type, std::string_view summary, bool operated, Text& out) {
  out << "    {\"" << name << "\", " << runtime << "PortDescriptor::Direction::" << direction << ", \""
      << type << "\", " << string_literal(summary) << ", " << bool_literal(operated) << "},\n";
}

}  // namespace

void add_port_includes(const Model& model, const Ports& ports, std::set<std::string>& own) {
  for (const InputPort& port : ports.inputs) own.insert(type_header(model.types[port.type]));
  for (const OutputPort& port : ports.outputs) own.insert(type_header(model.types[port.type]));
  for (const DevicePort& port : ports.devices) own.insert(model.interfaces[port.interface].header);
  if (!ports.inputs.empty() || !ports.outputs.empty()) own.insert("runtime/blackboard/ports.hpp");
}

void declare_ports(const Model& model, const Space& space, const Ports& ports, Text& members) {
  for (const InputPort& port : ports.inputs) {
    members << "  " << input_type(model, space, port) << " " << port.name << ";  ///< "
            << comment_text(port.summary) << "\n";
  }
  for (const OutputPort& port : ports.outputs) {
    members << "  " << output_type(model, space, port) << " " << port.name << ";  ///< "
            << comment_text(port.summary) << "\n";
  }
}

void connect_ports(const Ports& ports, const std::vector<OutputPort>& before, Text& out) {
  std::size_t slots = 0, queues = 0, outputs = 0, queue_outputs = 0;
  for (const OutputPort& port : before) ++(port.queue ? queue_outputs : outputs);
  for (const InputPort& port : ports.inputs) {
    if (port.queue) {
      out << "  " << port.name << ".connect(binding.queue_input(" << queues++ << "));\n";
    } else {
      out << "  " << port.name << ".connect(binding.context, binding.input(" << slots++ << "));\n";
    }
  }
  for (const OutputPort& port : ports.outputs) {
    out << "  " << port.name << ".connect(binding.context, binding."
        << (port.queue ? "queue_output(" : "output(") << (port.queue ? queue_outputs++ : outputs++)
        << "));\n";
  }
}

void declare_input_counters(const Space& space, const Ports& ports, Text& out) {
  if (!has_slot_inputs(ports)) return;
  out << "  " << space.runtime()
      << "InputCounters input_counters(std::size_t input, std::size_t member) const noexcept final;\n";
}

void define_input_counters(const Space& space, const std::string& class_name, const Ports& ports, Text& out) {
  if (!has_slot_inputs(ports)) return;
  out << "\n"
      << space.runtime() << "InputCounters " << class_name
      << "::input_counters(std::size_t input, std::size_t member) const noexcept {\n  switch (input) {\n";
  std::size_t number = 0;
  for (const InputPort& port : ports.inputs) {
    if (!port.queue) out << "    case " << number++ << ": return " << port.name << ".counters(member);\n";
  }
  out << "    default: return {};\n  }\n}\n";
}

void define_ports(const Model& model, const Space& space, const std::string& name, const Ports& ports,
                  Text& out) {
  if (ports.empty()) return;
  const std::string_view runtime = space.runtime();
  out << "constexpr " << runtime << "PortDescriptor " << name << "[] = {\n";
  for (const InputPort& port : ports.inputs) {
    const Type& type = model.types[port.type];
    define_port(runtime, port.name, port.queue ? "queue_input" : "input", type.name, port.summary,
                type.operated, out);
  }
  for (const OutputPort& port : ports.outputs) {
    define_port(runtime, port.name, port.queue ? "queue_output" : "output", model.types[port.type].name,
                port.summary, false, out);
  }
  for (const DevicePort& port : ports.devices) {
    const Interface& interface = model.interfaces[port.interface];
    define_port(runtime, port.name, "device", interface.class_name, port.summary, interface.operated, out);
  }
  out << "};\n";
}

}  // namespace flexrf::config_gen
