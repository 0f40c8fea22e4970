// The panel's own widgets: what each can show or change, and how a row [widget.N] names it. The panel judges
// the same of items that come later (web-ui/panel/src/widgets/choose.ts).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

const std::vector<std::string>& built_in_widgets();
bool is_built_in_widget(std::string_view kind);

// By which roles a row of this kind names slots and parameters.
struct WidgetRoles {
  std::vector<std::string> slots;
  std::vector<std::string> parameters;
  bool any_parameters = false;  // of whatever roles
  bool is_single = false;       // `value` is one item, a slot or a parameter
};
WidgetRoles roles_of_widget(std::string_view kind);

// What a built-in widget needs that this parameter is not, as "a number with a range that can be changed";
// empty where it fits. `has_range`: the row that changes how the parameter is shown gives it one.
std::string widget_misfit(const Model& model, std::string_view kind, const Parameter& parameter,
                          bool has_range);

// The same of a slot that carries a record; of a slot with parameters `type` is null.
std::string widget_misfit(const Type* type, std::string_view kind);

}  // namespace flexrf::config_gen
