// [thread.N] rows of applications and groups, and the IO threads of devices.
#include <algorithm>

#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::string_view trigger_hint =
    "write { period = \"7 ms\" }, { slots = [\"keys\"] }, { device = \"can0\" }, { backoff = \"frames\", ... "
    "} or { free = true }";

// "axis[*].drive" against "axis[2].drive".
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0;
  while (p < pattern.size()) {
    if (pattern[p] == '*') {
      const std::size_t start = n;
      while (n < name.size() && name[n] >= '0' && name[n] <= '9') ++n;
      if (n == start) return false;
      ++p;
    } else {
      if (n == name.size() || pattern[p] != name[n]) return false;
      ++p;
      ++n;
    }
  }
  return n == name.size();
}

std::optional<SourceReference> one_source(Assembly& assembly, const std::string& name) {
  if (const auto slot = assembly.slots.find(name); slot != assembly.slots.end())
    return SourceReference{false, slot->second};
  if (const auto queue = assembly.queues.find(name); queue != assembly.queues.end())
    return SourceReference{true, queue->second.front()};
  return std::nullopt;
}

std::vector<SourceReference> find_sources(Assembly& assembly, const Scope& scope, const Node& value) {
  const std::string name = scope.slot_name(value.text);
  if (const auto source = one_source(assembly, name)) return {*source};
  std::vector<SourceReference> sources;
  if (const auto array = assembly.arrays.find(name); array != assembly.arrays.end()) {
    auto members = array->second;
    std::sort(members.begin(), members.end());
    for (const auto& [member, slot] : members) sources.push_back({false, slot});
    return sources;
  }
  if (assembly.broken_places.contains(array_base(name))) return {};
  std::vector<std::string> known = assembly.names_in(scope, assembly.slots);
  for (const std::string& queue : assembly.names_in(scope, assembly.queues)) known.push_back(queue);
  assembly.diagnostics.error(
      value.position, "unknown slot or queue " + quote(value.text) + " in a trigger",
      suggest(value.text, known, "slots and queues", "nothing is published in this application"));
  return {};
}

// A timeout releases whatever min_interval says, which the schedulability analysis counts on.
template <typename TimedTrigger>
void read_times(Assembly& assembly, Row& row, TimedTrigger& trigger) {
  trigger.min_interval = row.positive_duration("min_interval", release_bounds);
  trigger.timeout = row.positive_duration("timeout", release_bounds);
  if (trigger.timeout && trigger.min_interval && *trigger.timeout < *trigger.min_interval)
    assembly.diagnostics.error(
        row.position("timeout"),
        "'timeout' of " + row.name() + " is " + duration_text(*trigger.timeout) +
            ", shorter than its 'min_interval' of " + duration_text(*trigger.min_interval),
        "a release by the timeout comes no sooner than any other: lengthen it, or shorten min_interval");
}

// Each source fires by one bit of its own.
void add_source(Assembly& assembly, const Node& name, const SourceReference& source, SlotsTrigger& trigger,
                const Row& row) {
  const bool known = std::any_of(
      trigger.sources.begin(), trigger.sources.end(),
      [&](const SourceReference& one) { return one.queue == source.queue && one.index == source.index; });
  if (!known) {
    trigger.sources.push_back(source);
    return;
  }
  const std::string& full =
      source.queue ? assembly.model.queues[source.index].declared : assembly.model.slots[source.index].name;
  assembly.diagnostics.error(name.position, quote(full) + " is twice in 'slots' of " + row.name(),
                             "remove one; the name of an array means all its members");
}

Trigger read_slots_trigger(Assembly& assembly, Row& row, const Scope& scope) {
  SlotsTrigger trigger;
  if (const Node* names = row.list_of_texts("slots")) {
    if (names->children.empty())
      assembly.diagnostics.error(names->position, "'slots' of " + row.name() + " is empty",
                                 "name at least one slot or queue");
    for (const Node& name : names->children)
      for (const SourceReference& source : find_sources(assembly, scope, name))
        add_source(assembly, name, source, trigger, row);
  }
  read_times(assembly, row, trigger);
  return trigger;
}

std::optional<Trigger> read_device_trigger(Assembly& assembly, Row& row, const Scope& scope) {
  DeviceTrigger trigger;
  const auto name = row.text("device");
  read_times(assembly, row, trigger);
  if (!name) return std::nullopt;
  auto found = assembly.devices.find(scope.prefix + *name);
  if (found == assembly.devices.end()) found = assembly.devices.find(*name);
  if (found == assembly.devices.end()) {
    if (!assembly.is_broken_device(scope.prefix + *name))
      assembly.diagnostics.error(row.position("device"), "unknown device " + quote(*name) + " in a trigger",
                                 suggest(*name, assembly.names_in(scope, assembly.devices), "devices",
                                         "declare it as [device." + *name + "]"));
    return std::nullopt;
  }
  trigger.device = found->second;
  return trigger;
}

std::optional<Trigger> read_backoff_trigger(Assembly& assembly, Row& row, const Scope& scope) {
  BackoffTrigger trigger;
  const bool named = row.text("backoff").has_value();
  for (const char* key : {"shortest", "longest"})
    if (!row.has(key))
      row.missing(key, "add shortest = \"100 us\" and longest = \"50 ms\": the bounds of its sleeps");
  trigger.shortest = row.positive_duration("shortest", sleep_bounds).value_or(0);
  trigger.longest = row.positive_duration("longest", sleep_bounds).value_or(0);
  trigger.tries = static_cast<std::size_t>(row.integer("tries", 1, 1000).value_or(4));
  if (trigger.shortest > trigger.longest && trigger.longest > 0)
    assembly.diagnostics.error(row.position("shortest"),
                               "'shortest' of " + row.name() + " is longer than 'longest': " +
                                   duration_text(trigger.shortest) + " and " + duration_text(trigger.longest),
                               "exchange the two");
  if (!named) return std::nullopt;
  const Node& value = *row.node().find("backoff");
  const auto sources = find_sources(assembly, scope, value);
  if (sources.size() > 1)
    assembly.diagnostics.error(
        value.position,
        "'backoff' of " + row.name() + " polls one source, but " + quote(value.text) + " is an array",
        "choose a member, as " + quote(value.text + "[0]"));
  if (sources.empty()) return std::nullopt;
  trigger.source = sources.front();
  return trigger;
}

std::optional<Trigger> read_trigger(Assembly& assembly, Row& thread, const Scope& scope) {
  if (!thread.has("trigger")) thread.missing("trigger", trigger_hint);
  const Node* table = thread.table("trigger");
  if (table == nullptr) return std::nullopt;
  Row row(*table, "'trigger' of " + thread.name(), assembly.diagnostics);
  std::vector<std::string> kinds;
  for (const char* kind : {"period", "slots", "device", "backoff", "free"})
    if (row.has(kind)) kinds.emplace_back(kind);
  if (kinds.size() != 1) {
    static const std::vector<std::string> keys = {"period",   "slots",   "device",       "backoff",
                                                  "free",     "phase",   "min_interval", "timeout",
                                                  "shortest", "longest", "tries"};
    for (const std::string& key : keys) row.also(key);
    row.finish();
    bool misspelt = false;  // said already
    for (const Node& child : table->children)
      misspelt = misspelt || std::find(keys.begin(), keys.end(), child.key) == keys.end();
    if (kinds.size() > 1)
      assembly.diagnostics.error(table->position, row.name() + " has several kinds: " + listed(kinds),
                                 "keep one; a slots or device trigger may have a 'timeout'");
    else if (!misspelt)
      assembly.diagnostics.error(table->position, row.name() + " has no kind", std::string(trigger_hint));
    return std::nullopt;
  }
  std::optional<Trigger> trigger;
  if (kinds[0] == "period") {
    PeriodTrigger period;
    const auto length = row.positive_duration("period", release_bounds);
    period.phase = row.duration("phase").value_or(0);
    if (length) {
      period.period = *length;
      trigger = period;
      if (period.phase >= period.period)
        assembly.diagnostics.error(row.position("phase"),
                                   "'phase' of " + row.name() + " is " + duration_text(period.phase) +
                                       ", not shorter than its period of " + duration_text(period.period),
                                   "a phase shifts the releases within one period");
    }
  } else if (kinds[0] == "slots") {
    trigger = read_slots_trigger(assembly, row, scope);
  } else if (kinds[0] == "device") {
    trigger = read_device_trigger(assembly, row, scope);
  } else if (kinds[0] == "backoff") {
    trigger = read_backoff_trigger(assembly, row, scope);
  } else {
    if (const auto free = row.boolean("free"); free && !*free)
      assembly.diagnostics.error(row.position("free"), "'free' of " + row.name() + " is false",
                                 std::string(trigger_hint));
    trigger = FreeTrigger{};
  }
  row.finish();
  return trigger;
}

void read_overrun(Assembly& assembly, Row& thread, Overrun& overrun) {
  const Node* table = thread.table("overrun");
  if (table == nullptr) return;
  Row row(*table, "'overrun' of " + thread.name(), assembly.diagnostics);
  if (const auto policy = row.word("policy", {"skip", "catch-up", "fault"}))
    overrun.policy = static_cast<Overrun::Policy>(*policy);
  if (const auto count = row.integer("consecutive", 1, 1'000'000)) {
    overrun.limit = Overrun::Limit::consecutive;
    overrun.consecutive = static_cast<std::size_t>(*count);
  }
  if (const Node* leaky = row.table("leaky")) {
    Row bucket(*leaky, "'leaky' of " + thread.name(), assembly.diagnostics);
    for (const char* key : {"limit", "drain"})
      if (!bucket.has(key))
        bucket.missing(
            key, "write leaky = { limit = 5, drain = 100 }: a fault at 5, one less each 100 good cycles");
    overrun.limit = Overrun::Limit::leaky;
    overrun.leaky_limit = static_cast<std::size_t>(bucket.integer("limit", 1, 1'000'000).value_or(1));
    overrun.leaky_drain = static_cast<std::size_t>(bucket.integer("drain", 1, 1'000'000).value_or(1));
    bucket.finish();
    if (row.has("consecutive"))
      assembly.diagnostics.error(row.position("leaky"), row.name() + " has both 'consecutive' and 'leaky'",
                                 "keep one limit");
  }
  row.finish();
}

void check_number(Assembly& assembly, const Position& position) {
  if (assembly.model.threads.size() < max_threads) return;
  assembly.diagnostics.give_up(
      position, "with this row the application has more than " + std::to_string(max_threads) + " threads",
      "those of instances of groups, of members of populations and of devices count: let one thread step "
      "several "
      "units");
}

// each = "tracker": a thread as this for each member of the population, called by its number.
void add_each(Assembly& assembly, Row& row, const Scope& scope, Thread thread) {
  Model& model = assembly.model;
  const auto name = row.text("each");
  const std::string full = scope.prefix + name.value_or("");
  const auto found = assembly.populations.find(full);
  if (found == assembly.populations.end()) {
    thread.units_unknown = true;
    model.threads.push_back(std::move(thread));
    if (!name || assembly.broken_owners.contains(full)) return;
    const Position position = row.position("each");
    const auto unit = assembly.units.find(full);
    if (unit == assembly.units.end()) {
      assembly.diagnostics.error(position, "unknown population " + quote(*name) + " in " + row.name(),
                                 suggest(*name, assembly.names_in(scope, assembly.populations), "populations",
                                         "declare it as [unit." + *name + "] with a 'capacity'"));
    } else if (const auto population = model.units[unit->second].population) {
      const std::string meant = model.populations[*population].name.substr(scope.prefix.size());
      assembly.diagnostics.error(
          position, quote(*name) + " in " + row.name() + " is one member of a population",
          "write each = \"" + meant + "\": a thread for each of them; or units = [\"" + *name + "\"]");
    } else {
      assembly.diagnostics.error(position, quote(*name) + " in " + row.name() + " is no population",
                                 "write units = [\"" + *name + "\"], or give the unit a 'capacity'");
    }
    return;
  }
  const Population& population = model.populations[found->second];
  for (std::size_t member = 0; member < population.capacity; ++member) {
    check_number(assembly, thread.position);
    Thread one = thread;
    one.name += "[" + std::to_string(member) + "]";
    const Index unit = population.first + member;
    one.units = {unit};
    if (!model.units[unit].thread) model.units[unit].thread = model.threads.size();
    model.threads.push_back(std::move(one));
  }
}

void read_units(Assembly& assembly, Row& row, const Scope& scope, Thread& thread, Index index) {
  if (!row.has("units"))
    row.missing("units",
                "add units = [\"jog\"], in the order of their steps; or each = \"tracker\", for a thread of "
                "each member of a population");
  const Node* names = row.list_of_texts("units");
  thread.units_unknown = names == nullptr;
  if (names == nullptr) return;
  if (names->children.empty())
    assembly.diagnostics.error(names->position, row.name() + " has no units",
                               "list at least one unit, or remove the thread");
  for (const Node& name : names->children) {
    const std::string full = scope.prefix + name.text;
    std::vector<Index> found;
    if (const auto unit = assembly.units.find(full); unit != assembly.units.end())
      found.push_back(unit->second);
    if (const auto population = assembly.populations.find(full); population != assembly.populations.end()) {
      const Population& all = assembly.model.populations[population->second];
      for (std::size_t member = 0; member < all.capacity; ++member) found.push_back(all.first + member);
    }
    bool broken = assembly.broken_owners.contains(full);
    if (full.find('*') != std::string::npos) {
      for (Index unit = 0; unit < assembly.model.units.size(); ++unit) {
        const Unit& one = assembly.model.units[unit];
        const bool population =
            one.population && matches(full, assembly.model.populations[*one.population].name);
        if (population || matches(full, one.name)) found.push_back(unit);
      }
      for (const std::string& owner : assembly.broken_owners) broken = broken || matches(full, owner);
    }
    if (found.empty() && !broken) {
      std::vector<std::string> known = assembly.names_in(scope, assembly.units);
      for (const std::string& population : assembly.names_in(scope, assembly.populations))
        known.push_back(population);
      const auto meant = assembly.units.find(scope.prefix + nearest(name.text, known));
      if (meant != assembly.units.end()) assembly.model.units[meant->second].partial = true;
      assembly.diagnostics.error(
          name.position, "unknown unit " + quote(name.text) + " in " + row.name(),
          suggest(name.text, known, "units", "declare it as [unit." + name.text + "]"));
    }
    for (const Index unit : found) {
      thread.units.push_back(unit);
      if (!assembly.model.units[unit].thread) assembly.model.units[unit].thread = index;
    }
  }
}

void read_thread_row(Assembly& assembly, const FlatRow& flat) {
  Row row(*flat.node, "[thread." + flat.node->key + "]", assembly.diagnostics);
  Thread thread;
  thread.name = flat.scope->prefix + flat.node->key;
  thread.position = flat.node->key_position;
  thread.trigger_position = row.position("trigger");
  thread.priority = static_cast<int>(row.integer("priority", 0, 98).value_or(0));
  thread.role = read_role(row).value_or(thread.role);
  if (row.word("cpu", {"rest"})) thread.role = CpuRole::rest;
  thread.above_interrupts = row.boolean("above_interrupts").value_or(false);
  thread.deadline = row.positive_duration("deadline", release_bounds);
  thread.hang_timeout = row.positive_duration("hang_timeout", supervision_bounds);
  thread.stack = read_stack(row, assembly.diagnostics).value_or(thread.stack);
  thread.summary = row.sentence("summary").value_or("");
  read_overrun(assembly, row, thread.overrun);
  const auto trigger = read_trigger(assembly, row, *flat.scope);
  thread.partial = !trigger;
  if (trigger) thread.trigger = *trigger;
  if (row.has("each") && !row.has("units")) {
    row.also("units");
    add_each(assembly, row, *flat.scope, std::move(thread));
    row.finish();
    return;
  }
  row.also("each");
  if (row.has("each"))
    assembly.diagnostics.error(row.position("each"), row.name() + " has both 'units' and 'each'",
                               "keep 'units' for one thread that steps them in turn, 'each' for a thread of "
                               "each member of a population");
  read_units(assembly, row, *flat.scope, thread, assembly.model.threads.size());
  row.finish();
  assembly.model.threads.push_back(std::move(thread));
}

}  // namespace

std::optional<CpuRole> read_role(Row& row) {
  const auto role = row.word("role", {cpu_role_names.begin(), cpu_role_names.begin() + 3});
  return role ? std::optional(static_cast<CpuRole>(*role)) : std::nullopt;
}

std::optional<std::size_t> read_stack(Row& row, Diagnostics& diagnostics) {
  const auto stack = row.size("stack");
  if (!stack || (*stack >= min_stack && *stack <= max_stack)) return stack;
  diagnostics.error(
      row.position("stack"), "'stack' of " + row.name() + " is " + size_text(*stack),
      "a thread's stack has from " + size_text(min_stack) + " to 1 GiB" + "; without the key it has 256 KiB");
  return std::nullopt;
}

void read_threads(Assembly& assembly) {
  Model& model = assembly.model;
  for (const FlatRow& row : assembly.flat.rows) {
    const InScope in_scope(assembly.diagnostics, *row.scope);
    if (row.kind == FlatRow::Kind::thread) {
      check_number(assembly, row.node->key_position);
      read_thread_row(assembly, row);
    }
  }
  const std::size_t declared = model.threads.size();
  for (Thread& thread : assembly.io_threads) {
    check_number(assembly, thread.position);
    for (std::size_t i = 0; i < declared; ++i)
      if (model.threads[i].name == thread.name)
        assembly.diagnostics.error(
            model.threads[i].position,
            "the name " + quote(thread.name) + " is used twice: for a thread and the IO thread of a device",
            "rename one; the IO thread is at " + to_string(thread.position));
    model.devices[*thread.io_device].io_thread = model.threads.size();
    model.threads.push_back(std::move(thread));
  }
}

}  // namespace flexrf::config_gen
