// Inputs that read nothing, slots with no or two writers, slots that nobody reads, types that do not fit.
#include <map>

#include "config-gen/check/checks.hpp"
#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::size_t most_buffers = 64;
constexpr std::size_t most_history_payload = 4096;

// "axis[2].tracks[3]" as its own table calls it: "tracks".
std::string local_base(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::string local = dot == std::string::npos ? name : name.substr(dot + 1);
  return local.substr(0, local.find('['));
}

void check_output_connections(const Model& model, const std::string& owner, const Position& row,
                              const std::vector<OutputPort>& ports,
                              const std::vector<OutputConnection>& outputs, Diagnostics& diagnostics) {
  for (std::size_t port = 0; port < outputs.size() && port < ports.size(); ++port) {
    if (outputs[port].position || ports[port].optional) continue;
    const InInstance instance(diagnostics, model, owner);
    diagnostics.warning(row, "output " + quote(ports[port].name) + " of " + quote(owner) + " goes nowhere",
                        "add out." + ports[port].name + " = \"" + ports[port].name +
                            "\", if anybody or the panel should see it");
  }
}

// All outputs that go to each slot, in table order; a slot keeps only its first writer.
std::map<Index, std::vector<Writer>> writers_by_slot(const Model& model) {
  std::map<Index, std::vector<Writer>> writers;
  const auto add = [&](Writer::Kind kind, Index owner, const std::vector<OutputConnection>& outputs) {
    for (std::size_t port = 0; port < outputs.size(); ++port)
      if (outputs[port].slot)
        writers[*outputs[port].slot].push_back({kind, owner, port, outputs[port].position});
  };
  for (Index i = 0; i < model.devices.size(); ++i)
    add(Writer::Kind::device_output, i, model.devices[i].outputs);
  for (Index i = 0; i < model.units.size(); ++i) add(Writer::Kind::unit_output, i, model.units[i].outputs);
  return writers;
}

void check_inputs_of(const Model& model, const Slot& slot, bool written, Diagnostics& diagnostics) {
  for (const InputReference& input : slot.inputs) {
    const InInstance instance(diagnostics, model, model.units[input.unit].name);
    const InputPort& port = model.unit_types[model.units[input.unit].type].inputs[input.port];
    if (!written) {
      std::vector<std::string> known;
      for (const Slot& other : model.slots)
        if (other.type.kind == SlotType::Kind::declared && other.type.index == port.type &&
            other.writer.position)
          known.push_back(other.name);
      diagnostics.error(
          input.position,
          "nobody writes slot " + quote(slot.name) + ", which " + describe(model, input) + " reads",
          suggest(slot.name, known, "slots of " + model.types[port.type].name,
                  "connect an output of type " + model.types[port.type].name + " to it")
              .doubted("the output that writes " + quote(slot.name) + " may be what is missing"));
      continue;
    }
    if (slot.type.index != port.type)
      diagnostics.error(input.position,
                        describe(model, input) + " takes " + model.types[port.type].name + ", but slot " +
                            quote(slot.name) + " carries " + type_name(model, slot.type),
                        describe(model, slot.writer) + ", connected at " + to_string(slot.writer.position) +
                            ", is declared as " + type_name(model, slot.type) + " at " +
                            to_string(declared_at(model, slot.writer)) + "; the input is declared at " +
                            to_string(port.type_position));
    if (port.history && slot.history == 0)
      diagnostics.error(
          input.position,
          describe(model, input) + " asks for the past, but slot " + quote(slot.name) + " keeps none",
          "add [slot." + local_base(slot.name) + "] with history = 64, the number of values to keep");
  }
}

}  // namespace

void check_inputs(const Model& model, Diagnostics& diagnostics) {
  for (const Unit& unit : model.units) {
    const UnitType& type = model.unit_types[unit.type];
    for (std::size_t port = 0; port < type.inputs.size(); ++port) {
      if (type.inputs[port].optional || unit.inputs[port].position) continue;
      const InInstance instance(diagnostics, model, unit.name);
      const std::string& name = type.inputs[port].name;
      diagnostics.error(unit.position,
                        "input " + quote(name) + " of unit " + quote(unit.name) + " is not connected",
                        "add in." + name + " = \"SLOT\", or declare the input optional = true at " +
                            to_string(type.inputs[port].position));
    }
    check_output_connections(model, unit.name, unit.position, type.outputs, unit.outputs, diagnostics);
  }
  for (const Device& device : model.devices)
    if (device.io_thread)
      check_output_connections(model, device.name, device.position,
                               model.interfaces[device.interface].outputs, device.outputs, diagnostics);
}

void check_slots(const Model& model, Diagnostics& diagnostics) {
  const auto writers = writers_by_slot(model);
  for (Index index = 0; index < model.slots.size(); ++index) {
    const Slot& slot = model.slots[index];
    if (slot.type.kind != SlotType::Kind::declared || slot.partial) continue;
    const auto found = writers.find(index);
    const bool written = found != writers.end();
    if (written) {
      const std::vector<Writer>& all = found->second;
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].position == slot.writer.position && all[i].owner == slot.writer.owner &&
            all[i].kind == slot.writer.kind && all[i].port == slot.writer.port)
          continue;
        const InInstance instance(diagnostics, model, slot.name);
        diagnostics.error(
            all[i].position,
            "slot " + quote(slot.name) + " has two writers: " + describe(model, slot.writer) + " and " +
                describe(model, all[i]),
            "a slot has one writer: give this output a slot of its own; the other is connected at " +
                to_string(slot.writer.position));
      }
    }
    check_inputs_of(model, slot, written, diagnostics);
    const InInstance instance(diagnostics, model, slot.name);
    if (written && slot.inputs.empty() && slot.doorbells.empty() && !slot.for_panel)
      diagnostics.warning(slot.writer.position, "slot " + quote(slot.name) + " is never read",
                          "connect an input to it; if it is for the panel alone, say so: [slot." +
                              local_base(slot.name) + "] observe = true");
    if (slot.buffers() > most_buffers)
      diagnostics.error(slot.position,
                        "slot " + quote(slot.name) + " needs " + std::to_string(slot.buffers()) +
                            " buffers, but " + std::to_string(most_buffers) + " is the most",
                        "it has " + std::to_string(slot.reader_count) + " readers and " +
                            std::to_string(slot.loans) + " loans: read it from fewer threads");
    if (slot.history > 0 && slot.payload_size > most_history_payload)
      diagnostics.error(
          slot.position,
          "slot " + quote(slot.name) + " cannot keep a history of items of " + size_text(slot.payload_size),
          "a history is for items of at most " + size_text(most_history_payload) +
              ": publish the small part in a slot of its own");
  }
}

}  // namespace flexrf::config_gen
