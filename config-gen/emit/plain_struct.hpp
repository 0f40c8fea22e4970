// A generated plain struct: its C++ definition and its TypeDescriptor. Types of the tables and the parameters
// of units and devices are written by the same code, so they have the same layout and the same accessors.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "config-gen/emit/space.hpp"
#include "config-gen/emit/text.hpp"
#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

struct PlainField {
  const Field* field = nullptr;
  std::size_t offset = 0;            // in this struct, which may be another than the field was laid out in
  std::string scalar;                // enumerator of flexrf::Scalar
  const Literal* initial = nullptr;  // none: zero
};

struct PlainStruct {
  std::string name;        // CamelCase
  std::string identifier;  // snake_case of it: prefix of what belongs to it
  Space space{library_space};
  std::string summary;
  Position position;
  std::size_t size = 1;
  std::size_t alignment = 1;
  bool image = false;
  std::size_t elements_offset = 0;  // as Type's: the last field lies behind the struct
  std::vector<PlainField> fields;
  std::string base;             // the struct that it derives from; empty: none
  std::size_t base_fields = 0;  // of `fields`, the first, which are the base's

  // Of the C++ struct.
  std::size_t struct_size() const;
};

PlainStruct plain_struct(const Model& model, const Type& type);
// Of parameters laid out one after the other. An interface's come before its driver's own.
PlainStruct plain_struct(const Model& model, std::string name, const Space& space, std::string summary,
                         const Position& position, const std::vector<const ParameterBlock*>& blocks);
// Of a driver's own, as they were laid out behind their interface's, `before`, whose struct is `base`: what
// is written through that changes nothing of them.
PlainStruct plain_struct(const Model& model, std::string name, const Space& space, std::string summary,
                         const Position& position, const ParameterBlock& own, std::string base,
                         const ParameterBlock& before);

// What #include lines a header with these fields needs.
void add_includes(const Model& model, const PlainStruct& plain, std::set<std::string>& system,
                  std::set<std::string>& own);
std::string include_lines(const std::set<std::string>& system, const std::set<std::string>& own);

// The runtime finds the descriptor of a type by the type: for after its definition, in its namespace.
void declare_descriptor(const Space& space, std::string_view type, std::string_view descriptor, Text& out);

// Definition of the struct, declaration of its descriptor: for a header.
void define_struct(const Model& model, const PlainStruct& plain, Text& out);
// Checks of the layout, and the descriptor itself: for a source file.
void define_descriptor(const Model& model, const PlainStruct& plain, Text& out);
// The descriptor alone, called as plain.identifier says, as names are in `space`.
void define_descriptor_alone(const Model& model, const PlainStruct& plain, const Space& space, Text& out);

std::uint64_t hash_of(const Model& model, const PlainStruct& plain);
std::uint64_t hash_of(const Model& model, const Type& type);

struct Range {
  std::size_t offset = 0;
  std::size_t size = 0;
};
std::vector<Range> significant_ranges(const Model& model, const PlainStruct& plain);

// "std::array<double, 3>", and a value of it as a C++ initialiser.
std::string cpp_type(const Model& model, const Space& space, const Field& field);
std::string cpp_value(const Model& model, const Space& space, const Field& field, const Literal& value);

// Enumerator of flexrf::Scalar for a field, or for a parameter.
std::string scalar_of(const Model& model, const FieldType& type);
std::string scalar_of(const Model& model, const Parameter& parameter);

// "types/pose.hpp"
std::string type_header(const Type& type);
std::string descriptor_name(std::string_view type);  // Pose: pose_descriptor
}  // namespace flexrf::config_gen
