// A type of the tables: its header and its descriptor.
#include "config-gen/emit/emit.hpp"
#include "config-gen/emit/plain_struct.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

void define_enumeration(const Type& type, Text& out) {
  out << "/// " << comment_text(type.summary) << "\nenum class " << type.name << " : std::uint8_t {\n";
  for (const EnumerationValue& value : type.values)
    out << "  " << value.name << ",  ///< " << comment_text(value.summary) << "\n";
  const std::string descriptor = descriptor_name(type.name);
  out << "};\n/// As in the table; \"?\" for a number that is none of the values.\nconst char* name_of("
      << type.name << " value) noexcept;\n\n";
  declare_descriptor(Space(type.space), type.name, descriptor, out);
}

void define_enumeration_descriptor(const Model& model, const Type& type, Text& out) {
  const std::string prefix = snake_case(type.name);
  const std::string runtime(Space(type.space).runtime());
  out << "namespace {\n\nconstexpr " << runtime << "ByteRange " << prefix
      << "_significant[] = {{0, 1}};\nconstexpr " << runtime << "EnumerationValue " << prefix
      << "_values[] = {\n";
  for (const EnumerationValue& value : type.values) {
    out << "    {\"" << value.name << "\", " << string_literal(value.summary) << "},\n";
  }
  out << "};\n\n}  // namespace\n\nconstinit const " << runtime << "TypeDescriptor " << prefix
      << "_descriptor{\n    \"" << type.name << "\", " << string_literal(type.summary) << ",\n    1, 1, "
      << hash_literal(hash_of(model, type)) << ", {}, " << prefix << "_significant, " << prefix
      << "_values, false};\n\nconst char* name_of(" << type.name
      << " value) noexcept {\n  const auto number = static_cast<std::size_t>(value);\n  return number < "
         "std::size("
      << prefix << "_values) ? " << prefix << "_values[number].name : \"?\";\n}\n";
}

}  // namespace

std::string type_header_text(const Model& model, const Type& type) {
  Text out;
  out << generated_note(type.file) << "#pragma once\n\n";
  if (type.kind == Type::Kind::enumeration) {
    out << "#include <cstdint>\n\n#include \"runtime/core/type_descriptor.hpp\"\n\n"
        << Space(type.space).open() << "\n";
    define_enumeration(type, out);
  } else {
    const PlainStruct plain = plain_struct(model, type);
    std::set<std::string> system, own;
    add_includes(model, plain, system, own);
    out << include_lines(system, own) << "\n" << Space(type.space).open() << "\n";
    define_struct(model, plain, out);
  }
  out << "\n" << Space(type.space).close();
  return out.take();
}

std::string type_source_text(const Model& model, const Type& type) {
  Text out;
  out << generated_note(type.file) << "#include \"" << type_header(type) << "\"\n\n";
  if (type.kind == Type::Kind::enumeration) {
    out << "#include <iterator>\n\n" << Space(type.space).open() << "\n";
    define_enumeration_descriptor(model, type, out);
  } else {
    out << "#include <cstddef>\n#include <type_traits>\n\n" << Space(type.space).open() << "\n";
    define_descriptor(model, plain_struct(model, type), out);
  }
  out << "\n" << Space(type.space).close();
  return out.take();
}

}  // namespace flexrf::config_gen
