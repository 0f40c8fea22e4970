// What the rows of a widget say of the things that it draws: in which slots, which of them, and how each is
// called.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config-gen/read/panel_fields.hpp"

namespace flexrf::config_gen {

// One row [widget.NAME.overlay.NAME] or [widget.NAME.bodies.NAME] while it is read.
class ThingRow {
 public:
  // Reads what all of them have. `row` outlives it.
  ThingRow(Assembly& assembly, Row& row, PanelThings& things);

  // Where it is false, what the slot carries is not known, which was said: its fields are not judged.
  bool is_known() const { return thing_ != nullptr; }
  // The field of a thing that the key names, if any.
  std::optional<FieldPlace> field(std::string_view key, const FieldNeed& need, std::string& path);
  // The same of a text that stands elsewhere in the row.
  std::optional<FieldPlace> field(std::string_view key, const FieldNeed& need, const Node& text,
                                  std::string& path);
  // A field of a thing, or where it has none of this name, of what the slot carries.
  void field_of_either(std::string_view key, const FieldNeed& need, std::string& path, bool& of_slot);

 private:
  void read_slots(PanelThings& things);
  void read_list(PanelThings& things);
  void read_empty(PanelThings& things);
  void read_text(PanelThings& things);
  void read_certainty(PanelThings& things);
  std::optional<PanelThings::Value> value_of(const FieldPlace& place, const Node& node);

  Assembly& assembly_;
  Row& row_;
  const Type* carried_ = nullptr;  // by the slot
  const Type* thing_ = nullptr;
};

// The rows of a table [widget.NAME.key.NAME], each with its name for messages; `what` is as "an overlay".
struct NamedRow {
  const Node* node;
  std::string name;
};
std::vector<NamedRow> rows_of(Assembly& assembly, Row& row, std::string_view key, std::string_view what);

}  // namespace flexrf::config_gen
