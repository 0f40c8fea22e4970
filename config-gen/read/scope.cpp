#include "config-gen/read/scope.hpp"

#include <algorithm>

#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/arguments.hpp"
#include "config-gen/read/device_list.hpp"

namespace flexrf::config_gen {
namespace {

struct RowKind {
  std::string_view key;
  FlatRow::Kind kind;
  std::string_view what;
};

constexpr RowKind row_kinds[] = {{"device", FlatRow::Kind::device, "a device"},
                                 {"unit", FlatRow::Kind::unit, "a unit"},
                                 {"slot", FlatRow::Kind::slot, "a slot"},
                                 {"queue", FlatRow::Kind::queue, "a queue"},
                                 {"thread", FlatRow::Kind::thread, "a thread"}};

bool is_group_row(const Node& tree, const Node* row) {
  const Node* groups = tree.find("group");
  return groups != nullptr && !groups->children.empty() && row >= groups->children.data() &&
         row < groups->children.data() + groups->children.size();
}

class Flattener {
 public:
  Flattener(Library& library, std::filesystem::path folder)
      : library_(library), diagnostics_(library.diagnostics()), folder_(std::move(folder)) {}

  Flattened run(Node application) {
    add_listed(application);
    fill_in(application, {}, std::nullopt, false, diagnostics_);
    Scope& root = result_.scopes.emplace_back();
    root.tree = std::move(application);
    walk(root);
    return std::move(result_);
  }

 private:
  void add_listed(Node& table) {
    if (!add_listed_devices(table, folder_, diagnostics_, library_.model().files))
      result_.devices_missing = true;
  }

  // Where a table says that there is this row.
  static const Position& place_of(const Node& row) { return row.listed ? row.listed : row.key_position; }

  void walk(const Scope& scope) {
    const InScope in_scope(diagnostics_, scope);
    struct Found {
      const Node* node;
      FlatRow::Kind kind;
      bool group;
    };
    std::vector<Found> found;
    for (const RowKind& kind : row_kinds)
      for (const Node* node : named_rows(library_, scope.tree, kind.key, kind.what))
        found.push_back({node, kind.kind, false});
    for (const Node* node : named_rows(library_, scope.tree, "group", "a group"))
      found.push_back({node, FlatRow::Kind::unit, true});
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return place_of(*a.node) < place_of(*b.node); });
    check_names(scope, found);
    for (const Found& row : found) {
      if (row.group)
        instantiate(scope, *row.node);
      else if (result_.rows.size() == max_rows)
        too_many(row.node->key_position, std::to_string(max_rows) + " rows");
      else
        result_.rows.push_back({row.kind, row.node, &scope});
    }
  }

  // Each instance is a copy of its table.
  [[noreturn]] void too_many(const Position& position, const std::string& most) {
    diagnostics_.give_up(position, "with this row the application has more than " + most,
                         "instances of groups count with all their rows: lower a 'count'");
  }

  // Units, devices and groups have pages and values under their names, so these differ; as do slots and
  // queues.
  template <typename Rows>
  void check_names(const Scope& scope, const Rows& rows) {
    std::map<std::string, std::pair<std::string, Position>> owners, places;
    for (const auto& row : rows) {
      if (row.kind == FlatRow::Kind::thread) continue;
      const bool place = row.kind == FlatRow::Kind::slot || row.kind == FlatRow::Kind::queue;
      const std::string what = is_group_row(scope.tree, row.node)  ? "group"
                               : row.kind == FlatRow::Kind::device ? "device"
                               : row.kind == FlatRow::Kind::slot   ? "slot"
                               : row.kind == FlatRow::Kind::queue  ? "queue"
                                                                   : "unit";
      auto& taken = place ? places : owners;
      const auto [first, is_new] = taken.try_emplace(row.node->key, what, row.node->key_position);
      if (!is_new)
        diagnostics_.error(row.node->key_position,
                           "the name " + quote(row.node->key) + " is used twice: for a " +
                               first->second.first + " and a " + what,
                           "rename one; the other is at " + to_string(first->second.second));
    }
  }

  const Node* load(const std::string& table, const Position& place) {
    const auto known = tables_.find(table);
    if (known != tables_.end()) return known->second ? &*known->second : nullptr;
    const std::filesystem::path file = folder_ / "groups" / (table + ".toml");
    std::error_code ignored;
    if (std::filesystem::status(file, ignored).type() == std::filesystem::file_type::not_found) {
      std::vector<std::string> names;
      for (const auto& entry : std::filesystem::directory_iterator(folder_ / "groups", ignored))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
      diagnostics_.error(place, "unknown group table " + quote(table),
                         suggest(table, names, "group tables", "declare it in " + file.generic_string()));
      return nullptr;
    }
    auto& tree = tables_.emplace(table, library_.parse(file)).first->second;
    if (!tree) return nullptr;
    add_listed(*tree);
    Row row(*tree, "this group table", diagnostics_);
    row.summary();
    for (const char* section :
         {"device", "device_list", "unit", "slot", "queue", "thread", "group", "argument", "port"})
      row.also(section);
    row.finish();
    return &*tree;
  }

  void instantiate(const Scope& outer, const Node& row_node) {
    Row row(row_node, "[group." + row_node.key + "]", diagnostics_);
    const auto table = row.required_text("table", "add table = \"axis\", the name of a file in groups/");
    const auto count = row.integer("count", 1, 4096);
    row.table("with");
    row.table("in");
    row.table("out");
    row.sentence("summary");
    row.finish();
    if (!table) return;
    if (std::find(open_.begin(), open_.end(), *table) != open_.end()) {
      std::vector<std::string> path(std::find(open_.begin(), open_.end(), *table), open_.end());
      path.push_back(*table);
      diagnostics_.error(row.position("table"),
                         "the group " + quote(*table) + " contains itself: " + join(path, " -> "),
                         "a group may contain other groups, but never itself");
      return;
    }
    if (open_.size() == max_nesting) {
      diagnostics_.error(row.position("table"),
                         "groups are nested deeper than " + std::to_string(max_nesting),
                         "a group of groups of groups: let the application name some of them itself");
      return;
    }
    const Node* group = load(*table, row.position("table"));
    if (group == nullptr) {
      mark_broken(outer, row_node);
      return;
    }
    open_.push_back(*table);
    const std::size_t instances = static_cast<std::size_t>(count.value_or(1));
    for (std::size_t i = 0; i < instances; ++i) {
      if (library_.model().groups.size() == max_instances)
        too_many(row_node.key_position, std::to_string(max_instances) + " instances of groups");
      else
        make(outer, row_node, *table, *group, i, row.has("count"));
    }
    open_.pop_back();
  }

  // Nobody writes or reads what this row names, and the reason was reported.
  void mark_broken(const Scope& outer, const Node& row) {
    for (const char* direction : {"in", "out"})
      if (const Node* section = row.find(direction))
        for (const Node& child : section->children)
          result_.broken_places.push_back(array_base(outer.slot_name(child.text)));
  }

  void make(const Scope& outer, const Node& row_node, const std::string& table, const Node& group,
            std::size_t index, bool counted) {
    Node row = row_node;
    Diagnostics said;  // what is unknown here was reported when the table around it was filled in
    fill_in(row, {}, index, true, said);
    Scope& scope = result_.scopes.emplace_back();
    scope.instance = outer.prefix + row.key + (counted ? "[" + std::to_string(index) + "]" : "");
    scope.prefix = scope.instance + ".";
    scope.instantiated = row.key_position;
    library_.model().groups.push_back({scope.instance, table, row.key_position});
    const Node* with = row.find("with");
    if (with != nullptr && with->kind != Node::Kind::table) with = nullptr;
    const Arguments arguments = read_arguments(library_, group, with, row);
    scope.tree = group;
    {
      const InScope in_scope(diagnostics_, scope);
      fill_in(scope.tree, arguments, index, true, diagnostics_);
    }
    connect(outer, row_node, row, scope, counted ? "[" + std::to_string(index) + "]" : "");
    walk(scope);
  }

  // `raw` is the row before ${index} was filled in: an output that does not say ${index} becomes an array.
  void connect(const Scope& outer, const Node& raw, const Node& row, Scope& scope, const std::string& index) {
    std::vector<std::string> names[2];
    const auto ports = named_rows(library_, scope.tree, "port", "a port");
    for (const Node* port : ports) {
      Row port_row(*port, "[port." + port->key + "]", diagnostics_);
      port_row.summary();
      const auto in = port_row.text("in");
      const auto out = port_row.text("out");
      port_row.finish();
      if (in.has_value() == out.has_value()) {
        diagnostics_.error(port->key_position, "[port." + port->key + "] needs either 'in' or 'out'",
                           "write in = \"unit.port\" or out = \"unit.port\"");
        continue;
      }
      names[in ? 0 : 1].push_back(port->key);
      const auto slot = outer_slot(outer, raw, row, *port, in.has_value(), index);
      if (slot) expose(scope, *port, in ? *in : *out, in.has_value(), *slot);
    }
    for (const bool in : {true, false}) report_unknown_ports(outer, row, in, names[in ? 0 : 1]);
  }

  // The full name of the slot that an instance connects a port to: in its row, or by a port of the group
  // around.
  std::optional<std::string> outer_slot(const Scope& outer, const Node& raw, const Node& row,
                                        const Node& port, bool in, const std::string& index) {
    for (const PortBinding& binding : outer.bindings)
      if (binding.input == in && binding.target == row.key && binding.port == port.key)
        return in ? binding.slot : binding.slot + index;
    const Node* section = row.find(in ? "in" : "out");
    const Node* value = section != nullptr ? section->find(port.key) : nullptr;
    if (value == nullptr || value->kind != Node::Kind::text || value->broken) return std::nullopt;
    const Node* raw_value = raw.find(in ? "in" : "out")->find(port.key);
    std::string slot = value->text;
    if (!in && raw_value->text.find("${index}") == std::string::npos) slot += index;
    if (is_slot_name(slot)) return outer.slot_name(slot);
    diagnostics_.error(value->position, quote(slot) + " is not the name of a slot or queue",
                       "write a name as \"keys\", or one of an array as \"tracks[3]\"");
    return std::nullopt;
  }

  void report_unknown_ports(const Scope& outer, const Node& row, bool in,
                            const std::vector<std::string>& known) {
    const std::string kind = in ? "input" : "output";
    for (const PortBinding& binding : outer.bindings)
      if (binding.input == in && binding.target == row.key &&
          std::find(known.begin(), known.end(), binding.port) == known.end())
        diagnostics_.error(
            binding.position,
            "unknown " + kind + " port " + quote(binding.port) + " of the group " + quote(row.key),
            suggest(binding.port, known, kind + " ports", "the group's table exposes no " + kind));
    const Node* section = row.find(in ? "in" : "out");
    if (section == nullptr) return;
    for (const Node& child : section->children) {
      if (child.kind != Node::Kind::text) {
        diagnostics_.error(child.position,
                           quote(child.key) + " of [group." + row.key + "] must be the name of a slot, not " +
                               kind_text(child.kind),
                           "write it in double quotes");
      } else if (std::find(known.begin(), known.end(), child.key) == known.end()) {
        result_.broken_places.push_back(array_base(outer.slot_name(child.text)));
        diagnostics_.error(
            child.key_position,
            "unknown " + kind + " port " + quote(child.key) + " of the group in [group." + row.key + "]",
            suggest(child.key, known, kind + " ports", "the group's table exposes no " + kind));
      }
    }
  }

  static std::vector<std::string> drivers_of(const Node& device) {
    std::vector<std::string> names;
    if (const Node* list = device.find("drivers"))
      for (const Node& driver : list->children) names.push_back(driver.text);
    return names;
  }
  // Of a device's row what it says of a driver.
  static const Node* table_of(const Node& device, const std::string& driver) {
    static const Node nothing_said;
    const Node* table = device.find(driver);
    return table != nullptr ? table : &nothing_said;
  }

  // The port leads to `target` = "unit.port", or "device.driver.port". If that is connected inside, its slot
  // becomes the slot outside.
  void expose(Scope& scope, const Node& port, const std::string& target, bool in, const std::string& slot) {
    const Node& place = *port.find(in ? "in" : "out");
    const std::size_t dot = target.rfind('.');
    const std::string name = target.substr(0, dot);
    const std::string inner_port = dot == std::string::npos ? "" : target.substr(dot + 1);
    const Node* owner = nullptr;
    std::vector<std::string> known;
    for (const char* kind : {"unit", "group", "device"}) {
      const Node* section = scope.tree.find(kind);
      if (section == nullptr) continue;
      for (const Node& row : section->children) {
        known.push_back(row.key);
        if (row.key == name) owner = &row;
        if (kind != std::string_view("device")) continue;
        for (const std::string& driver : drivers_of(row)) {
          known.push_back(row.key + "." + driver);
          if (known.back() == name) owner = table_of(row, driver);
        }
      }
    }
    const InScope in_scope(diagnostics_, scope);
    if (inner_port.empty()) {
      diagnostics_.error(place.position, quote(target) + " is not a port inside of the group",
                         "write it as \"unit.port\"");
      return;
    }
    if (owner == nullptr) {
      result_.broken_places.push_back(array_base(slot));
      diagnostics_.error(place.position,
                         "unknown unit or group " + quote(name) + " in [port." + port.key + "]",
                         suggest(name, known, "units and groups", "the group has none"));
      return;
    }
    const Node* connections = owner->find(in ? "in" : "out");
    const Node* inside = connections != nullptr ? connections->find(inner_port) : nullptr;
    if (inside == nullptr || inside->kind != Node::Kind::text) {
      scope.bindings.push_back({in, name, inner_port, slot, place.position});
      return;
    }
    const auto [alias, is_new] = scope.aliases.try_emplace(inside->text, slot);
    if (!is_new && alias->second != slot)
      diagnostics_.error(place.position,
                         quote(inside->text) + " would be two slots outside: " + quote(alias->second) +
                             " and " + quote(slot),
                         "connect both ports of the instance to the same slot, or expose it once");
  }

  Library& library_;
  Diagnostics& diagnostics_;
  std::filesystem::path folder_;
  std::map<std::string, std::optional<Node>> tables_;
  std::vector<std::string> open_;  // tables being instantiated, outermost first
  Flattened result_;
};

}  // namespace

std::string Scope::slot_name(const std::string& name) const {
  if (const auto found = aliases.find(name); found != aliases.end()) return found->second;
  const std::string base = array_base(name);
  if (const auto found = aliases.find(base); found != aliases.end())
    return found->second + name.substr(base.size());
  return prefix + name;
}

Flattened flatten(Library& library, Node application, const std::filesystem::path& folder) {
  return Flattener(library, folder).run(std::move(application));
}

std::string array_base(std::string_view name) {
  const std::size_t bracket = name.rfind('[');
  return std::string(!name.empty() && name.back() == ']' && bracket != std::string_view::npos
                         ? name.substr(0, bracket)
                         : name);
}

bool is_slot_name(std::string_view name) {
  const std::string base = array_base(name);
  if (!is_snake_case(base) || is_keyword(base)) return false;
  const std::string_view index = name.substr(base.size());
  return index.empty() ||
         (index.size() > 2 && index.size() < 8 &&
          std::all_of(index.begin() + 1, index.end() - 1, [](char c) { return c >= '0' && c <= '9'; }));
}

}  // namespace flexrf::config_gen
