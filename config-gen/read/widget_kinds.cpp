#include "config-gen/read/widget_kinds.hpp"

#include <algorithm>
#include <initializer_list>
#include <iterator>

#include "config-gen/read/literal.hpp"

namespace flexrf::config_gen {
namespace {

// What a widget is to show: a parameter, an element of one, or what a slot carries.
struct Item {
  enum class Kind { number, boolean, enumeration, text, structure, button, hold };
  Kind kind = Kind::number;
  std::size_t dimensions = 0;
  std::size_t length = 0;  // of the first dimension
  const Type* structure = nullptr;
  bool is_slot = false;
  bool can_be_set = false;
  bool has_range = false;

  bool is_single(Kind wanted) const { return dimensions == 0 && kind == wanted; }
  bool are_numbers(std::size_t wanted) const { return dimensions == wanted && kind == Kind::number; }
};

bool has_fields(const Item& item, std::initializer_list<std::string_view> names) {
  if (item.structure == nullptr || item.dimensions > 0) return false;
  const std::vector<Field>& fields = item.structure->fields;
  return std::all_of(names.begin(), names.end(), [&fields](std::string_view name) {
    return std::any_of(fields.begin(), fields.end(),
                       [name](const Field& field) { return field.name == name; });
  });
}

struct Widget {
  std::string_view kind;
  std::string_view needs;
  bool (*fits)(const Item& item);
};

using Kind = Item::Kind;

bool fits_nothing(const Item&) {
  return false;
}

// In the order in which messages list them.
constexpr Widget widgets[] = {
    {"number", "a number", [](const Item& item) { return item.are_numbers(0); }},
    {"vector", "a vector",
     [](const Item& item) { return item.dimensions == 1 && item.kind != Kind::structure; }},
    {"matrix", "a matrix",
     [](const Item& item) { return item.dimensions == 2 && item.kind != Kind::structure; }},
    {"lamp", "a bool", [](const Item& item) { return item.is_single(Kind::boolean); }},
    {"enumeration", "an enumeration", [](const Item& item) { return item.is_single(Kind::enumeration); }},
    {"text", "a single value",
     [](const Item& item) {
       return item.dimensions == 0 && item.kind != Kind::structure && item.kind != Kind::button &&
              item.kind != Kind::hold;
     }},
    {"image", "a slot of an image type",
     [](const Item& item) { return item.is_slot && item.structure != nullptr && item.structure->image; }},
    {"gauge", "a number with a range",
     [](const Item& item) { return item.are_numbers(0) && item.has_range; }},
    {"pose_2d", "a structure with position and orientation, or three numbers x, y, heading",
     [](const Item& item) {
       return has_fields(item, {"position", "orientation"}) || (item.are_numbers(1) && item.length == 3);
     }},
    {"robot", "a row [widget.NAME] of its own", fits_nothing},
    {"histogram", "a vector of numbers", [](const Item& item) { return item.are_numbers(1); }},
    {"structure", "a structure or an array",
     [](const Item& item) { return item.kind == Kind::structure || item.dimensions > 0; }},
    {"records", "an array of structures",
     [](const Item& item) { return item.kind == Kind::structure && item.dimensions == 1; }},
    {"button", "a button", [](const Item& item) { return item.kind == Kind::button; }},
    {"hold", "a hold", [](const Item& item) { return item.kind == Kind::hold; }},
    {"toggle", "a bool that can be changed",
     [](const Item& item) { return item.can_be_set && item.is_single(Kind::boolean); }},
    {"slider", "a number with a range that can be changed",
     [](const Item& item) { return item.can_be_set && item.are_numbers(0) && item.has_range; }},
    {"number_field", "a number that can be changed",
     [](const Item& item) { return item.can_be_set && item.are_numbers(0); }},
    {"select", "an enumeration that can be changed",
     [](const Item& item) { return item.can_be_set && item.is_single(Kind::enumeration); }},
    {"text_field", "a text that can be changed",
     [](const Item& item) { return item.can_be_set && item.is_single(Kind::text); }},
    {"array_field", "a vector or matrix of numbers that can be changed",
     [](const Item& item) { return item.can_be_set && (item.are_numbers(1) || item.are_numbers(2)); }},
    {"jog_pad", "a row [widget.NAME] of its own", fits_nothing},
    {"population", "a row [widget.NAME] of its own", fits_nothing},
    {"timeline", "a row [widget.NAME] of its own", fits_nothing}};

const Widget* find_widget(std::string_view kind) {
  const auto* const found = std::find_if(std::begin(widgets), std::end(widgets),
                                         [kind](const Widget& widget) { return widget.kind == kind; });
  return found == std::end(widgets) ? nullptr : found;
}

Item item_of(const Model& model, const Parameter& parameter, bool has_range) {
  const Field& field = parameter.field;
  Item item;
  item.dimensions = field.shape.size();
  item.length = field.shape.empty() ? 0 : field.shape[0];
  item.can_be_set = parameter.kind != Parameter::Kind::feedback;
  // One with a single number inside leaves nothing to choose.
  item.has_range =
      has_range || (parameter.low && parameter.high && is_below(*parameter.low, *parameter.high));
  if (parameter.input == Parameter::Input::button) {
    item.kind = Kind::button;
  } else if (parameter.input == Parameter::Input::hold) {
    item.kind = Kind::hold;
  } else if (field.type.kind == FieldType::Kind::declared) {
    const Type& type = model.types[field.type.declared];
    item.kind = type.kind == Type::Kind::enumeration ? Kind::enumeration : Kind::structure;
    item.structure = &type;
  } else if (field.type.scalar == Scalar::boolean) {
    item.kind = Kind::boolean;
  } else if (field.type.scalar == Scalar::text) {
    item.kind = Kind::text;
  }
  return item;
}

}  // namespace

const std::vector<std::string>& built_in_widgets() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const Widget& widget : widgets) names.emplace_back(widget.kind);
    return names;
  }();
  return kinds;
}

bool is_built_in_widget(std::string_view kind) {
  return find_widget(kind) != nullptr;
}

WidgetRoles roles_of_widget(std::string_view kind) {
  if (kind == "robot") return {{"joints"}, {}, false, false};
  if (kind == "population") return {{"members"}, {}, true, false};
  if (kind == "jog_pad") return {{}, {}, true, false};
  if (kind == "timeline") return {{}, {}, false, false};
  return {{"value"}, {"value"}, false, true};
}

std::string widget_misfit(const Model& model, std::string_view kind, const Parameter& parameter,
                          bool has_range) {
  const Widget* const widget = find_widget(kind);
  Item item = item_of(model, parameter, has_range);
  if (widget == nullptr || widget->fits(item)) return "";
  if (item.dimensions == 1) {
    // One for each element.
    item.dimensions = 0;
    item.length = 0;
    if (widget->fits(item)) return "";
  }
  return std::string(widget->needs);
}

std::string widget_misfit(const Type* type, std::string_view kind) {
  const Widget* const widget = find_widget(kind);
  Item item;
  item.kind = Kind::structure;
  item.structure = type;
  item.is_slot = true;
  return widget == nullptr || widget->fits(item) ? "" : std::string(widget->needs);
}

}  // namespace flexrf::config_gen
