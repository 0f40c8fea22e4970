// The application as a picture: threads as boxes with their units in them, arrows along slots and queues. A
// population is one unit in it: with sixteen members and eight readers nobody sees what goes where.
#include <algorithm>

#include "config-gen/emit/application_names.hpp"
#include "config-gen/emit/emit.hpp"
#include "config-gen/model/ports.hpp"

namespace flexrf::config_gen {
namespace {

struct Arrow {
  std::string from, to, label;
  bool queue = false;

  bool operator==(const Arrow&) const = default;
};

std::string device_node(Index device) {
  return "device" + std::to_string(device);
}

/// "reports[3]" is one of "reports".
std::string without_number(const std::string& name) {
  return name.ends_with(']') ? name.substr(0, name.rfind('[')) : name;
}

class Picture {
 public:
  explicit Picture(const Model& model) : model_(model) {
    for (const Population& population : model.populations) is_one_.push_back(runs_alike(population));
  }

  /// Units that are drawn in a thread; none of a population's further members.
  std::vector<Index> units_of(Index thread) const {
    std::vector<Index> units;
    for (const Index unit : model_.threads[thread].units)
      if (drawn_as(unit) == unit) units.push_back(unit);
    return units;
  }
  /// Devices that no unit of a thread owns are drawn in the thread that serves them.
  std::vector<Index> devices_of(Index thread) const {
    std::vector<Index> devices;
    for (Index device = 0; device < model_.devices.size(); ++device)
      if (model_.devices[device].thread == thread) devices.push_back(device);
    return devices;
  }
  bool shows(Index thread) const {
    return model_.threads[thread].units.empty() || !units_of(thread).empty() || !devices_of(thread).empty();
  }

  std::string thread_label(Index thread) const {
    const std::vector<Index> units = units_of(thread);
    const bool is_each =
        units.size() == 1 && model_.threads[thread].units.size() == 1 && population_of(units[0]);
    const std::string& name = model_.threads[thread].name;
    return is_each ? without_number(name) : name;
  }
  std::string unit_label(Index unit) const {
    const Population* const population = population_of(unit);
    if (population == nullptr) return model_.units[unit].name;
    return population->name + " x " + std::to_string(population->capacity);
  }
  std::string unit_node(Index unit) const { return "unit" + std::to_string(drawn_as(unit)); }

  std::vector<Arrow> arrows() const {
    std::vector<Arrow> arrows;
    for (const Slot& slot : model_.slots)
      for (const InputReference& input : slot.inputs) add(arrows, slot.writer, input, slot.name, false);
    for (const Queue& queue : model_.queues)
      for (const Writer& writer : queue.writers)
        for (const InputReference& input : queue.readers) add(arrows, writer, input, queue.name, true);
    return arrows;
  }

 private:
  /// All members in one thread, or each in one of its own: else it matters which runs where.
  bool runs_alike(const Population& population) const {
    bool together = true;
    bool alone = true;
    const Index end = population.first + population.capacity;
    for (Index unit = population.first; unit < end; ++unit) {
      const auto& thread = model_.units[unit].thread;
      if (!thread) return false;
      together = together && thread == model_.units[population.first].thread;
      alone = alone && model_.threads[*thread].units.size() == 1 && devices_of(*thread).empty();
    }
    return together || alone;
  }
  /// Nothing of a unit that is drawn by itself.
  const Population* population_of(Index unit) const {
    const auto& population = model_.units[unit].population;
    return population && is_one_[*population] ? &model_.populations[*population] : nullptr;
  }
  Index drawn_as(Index unit) const {
    const Population* const population = population_of(unit);
    return population == nullptr ? unit : population->first;
  }
  std::string node_of(const PortOwner& owner) const {
    return owner.kind == PortOwner::Kind::unit ? unit_node(owner.component) : device_node(owner.component);
  }
  /// Of what several drivers of a device, or members of a population, write or read alike there is one.
  void add(std::vector<Arrow>& arrows, const Writer& writer, const InputReference& input,
           const std::string& name, bool queue) const {
    const bool by_population =
        writer.owner.kind == PortOwner::Kind::unit && population_of(writer.owner.component) != nullptr;
    Arrow arrow{node_of(writer.owner), node_of(input.owner), by_population ? without_number(name) : name,
                queue};
    if (std::find(arrows.begin(), arrows.end(), arrow) == arrows.end()) arrows.push_back(std::move(arrow));
  }

  const Model& model_;
  std::vector<bool> is_one_;  // by population: its members are drawn as one unit
};

}  // namespace

std::string diagram_dot(const Model& model) {
  const Picture picture(model);
  Text out;
  out << "digraph " << string_literal(model.application->name)
      << " {\n  rankdir=LR;\n  node [shape=box, style=rounded, fontname=\"sans-serif\"];\n"
         "  edge [fontname=\"sans-serif\", fontsize=10];\n";
  for (Index i = 0; i < model.threads.size(); ++i) {
    if (!picture.shows(i)) continue;
    out << "  subgraph cluster_" << i << " {\n    label=" << string_literal(picture.thread_label(i))
        << "; style=dashed; fontname=\"sans-serif\";\n";
    for (const Index unit : picture.units_of(i))
      out << "    " << picture.unit_node(unit) << " [label=" << string_literal(picture.unit_label(unit))
          << "];\n";
    for (const Index device : picture.devices_of(i))
      out << "    " << device_node(device) << " [label=" << string_literal(model.devices[device].name)
          << ", shape=component, style=solid];\n";
    out << "  }\n";
  }
  for (const Arrow& arrow : picture.arrows()) {
    out << "  " << arrow.from << " -> " << arrow.to << " [label=" << string_literal(arrow.label)
        << (arrow.queue ? ", style=bold" : "") << "];\n";
  }
  for (Index i = 0; i < model.devices.size(); ++i) {
    const Device& device = model.devices[i];
    if (device.owner_unit) {
      out << "  " << picture.unit_node(*device.owner_unit) << " -> " << device_node(i)
          << " [dir=both, style=dotted];\n";
    }
    if (device.bus)
      out << "  " << device_node(*device.bus) << " -> " << device_node(i) << " [dir=both, style=dotted];\n";
  }
  out << "}\n";
  return out.take();
}

std::string diagram_mermaid(const Model& model) {
  const Picture picture(model);
  Text out;
  out << "flowchart LR\n";
  for (Index i = 0; i < model.threads.size(); ++i) {
    if (!picture.shows(i)) continue;
    out << "  subgraph thread" << i << "[\"" << picture.thread_label(i) << "\"]\n";
    for (const Index unit : picture.units_of(i))
      out << "    " << picture.unit_node(unit) << "(\"" << picture.unit_label(unit) << "\")\n";
    for (const Index device : picture.devices_of(i))
      out << "    " << device_node(device) << "[[\"" << model.devices[device].name << "\"]]\n";
    out << "  end\n";
  }
  for (const Arrow& arrow : picture.arrows()) {
    out << "  " << arrow.from << (arrow.queue ? " ==>" : " -->") << "|\"" << arrow.label << "\"| " << arrow.to
        << "\n";
  }
  for (Index i = 0; i < model.devices.size(); ++i) {
    const Device& device = model.devices[i];
    if (device.owner_unit)
      out << "  " << picture.unit_node(*device.owner_unit) << " -.- " << device_node(i) << "\n";
    if (device.bus) out << "  " << device_node(*device.bus) << " -.- " << device_node(i) << "\n";
  }
  return out.take();
}

}  // namespace flexrf::config_gen
