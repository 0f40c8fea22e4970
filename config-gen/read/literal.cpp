#include "config-gen/read/literal.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

struct Context {
  const Model& model;
  const std::string& what;
  Diagnostics& diagnostics;

  std::nullopt_t fail(const Node& value, const std::string& is, Hint hint) const {
    diagnostics.error(value.position, what + " " + is, std::move(hint));
    return std::nullopt;
  }
};

// Limits of what TOML can say: u64 above 2^63 - 1 cannot be written.
std::pair<std::int64_t, std::int64_t> limits_of(Scalar scalar) {
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  switch (scalar) {
    case Scalar::i8:
      return {-128, 127};
    case Scalar::u8:
      return {0, 255};
    case Scalar::i16:
      return {-32768, 32767};
    case Scalar::u16:
      return {0, 65535};
    case Scalar::i32:
      return {-2147483648LL, 2147483647LL};
    case Scalar::u32:
      return {0, 4294967295LL};
    case Scalar::u64:
      return {0, most};
    default:
      return {std::numeric_limits<std::int64_t>::min(), most};
  }
}

std::optional<Literal> read_scalar(const Context& context, const Field& field, const Node& value) {
  const Scalar scalar = field.type.scalar;
  Literal literal;
  literal.position = value.position;
  if (scalar == Scalar::boolean) {
    if (value.kind != Node::Kind::boolean)
      return context.fail(value, "must be true or false, not " + kind_text(value.kind),
                          "write true or false, without quotes");
    literal.value = value.boolean;
  } else if (scalar == Scalar::text) {
    if (value.kind != Node::Kind::text && !value.cell)
      return context.fail(value, "must be a text, not " + kind_text(value.kind), "write it in double quotes");
    if (value.text.size() > field.capacity)
      return context.fail(value,
                          "has " + std::to_string(value.text.size()) + " bytes, but the capacity is " +
                              std::to_string(field.capacity),
                          "shorten it, or raise the capacity in the table that declares it");
    literal.value = value.text;
  } else if (is_floating(scalar)) {
    if (value.kind != Node::Kind::real && value.kind != Node::Kind::integer)
      return context.fail(value, "must be a number, not " + kind_text(value.kind),
                          value.cell && value.text.find(',') != std::string::npos
                              ? "write the fraction after a point, as 1.5"
                              : "write it without quotes, in SI units");
    const double number = value.kind == Node::Kind::real ? value.real : static_cast<double>(value.integer);
    if (!std::isfinite(number)) return context.fail(value, "is not a finite number", "write a finite number");
    if (scalar == Scalar::f32 && std::abs(number) > static_cast<double>(std::numeric_limits<float>::max()))
      return context.fail(value, "does not fit in f32", "use f64, or a smaller number");
    literal.value = number;
  } else {
    if (value.kind != Node::Kind::integer)
      return context.fail(
          value, "must be a whole number (" + scalar_name(scalar) + "), not " + kind_text(value.kind),
          "write a number without quotes and without a fraction");
    const auto [least, most] = limits_of(scalar);
    if (value.integer < least || value.integer > most)
      return context.fail(
          value, "is " + std::to_string(value.integer) + ", which does not fit in " + scalar_name(scalar),
          "it holds " + std::to_string(least) + " to " + std::to_string(most));
    literal.value = value.integer;
  }
  return literal;
}

std::optional<Literal> read_record(const Context& context, const Type& type, const Node& value) {
  if (value.kind != Node::Kind::table)
    return context.fail(value,
                        "must be a table of the fields of " + type.name + ", not " + kind_text(value.kind),
                        "write it as { field = value, ... }");
  bool good = true;
  std::vector<std::string> known;
  for (const Field& field : type.fields) known.push_back(field.name);
  for (const Node& child : value.children) {
    bool found = false;
    for (const std::string& name : known) found = found || name == child.key;
    if (found) continue;
    context.diagnostics.error(
        child.key_position, "unknown field " + quote(child.key) + " of " + type.name + " in " + context.what,
        suggest(child.key, known, "fields", "it has none: remove this"));
    good = false;
  }
  Literal literal;
  literal.position = value.position;
  for (const Field& field : type.fields) {
    const Node* part = value.find(field.name);
    if (part == nullptr) {
      literal.elements.push_back(zero_literal(context.model, field, value.position));
      continue;
    }
    auto element = read_literal(context.model, field, *part, quote(field.name) + " in " + context.what,
                                context.diagnostics);
    good = good && element.has_value();
    if (element) literal.elements.push_back(std::move(*element));
  }
  if (!good) return std::nullopt;
  return literal;
}

std::optional<Literal> read_element(const Context& context, const Field& field, const Node& value) {
  if (field.type.kind == FieldType::Kind::scalar) return read_scalar(context, field, value);
  const Type& type = context.model.types[field.type.declared];
  if (type.kind == Type::Kind::record) return read_record(context, type, value);
  std::vector<std::string> names;
  for (const EnumerationValue& known : type.values) names.push_back(known.name);
  if (value.kind != Node::Kind::text && !value.cell)
    return context.fail(value,
                        "must be the name of a value of " + type.name + ", not " + kind_text(value.kind),
                        suggest("", names, "values", "the type has none"));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == value.text) return Literal{static_cast<std::int64_t>(i), {}, value.position};
  return context.fail(value, "is " + quote(value.text) + ", which is no value of " + type.name,
                      suggest(value.text, names, "values", "the type has none"));
}

bool is_list_of_records(const Model& model, const Field& field) {
  return field.shape.size() == 1 && field.type.kind == FieldType::Kind::declared &&
         model.types[field.type.declared].kind == Type::Kind::record;
}

// Fewer records than there is room for: the others are zero.
std::optional<Literal> read_short_list(const Context& context, const Field& field, const Node& value) {
  Literal literal = zero_literal(context.model, field, value.position);
  bool good = true;
  for (std::size_t i = 0; i < value.children.size(); ++i) {
    auto element = read_element(context, field, value.children[i]);
    good = good && element.has_value();
    if (element) literal.elements[i] = std::move(*element);
  }
  if (!good) return std::nullopt;
  return literal;
}

std::string shape_text(const std::vector<std::size_t>& shape) {
  return shape.size() == 1 ? std::to_string(shape[0]) + " values"
                           : std::to_string(shape[0]) + " rows of " + std::to_string(shape[1]) + " values";
}

}  // namespace

Literal zero_literal(const Model& model, const Field& field, const Position& position) {
  Literal zero;
  zero.position = position;
  if (!field.shape.empty()) {
    Field element = field;
    element.shape.clear();
    zero.elements.assign(field.elements(), zero_literal(model, element, position));
  } else if (field.type.kind == FieldType::Kind::declared) {
    const Type& type = model.types[field.type.declared];
    if (type.kind == Type::Kind::enumeration) zero.value = std::int64_t{0};
    for (const Field& part : type.fields) zero.elements.push_back(zero_literal(model, part, position));
  } else if (field.type.scalar == Scalar::boolean) {
    zero.value = false;
  } else if (field.type.scalar == Scalar::text) {
    zero.value = std::string();
  } else if (is_floating(field.type.scalar)) {
    zero.value = 0.0;
  } else {
    zero.value = std::int64_t{0};
  }
  return zero;
}

std::optional<Literal> read_literal(const Model& model, const Field& field, const Node& value,
                                    const std::string& what, Diagnostics& diagnostics) {
  const Context context{model, what, diagnostics};
  if (field.shape.empty()) return read_element(context, field, value);
  Literal literal;
  literal.position = value.position;
  if (value.kind != Node::Kind::array) {
    const auto element = read_element(context, field, value);
    if (!element) return std::nullopt;
    literal.elements.assign(field.elements(), *element);
    return literal;
  }
  const std::string hint =
      "the shape asks for " + shape_text(field.shape) + "; a single value without [] fills them all";
  const std::size_t rows = field.shape[0];
  if (is_list_of_records(model, field) && value.children.size() < rows)
    return read_short_list(context, field, value);
  if (value.children.size() != rows)
    return context.fail(value, "has " + std::to_string(value.children.size()) + " entries", hint);
  const std::size_t columns = field.shape.size() == 2 ? field.shape[1] : 1;
  literal.elements.resize(rows * columns);
  bool good = true;
  for (std::size_t r = 0; r < rows; ++r) {
    const Node& row = value.children[r];
    if (field.shape.size() == 2 && (row.kind != Node::Kind::array || row.children.size() != columns))
      return context.fail(row, "has a row that is not a list of " + std::to_string(columns), hint);
    for (std::size_t c = 0; c < columns; ++c) {
      auto element = read_element(context, field, field.shape.size() == 2 ? row.children[c] : row);
      good = good && element.has_value();
      if (element) literal.elements[c * rows + r] = std::move(*element);
    }
  }
  if (!good) return std::nullopt;
  return literal;
}

std::optional<Literal> read_parameter_value(const Model& model, const Parameter& parameter, const Node& value,
                                            const std::string& what, Diagnostics& diagnostics) {
  auto literal = read_literal(model, parameter.field, value, what, diagnostics);
  if (!literal || !parameter.low || !parameter.high) return literal;
  const auto judge = [&](const Literal& one) {
    if (!is_below(one, *parameter.low) && !is_below(*parameter.high, one)) return true;
    diagnostics.error(one.position,
                      what + " is " + literal_text(one) + ", outside of its range " + range_text(parameter),
                      "choose a value inside, or change the range at " + to_string(parameter.low->position));
    return false;
  };
  if (parameter.field.shape.empty()) return judge(*literal) ? literal : std::nullopt;
  for (const Literal& element : literal->elements)
    if (!judge(element)) return std::nullopt;
  return literal;
}

bool check_range(const Literal& low, const Literal& high, const Position& position, const std::string& what,
                 Diagnostics& diagnostics) {
  constexpr std::int64_t most = (std::int64_t{1} << 53) - 1;
  for (const Literal* bound : {&low, &high}) {
    const auto* integer = std::get_if<std::int64_t>(&bound->value);
    if (integer == nullptr || (*integer >= -most && *integer <= most)) continue;
    diagnostics.error(bound->position,
                      what + " has the bound " + literal_text(*bound) + ", which is too far from 0",
                      "bounds are exact from -" + std::to_string(most) + " to " + std::to_string(most) +
                          ": choose one inside, or leave out the range");
    return false;
  }
  if (!is_below(high, low)) return true;
  diagnostics.error(position, what + " is empty: " + literal_text(low) + " is above " + literal_text(high),
                    "write the lower bound first");
  return false;
}

std::optional<Literal> read_step(const Model& model, Row& row, const Parameter& parameter,
                                 Diagnostics& diagnostics) {
  const Node* node = row.any("step");
  if (node == nullptr) return std::nullopt;
  const FieldType& type = parameter.field.type;
  const bool numeric = parameter.kind != Parameter::Kind::feedback &&
                       parameter.input == Parameter::Input::value && type.kind == FieldType::Kind::scalar &&
                       (is_integer(type.scalar) || is_floating(type.scalar));
  if (!numeric) {
    diagnostics.error(node->position, "'step' of " + row.name() + " is for numbers that can be set",
                      "remove it");
    return std::nullopt;
  }
  Field element = parameter.field;
  element.shape.clear();
  auto step = read_literal(model, element, *node, "the step of " + row.name(), diagnostics);
  if (step && !(number_of(*step) > 0)) {
    diagnostics.error(node->position, "the step of " + row.name() + " must be above 0",
                      "write by how much a button of the panel changes it, in its unit of measure");
    return std::nullopt;
  }
  return step;
}

double number_of(const Literal& literal) {
  if (const auto* real = std::get_if<double>(&literal.value)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&literal.value)) return static_cast<double>(*integer);
  if (const auto* boolean = std::get_if<bool>(&literal.value)) return *boolean ? 1 : 0;
  return 0;
}

bool is_below(const Literal& one, const Literal& other) {
  const auto* integer = std::get_if<std::int64_t>(&one.value);
  const auto* bound = std::get_if<std::int64_t>(&other.value);
  if (integer != nullptr && bound != nullptr) return *integer < *bound;
  return number_of(one) < number_of(other);
}

std::string literal_text(const Literal& literal) {
  if (const auto* integer = std::get_if<std::int64_t>(&literal.value)) return std::to_string(*integer);
  if (const auto* boolean = std::get_if<bool>(&literal.value)) return *boolean ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&literal.value)) return "\"" + printable(*text) + "\"";
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.10g", number_of(literal));
  return text.data();
}

std::string range_text(const Parameter& parameter) {
  std::string text = "[" + literal_text(*parameter.low) + ", " + literal_text(*parameter.high) + "]";
  if (!parameter.field.unit.empty() && parameter.field.unit != "1") text += " " + parameter.field.told_unit;
  return text;
}

}  // namespace flexrf::config_gen
