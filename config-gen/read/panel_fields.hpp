// The fields that a widget's row names of what a slot carries, and what they have to be.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config-gen/read/assembly.hpp"
#include "config-gen/read/row.hpp"

namespace flexrf::config_gen {

struct FieldPlace {
  const Field* field = nullptr;
  bool element = false;  // one of its elements is meant

  bool is_single() const { return element || field->shape.empty(); }
};

struct FieldNeed {
  std::string_view text;  // "a whole number"
  bool (*fits)(const Model& model, const FieldPlace& place);
};

namespace field_need {
extern const FieldNeed boolean;
extern const FieldNeed whole_number;
extern const FieldNeed number;
extern const FieldNeed pixels;       // a number without another unit
extern const FieldNeed nanoseconds;  // i64
extern const FieldNeed sort;         // an enumeration, a bool or a whole number
extern const FieldNeed kind;         // an enumeration or a whole number
extern const FieldNeed words;        // whatever can be written in a few words
extern const FieldNeed list;         // an array of structures
extern const FieldNeed position;     // x and y, or x, y and z, in m
extern const FieldNeed angle;        // in rad
extern const FieldNeed length;       // in m
}  // namespace field_need

bool is_whole_number(const FieldPlace& place);
// Null where the field is no enumeration.
const Type* enumeration_of(const Model& model, const FieldPlace& place);

// "left", "region.left", "pixel[0]": of a record.
std::optional<FieldPlace> find_field(const Model& model, const Type& record, std::string_view path);

// The field that `text` names, for `key` of a row. Nothing where it is not there or does not fit, which is
// said.
std::optional<FieldPlace> read_field(Assembly& assembly, const Row& row, std::string_view key,
                                     const Node& text, const Type& record, const FieldNeed& need);

// The text of a key; null where it is missing, or is no text, which is said.
const Node* text_of(Row& row, std::string_view key);

// The type that the slot carries, for `key` of a row; null where its fields cannot be drawn, which is said.
const Type* drawn_type(Assembly& assembly, const Slot& slot, const Position& position);

// Nothing where the slot is not observed, which is said.
bool check_observed(Assembly& assembly, const Slot& slot, const Position& position);

// A number, whole or not; nothing where it is none.
std::optional<double> number_in(const Node& node);
// Above 0 and at most `most`; nothing where it is missing or is none, which is said.
std::optional<double> positive_number(Assembly& assembly, Row& row, std::string_view key, double most,
                                      std::string_view hint);

}  // namespace flexrf::config_gen
