// [slot.N] and [queue.N] rows of applications and groups.
#include <algorithm>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {
namespace {

// elements = 4147200, or [1920, 1080, 2], which is their product.
std::optional<std::size_t> read_elements(Row& row, Diagnostics& diagnostics) {
  const Node* const node = row.any("elements");
  if (node == nullptr) return std::nullopt;
  const auto is_count = [](const Node& one) {
    return one.kind == Node::Kind::integer && one.integer > 0 &&
           one.integer <= static_cast<std::int64_t>(most_elements);
  };
  std::size_t product = 1;
  bool good = is_count(*node);
  if (good) product = static_cast<std::size_t>(node->integer);
  if (node->kind == Node::Kind::array && !node->children.empty()) {
    good = std::all_of(node->children.begin(), node->children.end(), is_count);
    for (const Node& one : node->children)
      if (good) product = std::min(most_elements + 1, product * static_cast<std::size_t>(one.integer));
  }
  if (good && product <= most_elements) return product;
  diagnostics.error(node->position,
                    "'elements' of " + row.name() + " must be a whole number from 1 to " +
                        std::to_string(most_elements) + ", or a list of such that are multiplied",
                    "write elements = 4147200, or elements = [1920, 1080, 2]");
  return std::nullopt;
}

void set_elements(Assembly& assembly, Slot& slot, std::size_t elements, const Position& position) {
  const Field* const field = slot.type.kind == SlotType::Kind::declared
                                 ? assembly.model.types[slot.type.index].resizable()
                                 : nullptr;
  if (field == nullptr) {
    assembly.diagnostics.error(position,
                               "the items of slot " + quote(slot.name) + " all have one size: " +
                                   type_name(assembly.model, slot.type) + " has no field that is resizable",
                               "remove 'elements'; what is as large as its slot says is the last field of a "
                               "type, with resizable = true in the type's table");
    return;
  }
  Field resized = *field;
  resized.shape = {elements};
  lay_out(assembly.model, resized);
  if (resized.offset + resized.size > max_type_size) {
    assembly.diagnostics.error(position,
                               "an item of slot " + quote(slot.name) + " takes " +
                                   std::to_string(resized.offset + resized.size) + " bytes, more than " +
                                   std::to_string(max_type_size),
                               "make 'elements' smaller");
    return;
  }
  slot.elements = elements;
}

void read_slot_row(Assembly& assembly, const FlatRow& flat) {
  Row row(*flat.node, "[slot." + flat.node->key + "]", assembly.diagnostics);
  const auto observe = row.boolean("observe");
  const auto wall = row.boolean("wall");
  const auto history = row.integer("history", 1, 1 << 20);
  const auto elements = read_elements(row, assembly.diagnostics);
  const auto summary = row.sentence("summary");
  row.finish();
  const std::string name = flat.scope->slot_name(flat.node->key);
  std::vector<Index> found;
  if (const auto slot = assembly.slots.find(name); slot != assembly.slots.end())
    found.push_back(slot->second);
  if (const auto array = assembly.arrays.find(name); array != assembly.arrays.end())
    for (const auto& [member, slot] : array->second) found.push_back(slot);
  if (found.empty()) {
    if (assembly.broken_places.contains(name)) return;
    const bool queue = assembly.queues.contains(name);
    assembly.diagnostics.error(
        flat.node->key_position,
        queue ? quote(flat.node->key) + " is a queue, not a slot"
              : "unknown slot " + quote(flat.node->key) + ": no output writes it",
        queue ? "write [queue." + flat.node->key + "]"
              : suggest(flat.node->key, assembly.names_in(*flat.scope, assembly.slots), "slots",
                        "slots come to be by being named in out.PORT of a unit or device"));
    return;
  }
  for (const Index index : found) {
    Slot& slot = assembly.model.slots[index];
    slot.position = flat.node->key_position;
    slot.observe = observe.value_or(true);
    slot.for_panel = observe.value_or(false);
    slot.wall = wall.value_or(false);
    // A history whose length is wrong is one all the same: what reads the past is right.
    slot.history = static_cast<std::size_t>(history.value_or(row.has("history") ? 1 : 0));
    slot.summary = summary.value_or("");
    if (elements) set_elements(assembly, slot, *elements, row.position("elements"));
  }
}

// order = "arrival", or { score = "field" }.
void read_order(Assembly& assembly, Row& row, Queue& queue) {
  const Node* order = row.any("order");
  if (order == nullptr || (order->kind == Node::Kind::text && order->text == "arrival")) return;
  const Node* score = order->kind == Node::Kind::table ? order->find("score") : nullptr;
  if (score == nullptr || score->kind != Node::Kind::text || order->children.size() != 1) {
    assembly.diagnostics.error(order->position,
                               "'order' of " + row.name() + " is neither \"arrival\" nor a score",
                               "write order = \"arrival\", or order = { score = \"FIELD\" }");
    return;
  }
  const Type& type = assembly.model.types[queue.type];
  std::vector<std::string> known;
  for (std::size_t i = 0; i < type.fields.size(); ++i) {
    const Field& field = type.fields[i];
    known.push_back(field.name);
    if (field.name != score->text) continue;
    const bool number = field.type.kind == FieldType::Kind::scalar && field.shape.empty() &&
                        (is_integer(field.type.scalar) || is_floating(field.type.scalar));
    if (!number)
      assembly.diagnostics.error(
          score->position,
          quote(score->text) + " of " + type.name + " is not a single number, so it cannot be a score",
          "choose a number; the field is at " + to_string(field.position));
    queue.score = i;
    return;
  }
  assembly.diagnostics.error(score->position, "unknown field " + quote(score->text) + " of " + type.name,
                             suggest(score->text, known, "fields", "it has none: remove 'order'"));
}

void read_queue_row(Assembly& assembly, const FlatRow& flat) {
  Row row(*flat.node, "[queue." + flat.node->key + "]", assembly.diagnostics);
  const std::string name = flat.scope->slot_name(flat.node->key);
  const auto found = assembly.queues.find(name);
  Queue unused;
  Queue& queue = found != assembly.queues.end() ? assembly.model.queues[found->second.front()] : unused;
  const auto capacity = row.integer("capacity", 1, 1 << 20);
  if (capacity) queue.capacity = static_cast<std::size_t>(*capacity);
  if (const auto policy = row.word("policy", {"drop_newest", "drop_oldest"}))
    queue.policy = static_cast<Queue::Policy>(*policy);
  const auto share = row.word("share", {"jobs", "copies"});
  queue.jobs = share == std::size_t{0};
  queue.wall = row.boolean("wall").value_or(false);
  queue.summary = row.sentence("summary").value_or("");
  if (found != assembly.queues.end())
    read_order(assembly, row, queue);
  else
    row.also("order");
  row.finish();
  if (found == assembly.queues.end()) {
    if (assembly.broken_places.contains(name)) return;
    const bool slot = assembly.slots.contains(name) || assembly.arrays.contains(name);
    assembly.diagnostics.error(
        flat.node->key_position,
        slot ? quote(flat.node->key) + " is a slot, not a queue"
             : "unknown queue " + quote(flat.node->key) + ": no output or input names it",
        slot ? "write [slot." + flat.node->key + "]"
             : suggest(flat.node->key, assembly.names_in(*flat.scope, assembly.queues), "queues",
                       "queues come to be by being named in out.PORT of a unit or device"));
    return;
  }
  queue.position = flat.node->key_position;
  if (share == std::size_t{1}) assembly.copied.insert(name);
}

}  // namespace

void read_place_rows(Assembly& assembly) {
  for (const FlatRow& row : assembly.flat.rows) {
    const InScope in_scope(assembly.diagnostics, *row.scope);
    if (row.kind == FlatRow::Kind::slot) read_slot_row(assembly, row);
    if (row.kind == FlatRow::Kind::queue) read_queue_row(assembly, row);
  }
}

}  // namespace flexrf::config_gen
