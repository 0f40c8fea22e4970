// reference.md: what every unit, device and application is and can be told, for people.
#include "config-gen/emit/application_names.hpp"
#include "config-gen/emit/component.hpp"
#include "config-gen/emit/emit.hpp"
#include "config-gen/emit/port_emit.hpp"
#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

// A cell of a table: a bar would end it.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string type_text(const Model& model, const Field& field) {
  std::string text = type_name(model, field.type);
  if (field.capacity != 0) text += "(" + std::to_string(field.capacity) + ")";
  for (const std::size_t extent : field.shape) text += "[" + std::to_string(extent) + "]";
  return text;
}

std::string number_text(double value) {
  const std::string text = double_literal(value);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string value_text(const Model& model, const Field& field, const Literal& value) {
  if (!value.elements.empty()) {
    std::string list = "[";
    for (const Literal& element : value.elements) {
      list += (list.size() == 1 ? "" : ", ") + value_text(model, field, element);
    }
    return list + "]";
  }
  if (const auto* flag = std::get_if<bool>(&value.value)) return bool_literal(*flag);
  if (const auto* real = std::get_if<double>(&value.value)) return number_text(*real);
  if (const auto* text = std::get_if<std::string>(&value.value)) return "\"" + *text + "\"";
  const auto* integer = std::get_if<std::int64_t>(&value.value);
  if (integer == nullptr) return "0";
  if (field.type.kind == FieldType::Kind::declared &&
      model.types[field.type.declared].kind == Type::Kind::enumeration) {
    return model.types[field.type.declared].values[static_cast<std::size_t>(*integer)].name;
  }
  return std::to_string(*integer);
}

void parameters(const Model& model, std::string_view title, const std::vector<const ParameterBlock*>& blocks,
                Text& out) {
  Text rows;
  for (const ParameterBlock* block : blocks) {
    for (const Parameter& parameter : block->parameters) {
      const Field& field = parameter.field;
      const std::string type = parameter.input == Parameter::Input::button ? "button"
                               : parameter.input == Parameter::Input::hold ? "hold"
                                                                           : type_text(model, field);
      rows << "| `" << field.name << "` | " << type << " | " << cell(field.told_unit) << " | ";
      if (parameter.low && parameter.high) {
        rows << value_text(model, field, *parameter.low) << " to "
             << value_text(model, field, *parameter.high);
      }
      const bool has_default =
          parameter.kind != Parameter::Kind::feedback && parameter.input == Parameter::Input::value;
      rows << " | " << (has_default ? cell(value_text(model, field, parameter.initial)) : "") << " | "
           << cell(field.summary);
      const std::vector<Need>& needs = parameter.needs.empty() ? parameter.conditions : parameter.needs;
      for (const Need& need : needs) rows << (&need == needs.data() ? " It " : ", ") << cell(need.reason);
      rows << (needs.empty() ? " |\n" : ". |\n");
    }
  }
  if (rows.str().empty()) return;
  out << "\n"
      << title
      << "\n\n| parameter | type | unit | range | default | |\n| --- | --- | --- | --- | --- | --- |\n"
      << rows.str();
}

// `title`: of the first column.
void ports(const Model& model, std::string_view title, const Ports& all, Text& out) {
  if (all.empty()) return;
  out << "\n| " << title << " | | type | |\n| --- | --- | --- | --- |\n";
  for (const InputPort& port : all.inputs) {
    std::string notes;
    if (port.max_age) notes += " NULL when older than " + duration_text(*port.max_age) + ".";
    if (port.range) notes += " Of all members of a population.";
    if (port.history) notes += " Also its past.";
    if (port.optional) notes += " May stay unconnected.";
    out << "| `" << port.name << "` | " << (port.queue ? "queue in" : "in") << " | "
        << model.types[port.type].name << " | " << cell(port.summary) << notes << " |\n";
  }
  for (const OutputPort& port : all.outputs) {
    out << "| `" << port.name << "` | " << (port.queue ? "queue out" : "out") << " | "
        << model.types[port.type].name << " | " << cell(port.summary) << " |\n";
  }
  for (const DevicePort& port : all.devices) {
    out << "| `" << port.name << "` | device | " << model.interfaces[port.interface].class_name << " | "
        << cell(port.summary) << " |\n";
  }
}

void unit_section(const Model& model, const UnitType& unit, std::string_view heading, Text& out) {
  out << heading << " Unit `" << unit.name << "`\n\n" << unit.summary << "\n";
  ports(model, "port", {unit.inputs, unit.outputs, unit.devices}, out);
  parameters(model, "Configuration, read at `initialise()`:", {&unit.configuration}, out);
  parameters(model, "Runtime parameters:", {&unit.runtime}, out);
  parameters(model, "Feedback:", {&unit.feedback}, out);
}

void driver_section(const Model& model, const Driver& driver, std::string_view heading, Text& out) {
  const Interface& interface = model.interfaces[driver.interface];
  constexpr const char* kinds[] = {"mock", "simulated", "real"};
  out << heading << " Driver `" << driver.name << "` of " << interface.class_name << "\n\n"
      << driver.summary << "\n\nA " << kinds[static_cast<std::size_t>(driver.kind)] << " driver that "
      << (driver.actuates ? "moves something" : "only senses") << "; "
      << (driver.virtual_time ? "can live in virtual time" : "only in real time")
      << (driver.waits ? "; needs an IO thread" : "")
      << (driver.helper_threads > 0 ? "; has a thread of its own that may wait" : "") << ".\n";
  ports(model, "port, beside the interface's", {driver.inputs, driver.outputs}, out);
  parameters(model,
             "Configuration, read at `initialise()`:", {&interface.configuration, &driver.configuration},
             out);
  parameters(model, "Runtime parameters, beside those of the interface:", {&driver.runtime}, out);
  parameters(model, "Feedback, beside that of the interface:", {&driver.feedback}, out);
  if (driver.options.empty()) return;
  out << "\nOptions of the command line:\n\n| option | unit | range | |\n| --- | --- | --- | --- |\n";
  for (const DriverOption& option : driver.options) {
    out << "| `" << option.flag() << (option.value.empty() ? "" : " ") << cell(option.value) << "` | "
        << cell(option.unit) << " | ";
    if (option.range) out << number_text(option.range->first) << " to " << number_text(option.range->second);
    out << " | " << cell(option.summary)
        << (option.chooses ? " It chooses this driver where a device permits it. |\n" : " |\n");
  }
}

void interface_section(const Model& model, const Interface& interface, std::string_view heading, Text& out) {
  out << heading << " Interface " << interface.class_name << "\n\n" << interface.summary << "\n";
  ports(model, "port, with an IO thread", {{}, interface.outputs}, out);
  parameters(model, "Configuration of every driver:", {&interface.configuration}, out);
  parameters(model, "Runtime parameters:", {&interface.runtime}, out);
  parameters(model, "Feedback:", {&interface.feedback}, out);
}

std::string trigger_text(const Model& model, const Trigger& trigger) {
  const auto source = [&](const SourceReference& one) {
    return "`" + (one.queue ? model.queues[one.index].name : model.slots[one.index].name) + "`";
  };
  if (const auto* period = std::get_if<PeriodTrigger>(&trigger))
    return "every " + duration_text(period->period);
  if (const auto* slots = std::get_if<SlotsTrigger>(&trigger)) {
    std::string list;
    for (const SourceReference& one : slots->sources) list += (list.empty() ? "" : ", ") + source(one);
    return list + (slots->timeout ? ", or after " + duration_text(*slots->timeout) : "");
  }
  if (const auto* device = std::get_if<DeviceTrigger>(&trigger)) {
    return "device `" + model.devices[device->device].name + "`" +
           (device->timeout ? ", or after " + duration_text(*device->timeout) : "");
  }
  if (const auto* backoff = std::get_if<BackoffTrigger>(&trigger)) return "polls " + source(backoff->source);
  return "runs freely";
}

std::string names_of(const std::vector<InputReference>& readers, const Model& model) {
  std::string list;
  for (const std::string& reader : reader_texts(model, readers)) {
    list += (list.empty() ? "`" : ", `") + reader + "`";
  }
  return list;
}

void application_tables(const Model& model, Text& out) {
  out << "\n## Threads\n\n| thread | released | priority | role | units | budget |\n"
         "| --- | --- | --- | --- | --- | --- |\n";
  for (const Thread& thread : model.threads) {
    std::string units;
    for (const Index unit : thread.units)
      units += (units.empty() ? "`" : ", `") + model.units[unit].name + "`";
    out << "| `" << thread.name << "` | " << trigger_text(model, thread.trigger) << " | "
        << (thread.priority == 0 ? "not real-time" : std::to_string(thread.priority)) << " | "
        << name_of(thread.role) << " | " << units << " | "
        << (thread.demand == 0 ? "" : duration_text(thread.demand)) << " |\n";
  }
  out << "\n## Slots\n\n| slot | type | written by | read by | |\n| --- | --- | --- | --- | --- |\n";
  for (const Slot& slot : model.slots) {
    const std::string writer = writer_text(model, slot.writer);
    out << "| `" << slot.name << "` | " << common_type_name(model, slot) << " | "
        << (writer.empty() ? "the executive" : "`" + writer + "`") << " | " << names_of(slot.inputs, model)
        << " | " << cell(slot.summary) << " |\n";
  }
  if (!model.queues.empty()) {
    out << "\n## Queues\n\n| queue | type | capacity | written by | read by | |\n| --- | --- | --- | --- | "
           "--- | --- |\n";
  }
  for (const Queue& queue : model.queues) {
    std::string writers;
    for (const Writer& writer : queue.writers) {
      writers += (writers.empty() ? "`" : ", `") + writer_text(model, writer) + "`";
    }
    out << "| `" << queue.name << "` | " << model.types[queue.type].name << " | " << queue.capacity << " | "
        << writers << " | " << names_of(queue.readers, model) << " | " << cell(queue.summary) << " |\n";
  }
  if (!model.devices.empty()) {
    out << "\n## Devices\n\n| device | interface | drivers | thread | owner |\n| --- | --- | --- | --- | --- "
           "|\n";
  }
  for (const Device& device : model.devices) {
    std::string drivers;
    for (const DriverChoice& choice : device.drivers) {
      drivers += (drivers.empty() ? "" : ", ") + model.drivers[choice.driver].name;
    }
    const std::string owner = device.owner_unit ? "`" + model.units[*device.owner_unit].name + "`"
                              : device.bus      ? "`" + model.devices[*device.bus].name + "`"
                                                : "";
    out << "| `" << device.name << "` | " << model.interfaces[device.interface].class_name << " | " << drivers
        << " | `" << (device.thread ? model.threads[*device.thread].name : "") << "` | " << owner << " |\n";
  }
}

}  // namespace

std::string unit_reference(const Model& model, const UnitType& unit) {
  Text out;
  unit_section(model, unit, "#", out);
  return out.take();
}

std::string interface_reference(const Model& model, const Interface& interface) {
  Text out;
  interface_section(model, interface, "#", out);
  return out.take();
}

std::string driver_reference(const Model& model, const Driver& driver) {
  Text out;
  driver_section(model, driver, "#", out);
  return out.take();
}

std::string application_reference(const Model& model) {
  Text out;
  out << "# Application `" << model.application->name << "`\n\n"
      << model.application->summary << "\n\n```mermaid\n"
      << diagram_mermaid(model) << "```\n";
  application_tables(model, out);
  for (const UnitType& unit : model.unit_types) out << "\n", unit_section(model, unit, "##", out);
  for (const Interface& interface : model.interfaces)
    out << "\n", interface_section(model, interface, "##", out);
  for (const Driver& driver : model.drivers) out << "\n", driver_section(model, driver, "##", out);
  return out.take();
}

}  // namespace flexrf::config_gen
