#include "config-gen/read/panel_fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

bool is_scalar(const FieldPlace& place) {
  return place.is_single() && place.field->type.kind == FieldType::Kind::scalar;
}
bool is_floating_scalar(const FieldPlace& place) {
  return is_scalar(place) && is_floating(place.field->type.scalar);
}
bool is_boolean(const FieldPlace& place) {
  return is_scalar(place) && place.field->type.scalar == Scalar::boolean;
}

// Null where it is no structure, or an array of them.
const Type* record_of(const Model& model, const FieldPlace& place) {
  if (!place.is_single() || place.field->type.kind != FieldType::Kind::declared) return nullptr;
  const Type& type = model.types[place.field->type.declared];
  return type.kind == Type::Kind::record ? &type : nullptr;
}

void add_fitting(const Model& model, const Type& record, const FieldNeed& need, const std::string& before,
                 std::vector<std::string>& names) {
  for (const Field& field : record.fields) {
    const FieldPlace place{&field, false};
    if (need.fits(model, place)) names.push_back(before + field.name);
    if (const Type* const inner = record_of(model, place); inner != nullptr)
      add_fitting(model, *inner, need, before + field.name + ".", names);
  }
}

// "f64[3] in m"
std::string described(const Model& model, const FieldPlace& place) {
  std::string text = type_name(model, place.field->type);
  if (!place.element)
    for (const std::size_t extent : place.field->shape) text += "[" + std::to_string(extent) + "]";
  const std::string& unit = place.field->unit;
  return unit.empty() || unit == "1" ? text : text + " in " + unit;
}

// One part of a path, as "pixel[0]".
struct PathPart {
  std::string_view name;
  std::optional<std::size_t> element;
};

std::optional<PathPart> part_of(std::string_view text) {
  const std::size_t bracket = text.find('[');
  if (bracket == std::string_view::npos) return PathPart{text, std::nullopt};
  if (text.back() != ']') return std::nullopt;
  const std::string_view digits = text.substr(bracket + 1, text.size() - bracket - 2);
  std::size_t element = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stopped, error] = std::from_chars(digits.data(), end, element);
  if (digits.empty() || error != std::errc{} || stopped != end) return std::nullopt;
  return PathPart{text.substr(0, bracket), element};
}

}  // namespace

bool is_whole_number(const FieldPlace& place) {
  return is_scalar(place) && is_integer(place.field->type.scalar);
}

const Type* enumeration_of(const Model& model, const FieldPlace& place) {
  if (!place.is_single() || place.field->type.kind != FieldType::Kind::declared) return nullptr;
  const Type& type = model.types[place.field->type.declared];
  return type.kind == Type::Kind::enumeration ? &type : nullptr;
}

namespace field_need {
namespace {

bool is_number(const FieldPlace& place) {
  return is_whole_number(place) || is_floating_scalar(place);
}

}  // namespace

const FieldNeed boolean{"a bool", [](const Model&, const FieldPlace& place) { return is_boolean(place); }};
const FieldNeed whole_number{"a whole number",
                             [](const Model&, const FieldPlace& place) { return is_whole_number(place); }};
const FieldNeed number{"a number", [](const Model&, const FieldPlace& place) { return is_number(place); }};
const FieldNeed pixels{"a number of pixels", [](const Model&, const FieldPlace& place) {
                         const std::string& unit = place.field->unit;
                         return is_number(place) && (unit.empty() || unit == "px");
                       }};
const FieldNeed nanoseconds{"an i64 in ns", [](const Model&, const FieldPlace& place) {
                              return is_scalar(place) && place.field->type.scalar == Scalar::i64 &&
                                     place.field->unit == "ns";
                            }};
const FieldNeed sort{
    "an enumeration, a bool or a whole number", [](const Model& model, const FieldPlace& place) {
      return enumeration_of(model, place) != nullptr || is_boolean(place) || is_whole_number(place);
    }};
const FieldNeed kind{"an enumeration or a whole number", [](const Model& model, const FieldPlace& place) {
                       return enumeration_of(model, place) != nullptr || is_whole_number(place);
                     }};
const FieldNeed words{"a single value", [](const Model& model, const FieldPlace& place) {
                        return enumeration_of(model, place) != nullptr || is_scalar(place);
                      }};
const FieldNeed list{"an array of structures", [](const Model& model, const FieldPlace& place) {
                       return !place.is_single() && place.field->shape.size() == 1 &&
                              record_of(model, {place.field, true}) != nullptr;
                     }};
const FieldNeed position{"two or three numbers in m", [](const Model&, const FieldPlace& at) {
                           const Field& field = *at.field;
                           return !at.element && field.shape.size() == 1 &&
                                  (field.shape[0] == 2 || field.shape[0] == 3) &&
                                  is_floating_scalar({at.field, true}) && field.unit == "m";
                         }};
const FieldNeed angle{"a number in rad", [](const Model&, const FieldPlace& at) {
                        return is_floating_scalar(at) && at.field->unit == "rad";
                      }};
const FieldNeed length{"a number in m", [](const Model&, const FieldPlace& at) {
                         return is_floating_scalar(at) && at.field->unit == "m";
                       }};

}  // namespace field_need

std::optional<FieldPlace> find_field(const Model& model, const Type& record, std::string_view path) {
  const Type* type = &record;
  while (type != nullptr) {
    const std::size_t dot = path.find('.');
    const auto part = part_of(path.substr(0, dot));
    if (!part) return std::nullopt;
    const auto field = std::find_if(type->fields.begin(), type->fields.end(),
                                    [&](const Field& one) { return one.name == part->name; });
    if (field == type->fields.end()) return std::nullopt;
    if (part->element && (field->shape.size() != 1 || *part->element >= field->shape[0])) return std::nullopt;
    const FieldPlace place{&*field, part->element.has_value()};
    if (dot == std::string_view::npos) return place;
    type = record_of(model, place);
    path.remove_prefix(dot + 1);
  }
  return std::nullopt;
}

std::optional<FieldPlace> read_field(Assembly& assembly, const Row& row, std::string_view key,
                                     const Node& text, const Type& record, const FieldNeed& need) {
  const Model& model = assembly.model;
  const auto place = find_field(model, record, text.text);
  if (place && need.fits(model, *place)) return place;
  std::vector<std::string> fitting;
  add_fitting(model, record, need, "", fitting);
  std::string told = "unknown field " + quote(text.text) + " of " + record.name;
  if (place)
    told = quote(text.text) + " of " + record.name + " is " + described(model, *place) + ": " + quote(key) +
           " of " + row.name() + " needs " + std::string(need.text);
  assembly.diagnostics.error(text.position, std::move(told),
                             suggest(text.text, fitting, "fields of this kind",
                                     record.name + " has no field that is " + std::string(need.text)));
  return std::nullopt;
}

const Node* text_of(Row& row, std::string_view key) {
  return row.text(key) ? row.node().find(key) : nullptr;
}

const Type* drawn_type(Assembly& assembly, const Slot& slot, const Position& position) {
  const Type* const type =
      slot.type.kind == SlotType::Kind::declared ? &assembly.model.types[slot.type.index] : nullptr;
  if (type == nullptr) {
    assembly.diagnostics.error(position, "the slot " + quote(slot.name) + " carries parameters, no things",
                               "name a slot that a unit or a driver writes");
    return nullptr;
  }
  if (!type->image) return type;
  assembly.diagnostics.error(
      position,
      "the slot " + quote(slot.name) + " carries pictures, which come to the page without their other fields",
      "name a slot that tells of what is in them");
  return nullptr;
}

bool check_observed(Assembly& assembly, const Slot& slot, const Position& position) {
  if (slot.observe) return true;
  assembly.diagnostics.error(position,
                             "the slot " + quote(slot.name) + " is not observed: no panel can show it",
                             "remove observe = false from its row at " + to_string(slot.position));
  return false;
}

std::optional<double> number_in(const Node& node) {
  if (node.kind == Node::Kind::integer) return static_cast<double>(node.integer);
  if (node.kind == Node::Kind::real && std::isfinite(node.real)) return node.real;
  return std::nullopt;
}

std::optional<double> positive_number(Assembly& assembly, Row& row, std::string_view key, double most,
                                      std::string_view hint) {
  const Node* const node = row.any(key);
  if (node == nullptr) {
    if (!row.has(key)) row.missing(key, "add " + std::string(hint));
    return std::nullopt;
  }
  const auto number = number_in(*node);
  if (number && *number > 0 && *number <= most) return number;
  assembly.diagnostics.error(node->position,
                             quote(key) + " of " + row.name() + " must be a number above 0 and at most " +
                                 std::to_string(static_cast<long long>(most)),
                             "write " + std::string(hint));
  return std::nullopt;
}

}  // namespace flexrf::config_gen
