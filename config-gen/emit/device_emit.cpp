// The generated base classes of an interface and of a driver, and the function that constructs a driver.
#include <tuple>

#include "config-gen/emit/component.hpp"
#include "config-gen/emit/port_emit.hpp"

namespace flexrf::config_gen {
namespace {

BlockText runtime_of(const Model& model, const Interface& interface) {
  return block_text(model, interface.class_name, Space(interface.space), "Runtime", interface.position,
                    {&interface.runtime});
}
BlockText feedback_of(const Model& model, const Interface& interface) {
  return block_text(model, interface.class_name, Space(interface.space), "Feedback", interface.position,
                    {&interface.feedback});
}
std::string base_of(const Interface& interface) {
  return interface.class_name + "Interface";
}

void declare_parameters(const BlockText& block, Text& out) {
  if (block.empty()) return;
  out << "extern const " << block.plain.space.runtime() << "ParameterDescriptor " << block.plain.identifier
      << "_parameters[" << block.parameters.size() << "];\n";
}

// As that of component.hpp, of a block that is the interface's.
std::string block_initialiser(const BlockText& block, const Space& space, const Interface& interface) {
  if (block.empty()) return "{}";
  return "{&" + space.of(interface, block.plain.identifier) + "_descriptor, " +
         space.of(interface, block.plain.identifier) + "_parameters}";
}

// What moves something is led by the guard, and what is led by it says so in its table. A bus has what it
// carries do it.
std::string guard_check(const Interface& interface, const Driver& driver, const std::string& row) {
  if (interface.bus) return "";
  const std::string guarded =
      std::string(Space(driver.space).runtime()) + "GuardedDriver<" + driver.class_name + ">";
  if (driver.actuates) {
    return "static_assert(" + guarded + ",\n              " +
           string_literal(row + " actuates, so " + interface.class_name + " has to derive from Actuator<" +
                          base_of(interface) + "> (hal/driver/actuator.hpp)") +
           ");\n";
  }
  return "static_assert(!" + guarded + ",\n              " +
         string_literal(row +
                        " is led by the guard of what moves something: its table has to say "
                        "actuates = true") +
         ");\n";
}

Ports ports_of(const Interface& interface) {
  return {{}, interface.outputs};
}
Ports own_ports_of(const Driver& driver) {
  return {driver.inputs, driver.outputs};
}
// Of a device with this driver: the interface's first.
Ports ports_of(const Interface& interface, const Driver& driver) {
  Ports ports{driver.inputs, interface.outputs};
  ports.outputs.insert(ports.outputs.end(), driver.outputs.begin(), driver.outputs.end());
  return ports;
}

bool connects(const Interface& interface) {
  return !interface.outputs.empty() || !interface.resources.empty();
}

// Where an interface's values lie is its driver's choice, as a driver may have more of them: the base of both
// reaches them by reference.
void declare_values(const BlockText& runtime, const BlockText& feedback, const std::string& base, Text& out,
                    Text& members, Text& places) {
  out << "\n  /// Of a driver with values of its own: where those lie that it shares with the others.\n"
      << "  struct Values {\n";
  Text storage, initialisers;
  for (const auto& [block, type, name] :
       {std::tuple{&runtime, "Runtime", "runtime"}, {&feedback, "Feedback", "feedback"}}) {
    if (block->empty()) continue;
    out << "    " << type << "* " << name << " = nullptr;  ///< null: here\n";
    members << "  " << type << "& " << name << ";\n";
    storage << "  " << type << " " << name << "_;\n";
    initialisers << (initialisers.str().empty() ? "" : ",\n        ") << name << "(values_." << name
                 << " != nullptr ? *values_." << name << " : " << name << "_)";
  }
  out << "  };\n"
      << "  " << base << "() noexcept : " << base << "(Values{}) {}\n"
      << "  explicit " << base << "(const Values& values_) noexcept\n      : " << initialisers.str()
      << " {}\n";
  places << "\n private:\n" << storage.str();
}

}  // namespace

std::string interface_base_header(const Model& model, const Interface& interface) {
  const BlockText runtime = runtime_of(model, interface);
  const BlockText feedback = feedback_of(model, interface);
  const Space space(interface.space);
  const std::string prefix(space.runtime());
  std::set<std::string> system, own{"runtime/device/device.hpp"};
  if (!runtime.empty()) add_includes(model, runtime.plain, system, own);
  if (!feedback.empty()) add_includes(model, feedback.plain, system, own);
  add_port_includes(model, ports_of(interface), own);
  for (const Resource& resource : interface.resources) own.insert(resource_header(resource.reader));

  Text out;
  out << generated_note(interface.file) << "#pragma once\n\n"
      << include_lines(system, own) << "\n"
      << space.open() << "\n";
  if (!runtime.empty()) define_struct(model, runtime.plain, out), out << "\n";
  if (!feedback.empty()) define_struct(model, feedback.plain, out), out << "\n";
  out << "/// " << comment_text(interface.summary) << "\nclass " << base_of(interface) << " : public "
      << prefix << "Device {\n public:\n";
  if (!runtime.empty()) {
    out << "  using Runtime = " << runtime.plain.name << ";\n\n"
        << "  /// May refuse a set of runtime parameters as a whole; its cause goes to who asked. Between "
           "two steps.\n"
        << "  virtual " << prefix << "Status accept(const Runtime& /*proposed*/) { return {}; }\n"
        << "  " << prefix << "Status accept_runtime(const void* proposed) noexcept override;\n";
  }
  if (!feedback.empty()) out << "  using Feedback = " << feedback.plain.name << ";\n";
  out << "  void connect(const " << prefix << "DeviceBinding& binding) noexcept override;\n";
  Text members, places;
  if (!runtime.empty() || !feedback.empty())
    declare_values(runtime, feedback, base_of(interface), out, members, places);
  declare_ports(model, space, ports_of(interface), members);
  for (const Resource& resource : interface.resources) {
    members << "  const " << prefix << resource_type(resource.reader) << "* " << resource.name
            << " = nullptr;  ///< " << comment_text(resource.summary) << "\n";
  }
  if (!members.str().empty()) out << "\n protected:\n" << members.str() << places.str();
  out << "};\n";
  if (!runtime.empty() || !feedback.empty()) out << "\n";
  declare_parameters(runtime, out);
  declare_parameters(feedback, out);
  out << "\n" << space.close();
  return out.take();
}

std::string interface_base_source(const Model& model, const Interface& interface) {
  const BlockText runtime = runtime_of(model, interface);
  const BlockText feedback = feedback_of(model, interface);
  const Space space(interface.space);
  const std::string prefix(space.runtime());
  Text out;
  out << generated_note(interface.file) << "#include \"" << interface.name
      << "_interface.hpp\"\n\n#include <cstddef>\n#include <type_traits>\n\n"
      << space.open() << "\n";
  for (const BlockText* block : {&runtime, &feedback}) {
    if (block->empty()) continue;
    define_descriptor(model, block->plain, out);
    out << "\n";
    define_parameters(*block, true, out);
    out << "\n";
  }
  out << "void " << base_of(interface) << "::connect(const " << prefix << "DeviceBinding& "
      << (connects(interface) ? "binding" : "/*binding*/") << ") noexcept {\n";
  connect_ports(ports_of(interface), {}, out);
  for (std::size_t i = 0; i < interface.resources.size(); ++i) {
    const Resource& resource = interface.resources[i];
    out << "  " << resource.name << " = static_cast<const " << prefix << resource_type(resource.reader)
        << "*>(binding.resources[" << i << "]);\n";
  }
  out << "}\n";
  if (!runtime.empty()) {
    out << "\n"
        << prefix << "Status " << base_of(interface) << "::accept_runtime(const void* proposed) noexcept {\n"
        << "  return accept(*static_cast<const Runtime*>(proposed));\n}\n";
  }
  out << "\n" << space.close();
  return out.take();
}

namespace {

bool connects(const Driver& driver) {
  return driver.bus_interface || !own_ports_of(driver).empty();
}

std::string values_of(const Driver& driver) {
  return driver.class_name + "Values";
}

// What a driver has beside its interface's values lies before all that it derives from, as the interface's
// base refers to a part of it.
void declare_own_values(const BlockText& runtime, const BlockText& feedback, const Driver& driver,
                        Text& out) {
  out << "struct " << values_of(driver) << " {\n";
  if (!runtime.empty()) out << "  " << runtime.plain.name << " runtime;\n";
  if (!feedback.empty()) out << "  " << feedback.plain.name << " feedback;\n";
  out << "};\n\n";
}

// Of a driver whose own runtime parameters are checked with its interface's.
void declare_own_accept(const Interface& interface, const std::string& face, const std::string& prefix,
                        Text& out) {
  const bool is_shared = !interface.runtime.empty();
  if (is_shared) out << "  using " << face << "::accept;\n";
  out << "  /// May refuse a set of runtime parameters as a whole; its cause goes to who asked. Between two "
         "steps.\n"
      << "  virtual " << prefix << "Status accept(const Runtime& "
      << (is_shared ? "proposed" : "/*proposed*/") << ") { return ";
  if (is_shared) {
    out << face << "::accept(static_cast<const " << face << "::Runtime&>(proposed))";
  } else {
    out << "{}";
  }
  out << "; }\n"
      << "  " << prefix << "Status accept_runtime(const void* proposed) noexcept final;\n";
}

}  // namespace

std::string driver_base_header(const Model& model, const Driver& driver) {
  const Interface& interface = model.interfaces[driver.interface];
  const BlockText configuration = driver_configuration(model, driver);
  const BlockText runtime = driver_runtime(model, driver);
  const BlockText feedback = driver_feedback(model, driver);
  const bool has_own_values = !runtime.empty() || !feedback.empty();
  const Space space(driver.space);
  const std::string prefix(space.runtime());
  std::set<std::string> system, own{interface.header};
  for (const BlockText* block : {&configuration, &runtime, &feedback})
    if (!block->empty()) add_includes(model, block->plain, system, own);
  if (driver.bus_interface) own.insert(model.interfaces[*driver.bus_interface].header);
  if (!driver.options.empty()) own.insert("runtime/core/option.hpp");
  add_port_includes(model, own_ports_of(driver), own);

  Text out;
  out << generated_note(driver.file) << "#pragma once\n\n"
      << include_lines(system, own) << "\n"
      << space.open() << "\n";
  for (const BlockText* block : {&configuration, &runtime, &feedback})
    if (!block->empty()) define_struct(model, block->plain, out), out << "\n";
  const std::string face = space.of(interface, interface.class_name);
  if (has_own_values) declare_own_values(runtime, feedback, driver, out);
  out << "/// " << comment_text(driver.summary) << "\nclass " << driver.base_class << " : "
      << (has_own_values ? "private " + values_of(driver) + ", " : "") << "public " << face
      << " {\n public:\n";
  if (!configuration.empty()) out << "  using Configuration = " << configuration.plain.name << ";\n";
  if (!runtime.empty()) out << "  using Runtime = " << runtime.plain.name << ";\n";
  if (!feedback.empty()) out << "  using Feedback = " << feedback.plain.name << ";\n";
  if (has_own_values || !configuration.empty()) out << "\n";
  if (!runtime.empty()) declare_own_accept(interface, face, prefix, out);
  declare_options(driver, prefix, out);
  if (connects(driver))
    out << "  void connect(const " << prefix << "DeviceBinding& binding) noexcept final;\n";
  declare_input_counters(space, own_ports_of(driver), out);
  out << "  const " << prefix << "ComponentType& component_type() const noexcept final;\n"
      << "  " << prefix << "ParameterMemory parameter_memory() noexcept final;\n";
  if (has_own_values || connects(driver) || !configuration.empty() || !driver.options.empty())
    out << "\n protected:\n";
  if (has_own_values) {
    std::string shared;
    for (const auto& [block, common, name] :
         {std::tuple{&runtime, &interface.runtime, "runtime"}, {&feedback, &interface.feedback, "feedback"}})
      if (!block->empty() && !common->empty())
        shared += (shared.empty() ? "." : ", .") + std::string(name) + " = &" + name;
    if (!shared.empty())
      out << "  // " << interface.class_name << " has to hand on its base's constructors: using "
          << base_of(interface) << "::" << base_of(interface) << ";\n"
          << "  " << driver.base_class << "() noexcept : " << face << "(Values{" << shared << "}) {}\n";
    if (!runtime.empty()) out << "  using " << values_of(driver) << "::runtime;\n";
    if (!feedback.empty()) out << "  using " << values_of(driver) << "::feedback;\n";
  }
  if (driver.bus_interface) {
    const Interface& bus = model.interfaces[*driver.bus_interface];
    out << "  " << space.of(bus, bus.class_name)
        << "* bus = nullptr;  ///< What this device is reached through.\n";
  }
  declare_ports(model, space, own_ports_of(driver), out);
  if (!configuration.empty()) out << "  Configuration configuration;\n";
  if (!driver.options.empty()) out << "  Options options() const noexcept;\n";
  out << "};\n\n";
  if (!driver.options.empty())
    out << "extern const " << prefix << "Option " << driver_options_name(driver) << "["
        << driver.options.size() << "];\n";
  out << "extern const " << prefix << "ComponentType " << driver_component_name(driver) << ";\n"
      << prefix << "Device* " << driver_construct_name(driver) << "(void* storage);\n\n"
      << space.close();
  return out.take();
}

std::string driver_base_source(const Model& model, const Driver& driver) {
  const Interface& interface = model.interfaces[driver.interface];
  const BlockText configuration = driver_configuration(model, driver);
  const BlockText runtime = driver_runtime(model, driver);
  const BlockText feedback = driver_feedback(model, driver);
  const bool has_runtime = !runtime.empty() || !interface.runtime.empty();
  const bool has_feedback = !feedback.empty() || !interface.feedback.empty();
  const Space space(driver.space);
  const std::string prefix(space.runtime());
  Text out;
  out << generated_note(driver.file) << "#include \"" << driver.base_header
      << "\"\n\n#include <cstddef>\n#include <type_traits>\n\n"
      << space.open() << "\n";
  for (const BlockText* block : {&configuration, &runtime, &feedback})
    if (!block->empty()) define_descriptor(model, block->plain, out), out << "\n";
  Text local;
  for (const BlockText* block : {&configuration, &runtime, &feedback})
    define_parameters(*block, false, local);
  const Ports ports = ports_of(interface, driver);
  define_ports(model, space, driver.stem + "_driver_ports", ports, local);
  if (!local.str().empty()) out << "namespace {\n\n" << local.str() << "\n}  // namespace\n\n";
  out << "constinit const " << prefix << "ComponentType " << driver_component_name(driver) << "{\n    \""
      << driver.stem << "\", " << string_literal(driver.summary) << ",\n    "
      << block_initialiser(configuration) << ",\n    "
      << (runtime.empty() ? block_initialiser(runtime_of(model, interface), space, interface)
                          : block_initialiser(runtime))
      << ",\n    "
      << (feedback.empty() ? block_initialiser(feedback_of(model, interface), space, interface)
                           : block_initialiser(feedback))
      << ",\n    " << (ports.empty() ? "{}" : driver.stem + "_driver_ports") << "};\n\n";
  define_options(driver, prefix, out);
  if (connects(driver)) {
    out << "void " << driver.base_class << "::connect(const " << prefix
        << "DeviceBinding& binding) noexcept {\n  " << space.of(interface, base_of(interface))
        << "::connect(binding);\n";
    if (driver.bus_interface) {
      const Interface& bus = model.interfaces[*driver.bus_interface];
      out << "  bus = static_cast<" << space.of(bus, bus.class_name) << "*>(binding.bus);\n";
    }
    connect_ports(own_ports_of(driver), interface.outputs, out);
    out << "}\n\n";
  }
  if (!runtime.empty()) {
    out << prefix << "Status " << driver.base_class << "::accept_runtime(const void* proposed) noexcept {\n"
        << "  return accept(*static_cast<const Runtime*>(proposed));\n}\n\n";
  }
  out << "const " << prefix << "ComponentType& " << driver.base_class
      << "::component_type() const noexcept { return " << driver_component_name(driver) << "; }\n\n"
      << prefix << "ParameterMemory " << driver.base_class << "::parameter_memory() noexcept {\n  return {"
      << (configuration.empty() ? "nullptr" : "&configuration") << ", "
      << (has_runtime ? "&runtime" : "nullptr") << ", " << (has_feedback ? "&feedback" : "nullptr")
      << "};\n}\n";
  define_input_counters(space, driver.base_class, own_ports_of(driver), out);
  out << "\n" << space.close();
  return out.take();
}

std::string driver_construct_source(const Model& model, const Driver& driver) {
  const std::string row = short_path(driver.file) + ": class " + driver.class_name;
  const Space space(driver.space);
  Text out;
  out << generated_note(driver.file) << "#include <new>\n#include <type_traits>\n\n"
      << include_line(driver.header) << "\n"
      << space.open() << "\n"
      << "static_assert(std::is_base_of_v<" << driver.base_class << ", " << driver.class_name
      << ">,\n              " << string_literal(row + " must derive from " + driver.base_class) << ");\n"
      << "static_assert(!std::is_abstract_v<" << driver.class_name << ">,\n              "
      << string_literal(row + " must have every function of its interface") << ");\n"
      << guard_check(model.interfaces[driver.interface], driver, row) << "\n"
      << space.runtime() << "Device* " << driver_construct_name(driver)
      << "(void* storage) { return new (storage) " << driver.class_name << "; }\n\n"
      << space.close();
  return out.take();
}

}  // namespace flexrf::config_gen
