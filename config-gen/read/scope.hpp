// Groups flattened: each instance of a group is a scope with its own copy of the group's table, arguments
// filled in.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "config-gen/read/library.hpp"

namespace flexrf::config_gen {

// A connection that an instance makes through a port of its group: to a unit (or inner group) inside.
struct PortBinding {
  bool input = false;
  std::string target;  // the unit's or inner group's name in the group's table
  std::string port;
  std::string slot;   // the full name outside
  Position position;  // of the port's row
};

struct Scope {
  std::string prefix;    // of every name inside: "" or "axis[2]."
  std::string instance;  // "axis[2]"; empty for the application itself
  Position instantiated;
  Node tree;
  std::map<std::string, std::string> aliases;  // slots inside that are slots outside: name here -> full name
  std::vector<PortBinding> bindings;

  // The full name of a slot or queue that is called `name` here. Members of an array keep their "[3]".
  std::string slot_name(const std::string& name) const;
};

struct FlatRow {
  enum class Kind { device, unit, slot, queue, thread };
  Kind kind = Kind::device;
  const Node* node = nullptr;
  const Scope* scope = nullptr;
};

struct Flattened {
  std::deque<Scope> scopes;                // the application first
  std::vector<std::string> broken_places;  // slots and queues of instances that could not be made
  bool devices_missing = false;            // a list of them has errors: nothing is said of unknown ones
  std::vector<FlatRow> rows;               // source order, an instance's rows in place of its own
};

Flattened flatten(Library& library, Node application, const std::filesystem::path& folder);

// "name" or "name[3]": what may be written where a slot or queue is named.
bool is_slot_name(std::string_view name);
std::string array_base(std::string_view name);  // without a "[3]" at the end

// While rows of a scope are read, errors name its instance.
class InScope {
 public:
  InScope(Diagnostics& diagnostics, const Scope& scope)
      : diagnostics_(diagnostics), active_(!scope.instance.empty()) {
    if (active_) diagnostics_.enter(scope.instance, scope.instantiated);
  }
  ~InScope() {
    if (active_) diagnostics_.leave();
  }
  InScope(const InScope&) = delete;
  InScope& operator=(const InScope&) = delete;

 private:
  Diagnostics& diagnostics_;
  bool active_;
};

}  // namespace flexrf::config_gen
