#include "config-gen/read/panel_things.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {

ThingRow::ThingRow(Assembly& assembly, Row& row, PanelThings& things) : assembly_(assembly), row_(row) {
  things.name = row.node().key;
  things.label = row.text("label").value_or("");
  things.shown = row.boolean("shown").value_or(true);
  for (const std::string_view key : {"slot", "list", "count", "empty", "text", "certain", "doubtful"})
    row.also(key);
  read_slots(things);
  if (carried_ == nullptr) return;
  read_list(things);
  if (thing_ == nullptr) return;
  read_empty(things);
  read_text(things);
  read_certainty(things);
}

void ThingRow::read_slots(PanelThings& things) {
  if (!row_.has("slot"))
    row_.missing("slot", "add slot = \"NAME\": a slot, or those of all members of a population");
  const Node* const node = text_of(row_, "slot");
  if (node == nullptr) return;
  std::vector<Index> found;
  std::vector<std::string> known;
  for (Index index = 0; index < assembly_.model.slots.size(); ++index) {
    known.push_back(assembly_.model.slots[index].name);
    if (known.back() == node->text) found.push_back(index);
  }
  for (const auto& [name, members] : assembly_.arrays) {
    known.push_back(name);
    if (name != node->text || !found.empty()) continue;
    auto in_order = members;
    std::sort(in_order.begin(), in_order.end());
    for (const auto& [member, index] : in_order) found.push_back(index);
  }
  if (found.empty()) {
    if (!assembly_.broken_places.contains(array_base(node->text)))
      assembly_.diagnostics.error(node->position, "unknown slot " + quote(node->text),
                                  suggest(node->text, known, "slots", "there is none"));
    return;
  }
  for (const Index index : found) {
    const Slot& slot = assembly_.model.slots[index];
    if (!check_observed(assembly_, slot, node->position)) return;
    things.slots.push_back(slot.name);
  }
  carried_ = drawn_type(assembly_, assembly_.model.slots[found.front()], node->position);
}

void ThingRow::read_list(PanelThings& things) {
  const Node* const list = text_of(row_, "list");
  if (list == nullptr) {
    if (!row_.has("list")) thing_ = carried_;
    if (row_.has("count"))
      assembly_.diagnostics.error(row_.position("count"),
                                  quote("count") + " of " + row_.name() + " counts the things of no list",
                                  "add list = \"FIELD\", or remove it");
    return;
  }
  const auto place = read_field(assembly_, row_, "list", *list, *carried_, field_need::list);
  if (place) {
    things.list = list->text;
    thing_ = &assembly_.model.types[place->field->type.declared];
  }
  const Node* const count = text_of(row_, "count");
  if (count != nullptr && read_field(assembly_, row_, "count", *count, *carried_, field_need::whole_number))
    things.count = count->text;
}

void ThingRow::read_empty(PanelThings& things) {
  const Node* const table = row_.table("empty");
  if (table == nullptr) return;
  if (table->children.size() != 1) {
    assembly_.diagnostics.error(table->position,
                                quote("empty") + " of " + row_.name() + " must name one field and its value",
                                "write empty = { FIELD = VALUE }: a thing that has it is not drawn");
    return;
  }
  const Node& child = table->children.front();
  Node name = child;
  name.text = child.key;
  name.position = child.key_position;
  std::string path;
  const auto place = field("empty", field_need::sort, name, path);
  if (!place) return;
  if (auto value = value_of(*place, child)) things.empty.emplace(std::move(path), *std::move(value));
}

std::optional<PanelThings::Value> ThingRow::value_of(const FieldPlace& place, const Node& node) {
  if (const Type* const type = enumeration_of(assembly_.model, place); type != nullptr) {
    std::vector<std::string> known;
    for (const EnumerationValue& value : type->values) known.push_back(value.name);
    if (node.kind == Node::Kind::text && std::find(known.begin(), known.end(), node.text) != known.end())
      return node.text;
    if (node.kind == Node::Kind::text)
      assembly_.diagnostics.error(node.position, type->name + " has no value " + quote(node.text),
                                  suggest(node.text, known, "values", ""));
    else
      row_.wrong_kind(node, "empty", "a value of " + type->name, "write its name in double quotes");
    return std::nullopt;
  }
  if (is_whole_number(place)) {
    if (node.kind == Node::Kind::integer) return node.integer;
    row_.wrong_kind(node, "empty", "a whole number", "write a number without quotes and without a fraction");
    return std::nullopt;
  }
  if (node.kind == Node::Kind::boolean) return node.boolean;
  row_.wrong_kind(node, "empty", "true or false", "write true or false, without quotes");
  return std::nullopt;
}

void ThingRow::read_text(PanelThings& things) {
  const Node* const texts = row_.list_of_texts("text");
  if (texts == nullptr) return;
  for (const Node& text : texts->children) {
    std::string path;
    if (field("text", field_need::words, text, path)) things.text.push_back(std::move(path));
  }
}

void ThingRow::read_certainty(PanelThings& things) {
  field("certain", field_need::boolean, things.certain);
  field("doubtful", field_need::boolean, things.doubtful);
  if (row_.has("certain") && row_.has("doubtful"))
    assembly_.diagnostics.error(row_.position("doubtful"), row_.name() + " has both 'certain' and 'doubtful'",
                                "keep one: each says of a thing whether it is there for sure");
}

std::optional<FieldPlace> ThingRow::field(std::string_view key, const FieldNeed& need, std::string& path) {
  const Node* const text = text_of(row_, key);
  return text == nullptr ? std::nullopt : field(key, need, *text, path);
}

std::optional<FieldPlace> ThingRow::field(std::string_view key, const FieldNeed& need, const Node& text,
                                          std::string& path) {
  auto place = read_field(assembly_, row_, key, text, *thing_, need);
  if (place) path = text.text;
  return place;
}

void ThingRow::field_of_either(std::string_view key, const FieldNeed& need, std::string& path,
                               bool& of_slot) {
  const Node* const text = text_of(row_, key);
  if (text == nullptr) return;
  of_slot = thing_ == carried_ || !find_field(assembly_.model, *thing_, text->text);
  if (read_field(assembly_, row_, key, *text, of_slot ? *carried_ : *thing_, need)) path = text->text;
}

std::vector<NamedRow> rows_of(Assembly& assembly, Row& row, std::string_view key, std::string_view what) {
  std::vector<NamedRow> rows;
  const Node* const table = row.table(key);
  if (table == nullptr) return rows;
  // "[widget.eye]" and "overlay" are "[widget.eye.overlay.NAME]".
  const std::string before = row.name().substr(0, row.name().size() - 1) + "." + std::string(key) + ".";
  for (const Node& child : table->children) {
    if (child.kind == Node::Kind::table) {
      check_name(child, what, true, assembly.diagnostics);
      rows.push_back({&child, before + child.key + "]"});
    } else {
      assembly.diagnostics.error(child.key_position,
                                 quote(std::string(key) + "." + child.key) + " of " + row.name() +
                                     " must be a table, not " + kind_text(child.kind),
                                 "write rows as " + before + "NAME]");
    }
  }
  return rows;
}

}  // namespace flexrf::config_gen
