// descriptor.json: what a panel, a recording or a configuration file must know of an application.
#include <nlohmann/json.hpp>

#include "config-gen/emit/application_names.hpp"
#include "config-gen/emit/component.hpp"
#include "config-gen/emit/descriptor_panel.hpp"
#include "config-gen/emit/emit.hpp"
#include "config-gen/emit/plain_struct.hpp"
#include "config-gen/model/layout.hpp"
#include "config-gen/model/ports.hpp"

namespace flexrf::config_gen {
namespace {

using Json = nlohmann::ordered_json;  // keys in the order written: for people who read it

Json json_of(const Model& model, const Field& field, const Literal& value, bool as_element = false);

Json scalar_json(const Model& model, const Field& field, const Literal& value) {
  if (field.type.kind == FieldType::Kind::declared) {
    const Type& type = model.types[field.type.declared];
    if (type.kind == Type::Kind::enumeration) {
      const auto* chosen = std::get_if<std::int64_t>(&value.value);
      return type.values[chosen == nullptr ? 0 : static_cast<std::size_t>(*chosen)].name;
    }
    Json record = Json::object();
    const Literal zero;
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      record[type.fields[i].name] =
          json_of(model, type.fields[i], i < value.elements.size() ? value.elements[i] : zero);
    }
    return record;
  }
  if (field.type.scalar == Scalar::text) {
    const auto* text = std::get_if<std::string>(&value.value);
    return text == nullptr ? "" : *text;
  }
  if (const auto* flag = std::get_if<bool>(&value.value)) return *flag;
  if (const auto* real = std::get_if<double>(&value.value)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value.value)) {
    if (field.type.scalar == Scalar::u64) return static_cast<std::uint64_t>(*integer);
    if (is_floating(field.type.scalar)) return static_cast<double>(*integer);
    return *integer;
  }
  if (field.type.scalar == Scalar::boolean) return false;
  return is_floating(field.type.scalar) ? Json(0.0) : Json(0);
}

// Arrays flat, two dimensions column by column, as they lie in memory.
Json json_of(const Model& model, const Field& field, const Literal& value, bool as_element) {
  if (field.shape.empty() || as_element) return scalar_json(model, field, value);
  Json list = Json::array();
  const Literal zero;
  for (std::size_t i = 0; i < field.elements(); ++i) {
    list.push_back(json_of(model, field, i < value.elements.size() ? value.elements[i] : zero, true));
  }
  return list;
}

Json field_json(const Model& model, const PlainField& plain) {
  const Field& field = *plain.field;
  Json json = {{"name", field.name}, {"scalar", plain.scalar}};
  if (field.type.kind == FieldType::Kind::declared) json["type"] = model.types[field.type.declared].name;
  if (!field.shape.empty()) json["shape"] = field.shape;
  if (field.capacity != 0) json["capacity"] = field.capacity;
  json["offset"] = plain.offset;
  json["size"] = field.size;
  if (!field.unit.empty()) json["unit"] = field.unit;
  json["summary"] = field.summary;
  return json;
}

Json struct_json(const Model& model, const PlainStruct& plain) {
  Json json = {{"name", plain.name},
               {"summary", plain.summary},
               {"size", plain.size},
               {"alignment", plain.alignment},
               {"hash", hash_text(hash_of(model, plain))}};
  if (plain.image) json["image"] = true;
  json["fields"] = Json::array();
  for (const PlainField& field : plain.fields) json["fields"].push_back(field_json(model, field));
  return json;
}

Json type_json(const Model& model, const Type& type) {
  if (type.kind == Type::Kind::record) return struct_json(model, plain_struct(model, type));
  Json json = {{"name", type.name}, {"summary", type.summary}, {"hash", hash_text(hash_of(model, type))}};
  json["values"] = Json::array();
  for (const EnumerationValue& value : type.values) {
    json["values"].push_back({{"name", value.name}, {"summary", value.summary}});
  }
  return json;
}

const char* role_text(PanelRole role) {
  switch (role) {
    case PanelRole::viewer:
      return "viewer";
    case PanelRole::op:
      return "operator";
    case PanelRole::engineer:
      return "engineer";
    case PanelRole::admin:
      break;
  }
  return "admin";
}

Json need_json(const Need& need) {
  Json json = {{"of", need.of == Need::Of::motion    ? "motion"
                      : need.of == Need::Of::runtime ? "runtime"
                                                     : "feedback"}};
  if (need.of != Need::Of::motion) {
    json["field"] = need.field;
    json["numbers"] = Json::array();
    for (unsigned number = 0; number < 64; ++number)
      if ((need.numbers >> number & 1U) != 0) json["numbers"].push_back(number);
  }
  json["reason"] = need.reason;
  return json;
}

Json parameters_json(const Model& model, const std::vector<const ParameterBlock*>& blocks) {
  Json list = Json::array();
  for (const ParameterBlock* block : blocks) {
    for (const Parameter& parameter : block->parameters) {
      Json json = {{"name", parameter.field.name}};
      if (parameter.kind != Parameter::Kind::feedback) {
        json["role"] = role_text(parameter.role);
        json["default"] = json_of(model, parameter.field, parameter.initial);
      }
      if (parameter.low && parameter.high) {
        json["range"] = {scalar_json(model, parameter.field, *parameter.low),
                         scalar_json(model, parameter.field, *parameter.high)};
      }
      if (parameter.step) json["step"] = scalar_json(model, parameter.field, *parameter.step);
      if (parameter.kind == Parameter::Kind::runtime) json["persist"] = parameter.persist;
      if (!parameter.widget.empty()) json["widget"] = parameter.widget;
      if (!parameter.label.empty()) json["label"] = parameter.label;
      if (!parameter.menu.empty()) json["menu"] = parameter.menu;
      for (const Need& need : parameter.needs) json["needs"].push_back(need_json(need));
      list.push_back(std::move(json));
    }
  }
  return list;
}

// The struct's name under "types", and what is declared beside its fields, in their order.
void add_block(const Model& model, const std::string& class_name, const char* key, const char* what,
               const std::vector<const ParameterBlock*>& blocks, Json& json) {
  Json parameters = parameters_json(model, blocks);
  if (parameters.empty()) return;
  json[key] = {{"type", block_struct_name(class_name, what)}, {"parameters", std::move(parameters)}};
}

void add_struct(const Model& model, const BlockText& block, Json& types) {
  if (!block.empty()) types.push_back(struct_json(model, block.plain));
}

Json port_json(const Model& model, const OutputPort& port) {
  Json json = {{"name", port.name}, {port.queue ? "queue" : "type", model.types[port.type].name}};
  if (port.loans != 1) json["loans"] = port.loans;
  json["summary"] = port.summary;
  return json;
}

Json port_json(const Model& model, const InputPort& port) {
  Json json = {{"name", port.name}, {port.queue ? "queue" : "type", model.types[port.type].name}};
  if (port.max_age) json["max_age_ns"] = *port.max_age;
  if (port.hold) json["hold"] = true;
  if (port.range) json["range"] = true;
  if (port.history) json["history"] = true;
  if (port.optional) json["optional"] = true;
  json["summary"] = port.summary;
  return json;
}

void add_ports(const Model& model, const std::vector<InputPort>& inputs,
               const std::vector<OutputPort>& outputs, Json& json) {
  for (const InputPort& port : inputs) json["inputs"].push_back(port_json(model, port));
  for (const OutputPort& port : outputs) json["outputs"].push_back(port_json(model, port));
}

Json unit_type_json(const Model& model, const UnitType& type, Json& types) {
  Json json = {{"name", type.name}, {"class", type.class_name}, {"summary", type.summary}};
  add_ports(model, type.inputs, type.outputs, json);
  for (const DevicePort& port : type.devices) {
    json["devices"].push_back({{"name", port.name},
                               {"interface", model.interfaces[port.interface].class_name},
                               {"summary", port.summary}});
  }
  add_block(model, type.class_name, "configuration", "Configuration", {&type.configuration}, json);
  add_block(model, type.class_name, "runtime", "Runtime", {&type.runtime}, json);
  add_block(model, type.class_name, "feedback", "Feedback", {&type.feedback}, json);
  for (const auto& [what, block] : {std::pair{"Configuration", &type.configuration},
                                    {"Runtime", &type.runtime},
                                    {"Feedback", &type.feedback}}) {
    add_struct(model, block_text(model, type.class_name, Space(type.space), what, type.position, {block}),
               types);
  }
  return json;
}

Json interface_json(const Model& model, const Interface& interface, Json& types) {
  Json json = {{"name", interface.class_name}, {"summary", interface.summary}};
  if (interface.bus) json["bus"] = true;
  add_ports(model, {}, interface.outputs, json);
  add_block(model, interface.class_name, "runtime", "Runtime", {&interface.runtime}, json);
  add_block(model, interface.class_name, "feedback", "Feedback", {&interface.feedback}, json);
  for (const auto& [what, block] :
       {std::pair{"Runtime", &interface.runtime}, {"Feedback", &interface.feedback}}) {
    add_struct(
        model,
        block_text(model, interface.class_name, Space(interface.space), what, interface.position, {block}),
        types);
  }
  return json;
}

const char* kind_text(Driver::Kind kind) {
  switch (kind) {
    case Driver::Kind::mock:
      return "mock";
    case Driver::Kind::simulated:
      return "simulated";
    case Driver::Kind::real:
      break;
  }
  return "real";
}

Json driver_json(const Model& model, const Driver& driver, Json& types) {
  const Interface& interface = model.interfaces[driver.interface];
  Json json = {{"name", driver.stem},
               {"driver", driver.name},
               {"interface", interface.class_name},
               {"kind", kind_text(driver.kind)},
               {"actuates", driver.actuates},
               {"virtual_time", driver.virtual_time},
               {"summary", driver.summary}};
  add_ports(model, driver.inputs, driver.outputs, json);
  add_block(model, driver.class_name, "configuration", "Configuration",
            {&interface.configuration, &driver.configuration}, json);
  add_struct(model, driver_configuration(model, driver), types);
  // Where there is none of its own, the interface's is all there is.
  if (!driver.runtime.empty())
    add_block(model, driver.class_name, "runtime", "Runtime", {&interface.runtime, &driver.runtime}, json);
  if (!driver.feedback.empty())
    add_block(model, driver.class_name, "feedback", "Feedback", {&interface.feedback, &driver.feedback},
              json);
  add_struct(model, driver_runtime(model, driver), types);
  add_struct(model, driver_feedback(model, driver), types);
  return json;
}

Json values_json(const Model& model, const ParameterBlock& block, const std::vector<Literal>& values) {
  Json json = Json::object();
  for (std::size_t i = 0; i < block.parameters.size() && i < values.size(); ++i) {
    json[block.parameters[i].field.name] = json_of(model, block.parameters[i].field, values[i]);
  }
  return json;
}

void add_values(const Model& model, const char* key, const ParameterBlock& block,
                const std::vector<Literal>& values, Json& json) {
  if (Json all = values_json(model, block, values); !all.empty()) json[key] = std::move(all);
}

Json bound_json(const Literal& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.value)) return *integer;
  if (const auto* real = std::get_if<double>(&value.value)) return *real;
  if (const auto* flag = std::get_if<bool>(&value.value)) return *flag;
  return nullptr;
}

Json override_json(const ParameterOverride& change) {
  Json json = {{"parameter", change.parameter}};
  if (change.label) json["label"] = *change.label;
  if (change.hidden) json["hidden"] = *change.hidden;
  if (change.low && change.high) json["range"] = {bound_json(*change.low), bound_json(*change.high)};
  if (change.step) json["step"] = bound_json(*change.step);
  if (change.widget) json["widget"] = *change.widget;
  if (change.menu) json["menu"] = *change.menu;
  if (change.place) json["place"] = *change.place;
  if (change.confirm) json["confirm"] = *change.confirm;
  return json;
}

Json output_json(const Model& model, const OutputPort& port, const OutputConnection& output) {
  if (!port.queue) return output.slot ? Json(model.slots[*output.slot].name) : Json(nullptr);
  Json list = Json::array();
  for (const Index queue : output.queues) list.push_back(model.queues[queue].name);
  return list;
}

Json input_json(const Model& model, const InputPort& port, const InputConnection& input) {
  if (port.range) {
    Json list = Json::array();
    for (const Index slot : input.slots) list.push_back(model.slots[slot].name);
    return list;
  }
  if (input.queue) return model.queues[*input.queue].name;
  return input.slots.empty() ? Json(nullptr) : Json(model.slots[input.slots.front()].name);
}

// Of each port by its name the slot or queue.
void add_connections(const Model& model, const PortOwner& owner, Json& json) {
  const PortSet ports = ports_of(model, owner);
  for (std::size_t i = 0; i < ports.inputs.size(); ++i)
    json["inputs"][ports.inputs[i].name] = input_json(model, ports.inputs[i], ports.from[i]);
  for (std::size_t i = 0; i < ports.outputs.size(); ++i)
    json["outputs"][ports.outputs[i].name] = output_json(model, ports.outputs[i], ports.to[i]);
}

Json unit_json(const Model& model, Index index) {
  const Unit& unit = model.units[index];
  const UnitType& type = model.unit_types[unit.type];
  Json json = {{"name", unit.name}, {"type", type.name}};
  if (unit.thread) json["thread"] = model.threads[*unit.thread].name;
  if (unit.population) {
    json["population"] = model.populations[*unit.population].name;
    json["member"] = unit.member;
    json["active"] = unit.active;
  }
  add_connections(model, {PortOwner::Kind::unit, index, 0}, json);
  for (std::size_t i = 0; i < type.devices.size(); ++i) {
    if (unit.devices[i]) json["devices"][type.devices[i].name] = model.devices[*unit.devices[i]].name;
  }
  if (unit.values_slot) json["values_slot"] = model.slots[*unit.values_slot].name;
  if (unit.feedback_slot) json["feedback_slot"] = model.slots[*unit.feedback_slot].name;
  add_values(model, "configuration", type.configuration, unit.configuration, json);
  add_values(model, "runtime", type.runtime, unit.runtime, json);
  for (const ParameterOverride& change : unit.overrides) json["overrides"].push_back(override_json(change));
  if (unit.budget) json["budget_ns"] = *unit.budget;
  constexpr const char* policies[] = {"never", "once", "always"};
  json["restart"] = policies[static_cast<std::size_t>(unit.restart)];
  return json;
}

// Of an arm, from base to tool.
Json joints_json(const UrdfChain& chain) {
  Json list = Json::array();
  for (const UrdfJoint& joint : chain.joints) {
    Json one = {{"name", joint.name}, {"unit", joint.kind == UrdfJoint::Kind::prismatic ? "m" : "rad"}};
    if (joint.kind != UrdfJoint::Kind::continuous) one["range"] = {joint.lower, joint.upper};
    list.push_back(std::move(one));
  }
  return list;
}

Json device_json(const Model& model, Index index) {
  const Device& device = model.devices[index];
  const Interface& interface = model.interfaces[device.interface];
  Json json = {{"name", device.name}, {"interface", interface.class_name}};
  for (std::size_t i = 0; i < interface.units.size() && i < device.units.size(); ++i)
    json["units"][interface.units[i].name] = device.units[i];
  for (Index place = 0; place < device.drivers.size(); ++place) {
    const DriverChoice& choice = device.drivers[place];
    const Driver& driver = model.drivers[choice.driver];
    Json one = {{"driver", driver.name}, {"type", driver.stem}};
    add_connections(model, {PortOwner::Kind::driver, index, place}, one);
    Json values = values_json(model, interface.configuration, device.configuration);
    values.update(values_json(model, driver.configuration, choice.configuration));
    if (!values.empty()) one["configuration"] = std::move(values);
    add_values(model, "runtime", driver.runtime, choice.runtime, one);
    json["drivers"].push_back(std::move(one));
  }
  if (device.bus) json["on"] = model.devices[*device.bus].name;
  if (device.owner_unit) json["unit"] = model.units[*device.owner_unit].name;
  if (device.thread) json["thread"] = model.threads[*device.thread].name;
  add_connections(model, {PortOwner::Kind::device, index, 0}, json);
  if (device.values_slot) json["values_slot"] = model.slots[*device.values_slot].name;
  if (device.feedback_slot) json["feedback_slot"] = model.slots[*device.feedback_slot].name;
  add_values(model, "runtime", interface.runtime, device.runtime, json);
  for (const ParameterOverride& change : device.overrides) json["overrides"].push_back(override_json(change));
  const std::string robot = "robots/" + device.name + ".urdf";
  for (const PanelFile& file : model.panel.files)
    if (file.path == robot) json["robot"] = robot;
  for (const DeviceResource& resource : device.resources)
    if (resource.chain) json["joints"] = joints_json(*resource.chain);
  return json;
}

Json readers_json(const Model& model, const std::vector<InputReference>& readers) {
  Json list = Json::array();
  for (std::string& reader : reader_texts(model, readers)) list.push_back(std::move(reader));
  return list;
}

// Of a slot of a device's parameters: the structs of drivers that have more than their interface.
Json driver_types_json(const Model& model, const Slot& slot) {
  Json json = Json::object();
  const Writer& writer = slot.writer;
  if (writer.kind == Writer::Kind::output || writer.owner.kind != PortOwner::Kind::device) return json;
  const bool is_runtime = writer.kind == Writer::Kind::values;
  for (const DriverChoice& choice : model.devices[writer.owner.component].drivers) {
    const Driver& driver = model.drivers[choice.driver];
    if ((is_runtime ? driver.runtime : driver.feedback).empty()) continue;
    json[driver.name] = block_struct_name(driver.class_name, is_runtime ? "Runtime" : "Feedback");
  }
  return json;
}

// Of a slot that drivers write: the port of each, by driver.
Json driver_writers_json(const Model& model, Index slot) {
  Json json = Json::object();
  for (const Writer& writer : writers_of(model, slot)) {
    if (writer.owner.kind != PortOwner::Kind::driver) continue;
    const DriverChoice& choice = model.devices[writer.owner.component].drivers[writer.owner.choice];
    json[model.drivers[choice.driver].name] = writer_text(model, writer);
  }
  return json;
}

Json slot_json(const Model& model, Index index) {
  const Slot& slot = model.slots[index];
  Json json = {{"name", slot.name},
               {"type", common_type_name(model, slot)},
               {"writer", writer_text(model, slot.writer)},
               {"readers", readers_json(model, slot.inputs)},
               {"buffers", slot.buffers()},
               {"observe", slot.observe},
               {"wall", slot.wall},
               {"history", slot.history}};
  if (slot.elements > 0) json["elements"] = slot.elements;
  if (Json types = driver_types_json(model, slot); !types.empty()) json["driver_types"] = std::move(types);
  if (Json writers = driver_writers_json(model, index); !writers.empty())
    json["driver_writers"] = std::move(writers);
  json["summary"] = slot.summary;
  return json;
}

Json queue_json(const Model& model, const Queue& queue) {
  Json json = {{"name", queue.name},
               {"type", model.types[queue.type].name},
               {"capacity", queue.capacity},
               {"policy", queue.policy == Queue::Policy::drop_newest ? "drop_newest" : "drop_oldest"},
               {"share", queue.jobs ? "jobs" : "copies"}};
  if (queue.score) json["score"] = model.types[queue.type].fields[*queue.score].name;
  json["wall"] = queue.wall;
  json["writers"] = Json::array();
  for (const Writer& writer : queue.writers) json["writers"].push_back(writer_text(model, writer));
  json["readers"] = readers_json(model, queue.readers);
  json["summary"] = queue.summary;
  return json;
}

struct TriggerJson {
  const Model& model;

  std::string source(const SourceReference& one) const {
    return one.queue ? model.queues[one.index].name : model.slots[one.index].name;
  }
  static void add(Json& json, const char* key, const std::optional<Nanoseconds>& value) {
    if (value) json[key] = *value;
  }
  Json operator()(const PeriodTrigger& trigger) const {
    return {{"kind", "period"}, {"period_ns", trigger.period}, {"phase_ns", trigger.phase}};
  }
  Json operator()(const SlotsTrigger& trigger) const {
    Json json = {{"kind", "slots"}, {"sources", Json::array()}};
    for (const SourceReference& one : trigger.sources) json["sources"].push_back(source(one));
    add(json, "min_interval_ns", trigger.min_interval);
    add(json, "timeout_ns", trigger.timeout);
    return json;
  }
  Json operator()(const DeviceTrigger& trigger) const {
    Json json = {{"kind", "device"}, {"device", model.devices[trigger.device].name}};
    add(json, "min_interval_ns", trigger.min_interval);
    add(json, "timeout_ns", trigger.timeout);
    return json;
  }
  Json operator()(const BackoffTrigger& trigger) const {
    return {{"kind", "backoff"},
            {"source", source(trigger.source)},
            {"shortest_ns", trigger.shortest},
            {"longest_ns", trigger.longest},
            {"tries", trigger.tries}};
  }
  Json operator()(const FreeTrigger&) const { return {{"kind", "free"}}; }
};

Json thread_json(const Model& model, const Thread& thread) {
  Json json = {{"name", thread.name},
               {"trigger", std::visit(TriggerJson{model}, thread.trigger)},
               {"priority", thread.priority}};
  json["role"] = name_of(thread.role);
  json["units"] = Json::array();
  for (const Index unit : thread.units) json["units"].push_back(model.units[unit].name);
  json["devices"] = Json::array();
  for (const Index device : thread.devices) json["devices"].push_back(model.devices[device].name);
  json["budget_ns"] = thread.demand;
  if (thread.response_time) json["response_time_ns"] = *thread.response_time;
  json["stack"] = thread.stack;
  json["summary"] = thread.summary;
  return json;
}

Json application_json(const Model& model) {
  const Application& application = *model.application;
  Json json = {{"format", 1}, {"application", application.name}, {"summary", application.summary}};
  json["autostart"] = application.autostart;
  if (application.memory_budget) json["memory_budget"] = *application.memory_budget;
  json["stop_timeout_ns"] = application.stop_timeout;
  json["finish_timeout_ns"] = application.finish_timeout;
  json["standstill_limit_ns"] = application.standstill_limit;
  Json types = Json::array();
  for (const Type& type : model.types) types.push_back(type_json(model, type));
  const auto add_all = [&](const char* key, const auto& rows, const auto& make) {
    json[key] = Json::array();
    for (const auto& row : rows) json[key].push_back(make(row));
  };
  add_all("unit_types", model.unit_types,
          [&](const UnitType& row) { return unit_type_json(model, row, types); });
  add_all("interfaces", model.interfaces,
          [&](const Interface& row) { return interface_json(model, row, types); });
  add_all("drivers", model.drivers, [&](const Driver& row) { return driver_json(model, row, types); });
  json["types"] = std::move(types);
  const auto add_each = [&](const char* key, std::size_t count, const auto& make) {
    json[key] = Json::array();
    for (Index index = 0; index < count; ++index) json[key].push_back(make(index));
  };
  add_each("devices", model.devices.size(), [&](Index index) { return device_json(model, index); });
  add_each("units", model.units.size(), [&](Index index) { return unit_json(model, index); });
  add_all("populations", model.populations, [&](const Population& row) {
    return Json{{"name", row.name}, {"capacity", row.capacity}, {"active", row.active}};
  });
  add_all("groups", model.groups, [&](const GroupInstance& row) {
    return Json{{"name", row.name}, {"table", row.table}};
  });
  add_each("slots", model.slots.size(), [&](Index index) { return slot_json(model, index); });
  add_all("queues", model.queues, [&](const Queue& row) { return queue_json(model, row); });
  add_all("threads", model.threads, [&](const Thread& row) { return thread_json(model, row); });
  json["panel"] = {{"connections", model.panel.connections}};
  json["widgets"] = widgets_json(model);
  return json;
}

}  // namespace

DescriptorText descriptor_text(const Model& model) {
  const Json content = application_json(model);
  DescriptorText text;
  text.hash = fnv1a(content.dump());
  Json whole = {{"hash", hash_text(text.hash)}};
  whole.update(content);
  text.json = whole.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  return text;
}

std::string descriptor_source(const Model& model) {
  // One literal per line: a compiler's limit on the length of a line is no limit here.
  Text out;
  out << generated_note(model.application->file) << "namespace flexrf::application {\n\n"
      << "extern const char descriptor_json[];\nconstinit const char descriptor_json[] =\n";
  const std::string json = descriptor_text(model).json;
  for (std::size_t at = 0; at < json.size();) {
    const std::size_t end = json.find('\n', at) + 1;
    out << "    " << string_literal(std::string_view(json).substr(at, end - at)) << "\n";
    at = end;
  }
  out << "    ;\n\n}  // namespace flexrf::application\n";
  return out.take();
}

}  // namespace flexrf::config_gen
