// All generated types and classes, and those that authors derive, are in one namespace: each name once.
#include <map>

#include "config-gen/check/checks.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

struct ClassName {
  std::string name;
  std::string what;  // "the class of unit 'jog'"
  Position position;
};

std::vector<ClassName> class_names(const Model& model) {
  std::vector<ClassName> names;
  for (const UnitType& unit : model.unit_types) {
    const std::string of = "unit " + quote(unit.name);
    names.push_back({unit.class_name, "the class of " + of, unit.position});
    names.push_back({unit.base_class, "the base class of " + of, unit.position});
    for (const char* block : {"Configuration", "Runtime", "Feedback"})
      names.push_back({unit.class_name + block, "the parameter struct of " + of, unit.position});
  }
  for (const Interface& interface : model.interfaces) {
    const std::string of = "interface " + quote(interface.class_name);
    names.push_back({interface.class_name, "the class of " + of, interface.position});
    names.push_back({interface.class_name + "Interface", "the base class of " + of, interface.position});
    for (const char* block : {"Runtime", "Feedback"})
      names.push_back({interface.class_name + block, "the parameter struct of " + of, interface.position});
  }
  for (const Driver& driver : model.drivers) {
    const std::string of = "driver " + quote(driver.stem);
    names.push_back({driver.class_name, "the class of " + of, driver.position});
    names.push_back({driver.base_class, "the base class of " + of, driver.position});
    names.push_back({driver.class_name + "Configuration", "the parameter struct of " + of, driver.position});
    if (!driver.runtime.empty())
      names.push_back({driver.class_name + "Runtime", "the parameter struct of " + of, driver.position});
    if (!driver.feedback.empty())
      names.push_back({driver.class_name + "Feedback", "the parameter struct of " + of, driver.position});
    if (!driver.runtime.empty() || !driver.feedback.empty())
      names.push_back({driver.class_name + "Values", "the struct of values of " + of, driver.position});
  }
  for (const Type& type : model.types)
    names.push_back({type.name, "the type " + quote(type.stem), type.position});
  return names;
}

}  // namespace

void check_class_names(const Model& model, Diagnostics& diagnostics) {
  std::map<std::string, const ClassName*> taken;
  const std::vector<ClassName> names = class_names(model);
  for (const ClassName& name : names) {
    const auto [first, is_new] = taken.try_emplace(name.name, &name);
    if (!is_new)
      diagnostics.error(
          name.position,
          "the name " + quote(name.name) + " is used twice: " + name.what + " and " + first->second->what,
          "rename one; the other is at " + to_string(first->second->position));
  }
}

}  // namespace flexrf::config_gen
