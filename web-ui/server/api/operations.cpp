#include "web-ui/server/api/operations.hpp"

#include <algorithm>
#include <iterator>

#include "base/nearest_name.hpp"

namespace flexrf::panel {
namespace {

void refresh(Asked& asked) {
  const std::string_view lease = asked.fields.text("lease");
  if (asked.is_right()) asked.operations.parameters.refresh(asked.caller, lease, asked.now);
}

void release(Asked& asked) {
  const std::string_view lease = asked.fields.text("lease");
  if (asked.is_right()) asked.operations.parameters.release(asked.caller, lease, asked.now);
}

void ping(Asked& asked) {
  const double sent = asked.fields.number("sent");
  if (!asked.is_right()) return;
  asked.operations.answers.done(asked.caller, [&](JsonWriter& json) {
    json.member("sent", sent).member("server_time_ns", nanoseconds(asked.now));
  });
}

void set(Asked& asked) {
  const auto component = asked.find_component();
  if (!component) return;
  const auto values = asked.fields.object("values");
  std::optional<std::uint64_t> expected;
  if (asked.fields.has("expected")) expected = asked.fields.integer("expected");
  if (asked.is_right())
    asked.operations.parameters.set(asked.caller, *component, *values, expected, asked.now);
}

void reset(Asked& asked) {
  const auto component = asked.find_component();
  if (!component) return;
  std::optional<JsonArray> parameters;
  if (asked.fields.has("parameters")) parameters = asked.fields.array("parameters");
  if (asked.is_right()) asked.operations.parameters.reset(asked.caller, *component, parameters, asked.now);
}

void press(Asked& asked) {
  const auto component = asked.find_component();
  if (!component) return;
  const std::string_view parameter = asked.fields.text("parameter");
  const std::uint64_t count = asked.fields.integer_or("count", 1);
  if (asked.is_right())
    asked.operations.parameters.press(asked.caller, *component, parameter, count, asked.now);
}

void hold(Asked& asked) {
  const auto component = asked.find_component();
  if (!component) return;
  const std::string_view parameter = asked.fields.text("parameter");
  if (asked.is_right()) asked.operations.parameters.hold(asked.caller, *component, parameter, asked.now);
}

void act(Asked& asked) {
  const auto component = asked.find_component();
  if (!component) return;
  const std::string_view action = asked.action ? *asked.action : asked.fields.text("action");
  const std::string_view source = asked.fields.text_or("source", "");
  if (asked.is_right()) asked.operations.act(asked.caller, *component, action, source, asked.now);
}

void answer_control(Asked& asked) {
  const bool grant = asked.fields.boolean("grant");
  if (asked.is_right()) asked.operations.motion.answer_control(asked.caller, grant, asked.now);
}

void begin_edit(Asked& asked) {
  const auto components = asked.fields.array("components");
  if (asked.is_right()) asked.operations.edits.begin(asked.caller, *components, asked.now);
}

void apply_edit(Asked& asked) {
  const std::string_view edit = asked.fields.text("edit");
  const auto changes = asked.fields.array("changes");
  if (asked.is_right()) asked.operations.edits.apply(asked.caller, edit, *changes, asked.now);
}

void discard_edit(Asked& asked) {
  const std::string_view edit = asked.fields.text("edit");
  if (asked.is_right()) asked.operations.edits.discard(asked.caller, edit);
}

constexpr Operation all_operations[] = {
    // First of all: nothing stands between a person and this.
    {"stop_motion", [](Asked& asked) { asked.operations.motion.stop_motion(asked.caller); }},
    {"refresh", &refresh, false},
    {"release", &release},
    {"ping", &ping, false},
    {"subscribe",
     [](Asked& asked) { asked.operations.subscriptions.subscribe(asked.caller, asked.fields, asked.now); },
     false},
    {"set", &set},
    {"reset", &reset},
    {"press", &press},
    {"hold", &hold},
    {"action", &act},
    {"clear_stop_motion", [](Asked& asked) { asked.operations.motion.clear_stop_motion(asked.caller); }},
    {"start_motion", [](Asked& asked) { asked.operations.motion.start_motion(asked.caller); }},
    {"save_values", [](Asked& asked) { asked.operations.saving.save(asked.caller, asked.now); }},
    {"take_control", [](Asked& asked) { asked.operations.motion.take_control(asked.caller, asked.now); }},
    {"release_control", [](Asked& asked) { asked.operations.motion.release_control(asked.caller); }},
    {"answer_control", &answer_control},
    {"edit_begin", &begin_edit},
    {"edit_apply", &apply_edit},
    {"edit_discard", &discard_edit},
};

}  // namespace

const Operation* find_operation(std::string_view name) noexcept {
  const Operation* const found = std::ranges::find(all_operations, name, &Operation::name);
  return found == std::end(all_operations) ? nullptr : found;
}

Refusal no_operation(std::string_view name) noexcept {
  NearestName nearest(name);
  for (const Operation& known : all_operations) nearest.offer(known.name);
  return no_such("op", name, nearest.best(), "docs/panel-protocol.md lists them");
}

bool Asked::is_right() {
  if (fields.status()) return true;
  operations.answers.refuse(caller, RefusalKind::bad_request, "%.*s: %s.", static_cast<int>(what.size()),
                            what.data(), fields.status().cause());
  return false;
}

std::optional<ComponentIndex> Asked::find_component() {
  if (component) return operations.component(caller, *component);
  const std::string_view name = fields.text("component");
  return is_right() ? operations.component(caller, name) : std::nullopt;
}

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
