// The application while it is put together: what its rows have become so far, by name.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "config-gen/read/scope.hpp"

namespace flexrf::config_gen {

// A row and the units it became: one, or the members of a population.
struct UnitRow {
  const FlatRow* row = nullptr;
  Index first = 0;
  std::size_t count = 1;
  bool population = false;
};

struct DeviceRow {
  const FlatRow* row = nullptr;
  Index device = 0;
};

struct Assembly {
  explicit Assembly(Library& from) : library(from), model(from.model()), diagnostics(from.diagnostics()) {}

  Library& library;
  Model& model;
  Diagnostics& diagnostics;
  Flattened flat;

  std::map<std::string, Index> devices;
  std::map<std::string, Index> units;  // members of populations too
  std::map<std::string, Index> populations;
  std::map<std::string, Index> slots;
  std::map<std::string, std::vector<Index>> queues;  // several for copies
  std::map<std::string, std::vector<std::pair<std::size_t, Index>>>
      arrays;  // slots "name[3]" by name: member, slot
  std::vector<UnitRow> unit_rows;
  std::vector<DeviceRow> device_rows;
  std::vector<Thread> io_threads;

  std::size_t values = 0;        // of the parameters of all units so far
  std::set<std::string> copied;  // queues with share = "copies"

  // Rows too broken to become anything, and the slots they name: nothing that depends on them is judged.
  std::set<std::string> broken_owners;  // units and devices
  std::set<std::string> broken_places;  // slots and queues

  // Of a device that is there, or unknown: something is wrong that was reported.
  bool is_broken_device(const std::string& name) const {
    return flat.devices_missing || broken_owners.contains(name);
  }

  // Names of `table` that rows of `scope` can use, as they would write them.
  template <typename Map>
  std::vector<std::string> names_in(const Scope& scope, const Map& table) const {
    std::vector<std::string> names;
    for (const auto& [name, index] : table)
      if (name.starts_with(scope.prefix)) names.push_back(name.substr(scope.prefix.size()));
    return names;
  }
};

// Each stage needs those before it.
void read_device_row(Assembly& assembly, const FlatRow& row);
void read_unit_row(Assembly& assembly, const FlatRow& row);
void connect_devices(Assembly& assembly);  // to buses and units
void connect_outputs(Assembly& assembly);  // makes slots and queues
void read_place_rows(Assembly& assembly);  // [slot.N], [queue.N]
void connect_inputs(Assembly& assembly);
void read_threads(Assembly& assembly);
void read_renames(Assembly& assembly, const Node& table);  // [renamed]
void derive(Assembly& assembly);                           // readers, doorbells, parameter slots, order
void read_panel(Assembly& assembly);                       // [panel], [widget.N]

// `section`.P = v for parameters of `block`, under `table` (may be null): a value for each parameter.
std::vector<Literal> read_values(Assembly& assembly, const Node* table, const ParameterBlock& block,
                                 const std::string& section, const std::string& row_name);

// A block of the configuration and its values, one for each parameter.
struct ConfigurationPart {
  const ParameterBlock& block;
  const std::vector<Literal>& values;
};

// Whether each parameter of `own` that is set in this row has what it needs there, of `own` or of what its
// interface has.
void check_needs_of_configuration(Assembly& assembly, const ConfigurationPart& own,
                                  const std::optional<ConfigurationPart>& of_interface, const Row& row);

// parameter.P = {...} under `table` (may be null), for parameters of `blocks`; `owner` is as "'arm'".
std::vector<ParameterOverride> read_overrides(Assembly& assembly, const Node* table,
                                              const std::vector<const ParameterBlock*>& blocks,
                                              const std::string& owner, const std::string& row_name);
// The values of `block` that a narrowed range would leave out.
void check_narrowed(Assembly& assembly, const std::vector<ParameterOverride>& changes,
                    const ParameterBlock& block, const std::vector<Literal>& values);

// The key `role` of a thread's row.
std::optional<CpuRole> read_role(Row& row);
// The key `stack` of a thread's row; what is less than any thread needs is reported.
std::optional<std::size_t> read_stack(Row& row, Diagnostics& diagnostics);

// Marks every slot that a broken row names.
void mark_broken(Assembly& assembly, const FlatRow& row);
// The same of the sections `in` and `out` of one table.
void mark_broken_places(Assembly& assembly, const Node& table, const Scope& scope);

}  // namespace flexrf::config_gen
