#include "config-gen/emit/plain_struct.hpp"

#include <algorithm>
#include <cmath>

#include "config-gen/model/footprint.hpp"
#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

bool has_map(const Field& field) {
  return !field.shape.empty() && field.type.kind == FieldType::Kind::scalar && is_floating(field.type.scalar);
}
bool is_text(const Field& field) {
  return field.type.kind == FieldType::Kind::scalar && field.type.scalar == Scalar::text;
}

std::string cpp_scalar(Scalar scalar) {
  switch (scalar) {
    case Scalar::boolean:
      return "bool";
    case Scalar::i8:
      return "std::int8_t";
    case Scalar::u8:
      return "std::uint8_t";
    case Scalar::i16:
      return "std::int16_t";
    case Scalar::u16:
      return "std::uint16_t";
    case Scalar::i32:
      return "std::int32_t";
    case Scalar::u32:
      return "std::uint32_t";
    case Scalar::i64:
      return "std::int64_t";
    case Scalar::u64:
      return "std::uint64_t";
    case Scalar::f32:
      return "float";
    case Scalar::f64:
      return "double";
    case Scalar::text:
      return "char";
  }
  return "";
}

std::string text_value(const std::string& value, std::size_t capacity) {
  if (value.empty()) return "{}";
  if (value.size() < capacity) return "{" + string_literal(value) + "}";
  std::string list = "{{";  // full: without a terminating zero, so no string literal fits
  for (std::size_t i = 0; i < capacity; ++i) {
    const std::string one = string_literal(value.substr(i, 1));
    list += (i == 0 ? "'" : ", '") + (value[i] == '\'' ? "\\'" : one.substr(1, one.size() - 2)) + "'";
  }
  return list + "}}";
}

double number(const Literal& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value.value)) return *real;
  return 0;
}

std::string element_value(const Model& model, const Space& space, const Field& field, const Literal& value) {
  if (value.value.index() == 0 && value.elements.empty()) return "{}";
  if (field.type.kind == FieldType::Kind::declared) {
    const Type& type = model.types[field.type.declared];
    if (type.kind == Type::Kind::enumeration) {
      const auto chosen = static_cast<std::size_t>(std::get<std::int64_t>(value.value));
      return space.of(type, type.name) + "::" + type.values[chosen].name;
    }
    std::string list = space.of(type, type.name) + "{";
    for (std::size_t i = 0; i < type.fields.size(); ++i) {
      list += (i == 0 ? "" : ", ") + cpp_value(model, space, type.fields[i], value.elements[i]);
    }
    return list + "}";
  }
  switch (field.type.scalar) {
    case Scalar::boolean:
      return bool_literal(std::get<bool>(value.value));
    case Scalar::f32:
      return float_literal(number(value));
    case Scalar::f64:
      return double_literal(number(value));
    case Scalar::text:
      return text_value(std::get<std::string>(value.value), field.capacity);
    default:
      return integer_literal(std::get<std::int64_t>(value.value), field.type.scalar);
  }
}

std::string matrix_type(const Field& field) {
  const std::string columns = field.shape.size() == 2 ? std::to_string(field.shape[1]) : "1";
  const std::string scalar = cpp_scalar(field.type.scalar);
  // Eigen wants a matrix of one row stored by rows; of one row both orders are the same.
  const std::string order = field.shape[0] == 1 && columns != "1" ? ", Eigen::RowMajor" : "";
  return "Eigen::Matrix<" + scalar + ", " + std::to_string(field.shape[0]) + ", " + columns + order + ">";
}

void define_accessors(const Field& field, Text& out) {
  const std::string& name = field.name;
  if (has_map(field)) {
    const std::string matrix = matrix_type(field);
    out << "  auto " << name << "_map() noexcept { return Eigen::Map<" << matrix << ">(" << name
        << ".data()); }\n";
    out << "  auto " << name << "_map() const noexcept { return Eigen::Map<const " << matrix << ">(" << name
        << ".data()); }\n";
  } else if (is_text(field) && field.shape.empty()) {
    // Whatever fields are called: a member 'text_view' or 'set_text' hides the function, and no field's name
    // ends as the parameter's.
    out << "  std::string_view " << name << "_view() const noexcept { return flexrf::text_view(" << name
        << "); }\n";
    out << "  void set_" << name << "(std::string_view text_) noexcept { flexrf::set_text(" << name
        << ", text_); }\n";
  }
}

std::string comment_of(const Field& field) {
  return comment_text(field.summary +
                      (field.unit.empty() || field.unit == "1" ? "" : " [" + field.told_unit + "]"));
}

// Of the last field, which lies behind the struct. No field's name ends as these do.
void define_elements(const PlainStruct& plain, Text& out) {
  const Field& field = *plain.fields.back().field;
  const std::string element = cpp_scalar(field.type.scalar);
  const auto accessor = [&](const char* of, const char* where) {
    out << "  std::span<" << of << element << "> " << field.name << "()" << where << "noexcept {\n"
        << "    return {reinterpret_cast<" << of << element << "*>(reinterpret_cast<" << of
        << "std::byte*>(this) + elements_begin_), elements_};\n  }\n";
  };
  out << "  std::uint32_t elements_{};  ///< how many " << field.name << "() has: the slot writes it\n\n"
      << "  using SlotElement = " << element << ";\n"
      << "  static constexpr std::size_t elements_begin_ = " << plain.fields.back().offset << ";\n"
      << "  static constexpr std::size_t usual_elements_ = " << field.elements() << ";\n";
  out << "  /// " << comment_of(field) << "\n";
  accessor("", " ");
  accessor("const ", " const ");
  out << "\n  " << plain.name << "() noexcept = default;\n\n private:\n"
      << "  // It is as large as its slot says: what looks at it looks where it lies.\n"
      << "  " << plain.name << "(const " << plain.name << "&) = default;\n"
      << "  " << plain.name << "& operator=(const " << plain.name << "&) = default;\n";
}

// What a slot's row may say is not of the type.
std::string field_signature(const Model& model, const PlainField& plain) {
  const Field& field = *plain.field;
  std::string text = field.name + ":" + plain.scalar;
  if (field.type.kind == FieldType::Kind::declared) {
    text += "=" + hash_text(hash_of(model, model.types[field.type.declared]));
  }
  for (const std::size_t extent : field.shape)
    text += field.resizable ? "[slot]" : "[" + std::to_string(extent) + "]";
  if (is_text(field)) text += "(" + std::to_string(field.capacity) + ")";
  return text + " " + field.unit + ";";
}

void add_ranges(const Model& model, const Field& field, std::size_t offset, std::vector<Range>& ranges) {
  const bool is_record = field.type.kind == FieldType::Kind::declared &&
                         model.types[field.type.declared].kind == Type::Kind::record;
  if (!is_record) {
    if (!ranges.empty() && ranges.back().offset + ranges.back().size == offset) {
      ranges.back().size += field.size;
    } else {
      ranges.push_back({offset, field.size});
    }
    return;
  }
  const Type& type = model.types[field.type.declared];
  for (std::size_t i = 0; i < field.elements(); ++i) {
    for (const Field& inner : type.fields)
      add_ranges(model, inner, offset + i * type.size + inner.offset, ranges);
  }
}

}  // namespace

std::string type_header(const Type& type) {
  return "types/" + type.stem + ".hpp";
}
std::string descriptor_name(std::string_view type) {
  return snake_case(type) + "_descriptor";
}

std::string scalar_of(const Model& model, const FieldType& type) {
  if (type.kind == FieldType::Kind::scalar) {
    return type.scalar == Scalar::boolean ? "boolean" : scalar_name(type.scalar);
  }
  return model.types[type.declared].kind == Type::Kind::enumeration ? "enumeration" : "structure";
}

std::string scalar_of(const Model& model, const Parameter& parameter) {
  if (parameter.input == Parameter::Input::button) return "button";
  if (parameter.input == Parameter::Input::hold) return "hold";
  return scalar_of(model, parameter.field.type);
}

std::string cpp_type(const Model& model, const Space& space, const Field& field) {
  std::string element;
  if (field.type.kind == FieldType::Kind::declared) {
    const Type& type = model.types[field.type.declared];
    element = space.of(type, type.name);
  } else if (is_text(field)) {
    element = "std::array<char, " + std::to_string(field.capacity) + ">";
  } else {
    element = cpp_scalar(field.type.scalar);
  }
  return field.shape.empty() ? element
                             : "std::array<" + element + ", " + std::to_string(field.elements()) + ">";
}

std::string cpp_value(const Model& model, const Space& space, const Field& field, const Literal& value) {
  if (field.shape.empty()) return element_value(model, space, field, value);
  if (value.elements.empty()) return "{}";
  std::string list = "{{";
  for (std::size_t i = 0; i < value.elements.size(); ++i) {
    list += (i == 0 ? "" : ", ") + element_value(model, space, field, value.elements[i]);
  }
  return list + "}}";
}

std::size_t PlainStruct::struct_size() const {
  return elements_offset == 0 ? size : round_up(elements_offset + sizeof(std::uint32_t), alignment);
}

PlainStruct plain_struct(const Model& model, const Type& type) {
  PlainStruct plain{type.name,
                    snake_case(type.name),
                    Space(type.space),
                    type.summary,
                    type.position,
                    type.size,
                    type.alignment,
                    type.image,
                    type.elements_offset,
                    {},
                    "",
                    0};
  for (const Field& field : type.fields) {
    plain.fields.push_back({&field, field.offset, scalar_of(model, field.type), nullptr});
  }
  return plain;
}

PlainStruct plain_struct(const Model& model, std::string name, const Space& space, std::string summary,
                         const Position& position, const std::vector<const ParameterBlock*>& blocks) {
  const std::string identifier = snake_case(name);
  PlainStruct plain{
      std::move(name), identifier, space, std::move(summary), position, 1, 1, false, 0, {}, "", 0};
  Extent extent;
  for (const ParameterBlock* block : blocks) {
    for (const Parameter& parameter : block->parameters) {
      Field field = parameter.field;
      append(field, extent, plain.fields.empty());
      plain.fields.push_back(
          {&parameter.field, field.offset, scalar_of(model, parameter), &parameter.initial});
    }
  }
  extent = finish(extent, plain.fields.empty());
  plain.size = extent.size;
  plain.alignment = extent.alignment;
  return plain;
}

PlainStruct plain_struct(const Model& model, std::string name, const Space& space, std::string summary,
                         const Position& position, const ParameterBlock& own, std::string base,
                         const ParameterBlock& before) {
  PlainStruct plain = plain_struct(model, std::move(name), space, std::move(summary), position, {&before});
  if (!before.empty()) plain.base = std::move(base);
  plain.base_fields = plain.fields.size();
  for (const Parameter& parameter : own.parameters)
    plain.fields.push_back(
        {&parameter.field, parameter.field.offset, scalar_of(model, parameter), &parameter.initial});
  plain.size = own.size;
  plain.alignment = own.alignment;
  return plain;
}

void add_includes(const Model& model, const PlainStruct& plain, std::set<std::string>& system,
                  std::set<std::string>& own) {
  own.insert("runtime/core/type_descriptor.hpp");
  for (const PlainField& entry : plain.fields) {
    const Field& field = *entry.field;
    if (field.resizable) {
      system.insert({"cstddef", "cstdint", "span"});
      continue;
    }
    if (!field.shape.empty() || is_text(field)) system.insert("array");
    if (has_map(field)) system.insert("Eigen/Core");
    if (is_text(field)) {
      system.insert("string_view");
      own.insert("base/text.hpp");
    }
    if (field.type.kind == FieldType::Kind::declared) {
      own.insert(type_header(model.types[field.type.declared]));
    } else if (is_integer(field.type.scalar)) {
      system.insert("cstdint");
    }
    if (entry.initial != nullptr && !std::isfinite(number(*entry.initial))) system.insert("limits");
  }
}

std::string include_lines(const std::set<std::string>& system, const std::set<std::string>& own) {
  Text out;
  for (const std::string& header : system) out << "#include <" << header << ">\n";
  if (!system.empty() && !own.empty()) out << "\n";
  for (const std::string& header : own) out << include_line(header);
  return out.take();
}

void declare_descriptor(const Space& space, std::string_view type, std::string_view descriptor, Text& out) {
  out << "extern const " << space.runtime() << "TypeDescriptor " << descriptor << ";\n";
  // A specialisation is in the namespace of its template.
  if (space.is_user()) out << space.close() << Space(library_space).open();
  const std::string prefix = space.is_user() ? "user::" : "";
  out << "template <>\ninline constexpr const TypeDescriptor* descriptor_of<" << prefix << type << "> = &"
      << prefix << descriptor << ";\n";
  if (space.is_user()) out << Space(library_space).close() << space.open();
}

void define_struct(const Model& model, const PlainStruct& plain, Text& out) {
  out << "/// " << comment_text(plain.summary) << "\nstruct " << plain.name
      << (plain.base.empty() ? "" : " : " + plain.base) << " {\n";
  Text accessors;
  for (std::size_t i = plain.base_fields; i < plain.fields.size(); ++i) {
    const PlainField& entry = plain.fields[i];
    if (entry.field->resizable) continue;
    const std::string value =
        entry.initial == nullptr ? "{}" : cpp_value(model, plain.space, *entry.field, *entry.initial);
    const bool braced = value.starts_with("{");
    // Else it may lie in the base's padding, which whoever assigns to the base overwrites.
    const bool behind = i == plain.base_fields && !plain.base.empty();
    out << "  "
        << (behind
                ? "alignas(" + plain.base + ") alignas(" + cpp_type(model, plain.space, *entry.field) + ") "
                : "")
        << cpp_type(model, plain.space, *entry.field) << " " << entry.field->name << (braced ? "" : " = ")
        << value << ";  ///< " << comment_of(*entry.field) << "\n";
    define_accessors(*entry.field, accessors);
  }
  if (plain.elements_offset != 0) define_elements(plain, accessors);
  if (!accessors.str().empty()) out << "\n" << accessors.str();
  out << "};\n\n";
  declare_descriptor(plain.space, plain.name, plain.identifier + "_descriptor", out);
}

std::uint64_t hash_of(const Model& model, const PlainStruct& plain) {
  std::string signature = plain.name + "{";
  for (const PlainField& entry : plain.fields) signature += field_signature(model, entry);
  return fnv1a(signature + "}");
}

std::uint64_t hash_of(const Model& model, const Type& type) {
  if (type.kind == Type::Kind::record) return hash_of(model, plain_struct(model, type));
  std::string signature = type.name + "<";
  for (const EnumerationValue& value : type.values) signature += value.name + ";";
  return fnv1a(signature + ">");
}

std::vector<Range> significant_ranges(const Model& model, const PlainStruct& plain) {
  std::vector<Range> ranges;
  for (const PlainField& entry : plain.fields) add_ranges(model, *entry.field, entry.offset, ranges);
  return ranges;
}

void define_descriptor(const Model& model, const PlainStruct& plain, Text& out) {
  const std::string& name = plain.name;
  const std::string row = short_position(plain.position);
  out << "static_assert(sizeof(" << name << ") == " << plain.struct_size() << " && alignof(" << name
      << ") == " << plain.alignment << ", " << string_literal(row + ": layout of " + name) << ");\n"
      << "static_assert(std::is_trivially_copyable_v<" << name << ">"
      << (plain.base.empty() ? " && std::is_standard_layout_v<" + name + ">" : "") << ");\n";
  // With a base it has no standard layout; GCC and Clang know the places all the same.
  if (!plain.base.empty())
    out << "#pragma GCC diagnostic push\n#pragma GCC diagnostic ignored \"-Winvalid-offsetof\"\n";
  for (const PlainField& entry : plain.fields) {
    const bool behind = entry.field->resizable;
    out << "static_assert(offsetof(" << name << ", " << (behind ? "elements_" : entry.field->name)
        << ") == " << (behind ? plain.elements_offset : entry.offset) << ", "
        << string_literal(short_position(entry.field->position) + ": place of " + entry.field->name)
        << ");\n";
  }
  if (!plain.base.empty()) out << "#pragma GCC diagnostic pop\n";
  define_descriptor_alone(model, plain, plain.space, out);
}

void define_descriptor_alone(const Model& model, const PlainStruct& plain, const Space& space, Text& out) {
  const std::string runtime(space.runtime());
  const std::string fields = plain.fields.empty() ? "{}" : plain.identifier + "_fields";
  const std::string ranges = plain.fields.empty() ? "{}" : plain.identifier + "_significant";
  if (!plain.fields.empty()) {
    out << "\nnamespace {\n\nconstexpr " << runtime << "FieldDescriptor " << fields << "[] = {\n";
    for (const PlainField& entry : plain.fields) {
      const Field& field = *entry.field;
      const auto extent = [&](std::size_t i) { return i < field.shape.size() ? field.shape[i] : 0; };
      out << "    {\"" << field.name << "\", " << runtime << "Scalar::" << entry.scalar << ", "
          << field.shape.size() << ", {" << extent(0) << ", " << extent(1) << "}, "
          << (is_text(field) ? field.capacity : field.elements()) << ", " << entry.offset << ", "
          << string_literal(field.told_unit) << ", " << string_literal(field.summary) << ", "
          << (field.type.kind == FieldType::Kind::declared
                  ? "&" + space.of(model.types[field.type.declared],
                                   descriptor_name(model.types[field.type.declared].name))
                  : "nullptr")
          << "},\n";
    }
    out << "};\nconstexpr " << runtime << "ByteRange " << ranges << "[] = {";
    bool first = true;
    for (const Range& range : significant_ranges(model, plain)) {
      out << (first ? "{" : ", {") << range.offset << ", " << range.size << "}";
      first = false;
    }
    out << "};\n\n}  // namespace\n";
  }
  out << "\nconstinit const " << runtime << "TypeDescriptor " << plain.identifier << "_descriptor{\n    \""
      << plain.name << "\", " << string_literal(plain.summary) << ",\n    " << plain.size << ", "
      << plain.alignment << ", " << hash_literal(hash_of(model, plain)) << ", " << fields << ", " << ranges
      << ", {}, " << bool_literal(plain.image)
      << (plain.elements_offset == 0 ? "" : ", " + std::to_string(plain.elements_offset)) << "};\n";
}

}  // namespace flexrf::config_gen
