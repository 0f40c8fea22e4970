#include "config-gen/emit/application_names.hpp"

#include <algorithm>

#include "config-gen/model/ports.hpp"

namespace flexrf::config_gen {
namespace {

template <class Row>
std::vector<std::string> identifiers(const std::vector<Row>& rows) {
  Identifiers known;
  std::vector<std::string> result;
  for (const Row& row : rows) result.push_back(known.of(row.name));
  return result;
}

}  // namespace

ApplicationNames::ApplicationNames(const Model& model, Diagnostics& diagnostics)
    : model_(model),
      slots_(identifiers(model.slots)),
      queues_(identifiers(model.queues)),
      units_(identifiers(model.units)),
      devices_(identifiers(model.devices)),
      threads_(identifiers(model.threads)),
      readers_(model.threads.size()) {
  for (Index thread = 0; thread < model.threads.size(); ++thread) place_readers(thread, diagnostics);
  for (Index slot = 0; slot < model.slots.size(); ++slot) {
    if (!model.slots[slot].observe) continue;
    observer_places_[slot] = observers_.size();
    observers_.push_back(slot);
  }
}

// A buffer is held per thread and slot, so the inputs of a thread share its readers. Those of a range stand
// in a row, for the range's input walks along them; a held input has its own.
void ApplicationNames::place_readers(Index thread, Diagnostics& diagnostics) {
  const Model& model = model_;
  std::vector<Index>& readers = readers_[thread];
  std::map<Index, std::size_t> shared;
  const auto each_input = [&](bool held, bool range, const auto& act) {
    for (const PortOwner& owner : owners_in_thread(model, model.threads[thread])) {
      const PortSet ports = ports_of(model, owner);
      for (Index port = 0; port < ports.inputs.size(); ++port) {
        const std::vector<Index>& slots = ports.from[port].slots;
        if (slots.empty() || ports.inputs[port].hold != held || (!held && (slots.size() > 1) != range))
          continue;
        act(owner, port, slots);
      }
    }
  };
  each_input(false, true, [&](const PortOwner& owner, Index port, const std::vector<Index>& slots) {
    const auto known = shared.find(slots.front());
    const std::size_t first = known == shared.end() ? readers.size() : known->second;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (first + i == readers.size()) readers.push_back(slots[i]);
      if (readers[first + i] != slots[i]) {
        diagnostics.error(
            ports_of(model, owner).from[port].position,
            "input '" + reader_text(model, {owner, port, {}}) + "' reads a part of what another range reads",
            "let both read the same range");
        return;
      }
      shared.emplace(slots[i], first + i);
    }
    places_[{owner, port}] = {thread, first};
  });
  each_input(false, false, [&](const PortOwner& owner, Index port, const std::vector<Index>& slots) {
    const auto [place, is_new] = shared.try_emplace(slots.front(), readers.size());
    if (is_new) readers.push_back(slots.front());
    places_[{owner, port}] = {thread, place->second};
  });
  each_input(true, false, [&](const PortOwner& owner, Index port, const std::vector<Index>& slots) {
    places_[{owner, port}] = {thread, readers.size()};
    readers.insert(readers.end(), slots.begin(), slots.end());
  });
}

std::string ApplicationNames::reader_of(const PortOwner& owner, Index port) const {
  const auto& [thread, place] = places_.at({owner, port});
  return "&readers_" + threads_[thread] + "[" + std::to_string(place) + "]";
}

std::string ApplicationNames::observer_of(Index slot) const {
  const auto place = observer_places_.find(slot);
  return place == observer_places_.end() ? "nullptr" : "&observers[" + std::to_string(place->second) + "]";
}

std::string ApplicationNames::sink(Index queue, std::size_t writer) const {
  return (model_.queues[queue].jobs ? "&sink_" : "&ring_") + queues_[queue] + "_" + std::to_string(writer);
}

std::string ApplicationNames::source(Index queue) const {
  const bool is_ring = !model_.queues[queue].jobs && model_.queues[queue].writers.size() == 1;
  return is_ring ? sink(queue, 0) : "&queue_" + queues_[queue];
}

std::string ApplicationNames::sinks_of(const OutputConnection& output, const PortOwner& owner,
                                       Index port) const {
  std::string list;
  for (const Index queue : output.queues) {
    const std::vector<Writer>& writers = model_.queues[queue].writers;
    for (std::size_t i = 0; i < writers.size(); ++i) {
      if (writers[i].owner == owner && writers[i].port == port) {
        list += (list.empty() ? "" : ", ") + sink(queue, i);
      }
    }
  }
  return list;
}

std::string writer_text(const Model& model, const Writer& writer) {
  if (writer.kind != Writer::Kind::output) return "";
  const PortSet ports = ports_of(model, writer.owner);
  return ports.name + "." + ports.outputs[writer.port].name;
}

std::string reader_text(const Model& model, const InputReference& input) {
  const PortSet ports = ports_of(model, input.owner);
  return ports.name + "." + ports.inputs[input.port].name;
}

std::vector<std::string> reader_texts(const Model& model, const std::vector<InputReference>& readers) {
  std::vector<std::string> texts;
  for (const InputReference& reader : readers) {
    std::string text = reader_text(model, reader);
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace flexrf::config_gen
