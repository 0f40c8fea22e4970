#include "web-ui/server/api/operations.hpp"

#include "base/nearest_name.hpp"

namespace flexrf::panel {

std::optional<ComponentIndex> Operations::component(const Caller& caller, std::string_view name) {
  const std::optional<ComponentIndex> found = directory.component(name);
  if (!found) answers.refuse(caller, directory.no_component(name));
  return found;
}

void Operations::act(const Caller& caller, ComponentIndex component, std::string_view action,
                     std::string_view source, Time now) {
  if (action == "start") return lifecycle.act(caller, component, ComponentAction::start);
  if (action == "stop") return lifecycle.act(caller, component, ComponentAction::stop);
  if (action == "initialise") return lifecycle.act(caller, component, ComponentAction::initialise);
  if (action == "activate") return parameters.change_member(caller, component, RequestKind::activate, 0, now);
  if (action == "retire") return parameters.change_member(caller, component, RequestKind::retire, 0, now);
  if (action == "clone") {
    const auto member = directory.component(source);
    if (!member) return answers.refuse(caller, directory.no_component(source).about("source"));
    return parameters.change_member(caller, component, RequestKind::clone, *member, now);
  }
  NearestName nearest(action);
  for (const char* known : {"start", "stop", "initialise", "activate", "retire", "clone", "reset", "press"})
    nearest.offer(known);
  answers.refuse(caller, no_such("action", action, nearest.best(),
                                 "there are start, stop, initialise, activate, retire, clone"));
}

}  // namespace flexrf::panel
