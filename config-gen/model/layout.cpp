#include "config-gen/model/layout.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include "config-gen/model/footprint.hpp"

namespace flexrf::config_gen {
namespace {

struct ScalarRow {
  const char* name;
  std::size_t size;
};

constexpr std::array<ScalarRow, 12> scalars{{{"bool", 1},
                                             {"i8", 1},
                                             {"u8", 1},
                                             {"i16", 2},
                                             {"u16", 2},
                                             {"i32", 4},
                                             {"u32", 4},
                                             {"i64", 8},
                                             {"u64", 8},
                                             {"f32", 4},
                                             {"f64", 8},
                                             {"text", 1}}};

constexpr std::size_t elements_count_size = 4;

const ParameterBlock* block_of(const Model& model, const SlotType& type) {
  switch (type.kind) {
    case SlotType::Kind::unit_runtime:
      return &model.unit_types[type.index].runtime;
    case SlotType::Kind::unit_feedback:
      return &model.unit_types[type.index].feedback;
    case SlotType::Kind::interface_runtime:
      return &model.interfaces[type.index].runtime;
    case SlotType::Kind::interface_feedback:
      return &model.interfaces[type.index].feedback;
    case SlotType::Kind::driver_runtime:
      return &model.drivers[type.index].runtime;
    case SlotType::Kind::driver_feedback:
      return &model.drivers[type.index].feedback;
    case SlotType::Kind::declared:
      break;
  }
  return nullptr;
}

}  // namespace

std::size_t scalar_size(Scalar scalar) {
  return scalars[static_cast<std::size_t>(scalar)].size;
}
std::string scalar_name(Scalar scalar) {
  return scalars[static_cast<std::size_t>(scalar)].name;
}
bool is_floating(Scalar scalar) {
  return scalar == Scalar::f32 || scalar == Scalar::f64;
}
bool is_integer(Scalar scalar) {
  return scalar >= Scalar::i8 && scalar <= Scalar::u64;
}

std::string type_name(const Model& model, const FieldType& type) {
  return type.kind == FieldType::Kind::scalar ? scalar_name(type.scalar) : model.types[type.declared].name;
}

std::string type_name(const Model& model, const SlotType& type) {
  switch (type.kind) {
    case SlotType::Kind::unit_runtime:
      return model.unit_types[type.index].class_name + "Runtime";
    case SlotType::Kind::unit_feedback:
      return model.unit_types[type.index].class_name + "Feedback";
    case SlotType::Kind::interface_runtime:
      return model.interfaces[type.index].class_name + "Runtime";
    case SlotType::Kind::interface_feedback:
      return model.interfaces[type.index].class_name + "Feedback";
    case SlotType::Kind::driver_runtime:
      return model.drivers[type.index].class_name + "Runtime";
    case SlotType::Kind::driver_feedback:
      return model.drivers[type.index].class_name + "Feedback";
    case SlotType::Kind::declared:
      break;
  }
  return model.types[type.index].name;
}

std::string common_type_name(const Model& model, const Slot& slot) {
  const bool is_runtime = slot.type.kind == SlotType::Kind::driver_runtime;
  if (!is_runtime && slot.type.kind != SlotType::Kind::driver_feedback) return type_name(model, slot.type);
  const Index index = model.drivers[slot.type.index].interface;
  const Interface& interface = model.interfaces[index];
  if ((is_runtime ? interface.runtime : interface.feedback).empty()) return type_name(model, slot.type);
  return type_name(
      model, {is_runtime ? SlotType::Kind::interface_runtime : SlotType::Kind::interface_feedback, index});
}

std::size_t Field::elements() const {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

void lay_out(const Model& model, Field& field) {
  std::size_t element = 0;
  if (field.type.kind == FieldType::Kind::declared) {
    element = model.types[field.type.declared].size;
    field.alignment = model.types[field.type.declared].alignment;
  } else {
    element = scalar_size(field.type.scalar);
    field.alignment = element;
    if (field.type.scalar == Scalar::text) element *= field.capacity;
  }
  field.size = element * field.elements();
}

void append(Field& field, Extent& extent, bool first) {
  if (first) extent.size = 0;
  field.offset = round_up(extent.size, field.alignment);
  extent.size = field.offset + field.size;
  extent.alignment = std::max(extent.alignment, field.alignment);
}

Extent finish(Extent extent, bool empty) {
  if (!empty) extent.size = round_up(extent.size, extent.alignment);
  return extent;
}

std::size_t single_fields(const Model& model, const Field& field) {
  if (field.type.kind == FieldType::Kind::scalar) return 1;
  const Type& type = model.types[field.type.declared];
  return type.kind == Type::Kind::record ? type.single_fields * field.elements() : 1;
}

std::size_t single_values(const Model& model, const Field& field) {
  const std::size_t each =
      field.type.kind == FieldType::Kind::scalar ? 1 : model.types[field.type.declared].single_values;
  return each * field.elements();
}

void lay_out(const Model& model, Type& type) {
  Extent extent;
  if (type.kind == Type::Kind::record) {
    type.single_fields = type.single_values = 0;
    for (Field& field : type.fields) {
      type.single_fields += single_fields(model, field);
      type.single_values += single_values(model, field);
      lay_out(model, field);
      if (!field.resizable) append(field, extent, &field == &type.fields.front());
    }
    // One whose fields were all refused has none, and there must not be any number of it either.
    type.single_fields = std::max<std::size_t>(1, type.single_fields);
    type.single_values = std::max<std::size_t>(1, type.single_values);
    extent = finish(extent, type.fields.empty());
    if (!type.fields.empty() && type.fields.back().resizable) {
      type.elements_offset = round_up(extent.size, elements_count_size);
      extent.alignment = std::max(extent.alignment, elements_count_size);
      extent.size = round_up(type.elements_offset + elements_count_size, page);
      type.fields.back().offset = extent.size;
      extent.size += type.fields.back().size;
    }
  }
  type.size = extent.size;
  type.alignment = extent.alignment;
}

void lay_out(const Model& model, ParameterBlock& block) {
  lay_out(model, block, {});
}

void lay_out(const Model& model, ParameterBlock& block, const ParameterBlock& before) {
  Extent extent{before.size, before.alignment};
  for (Parameter& parameter : block.parameters) {
    lay_out(model, parameter.field);
    append(parameter.field, extent, before.empty() && &parameter == &block.parameters.front());
  }
  extent = finish(extent, block.empty());
  block.size = extent.size;
  block.alignment = extent.alignment;
}

std::size_t size_of(const Model& model, const SlotType& type) {
  const ParameterBlock* block = block_of(model, type);
  return block != nullptr ? block->size : model.types[type.index].size;
}

std::size_t size_of(const Model& model, const SlotType& type, std::size_t elements) {
  if (elements == 0) return size_of(model, type);
  Field field = *model.types[type.index].resizable();
  field.shape = {elements};
  lay_out(model, field);
  return field.offset + field.size;
}

std::size_t alignment_of(const Model& model, const SlotType& type) {
  const ParameterBlock* block = block_of(model, type);
  return block != nullptr ? block->alignment : model.types[type.index].alignment;
}

}  // namespace flexrf::config_gen
