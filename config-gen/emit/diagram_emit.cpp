// The application as a picture: threads as boxes with their units in them, arrows along slots and queues.
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

std::string unit_node(Index unit) {
  return "unit" + std::to_string(unit);
}
std::string device_node(Index device) {
  return "device" + std::to_string(device);
}

std::string node_of(const PortOwner& owner) {
  return owner.kind == PortOwner::Kind::unit ? unit_node(owner.component) : device_node(owner.component);
}

// Of what several drivers of a device write or read alike there is one.
std::vector<Arrow> arrows_of(const Model& model) {
  std::vector<Arrow> arrows;
  const auto add = [&](std::size_t before, const Writer& writer, const InputReference& input,
                       const std::string& label, bool queue) {
    Arrow arrow{node_of(writer.owner), node_of(input.owner), label, queue};
    const auto first = arrows.begin() + static_cast<std::ptrdiff_t>(before);
    if (std::find(first, arrows.end(), arrow) == arrows.end()) arrows.push_back(std::move(arrow));
  };
  for (const Slot& slot : model.slots) {
    const std::size_t before = arrows.size();
    for (const InputReference& input : slot.inputs) add(before, slot.writer, input, slot.name, false);
  }
  for (const Queue& queue : model.queues) {
    const std::size_t before = arrows.size();
    for (const Writer& writer : queue.writers)
      for (const InputReference& input : queue.readers) add(before, writer, input, queue.name, true);
  }
  return arrows;
}

// Devices that no unit of a thread owns are drawn in the thread that serves them.
bool is_drawn_in(const Device& device, Index thread) {
  return device.thread == thread;
}

}  // namespace

std::string diagram_dot(const Model& model) {
  Text out;
  out << "digraph " << string_literal(model.application->name)
      << " {\n  rankdir=LR;\n  node [shape=box, style=rounded, fontname=\"sans-serif\"];\n"
         "  edge [fontname=\"sans-serif\", fontsize=10];\n";
  for (Index i = 0; i < model.threads.size(); ++i) {
    out << "  subgraph cluster_" << i << " {\n    label=" << string_literal(model.threads[i].name)
        << "; style=dashed; fontname=\"sans-serif\";\n";
    for (const Index unit : model.threads[i].units) {
      out << "    " << unit_node(unit) << " [label=" << string_literal(model.units[unit].name) << "];\n";
    }
    for (Index device = 0; device < model.devices.size(); ++device) {
      if (!is_drawn_in(model.devices[device], i)) continue;
      out << "    " << device_node(device) << " [label=" << string_literal(model.devices[device].name)
          << ", shape=component, style=solid];\n";
    }
    out << "  }\n";
  }
  for (const Arrow& arrow : arrows_of(model)) {
    out << "  " << arrow.from << " -> " << arrow.to << " [label=" << string_literal(arrow.label)
        << (arrow.queue ? ", style=bold" : "") << "];\n";
  }
  for (Index i = 0; i < model.devices.size(); ++i) {
    const Device& device = model.devices[i];
    if (device.owner_unit) {
      out << "  " << unit_node(*device.owner_unit) << " -> " << device_node(i)
          << " [dir=both, style=dotted];\n";
    }
    if (device.bus)
      out << "  " << device_node(*device.bus) << " -> " << device_node(i) << " [dir=both, style=dotted];\n";
  }
  out << "}\n";
  return out.take();
}

std::string diagram_mermaid(const Model& model) {
  Text out;
  out << "flowchart LR\n";
  for (Index i = 0; i < model.threads.size(); ++i) {
    out << "  subgraph thread" << i << "[\"" << model.threads[i].name << "\"]\n";
    for (const Index unit : model.threads[i].units) {
      out << "    " << unit_node(unit) << "(\"" << model.units[unit].name << "\")\n";
    }
    for (Index device = 0; device < model.devices.size(); ++device) {
      if (!is_drawn_in(model.devices[device], i)) continue;
      out << "    " << device_node(device) << "[[\"" << model.devices[device].name << "\"]]\n";
    }
    out << "  end\n";
  }
  for (const Arrow& arrow : arrows_of(model)) {
    out << "  " << arrow.from << (arrow.queue ? " ==>" : " -->") << "|\"" << arrow.label << "\"| " << arrow.to
        << "\n";
  }
  for (Index i = 0; i < model.devices.size(); ++i) {
    const Device& device = model.devices[i];
    if (device.owner_unit) out << "  " << unit_node(*device.owner_unit) << " -.- " << device_node(i) << "\n";
    if (device.bus) out << "  " << device_node(*device.bus) << " -.- " << device_node(i) << "\n";
  }
  return out.take();
}

}  // namespace flexrf::config_gen
