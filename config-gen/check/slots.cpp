// Inputs that read nothing, slots with no or two writers, slots that nobody reads, types that do not fit.
#include <map>

#include "config-gen/check/checks.hpp"
#include "config-gen/model/layout.hpp"
#include "config-gen/model/ports.hpp"
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

// Whose ports it is, for messages; and what comes before in. and out. in a row that connects them.
struct Named {
  std::string name;
  std::string key;
};

Named named(const Model& model, const PortOwner& owner) {
  if (owner.kind != PortOwner::Kind::driver) return {quote(ports_of(model, owner).name), ""};
  const DriverChoice& choice = model.devices[owner.component].drivers[owner.choice];
  return {describe(model, owner), model.drivers[choice.driver].name + "."};
}

void check_input_connections(const Model& model, const PortOwner& owner, Diagnostics& diagnostics) {
  const PortSet ports = ports_of(model, owner);
  for (std::size_t port = 0; port < ports.inputs.size(); ++port) {
    const InputPort& input = ports.inputs[port];
    if (input.optional || ports.from[port].position) continue;
    const InInstance instance(diagnostics, model, ports.name);
    diagnostics.error(
        ports.row, "input " + quote(input.name) + " of " + describe(model, owner) + " is not connected",
        "add " + named(model, owner).key + "in." + input.name +
            " = \"SLOT\", or declare the input optional = true at " + to_string(input.position));
  }
}

void check_output_connections(const Model& model, const PortOwner& owner, Diagnostics& diagnostics) {
  const PortSet ports = ports_of(model, owner);
  const Named named_owner = named(model, owner);
  for (std::size_t port = 0; port < ports.to.size() && port < ports.outputs.size(); ++port) {
    const OutputPort& output = ports.outputs[port];
    if (ports.to[port].position || output.optional) continue;
    const InInstance instance(diagnostics, model, ports.name);
    diagnostics.warning(ports.row,
                        "output " + quote(output.name) + " of " + named_owner.name + " goes nowhere",
                        "add " + named_owner.key + "out." + output.name + " = \"" + output.name +
                            "\", if anybody or the panel should see it");
  }
}

// All outputs that go to each slot, in table order; a slot keeps only its first writer.
std::map<Index, std::vector<Writer>> writers_by_slot(const Model& model) {
  std::map<Index, std::vector<Writer>> writers;
  for (const PortOwner& owner : port_owners(model)) {
    const std::vector<OutputConnection>& outputs = ports_of(model, owner).to;
    for (std::size_t port = 0; port < outputs.size(); ++port)
      if (outputs[port].slot)
        writers[*outputs[port].slot].push_back({Writer::Kind::output, owner, port, outputs[port].position});
  }
  return writers;
}

bool is_same(const Writer& one, const Writer& other) {
  return one.position == other.position && one.owner == other.owner && one.port == other.port;
}

// One that writes at the same time as this: the first that does. Of two drivers of one device one is chosen.
const Writer* rival_of(const Writer& writer, const Slot& slot, const std::vector<Writer>& writers) {
  if (!writer.owner.excludes(slot.writer.owner)) return &slot.writer;
  for (const Writer& other : writers) {
    if (is_same(writer, other)) break;
    if (!writer.owner.excludes(other.owner)) return &other;
  }
  return nullptr;
}

void check_writers(const Model& model, const Slot& slot, const std::vector<Writer>& writers,
                   Diagnostics& diagnostics) {
  for (const Writer& writer : writers) {
    if (is_same(writer, slot.writer)) continue;
    const InInstance instance(diagnostics, model, slot.name);
    if (const Writer* rival = rival_of(writer, slot, writers); rival != nullptr) {
      diagnostics.error(
          writer.position,
          "slot " + quote(slot.name) + " has two writers: " + describe(model, *rival) + " and " +
              describe(model, writer),
          "a slot has one writer: give this output a slot of its own; the other is connected at " +
              to_string(rival->position));
      continue;
    }
    const Index type = ports_of(model, writer.owner).outputs[writer.port].type;
    if (type == slot.type.index) continue;
    diagnostics.error(writer.position,
                      describe(model, writer) + " gives " + model.types[type].name + ", but slot " +
                          quote(slot.name) + " carries " + type_name(model, slot.type),
                      describe(model, slot.writer) + ", connected at " + to_string(slot.writer.position) +
                          ", is declared as " + type_name(model, slot.type) + " at " +
                          to_string(declared_at(model, slot.writer)) + "; this output is declared at " +
                          to_string(declared_at(model, writer)));
  }
}

void check_inputs_of(const Model& model, const Slot& slot, bool written, Diagnostics& diagnostics) {
  for (const InputReference& input : slot.inputs) {
    const PortSet ports = ports_of(model, input.owner);
    const InInstance instance(diagnostics, model, ports.name);
    const InputPort& port = ports.inputs[input.port];
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
  for (const PortOwner& owner : port_owners(model)) {
    check_input_connections(model, owner, diagnostics);
    // What its interface publishes a device publishes with an IO thread alone.
    if (owner.kind != PortOwner::Kind::device || model.devices[owner.component].io_thread)
      check_output_connections(model, owner, diagnostics);
  }
}

void check_slots(const Model& model, Diagnostics& diagnostics) {
  const auto writers = writers_by_slot(model);
  for (Index index = 0; index < model.slots.size(); ++index) {
    const Slot& slot = model.slots[index];
    if (slot.type.kind != SlotType::Kind::declared || slot.partial) continue;
    const auto found = writers.find(index);
    const bool written = found != writers.end();
    if (written) check_writers(model, slot, found->second, diagnostics);
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
