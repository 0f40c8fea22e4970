// Fields of types, and parameters of units, interfaces and drivers.
#include <algorithm>
#include <map>
#include <utility>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/library.hpp"
#include "config-gen/read/literal.hpp"
#include "config-gen/read/members.hpp"
#include "config-gen/read/quantities.hpp"
#include "config-gen/read/widget_kinds.hpp"

namespace flexrf::config_gen {
namespace {

std::vector<std::string> scalar_words() {
  std::vector<std::string> words;
  for (int i = 0; i <= static_cast<int>(Scalar::text); ++i)
    words.push_back(scalar_name(static_cast<Scalar>(i)));
  return words;
}

void read_shape(Row& row, Field& field, Diagnostics& diagnostics) {
  const Node* shape = row.any("shape");
  if (shape == nullptr) return;
  const bool good = shape->kind == Node::Kind::array &&
                    (shape->children.size() == 1 || shape->children.size() == 2) &&
                    std::all_of(shape->children.begin(), shape->children.end(), [](const Node& extent) {
                      return extent.kind == Node::Kind::integer && extent.integer > 0 &&
                             extent.integer <= static_cast<std::int64_t>(most_elements);
                    });
  if (!good) {
    diagnostics.error(shape->position,
                      "'shape' of " + row.name() + " must be one or two whole numbers above 0",
                      "write it as [3], or [rows, columns]");
    return;
  }
  for (const Node& extent : shape->children) field.shape.push_back(static_cast<std::size_t>(extent.integer));
  if (field.elements() > most_elements) {
    diagnostics.error(shape->position, "'shape' of " + row.name() + " has too many elements",
                      "at most " + std::to_string(most_elements) + " fit in one field");
    field.shape.clear();
  }
}

void read_capacity(Row& row, Field& field, bool is_text, Diagnostics& diagnostics) {
  const auto capacity = row.integer("capacity", 1, 1 << 20);
  if (!is_text && row.has("capacity"))
    diagnostics.error(row.position("capacity"), "'capacity' of " + row.name() + " is for texts only",
                      "remove it; arrays have a shape");
  if (is_text && !row.has("capacity"))
    row.missing("capacity", "a text has a fixed place: add capacity = 32 (bytes)");
  if (capacity) field.capacity = static_cast<std::size_t>(*capacity);
}

// Its accessors are of one text; a record in between gives every text a name of its own.
void refuse_shape_of_text(Row& row, Field& field, Diagnostics& diagnostics) {
  if (!row.has("shape")) return;
  diagnostics.error(row.position("shape"), row.name() + " is a text and cannot have a 'shape'",
                    "declare a type with one text field, and give a field of that type the shape");
  field.shape.clear();
}

// What the unit is, whatever a device's row chooses.
std::vector<std::string> variants_of(const std::string& unit, const std::vector<UnitChoice>& choices) {
  std::vector<std::string> variants{unit};
  for (const UnitChoice& choice : choices) {
    std::vector<std::string> chosen;
    for (const std::string& variant : variants)
      for (const std::string& symbol : choice.units) {
        std::string text = replace_symbol(variant, choice.name, symbol);
        if (std::find(chosen.begin(), chosen.end(), text) == chosen.end()) chosen.push_back(std::move(text));
      }
    variants = std::move(chosen);
  }
  return variants;
}

void read_unit_of_measure(Row& row, Field& field, const std::vector<UnitChoice>& choices,
                          Diagnostics& diagnostics) {
  const bool scalar = field.type.kind == FieldType::Kind::scalar;
  const bool floating = scalar && is_floating(field.type.scalar);
  const bool integer = scalar && is_integer(field.type.scalar);
  const auto unit = row.text("unit");
  if (floating && !row.has("unit"))
    row.missing("unit", "add its SI unit of measure, as unit = \"m\", or unit = \"1\" when it has none");
  if (!unit) return;
  if (!floating && !integer) {
    diagnostics.error(row.position("unit"), "'unit' of " + row.name() + " is for numbers only", "remove it");
    return;
  }
  field.unit = *unit;
  for (const std::string& variant : variants_of(*unit, choices)) {
    if (const std::string advice = judge_unit(variant, integer ? UnitUse::multiples : UnitUse::si);
        !advice.empty()) {
      diagnostics.error(row.position("unit"),
                        quote(*unit) + " is not a unit of measure that " + row.name() + " can have", advice);
      field.told_unit = *unit;
      return;
    }
    field.told_unit += (field.told_unit.empty() ? "" : " or ") + variant;
  }
  if (floating && *unit == "1" && names_quantity(field.name))
    diagnostics.error(row.position("unit"),
                      row.name() + " is a physical quantity by its name, and 'unit' says that it has none",
                      "write the SI unit that it is measured in, as unit = \"m/s\"; a part or a multiple of "
                      "something says so in its name, as velocity_share or velocity_factor");
  if (*unit == "1") return;
  for (const std::string& variant : variants_of(*unit, choices)) {
    const std::string instead = units_instead(field.name, variant);
    if (instead.empty()) continue;
    diagnostics.error(row.position("unit"),
                      quote(*unit) + " does not measure what " + row.name() + " is by its name",
                      "write " + instead + ", or name it by what it is");
    return;
  }
}

// Before anything is computed from its size.
bool check_size(Library& library, const Row& row, Field& field) {
  lay_out(library.model(), field);
  const Position place = row.position(row.has("shape") ? "shape" : "type");
  if (field.size > max_type_size) {
    library.diagnostics().error(
        place, row.name() + " takes " + size_text(field.size) + ", more than " + size_text(max_type_size),
        "make its shape smaller");
    return false;
  }
  if (single_fields(library.model(), field) > max_type_fields) {
    library.diagnostics().error(
        place,
        row.name() + " has " + std::to_string(single_fields(library.model(), field)) +
            " single fields, those of each element counted, more than " + std::to_string(max_type_fields),
        "make its shape smaller, or a type whose fields are arrays of numbers: such an array is one field");
    return false;
  }
  return true;
}

void read_range(Library& library, Row& row, Parameter& parameter, bool numeric) {
  const Node* range = row.any("range");
  if (range == nullptr) return;
  Diagnostics& diagnostics = library.diagnostics();
  if (!numeric) {
    diagnostics.error(range->position, "'range' of " + row.name() + " is for numbers only", "remove it");
    return;
  }
  if (range->kind != Node::Kind::array || range->children.size() != 2) {
    diagnostics.error(range->position, "'range' of " + row.name() + " must be a list of two numbers",
                      "write it as [lowest, highest]");
    return;
  }
  Field bound = parameter.field;
  bound.shape.clear();
  const std::string what = "the range of " + row.name();
  auto low = read_literal(library.model(), bound, range->children[0], what, diagnostics);
  auto high = read_literal(library.model(), bound, range->children[1], what, diagnostics);
  if (!low || !high || !check_range(*low, *high, range->position, what, diagnostics)) return;
  low->position = high->position = range->position;
  parameter.low = std::move(low);
  parameter.high = std::move(high);
}

void read_default(Library& library, Row& row, Parameter& parameter, bool broken) {
  const Node* value = row.any("default");
  Diagnostics& diagnostics = library.diagnostics();
  const bool needed =
      parameter.kind != Parameter::Kind::feedback && parameter.input == Parameter::Input::value;
  if (!needed && value != nullptr)
    diagnostics.error(value->position, row.name() + " cannot have a default",
                      "remove it: buttons and holds start released");
  if (!needed || broken) return;
  if (value == nullptr) {
    row.missing("default", "every parameter starts with a value: add default = ...");
    return;
  }
  if (auto initial = read_parameter_value(library.model(), parameter, *value, "the default of " + row.name(),
                                          diagnostics))
    parameter.initial = std::move(*initial);
}

bool has_image(const Model& model, const FieldType& type) {
  if (type.kind != FieldType::Kind::declared) return false;
  const Type& declared = model.types[type.declared];
  return declared.image || std::any_of(declared.fields.begin(), declared.fields.end(),
                                       [&](const Field& field) { return has_image(model, field.type); });
}

Parameter read_parameter(Library& library, const Node& node, Parameter::Kind kind, const std::string& section,
                         const std::vector<UnitChoice>& choices) {
  Row row(node, "[" + section + "." + node.key + "]", library.diagnostics());
  Parameter parameter;
  parameter.kind = kind;
  parameter.field.name = node.key;
  parameter.field.position = node.key_position;
  const std::vector<std::string> words = kind == Parameter::Kind::runtime
                                             ? std::vector<std::string>{"button", "hold"}
                                             : std::vector<std::string>{};
  std::string word;
  auto field = read_field(library, row, words, &word, choices);
  if (word == "button") parameter.input = Parameter::Input::button;
  if (word == "hold") parameter.input = Parameter::Input::hold;

  if (field && kind == Parameter::Kind::feedback && has_image(library.model(), field->type)) {
    library.diagnostics().error(row.position("type"), "an image cannot be in feedback: " + row.name(),
                                "feedback is copied after each step: publish the image as an [output.NAME], "
                                "which is read where it lies");
    field.reset();
  }
  if (field && single_values(library.model(), *field) > max_parameter_values) {
    library.diagnostics().error(
        row.position(row.has("shape") ? "shape" : "type"),
        row.name() + " has " + std::to_string(single_values(library.model(), *field)) +
            " values, more than " + std::to_string(max_parameter_values),
        "make its shape smaller: what is large goes through a slot, or is read from a file");
    field.reset();
  }
  if (field) parameter.field = *field;
  parameter.widget = row.text("widget").value_or("");
  parameter.label = row.text("label").value_or("");
  if (field) parameter.initial = zero_literal(library.model(), parameter.field, node.key_position);
  if (kind != Parameter::Kind::feedback) {
    const FieldType& type = parameter.field.type;
    const bool numeric = field && parameter.input == Parameter::Input::value &&
                         type.kind == FieldType::Kind::scalar &&
                         (is_integer(type.scalar) || is_floating(type.scalar));
    if (field) {
      read_range(library, row, parameter, numeric);
      parameter.step = read_step(library.model(), row, parameter, library.diagnostics());
    } else {
      row.also("range");
      row.also("step");
    }
    read_default(library, row, parameter, !field);
    parameter.menu = row.text("menu").value_or("");
    parameter.role = kind == Parameter::Kind::runtime ? PanelRole::op : PanelRole::engineer;
    if (const auto role = row.word("role", {"viewer", "operator", "engineer", "admin"}))
      parameter.role = static_cast<PanelRole>(*role);
  }
  if (field && !parameter.widget.empty()) {
    const std::string needs = widget_misfit(library.model(), parameter.widget, parameter, false);
    if (!needs.empty())
      library.diagnostics().error(
          row.position("widget"),
          "the widget " + quote(parameter.widget) + " cannot show " + row.name() + ": it needs " + needs,
          "remove it, and the page shows the usual one");
  }
  if (kind != Parameter::Kind::feedback) row.also("needs");  // when all that it may name is known
  if (kind == Parameter::Kind::runtime) parameter.persist = row.boolean("persist").value_or(true);
  if (kind == Parameter::Kind::configuration && row.boolean("address").value_or(false)) {
    parameter.address = true;
    const FieldType& type = parameter.field.type;
    const bool fits =
        type.kind == FieldType::Kind::scalar && (is_integer(type.scalar) || type.scalar == Scalar::text);
    if (field && !fits)
      library.diagnostics().error(row.position("address"), row.name() + " cannot be an address",
                                  "an address on a bus is a whole number, an array of them, or a text");
  }
  row.finish();
  return parameter;
}

// As much as the runtime reserves for the parameters of one component.
void check_limits(const ParameterBlock& block, const ParameterBlock& before, Diagnostics& diagnostics) {
  auto holds = static_cast<std::size_t>(
      std::count_if(before.parameters.begin(), before.parameters.end(),
                    [](const Parameter& one) { return one.input == Parameter::Input::hold; }));
  bool too_large = false;
  for (const Parameter& parameter : block.parameters) {
    const Field& field = parameter.field;
    if (!too_large && field.offset + field.size > max_runtime_size) {
      too_large = true;
      diagnostics.error(field.position,
                        "the runtime parameters up to " + quote(field.name) + " take " +
                            std::to_string(field.offset + field.size) + " bytes, more than " +
                            std::to_string(max_runtime_size),
                        "make an array smaller, or take what is large from a slot or the configuration");
    }
    if (parameter.input == Parameter::Input::hold && ++holds == max_holds + 1)
      diagnostics.error(field.position,
                        quote(field.name) + " is one hold more than the " + std::to_string(max_holds) +
                            " that a component can have",
                        "remove one, or divide the unit into two");
  }
}

std::vector<const Field*> fields_of(const ParameterBlock& block) {
  std::vector<const Field*> fields;
  for (const Parameter& parameter : block.parameters) fields.push_back(&parameter.field);
  return fields;
}

}  // namespace

std::optional<Field> read_field(Library& library, Row& row, const std::vector<std::string>& words,
                                std::string* word, const std::vector<UnitChoice>& choices) {
  Diagnostics& diagnostics = library.diagnostics();
  Field field;
  field.name = row.node().key;
  field.position = row.node().key_position;
  field.summary = row.summary();
  const auto type = row.required_text("type", "add type = \"f64\", another scalar, or the name of a type");
  bool known = false;
  bool is_text = false;
  if (type) {
    const std::vector<std::string> scalars = scalar_words();
    const auto scalar = std::find(scalars.begin(), scalars.end(), *type);
    if (scalar != scalars.end()) {
      field.type.scalar = static_cast<Scalar>(scalar - scalars.begin());
      is_text = field.type.scalar == Scalar::text;
      known = true;
    } else if (std::find(words.begin(), words.end(), *type) != words.end()) {
      if (word != nullptr) *word = *type;
      field.type.scalar = *type == "button" ? Scalar::u32 : Scalar::boolean;
      known = true;
    } else if (is_camel_case(*type)) {
      const auto declared = library.type(*type, row.position("type"));
      if (declared && library.model().types[*declared].resizable() != nullptr) {
        diagnostics.error(
            row.position("type"),
            row.name() + " cannot be of the type " + quote(*type) + ", which is as large as each slot says",
            "publish it as an [output.NAME] of its own");
      } else if (declared) {
        field.type = {FieldType::Kind::declared, Scalar::boolean, *declared};
        known = true;
      }
    } else {
      static const std::map<std::string, std::string> elsewhere = {
          {"float", "f32"},   {"double", "f64"},  {"int", "i32"},    {"uint", "u32"},     {"byte", "u8"},
          {"int8", "i8"},     {"int16", "i16"},   {"int32", "i32"},  {"int64", "i64"},    {"uint8", "u8"},
          {"uint16", "u16"},  {"uint32", "u32"},  {"uint64", "u64"}, {"boolean", "bool"}, {"string", "text"},
          {"float32", "f32"}, {"float64", "f64"}, {"real", "f64"},   {"lreal", "f64"},    {"char", "u8"}};
      const auto same = elsewhere.find(*type);
      std::vector<std::string> all = scalars;
      all.insert(all.end(), words.begin(), words.end());
      diagnostics.error(row.position("type"), "unknown type " + quote(*type) + " in " + row.name(),
                        same != elsewhere.end() ? "it is called " + quote(same->second) + " here"
                                                : suggest(*type, all, "scalars", ""));
    }
  }
  const bool plain = known && (word == nullptr || word->empty());
  if (plain) {
    read_shape(row, field, diagnostics);
    if (is_text) refuse_shape_of_text(row, field, diagnostics);
    read_capacity(row, field, is_text, diagnostics);
    read_unit_of_measure(row, field, choices, diagnostics);
  } else if (!known) {
    for (const char* key : {"shape", "capacity", "unit"}) row.also(key);
  }
  if (!known || !check_size(library, row, field)) return std::nullopt;
  return field;
}

Parameter read_number(Library& library, Row& row) {
  Parameter number;
  number.field.name = row.node().key;
  number.field.type.scalar = Scalar::f64;
  read_unit_of_measure(row, number.field, {}, library.diagnostics());
  read_range(library, row, number, true);
  return number;
}

void read_parameters(Library& library, const Node& root, Parameter::Kind kind, ParameterBlock& block,
                     const std::vector<UnitChoice>& choices, const ParameterBlock& before) {
  const std::string section = kind == Parameter::Kind::configuration ? "configuration"
                              : kind == Parameter::Kind::runtime     ? "runtime"
                                                                     : "feedback";
  for (const Node* node : named_rows(library, root, section, "a parameter"))
    block.parameters.push_back(read_parameter(library, *node, kind, section, choices));
  // A configuration's struct is laid out where it is written, over both blocks.
  if (kind == Parameter::Kind::configuration)
    lay_out(library.model(), block);
  else
    lay_out(library.model(), block, before);
  check_fields(fields_of(block), library.diagnostics(), fields_of(before));
  if (kind == Parameter::Kind::runtime) check_limits(block, before, library.diagnostics());
}

std::vector<const Node*> named_rows(Library& library, const Node& root, std::string_view kind,
                                    std::string_view what) {
  std::vector<const Node*> rows;
  const Node* section = root.find(kind);
  if (section == nullptr) return rows;
  Diagnostics& diagnostics = library.diagnostics();
  const std::string header = "[" + std::string(kind) + ".NAME]";
  if (section->kind != Node::Kind::table) {
    diagnostics.error(section->position, quote(kind) + " must be a table, not " + kind_text(section->kind),
                      "write rows as " + header);
    return rows;
  }
  for (const Node& row : section->children) {
    if (row.kind != Node::Kind::table) {
      diagnostics.error(
          row.key_position,
          quote(row.key) + " in [" + std::string(kind) + "] must be a table, not " + kind_text(row.kind),
          "write rows as " + header);
      continue;
    }
    check_name(row, what, kind == "thread" || kind == "widget", diagnostics);
    rows.push_back(&row);
  }
  return rows;
}

}  // namespace flexrf::config_gen
