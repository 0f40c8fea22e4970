#include "config-gen/read/panel_options.hpp"

#include <algorithm>
#include <utility>

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

bool is_scalar(const Field& field) {
  return field.type.kind == FieldType::Kind::scalar;
}

bool has_numbers(const Field& field) {
  return is_scalar(field) && field.type.scalar != Scalar::boolean && field.type.scalar != Scalar::text;
}

bool is_bool(const Model&, const Field& field) {
  return field.shape.empty() && is_scalar(field) && field.type.scalar == Scalar::boolean;
}

bool is_number(const Model&, const Field& field) {
  return is_single_number(field);
}

bool is_whole_number(const Model&, const Field& field) {
  return is_single_number(field) && field.type.scalar != Scalar::f32 && field.type.scalar != Scalar::f64;
}

bool is_enumeration(const Model& model, const Field& field) {
  return field.shape.empty() && !is_scalar(field) &&
         model.types[field.type.declared].kind == Type::Kind::enumeration;
}

bool is_state(const Model& model, const Field& field) {
  return is_bool(model, field) || is_enumeration(model, field);
}

bool is_value(const Model& model, const Field& field) {
  return field.shape.empty() && (is_scalar(field) || is_enumeration(model, field));
}

bool is_record(const Model& model, const Field& field) {
  return !is_scalar(field) && model.types[field.type.declared].kind == Type::Kind::record;
}

bool is_structure(const Model& model, const Field& field) {
  return field.shape.empty() && is_record(model, field);
}

bool is_list_of_structures(const Model& model, const Field& field) {
  return field.shape.size() == 1 && is_record(model, field);
}

bool are_numbers(const Model& model, const Field& field) {
  if (field.shape.size() == 1) return has_numbers(field);
  if (!field.shape.empty() || !is_record(model, field)) return false;
  const std::vector<Field>& members = model.types[field.type.declared].fields;
  return std::all_of(members.begin(), members.end(), is_single_number);
}

std::string without_outer_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t") - begin + 1));
}

}  // namespace

namespace field_kind {
const FieldKind truth{is_bool, "is no bool"};
const FieldKind number{is_number, "is no single number"};
const FieldKind whole_number{is_whole_number, "is no single whole number"};
const FieldKind state{is_state, "is neither a bool nor an enumeration"};
const FieldKind value{is_value, "is no single value"};
const FieldKind structure{is_structure, "is no structure"};
const FieldKind list_of_structures{is_list_of_structures, "is no list of structures"};
const FieldKind numbers{are_numbers, "is neither a list of numbers nor a structure of them"};
}  // namespace field_kind

bool is_single_number(const Field& field) {
  return field.shape.empty() && has_numbers(field);
}

const Type* declared_type(const Model& model, const Slot& slot) {
  if (slot.partial || slot.type.kind != SlotType::Kind::declared) return nullptr;
  return &model.types[slot.type.index];
}

WidgetOptions::WidgetOptions(Assembly& assembly, const Row& row, const std::vector<std::string>& known)
    : assembly_(assembly), row_(row) {
  const Node* const table = row.node().find("options");
  if (table == nullptr || table->kind != Node::Kind::table) return;
  table_ = table;
  for (const Node& child : table->children) {
    if (std::find(known.begin(), known.end(), child.key) != known.end()) continue;
    Hint hint = suggest(child.key, known, "options", "");
    if (hint.replacement) meant_.insert(hint.replacement->wanted);
    assembly.diagnostics.error(child.key_position, "unknown option " + quote(child.key) + " in " + row.name(),
                               std::move(hint));
  }
}

const Node* WidgetOptions::find(std::string_view name) const {
  return table_ == nullptr ? nullptr : table_->find(name);
}

Position WidgetOptions::position(std::string_view name) const {
  const Node* const option = find(name);
  return option == nullptr ? row_.position() : option->position;
}

void WidgetOptions::error(std::string_view option, std::string text, Hint hint) {
  assembly_.diagnostics.error(position(option), std::move(text), std::move(hint));
}

void WidgetOptions::need(std::string_view name, std::string_view hint) {
  if (has(name) || meant_.contains(name)) return;
  assembly_.diagnostics.error(
      row_.position(), row_.name() + " has no " + quote("options." + std::string(name)), std::string(hint));
}

std::optional<std::string> WidgetOptions::text(std::string_view name) {
  const Node* const option = find(name);
  if (option == nullptr) return std::nullopt;
  if (option->kind != Node::Kind::text) {
    error(name,
          quote("options." + std::string(name)) + " of " + row_.name() + " must be a text, not " +
              kind_text(option->kind),
          "write it in double quotes");
    return std::nullopt;
  }
  return option->text;
}

std::vector<std::string> WidgetOptions::words(std::string_view name) {
  std::vector<std::string> words;
  const auto list = text(name);
  if (!list) return words;
  std::string_view rest = *list;
  for (;;) {
    const std::size_t comma = rest.find(',');
    words.push_back(without_outer_blanks(rest.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (std::find(words.begin(), words.end(), "") == words.end()) return words;
  error(name, quote("options." + std::string(name)) + " of " + row_.name() + " has an empty name",
        "write names with commas between them, as \"first, second\"");
  return {};
}

void WidgetOptions::check_whole_number(std::string_view name, std::int64_t least, std::int64_t most) {
  const Node* const option = find(name);
  if (option == nullptr ||
      (option->kind == Node::Kind::integer && option->integer >= least && option->integer <= most))
    return;
  error(name, quote("options." + std::string(name)) + " of " + row_.name() + " is no number that will do",
        "write a whole number from " + std::to_string(least) + " to " + std::to_string(most));
}

const Field* WidgetOptions::field(const Type& type, std::string_view option, const FieldKind& kind) {
  const auto name = text(option);
  return name ? field(type, option, *name, kind) : nullptr;
}

const Field* WidgetOptions::field(const Type& type, std::string_view option, std::string_view name,
                                  const FieldKind& kind) {
  const auto found = std::find_if(type.fields.begin(), type.fields.end(),
                                  [name](const Field& field) { return field.name == name; });
  std::vector<std::string> all, fitting;
  for (const Field& field : type.fields) {
    all.push_back(field.name);
    if (kind.fits(assembly_.model, field)) fitting.push_back(field.name);
  }
  if (found == type.fields.end()) {
    error(option, "the type " + quote(type.name) + " has no field " + quote(name),
          suggest(name, fitting.empty() ? all : fitting, "fields", "it has none"));
    return nullptr;
  }
  if (kind.fits(assembly_.model, *found)) return &*found;
  error(option, quote(name) + " of the type " + quote(type.name) + " " + std::string(kind.lacks),
        fitting.empty() ? "no field of this type will do for " + quote("options." + std::string(option))
                        : "what will do: " + listed(fitting));
  return nullptr;
}

}  // namespace flexrf::config_gen
