#include "config-gen/read/panel_layers.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "config-gen/model/words.hpp"
#include "config-gen/read/panel_files.hpp"
#include "config-gen/read/panel_things.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::size_t most_corners = 64;
constexpr double most_metres = 100;
constexpr double most_pixels = 100'000;

// ---- Overlays

void read_rectangle(Assembly& assembly, Row& row, ThingRow& things, PanelOverlay& overlay) {
  constexpr const char* written = "rectangle = [\"left\", \"top\", \"width\", \"height\"]";
  if (!row.has("rectangle"))
    row.missing("rectangle", std::string("add ") + written + ": four fields, in pixels of the picture");
  const Node* const list = row.list_of_texts("rectangle");
  if (list == nullptr || !things.is_known()) return;
  if (list->children.size() != overlay.rectangle.size()) {
    assembly.diagnostics.error(list->position,
                               "'rectangle' of " + row.name() + " names " +
                                   std::to_string(list->children.size()) +
                                   " fields, and a rectangle has four",
                               std::string("write ") + written);
    return;
  }
  for (std::size_t i = 0; i < overlay.rectangle.size(); ++i)
    things.field("rectangle", field_need::pixels, list->children[i], overlay.rectangle[i]);
}

void read_sort(Assembly& assembly, Row& row, ThingRow& things, PanelOverlay& overlay) {
  const auto place = things.field("class", field_need::sort, overlay.sort);
  const Node* const classes = row.list_of_texts("classes");
  const bool is_number = place && is_whole_number(*place);
  if (is_number && !row.has("classes")) {
    row.missing("classes", "add classes = [\"FIRST\", \"SECOND\"]: what the numbers of " +
                               quote(overlay.sort) + " mean, from 0 on");
  } else if (classes != nullptr && is_number) {
    for (const Node& name : classes->children) overlay.classes.push_back(name.text);
  } else if (classes != nullptr && (place || !row.has("class"))) {
    assembly.diagnostics.error(
        row.position("classes"),
        place ? "'classes' of " + row.name() + " names what " + quote(overlay.sort) + " has names for"
              : "'classes' of " + row.name() + " names the numbers of no field",
        place ? "remove it: names are for the numbers of a whole number"
              : "add class = \"FIELD\": a whole number, of which these are the names from 0 on");
  }
}

void read_overlay(Assembly& assembly, const NamedRow& named, PanelWidget& widget) {
  Row row(*named.node, named.name, assembly.diagnostics);
  PanelOverlay overlay;
  ThingRow things(assembly, row, overlay.things);
  for (const std::string_view key : {"rectangle", "class", "classes", "weight", "time"}) row.also(key);
  read_rectangle(assembly, row, things, overlay);
  if (things.is_known()) {
    read_sort(assembly, row, things, overlay);
    things.field("weight", field_need::number, overlay.weight);
    things.field_of_either("time", field_need::nanoseconds, overlay.time, overlay.time_of_slot);
  }
  row.finish();
  widget.overlays.push_back(std::move(overlay));
}

// ---- Bodies

// Twice the area, above 0 where the corners go around counter-clockwise.
double turning(const std::vector<std::array<double, 2>>& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& here = outline[i];
    const auto& next = outline[(i + 1) % outline.size()];
    sum += here[0] * next[1] - next[0] * here[1];
  }
  return sum;
}

void read_outline(Assembly& assembly, const Row& row, const Node& node, PanelBodyKind& kind) {
  const auto is_corner = [](const Node& corner) {
    return corner.kind == Node::Kind::array && corner.children.size() == 2 &&
           std::all_of(corner.children.begin(), corner.children.end(), [](const Node& one) {
             const auto number = number_in(one);
             return number && std::abs(*number) <= most_metres;
           });
  };
  const auto& corners = node.children;
  if (node.kind != Node::Kind::array || corners.size() < 3 || corners.size() > most_corners ||
      !std::all_of(corners.begin(), corners.end(), is_corner)) {
    assembly.diagnostics.error(node.position,
                               "'outline' of " + row.name() + " must be a list of 3 to " +
                                   std::to_string(most_corners) + " corners, each of two numbers in m",
                               "write it as [[-0.02, -0.01], [0.02, -0.01], [0.02, 0.01], [-0.02, 0.01]]");
    return;
  }
  for (const Node& corner : corners)
    kind.outline.push_back({*number_in(corner.children[0]), *number_in(corner.children[1])});
  if (turning(kind.outline) > 0) return;
  assembly.diagnostics.error(
      node.position, "the corners of 'outline' of " + row.name() + " do not go around counter-clockwise",
      "write them in the other order, x to the right and y ahead");
}

void read_radius(Assembly& assembly, Row& row, ThingRow& things, PanelBodyKind& kind) {
  const Node& node = *row.node().find("radius");
  if (node.kind == Node::Kind::text) {
    std::string path;
    things.field("radius", field_need::length, node, path);
    kind.radius = std::move(path);
  } else if (const auto radius = positive_number(assembly, row, "radius", most_metres, "radius = 0.02")) {
    kind.radius = *radius;
  }
}

void read_shape(Assembly& assembly, Row& row, ThingRow& things, PanelBodyKind& kind) {
  const Node* const outline = row.any("outline");
  row.also("radius");
  if (outline != nullptr && row.has("radius")) {
    assembly.diagnostics.error(row.position("radius"), row.name() + " has both an outline and a radius",
                               "keep one: a body is a prism, or round");
  } else if (outline != nullptr) {
    read_outline(assembly, row, *outline, kind);
  } else if (row.has("radius")) {
    read_radius(assembly, row, things, kind);
  } else {
    row.missing("outline", "add outline = [[x, y], ...], in m, or radius = 0.02, or the field that tells it");
  }
}

void read_colour(Assembly& assembly, Row& row, PanelBodyKind& kind) {
  const auto colour = row.required_text("colour", "add colour = \"#2850c8\"");
  if (!colour) return;
  const auto is_digit = [](unsigned char c) { return c < 128 && std::isxdigit(c) != 0; };
  if (colour->size() == 7 && colour->front() == '#' &&
      std::all_of(colour->begin() + 1, colour->end(), is_digit)) {
    kind.colour = *colour;
    return;
  }
  assembly.diagnostics.error(row.position("colour"), quote(*colour) + " is no colour",
                             "write red, green and blue in hexadecimal digits, as \"#2850c8\"");
}

// By which value of the field `kind` a body is of it.
void read_value(Assembly& assembly, Row& row, const FieldPlace& of, const PanelBodies& bodies,
                PanelBodyKind& kind) {
  const Type* const type = enumeration_of(assembly.model, of);
  if (type == nullptr) {
    if (!row.has("value"))
      row.missing("value", "add value = 0: the number that " + quote(bodies.kind) + " has of such a body");
    kind.value = row.integer("value", std::numeric_limits<std::int32_t>::min(),
                             std::numeric_limits<std::uint32_t>::max());
    const bool is_taken =
        kind.value && std::any_of(bodies.kinds.begin(), bodies.kinds.end(),
                                  [&](const PanelBodyKind& other) { return other.value == kind.value; });
    if (is_taken)
      assembly.diagnostics.error(row.position("value"),
                                 "two kinds of bodies have the value " + std::to_string(*kind.value),
                                 "give each kind a value of its own");
    return;
  }
  std::vector<std::string> known;
  for (const EnumerationValue& value : type->values) known.push_back(value.name);
  if (std::find(known.begin(), known.end(), kind.name) == known.end())
    assembly.diagnostics.error(row.position(), type->name + " has no value " + quote(kind.name),
                               suggest(kind.name, known, "values", ""));
}

void read_kinds(Assembly& assembly, Row& row, ThingRow& things, const std::optional<FieldPlace>& of,
                PanelBodies& bodies) {
  if (!row.has("kinds"))
    row.missing("kinds", "add kinds.NAME = { outline = [[x, y], ...], height = 0.02, colour = \"#2850c8\" }");
  for (const NamedRow& named : rows_of(assembly, row, "kinds", "a kind of body")) {
    Row one(*named.node, named.name, assembly.diagnostics);
    PanelBodyKind kind;
    kind.name = named.node->key;
    if (of)
      read_value(assembly, one, *of, bodies, kind);
    else
      one.also("value");
    read_shape(assembly, one, things, kind);
    kind.height = positive_number(assembly, one, "height", most_metres, "height = 0.02, in m").value_or(0);
    read_colour(assembly, one, kind);
    one.finish();
    bodies.kinds.push_back(std::move(kind));
  }
}

void read_bodies(Assembly& assembly, const NamedRow& named, PanelWidget& widget) {
  Row row(*named.node, named.name, assembly.diagnostics);
  PanelBodies bodies;
  ThingRow things(assembly, row, bodies.things);
  for (const std::string_view key : {"position", "angle", "kind", "kinds"}) row.also(key);
  if (!row.has("position"))
    row.missing("position", "add position = \"FIELD\": x and y in the robot's frame, in m");
  if (!row.has("kind"))
    row.missing("kind",
                "add kind = \"FIELD\": an enumeration or a whole number, by which bodies look different");
  if (things.is_known()) {
    things.field("position", field_need::position, bodies.position);
    things.field("angle", field_need::angle, bodies.angle);
    const auto of = things.field("kind", field_need::kind, bodies.kind);
    read_kinds(assembly, row, things, of, bodies);
  }
  row.finish();
  widget.bodies.push_back(std::move(bodies));
}

// ---- Frames

template <std::size_t size>
bool read_numbers(Assembly& assembly, Row& row, std::string_view key, std::string_view hint,
                  std::array<double, size>& numbers) {
  const Node* const node = row.any(key);
  if (node == nullptr) return false;
  bool good = node->kind == Node::Kind::array && node->children.size() == size;
  for (std::size_t i = 0; good && i < size; ++i) {
    const auto number = number_in(node->children[i]);
    good = number && std::abs(*number) <= most_metres;
    if (good) numbers[i] = *number;
  }
  if (!good)
    assembly.diagnostics.error(
        node->position, quote(key) + " of " + row.name() + " must be " + std::to_string(size) + " numbers",
        "write " + std::string(hint));
  return good;
}

PanelFrame::Mount read_mount(Assembly& assembly, const Node& node, const std::string& name) {
  Row row(node, name, assembly.diagnostics);
  PanelFrame::Mount mount;
  read_numbers(assembly, row, "position", "position = [0.05, 0.0, 0.05], in m", mount.position);
  constexpr const char* hint = "orientation = [0.0, 0.0, 0.0, 1.0]: a quaternion x, y, z, w of length 1";
  if (read_numbers(assembly, row, "orientation", hint, mount.orientation)) {
    double squares = 0;
    for (const double number : mount.orientation) squares += number * number;
    if (std::abs(squares - 1) > 1e-3)
      assembly.diagnostics.error(row.position("orientation"),
                                 "'orientation' of " + name + " is not of length 1",
                                 std::string("write ") + hint);
  }
  row.finish();
  return mount;
}

PanelFrame::Frustum read_frustum(Assembly& assembly, const Node& node, const std::string& name) {
  Row row(node, name, assembly.diagnostics);
  PanelFrame::Frustum frustum;
  const auto number = [&](const char* key, double most, const char* hint) {
    return positive_number(assembly, row, key, most, hint).value_or(0);
  };
  frustum.width = number("width", most_pixels, "width = 640, in pixels");
  frustum.height = number("height", most_pixels, "height = 480, in pixels");
  frustum.focal_length = number("focal_length", most_pixels, "focal_length = 600.0, in pixels");
  frustum.depth = number("depth", most_metres, "depth = 0.3, in m");
  row.finish();
  return frustum;
}

void read_pose_slot(Assembly& assembly, const Node& text, PanelFrame& frame) {
  const auto& slots = assembly.model.slots;
  const auto found =
      std::find_if(slots.begin(), slots.end(), [&](const Slot& slot) { return slot.name == text.text; });
  if (found == slots.end()) {
    std::vector<std::string> known;
    for (const Slot& slot : slots) known.push_back(slot.name);
    if (!assembly.broken_places.contains(array_base(text.text)))
      assembly.diagnostics.error(text.position, "unknown slot " + quote(text.text),
                                 suggest(text.text, known, "slots", "there is none"));
    return;
  }
  if (!check_observed(assembly, *found, text.position)) return;
  const Type* const type = drawn_type(assembly, *found, text.position);
  if (type == nullptr) return;
  const auto has = [&](const char* name, std::size_t size) {
    const auto place = find_field(assembly.model, *type, name);
    return place && place->field->shape == std::vector<std::size_t>{size} &&
           field_need::number.fits(assembly.model, {place->field, true});
  };
  frame.slot = text.text;
  if (has("position", 3) && has("orientation", 4)) return;
  assembly.diagnostics.error(
      text.position, "the slot " + quote(text.text) + " carries " + type->name + ", which is no pose",
      "name a slot of a type with 'position', 3 numbers in m, and 'orientation', 4 numbers");
}

void read_link(Assembly& assembly, const Node& text, const PanelWidget& widget, PanelFrame& frame) {
  frame.link = text.text;
  const DeviceResource* const robot = widget.device ? robot_of(assembly.model, *widget.device) : nullptr;
  if (robot == nullptr || !robot->chain) return;
  const auto& links = robot->chain->links;
  if (std::find(links.begin(), links.end(), text.text) == links.end())
    assembly.diagnostics.error(text.position, "the robot has no link " + quote(text.text),
                               suggest(text.text, links, "links", ""));
}

void read_frame(Assembly& assembly, const NamedRow& named, PanelWidget& widget) {
  Row row(*named.node, named.name, assembly.diagnostics);
  PanelFrame frame;
  frame.name = named.node->key;
  frame.label = row.text("label").value_or("");
  frame.shown = row.boolean("shown").value_or(true);
  const Node* const slot = text_of(row, "slot");
  const Node* const link = text_of(row, "link");
  if (row.has("slot") && row.has("link"))
    assembly.diagnostics.error(row.position("link"), row.name() + " has both a slot and a link",
                               "keep one: where the frame is");
  else if (!row.has("slot") && !row.has("link"))
    row.missing("slot", "add slot = \"NAME\", which carries a pose, or link = \"NAME\", of the robot");
  if (slot != nullptr) read_pose_slot(assembly, *slot, frame);
  if (link != nullptr) read_link(assembly, *link, widget, frame);
  const std::string before = row.name().substr(0, row.name().size() - 1);
  if (const Node* const mount = row.table("mount"); mount != nullptr)
    frame.mount = read_mount(assembly, *mount, before + ".mount]");
  if (const Node* const frustum = row.table("frustum"); frustum != nullptr)
    frame.frustum = read_frustum(assembly, *frustum, before + ".frustum]");
  row.finish();
  widget.frames.push_back(std::move(frame));
}

}  // namespace

void read_layers(Assembly& assembly, Row& row, PanelWidget& widget) {
  const auto is_for = [&](const char* key, const char* kind) {
    row.also(key);
    if (!row.has(key)) return false;
    // An application's own widget may make of them what it wants.
    if (widget.kind == kind || widget.custom) return true;
    if (!widget.kind.empty())
      assembly.diagnostics.error(
          row.position(key),
          quote(key) + " of " + row.name() + " is of widgets of kind " + quote(kind) + " alone",
          "write kind = \"" + std::string(kind) + "\", or remove it");
    return false;
  };
  if (is_for("overlay", "image"))
    for (const NamedRow& named : rows_of(assembly, row, "overlay", "an overlay"))
      read_overlay(assembly, named, widget);
  if (is_for("bodies", "robot"))
    for (const NamedRow& named : rows_of(assembly, row, "bodies", "a row of bodies"))
      read_bodies(assembly, named, widget);
  if (is_for("frame", "robot"))
    for (const NamedRow& named : rows_of(assembly, row, "frame", "a frame"))
      read_frame(assembly, named, widget);
  if (widget.bodies.empty() && widget.frames.empty()) return;
  const DeviceResource* const robot = widget.device ? robot_of(assembly.model, *widget.device) : nullptr;
  if (robot != nullptr && robot->chain) widget.base = robot->chain->base;
}

}  // namespace flexrf::config_gen
