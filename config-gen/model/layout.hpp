// Where the fields of a generated struct lie: the rules of the C++ ABI for plain structs.
#pragma once

#include <string>

#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

std::size_t scalar_size(Scalar scalar);  // text: 1
bool is_floating(Scalar scalar);
bool is_integer(Scalar scalar);
std::string scalar_name(Scalar scalar);
std::string type_name(const Model& model, const FieldType& type);
std::string type_name(const Model& model, const SlotType& type);  // "Pose"; "JogFeedback"
// Of a slot, for people: of a device's parameters what all its drivers have, as far as there is any.
std::string common_type_name(const Model& model, const Slot& slot);

// Sets size and alignment of a field whose type has been laid out.
void lay_out(const Model& model, Field& field);
// Sets offsets of fields that follow each other; gives size and alignment of the struct.
struct Extent {
  std::size_t size = 1;
  std::size_t alignment = 1;
};
void append(Field& field, Extent& extent, bool first);
Extent finish(Extent extent, bool empty);

// What one field of a struct takes of the limits of its type: as Type::single_fields and single_values.
std::size_t single_fields(const Model& model, const Field& field);
std::size_t single_values(const Model& model, const Field& field);

// Each of its fields is within the limits.
void lay_out(const Model& model, Type& type);
void lay_out(const Model& model, ParameterBlock& block);
// In one struct with what it begins with, and behind all of that: also behind its padding.
void lay_out(const Model& model, ParameterBlock& block, const ParameterBlock& before);

}  // namespace flexrf::config_gen
