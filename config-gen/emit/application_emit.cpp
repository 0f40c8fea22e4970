// application.cpp: the whole application as constants and zeroed memory.
#include <algorithm>

#include "config-gen/emit/application_parts.hpp"
#include "config-gen/emit/component.hpp"
#include "config-gen/emit/emit.hpp"

namespace flexrf::config_gen {
namespace {

std::string includes_of(const Model& model) {
  std::set<std::string> system{"algorithm", "cstddef", "cstdint", "numeric", "span"};
  std::set<std::string> own{"runtime/blackboard/doorbell.hpp",   "runtime/blackboard/history.hpp",
                            "runtime/blackboard/job_queue.hpp",  "runtime/blackboard/ports.hpp",
                            "runtime/blackboard/queue_ring.hpp", "runtime/blackboard/slot.hpp",
                            "runtime/executive/application.hpp"};
  for (const Unit& unit : model.units) own.insert(model.unit_types[unit.type].header);
  for (const Device& device : model.devices) {
    for (const DriverChoice& choice : device.drivers) own.insert(model.drivers[choice.driver].header);
    for (const DeviceResource& resource : device.resources) {
      own.insert(resource_header(model.interfaces[device.interface].resources[resource.resource].reader));
    }
  }
  for (const Slot& slot : model.slots) {
    if (slot.type.kind == SlotType::Kind::declared) own.insert(type_header(model.types[slot.type.index]));
  }
  for (const Queue& queue : model.queues) own.insert(type_header(model.types[queue.type]));
  return include_lines(system, own);
}

// The sizes of units and drivers are the compiler's to know, so the budget is judged here.
void emit_budget(const Application& application, const std::vector<std::string>& sizes, Text& out) {
  if (!application.memory_budget || sizes.empty()) return;
  out << "\n// ---- Memory against the budget\n\nconstexpr std::size_t memory_sizes[] = {\n";
  for (const std::string& size : sizes) out << "    " << size << ",\n";
  out << "};\nconstexpr std::size_t memory_used =\n    std::accumulate(std::begin(memory_sizes), "
         "std::end(memory_sizes), std::size_t{0});\n"
         "template <std::size_t bytes_used, std::size_t bytes_budgeted>\nstruct MemoryBudget {\n"
         "  static_assert(bytes_used <= bytes_budgeted,\n                "
      << string_literal(short_position(application.memory_budget_position) +
                        ": memory_budget is less than slots, queues, stacks, units and drivers take")
      << ");\n"
         "  static constexpr bool is_kept = true;\n};\nstatic_assert(MemoryBudget<memory_used, "
      << *application.memory_budget << ">::is_kept);\n";
}

void emit_application_record(const Model& model, Text& out) {
  const Application& application = *model.application;
  out << "\n// ---- The whole\n\n";
  const auto states = [&](std::string_view type, std::string_view name, std::size_t count) {
    if (count != 0) out << "constinit " << type << " " << name << "[" << count << "]{};\n";
  };
  states("UnitState", "states_of_units", model.units.size());
  states("DeviceState", "states_of_devices", model.devices.size());
  states("ThreadState", "states_of_threads", model.threads.size());
  const std::string renames = list_of(model.renames, [](const Rename& rename) {
    return "{" + string_literal(rename.from) + ", " + string_literal(rename.to) + "}";
  });
  emit_array("constexpr Rename", "renames_table", renames, out);
  Text ranges;
  emit_ranges(model, ranges);
  out << ranges.str();
  const auto table = [](std::string_view name, std::size_t count) {
    return count == 0 ? "{}" : std::string(name);
  };
  out << "extern const char descriptor_json[];\nextern const PanelRecord panel_record;\n"
      << "extern const Application application;\n"
      << "constinit const Application application{\n    .name = \"" << application.name
      << "\",\n    .summary = " << string_literal(application.summary)
      << ",\n    .descriptor_hash = " << hash_literal(descriptor_text(model).hash)
      << ",\n    .descriptor_json = descriptor_json,\n    .memory_budget = "
      << application.memory_budget.value_or(0)
      << ",\n    .autostart = " << bool_literal(application.autostart)
      << ",\n    .stop_timeout = " << duration_literal(application.stop_timeout)
      << ",\n    .finish_timeout = " << duration_literal(application.finish_timeout)
      << ",\n    .standstill_limit = " << duration_literal(application.standstill_limit) << ",\n    .save = {"
      << bool_literal(application.save.on_change) << ", " << duration_literal(application.save.quiet) << ", "
      << duration_literal(application.save.interval)
      << "},\n    .slots = " << table("slots_table", model.slots.size())
      << ",\n    .queues = " << table("queues_table", model.queues.size())
      << ",\n    .devices = " << table("devices_table", model.devices.size())
      << ",\n    .units = " << table("units_table", model.units.size())
      << ",\n    .populations = " << table("populations_table", model.populations.size())
      << ",\n    .threads = " << table("threads_table", model.threads.size())
      << ",\n    .renames = " << table("renames_table", model.renames.size())
      << ",\n    .ranges = " << (ranges.str().empty() ? "{}" : "ranges_table")
      << ",\n    .panel = &panel_record"
      << ",\n    .unit_states = " << table("states_of_units", model.units.size())
      << ",\n    .device_states = " << table("states_of_devices", model.devices.size())
      << ",\n    .thread_states = " << table("states_of_threads", model.threads.size()) << ",\n};\n";
}

// Of each class whose object the application has room for.
void define_sizes(const Model& model, Text& out) {
  Text sizes;
  std::set<Index> units, drivers;
  for (const Unit& unit : model.units)
    if (units.insert(unit.type).second) define_size(model.unit_types[unit.type], sizes);
  for (const Device& device : model.devices)
    for (const DriverChoice& choice : device.drivers)
      if (drivers.insert(choice.driver).second) define_size(model.drivers[choice.driver], sizes);
  if (sizes.str().empty()) return;
  const Space space(user_space);
  out << space.open() << sizes.str() << space.close() << "\n";
}

}  // namespace

std::string application_source(const Model& model, Diagnostics& diagnostics) {
  const ApplicationNames names(model, diagnostics);
  std::vector<std::string> sizes;
  Text out;
  out << generated_note(model.application->file) << includes_of(model) << "\n";
  define_sizes(model, out);
  out << application_space.open();
  emit_threads_memory(model, names, out, sizes);
  emit_slots(model, names, out, sizes);
  emit_readers(model, names, out);
  emit_queues(model, names, out, sizes);
  emit_devices(model, names, out, sizes);
  emit_units(model, names, out, sizes);
  out << "\n// ---- Tables\n";
  emit_slot_records(model, names, out);
  emit_queue_records(model, names, out);
  emit_thread_records(model, names, out);
  emit_budget(*model.application, sizes, out);
  emit_application_record(model, out);
  out << "\n" << application_space.close();
  return out.take();
}

}  // namespace flexrf::config_gen
