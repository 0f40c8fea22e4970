// What a widget draws of what slots carry: over a picture, and around a robot.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flexrf::config_gen {

// Things that a slot tells of. Fields are paths, as "region.left" or "pixel[0]": of a thing, but `count`.
struct PanelThings {
  using Value = std::variant<bool, std::int64_t, std::string>;
  std::string name;
  std::string label;  // empty: made from the name
  bool shown = true;
  std::vector<std::string> slots;  // several: of the members of a population
  std::string list;                // of the slot's type; empty: the slot's item is the only thing
  std::string count;               // of the slot's type: so many of the list are in use; empty: all
  std::optional<std::pair<std::string, Value>> empty;  // a thing whose field has this value is none
  std::vector<std::string> text;                       // written beside it
  std::string certain;                                 // a bool; empty: all are
  std::string doubtful;                                // a bool that says the contrary
};

// [widget.NAME.overlay.NAME]: rectangles over a picture.
struct PanelOverlay {
  PanelThings things;
  std::array<std::string, 4> rectangle;  // left, top, width, height
  std::string sort;                  // the key `class`: by what things are told apart; empty: they are alike
  std::vector<std::string> classes;  // names of the numbers of `sort`, from 0 on
  std::string weight;
  std::string time;           // of the picture; empty: when the slot's item was sampled
  bool time_of_slot = false;  // else of each thing
};

// An upright prism.
struct PanelBodyKind {
  std::string name;
  std::optional<std::int64_t> value;           // none: the name is an enumeration's value
  std::vector<std::array<double, 2>> outline;  // m, counter-clockwise; empty: it is round
  std::variant<double, std::string> radius;    // m, or the field that tells it; of one that is round
  double height = 0;                           // m
  std::string colour;                          // "#2850c8"
};

// [widget.NAME.bodies.NAME]: bodies around a robot.
struct PanelBodies {
  PanelThings things;
  std::string position;
  std::string angle;  // empty: none is turned
  std::string kind;
  std::vector<PanelBodyKind> kinds;
};

// [widget.NAME.frame.NAME]: a frame of reference beside a robot.
struct PanelFrame {
  struct Mount {
    std::array<double, 3> position{};               // m
    std::array<double, 4> orientation{0, 0, 0, 1};  // a quaternion x, y, z, w
  };
  struct Frustum {
    double width = 0;  // px, as the next two
    double height = 0;
    double focal_length = 0;
    double depth = 0;  // m
  };
  std::string name;
  std::string label;
  bool shown = true;
  std::string slot;  // a pose; or
  std::string link;  // of the robot
  std::optional<Mount> mount;
  std::optional<Frustum> frustum;
};

}  // namespace flexrf::config_gen
