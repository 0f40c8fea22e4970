// The options of a row [widget.N] whose kind knows all of them: what they name of types is looked for there.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "config-gen/read/assembly.hpp"
#include "config-gen/read/row.hpp"

namespace flexrf::config_gen {

// What a field has to be, and how it is said that it is not.
struct FieldKind {
  bool (*fits)(const Model& model, const Field& field);
  std::string_view lacks;  // "is no bool"
};
namespace field_kind {
extern const FieldKind truth;               // a bool
extern const FieldKind number;              // a single number
extern const FieldKind whole_number;        // a single integer
extern const FieldKind state;               // a bool or an enumeration
extern const FieldKind value;               // any single value, no structure
extern const FieldKind structure;           // a single one
extern const FieldKind list_of_structures;  // of one dimension
extern const FieldKind numbers;             // a list of numbers, or a structure of single ones
}  // namespace field_kind

bool is_single_number(const Field& field);

class WidgetOptions {
 public:
  // Reports every option that is not `known`.
  WidgetOptions(Assembly& assembly, const Row& row, const std::vector<std::string>& known);

  bool has(std::string_view name) const { return find(name) != nullptr; }
  Position position(std::string_view name) const;
  // Reports what is missing, unless a slip for it was told.
  void need(std::string_view name, std::string_view hint);
  // Each gives nothing where the option is missing, or is something else, which is reported.
  std::optional<std::string> text(std::string_view name);
  // "a, b": none of them is empty.
  std::vector<std::string> words(std::string_view name);
  void check_whole_number(std::string_view name, std::int64_t least, std::int64_t most);
  // The field of `type` that the option names, or one of its words; null: reported.
  const Field* field(const Type& type, std::string_view option, const FieldKind& kind);
  const Field* field(const Type& type, std::string_view option, std::string_view name, const FieldKind& kind);
  void error(std::string_view option, std::string text, Hint hint);

 private:
  const Node* find(std::string_view name) const;

  Assembly& assembly_;
  const Row& row_;
  const Node* table_ = nullptr;
  std::set<std::string, std::less<>> meant_;  // options that were told as slips
};

// Of a slot that carries a type of the tables; null: it carries parameters, or is broken.
const Type* declared_type(const Model& model, const Slot& slot);

}  // namespace flexrf::config_gen
