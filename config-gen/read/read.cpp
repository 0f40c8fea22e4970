// From tables to the Model.
#include <algorithm>

#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {
namespace {

void read_save(Row& application, SavePolicy& save, Diagnostics& diagnostics) {
  const Node* const table = application.table("save");
  if (table == nullptr) return;
  Row row(*table, "'save' of " + application.name(), diagnostics);
  save.on_change = row.word("on", {"change", "command"}).value_or(0) == 0;
  for (const char* const key : {"quiet", "interval"})
    if (!save.on_change && row.has(key))
      diagnostics.error(row.position(key), row.name() + " has " + quote(key) + ", but saves on command only",
                        "remove it, or write on = \"change\"");
  save.quiet = row.positive_duration("quiet", supervision_bounds).value_or(save.quiet);
  save.interval = row.positive_duration("interval", supervision_bounds).value_or(save.interval);
  row.finish();
}

void read_application(Library& library, const std::filesystem::path& file) {
  Diagnostics& diagnostics = library.diagnostics();
  Model& model = library.model();
  auto root = library.parse(file);
  if (!root) return;
  Application application;
  application.name = file.stem().string();
  application.file = file;
  application.position = root->position;
  std::string plain = application.name;
  std::replace(plain.begin(), plain.end(), '-', '_');
  if (!is_snake_case(plain))
    diagnostics.error(root->position,
                      "the file's name " + quote(application.name) + " is not a name for an application",
                      "use small letters, digits, and single '-' or '_', a letter first");
  Row row(*root, "this application table", diagnostics);
  application.summary = row.summary();
  application.memory_budget = row.size("memory_budget");
  application.memory_budget_position = row.position("memory_budget");
  if (!row.has("memory_budget"))
    row.missing("memory_budget",
                "add memory_budget = \"8 MiB\": what slots, queues, stacks and parameters may take");
  application.autostart = row.boolean("autostart").value_or(false);
  application.stop_timeout =
      row.positive_duration("stop_timeout", supervision_bounds).value_or(application.stop_timeout);
  application.finish_timeout =
      row.positive_duration("finish_timeout", supervision_bounds).value_or(application.finish_timeout);
  application.standstill_limit =
      row.positive_duration("standstill_limit", supervision_bounds).value_or(application.standstill_limit);
  read_save(row, application.save, diagnostics);
  for (const char* section :
       {"device", "device_list", "unit", "slot", "queue", "thread", "group", "renamed", "panel", "widget"})
    row.also(section);
  row.finish();
  model.application = std::move(application);

  const Node* const renamed = root->find("renamed");
  const std::optional<Node> renames = renamed != nullptr ? std::optional<Node>(*renamed) : std::nullopt;
  Assembly assembly(library);
  assembly.flat = flatten(library, std::move(*root), file.parent_path());
  assembly.broken_places.insert(assembly.flat.broken_places.begin(), assembly.flat.broken_places.end());
  for (const FlatRow& flat : assembly.flat.rows) {
    const InScope in_scope(diagnostics, *flat.scope);
    if (flat.kind == FlatRow::Kind::device) read_device_row(assembly, flat);
    if (flat.kind == FlatRow::Kind::unit) read_unit_row(assembly, flat);
  }
  connect_devices(assembly);
  connect_outputs(assembly);
  connect_inputs(assembly);
  read_place_rows(assembly);
  read_threads(assembly);
  if (renames) read_renames(assembly, *renames);
  derive(assembly);
  read_panel(assembly);
  for (Device& device : model.devices)
    device.partial = device.partial || assembly.is_broken_device(device.name);
  for (Slot& slot : model.slots) slot.partial = assembly.broken_places.contains(array_base(slot.name));
  for (Queue& queue : model.queues) queue.partial = assembly.broken_places.contains(queue.declared);
}

void read_target(Library& library, const Target& target) {
  switch (target.kind) {
    case Target::Kind::types:
      library.read_types(target.file);
      break;
    case Target::Kind::unit:
      library.read_unit(target.file);
      break;
    case Target::Kind::interface:
      library.read_interface(target.file);
      break;
    case Target::Kind::driver:
      library.read_driver(target.file);
      break;
    case Target::Kind::application:
      read_application(library, target.file);
      break;
  }
}

}  // namespace

Model read(const Target& target, const SearchPaths& paths, Diagnostics& diagnostics) {
  Model model;
  SearchPaths all = paths;
  if (target.kind == Target::Kind::types) {
    all.types.push_back(target.file);
  } else if (target.kind == Target::Kind::application) {
    all.types.push_back(target.file.parent_path() / "types");
    all.units.push_back(target.file.parent_path() / "units");
  }
  try {
    Library library(model, std::move(all), diagnostics);
    read_target(library, target);
  } catch (const GivenUp&) {
    // They are in `diagnostics`.
  }
  return model;
}

}  // namespace flexrf::config_gen
