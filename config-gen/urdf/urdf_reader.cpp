#include "config-gen/urdf/urdf_reader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

#include "config-gen/model/source_text.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/urdf/urdf_document.hpp"
#include "config-gen/urdf/urdf_path.hpp"
#include "config-gen/urdf/urdf_transform.hpp"
#include "config-gen/urdf/urdf_words.hpp"

namespace flexrf::config_gen {
namespace {

// Of a joint of which nothing is said: gentle for any arm.
constexpr double seconds_to_velocity = 1;
constexpr double seconds_to_acceleration = 0.2;

std::string shown(double value) {
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 4).ptr;
  return {buffer.data(), end};
}

// As a key of TOML.
std::string key_of(const std::string& name) {
  const bool bare = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  });
  return "joint." + (bare ? name : '"' + name + '"');
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& file, const UrdfRow& row, Diagnostics& diagnostics)
      : document_(text, file, diagnostics), row_(row), diagnostics_(diagnostics) {}

  std::optional<UrdfChain> read() {
    if (!document_.read()) return std::nullopt;
    chain_.name = document_.name();
    chain_.meshes = document_.meshes();
    const auto path = find_path(document_, row_, diagnostics_);
    if (!path) return std::nullopt;
    for (const auto& [name, link] : document_.links()) chain_.links.push_back(name);
    chain_.base = row_.base ? row_.base->link : document_.roots().front();
    UrdfTransform pending = path->start;  // fixed joints since the last movable one
    for (const DocumentJoint* joint : path->joints) {
      check_words(*joint, document_);
      pending = compose(pending, joint->origin);
      if (!joint->moves()) continue;
      chain_.joints.push_back(read_joint(*joint));
      chain_.joints.back().origin = std::exchange(pending, {});
    }
    chain_.tool = pending;
    check_count();
    check_rows();
    if (document_.failed() || failed_) return std::nullopt;
    tell_defaults();
    return std::move(chain_);
  }

 private:
  UrdfJoint read_joint(const DocumentJoint& from) {
    UrdfJoint joint;
    joint.name = from.name;
    if (from.type == "prismatic") joint.kind = UrdfJoint::Kind::prismatic;
    if (from.type == "continuous") joint.kind = UrdfJoint::Kind::continuous;
    if (from.type == "floating" || from.type == "planar") {
      error(from, "is " + from.type + ", and no joint of an arm is",
            "where it carries the whole robot: " + in_row("base = \"" + from.child + "\""));
    }
    if (const pugi::xml_node mimic = from.node.child("mimic")) {
      document_.error(mimic,
                      "joint '" + from.name + "' follows '" + mimic.attribute("joint").value() +
                          "': <mimic> is not supported within an arm",
                      "let the arm end before it: " + in_row("tool = \"" + from.parent + "\""));
    }
    read_axis(from, joint);
    read_range(from, joint);
    read_velocity(from, joint);
    read_motion(from, joint);
    read_home(from, joint);
    return joint;
  }

  void read_axis(const DocumentJoint& from, UrdfJoint& joint) {
    const pugi::xml_node axis = from.node.child("axis");
    if (!axis) return;  // URDF's default, x
    if (!parse_numbers(axis.attribute("xyz").value(), joint.axis)) {
      document_.error(axis, "joint '" + from.name + "': the axis's xyz is not three numbers up to 1e6",
                      "a direction, as xyz=\"0 0 1\"");
      return;
    }
    const double length = std::hypot(joint.axis[0], joint.axis[1], joint.axis[2]);
    if (!(length > 1e-6)) {
      document_.error(axis, "joint '" + from.name + "': the axis has no length",
                      "a direction, as xyz=\"0 0 1\"");
      return;
    }
    for (double& entry : joint.axis) entry /= length;
  }

  void read_range(const DocumentJoint& from, UrdfJoint& joint) {
    const UrdfJointRow row = own(joint);
    if (joint.kind == UrdfJoint::Kind::continuous && row.lower && row.upper)
      joint.kind = UrdfJoint::Kind::revolute;  // which is what ends make of it
    if (joint.kind == UrdfJoint::Kind::continuous) {
      joint.lower = -urdf_greatest_number;
      joint.upper = urdf_greatest_number;
      if (!row.lower && !row.upper) return;
      failed_ = true;
      diagnostics_.error(row.position, "joint '" + from.name + "' turns without end, and gets one end only",
                         "give both 'lower' and 'upper', in rad, or none");
      return;
    }
    const std::string hint = "URDF: <limit lower=\"...\" upper=\"...\" velocity=\"...\">, in " +
                             std::string(unit(joint)) + " and " + per_second(joint) + "; or " +
                             in_row(key_of(from.name) + " = { lower = -1.0, upper = 1.0, velocity = 1.0 }");
    const pugi::xml_node limit = from.node.child("limit");
    if (!limit && !(row.lower && row.upper)) return error(from, "has no <limit>", hint);
    // URDF: each is 0 where it is not given.
    const auto lower = row.lower ? row.lower : number(from, limit, "lower", 0);
    const auto upper = row.upper ? row.upper : number(from, limit, "upper", 0);
    if (!lower || !upper) return;
    joint.lower = *lower;
    joint.upper = *upper;
    narrow(from, row, joint);
    if (joint.lower < joint.upper) return;
    document_.error(limit ? limit : from.node,
                    "joint '" + from.name + "': lower (" + shown(joint.lower) + ") is not below upper (" +
                        shown(joint.upper) + ")",
                    hint);
  }

  // The arm's controller holds it back at soft limits. An end that the row gives is not moved.
  void narrow(const DocumentJoint& from, const UrdfJointRow& row, UrdfJoint& joint) {
    const pugi::xml_node soft = from.node.child("safety_controller");
    const auto lower = number(from, soft, "soft_lower_limit", 0);
    const auto upper = number(from, soft, "soft_upper_limit", 0);
    if (!lower || !upper || !(*lower < *upper)) return;  // both are 0 where there are none
    if (!row.lower) joint.lower = std::max(joint.lower, *lower);
    if (!row.upper) joint.upper = std::min(joint.upper, *upper);
  }

  void read_velocity(const DocumentJoint& from, UrdfJoint& joint) {
    const auto velocity = positive(from, "limit", "velocity", own(joint).velocity);
    joint.velocity = velocity.value_or(0);
    const pugi::xml_node limit = from.node.child("limit");
    const bool has_range = joint.kind == UrdfJoint::Kind::continuous || joint.lower < joint.upper;
    if (velocity || limit.attribute("velocity") || !has_range) return;
    document_.error(limit ? limit : from.node, "joint '" + from.name + "' has no velocity",
                    "URDF: <limit velocity=\"...\">, in " + per_second(joint) + "; or " +
                        in_row(key_of(from.name) + " = { velocity = 1.0 }"));
  }

  void read_motion(const DocumentJoint& from, UrdfJoint& joint) {
    const UrdfJointRow row = own(joint);
    auto acceleration = positive(from, "flexrf", "acceleration", row.acceleration);
    auto jerk = positive(from, "flexrf", "jerk", row.jerk);
    // URDF 1.2. Motions are planned with one for speeding up and slowing down.
    if (!acceleration) {
      acceleration = positive(from, "limit", "acceleration", {});
      const auto deceleration = positive(from, "limit", "deceleration", {});
      if (deceleration) acceleration = std::min(acceleration.value_or(*deceleration), *deceleration);
    }
    if (!jerk) jerk = positive(from, "limit", "jerk", {});
    joint.acceleration = acceleration.value_or(joint.velocity / seconds_to_velocity);
    joint.jerk = jerk.value_or(joint.acceleration / seconds_to_acceleration);
    if (!acceleration || !jerk) defaulted_.push_back(chain_.joints.size());
  }

  void read_home(const DocumentJoint& from, UrdfJoint& joint) {
    const pugi::xml_node extra = from.node.child("flexrf");
    auto home = own(joint).home;
    if (!home && extra.attribute("home")) home = number(from, extra, "home", 0);
    const bool within = home && *home >= joint.lower && *home <= joint.upper;
    joint.home = within ? *home : std::max(joint.lower, std::min(joint.upper, 0.0));
    if (!home && joint.home != 0) joint.home = (joint.lower + joint.upper) / 2;
    if (!home || within || !(joint.lower < joint.upper)) return;
    document_.error(
        extra.attribute("home") ? extra : from.node,
        "joint '" + from.name + "': home (" + shown(*home) + ") is outside the limits",
        "it must be from " + shown(joint.lower) + " to " + shown(joint.upper) + " " + unit(joint));
  }

  // `otherwise` where it is not given; nothing, with an error, where it is no number.
  std::optional<double> number(const DocumentJoint& from, const pugi::xml_node& node, const char* attribute,
                               std::optional<double> otherwise) {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found) return otherwise;
    double value = 0;
    if (parse_number(found.value(), value)) return value;
    document_.error(node,
                    "joint '" + from.name + "': <" + node.name() + "> " + attribute + "=\"" + found.value() +
                        "\" is not a number up to 1e6",
                    std::string("write what the arm can, as ") + attribute +
                        "=\"1.57\"; or leave the file as it is, and " +
                        in_row(key_of(from.name) + row_of(attribute)));
    return std::nullopt;
  }

  // The keys that go before this attribute of the file.
  static std::string row_of(std::string_view attribute) {
    if (attribute == "lower" || attribute == "upper" || attribute.starts_with("soft_"))
      return " = { lower = -1.57, upper = 1.57 }";
    return " = { " + std::string(attribute == "deceleration" ? "acceleration" : attribute) + " = 1.0 }";
  }

  // Above 0, of the row or of the file's element; nothing where neither has it.
  std::optional<double> positive(const DocumentJoint& from, const char* element, const char* attribute,
                                 const std::optional<double>& row) {
    if (row) return row;
    const pugi::xml_node node = from.node.child(element);
    const auto value = number(from, node, attribute, std::nullopt);
    if (!value || *value > 0) return value;
    document_.error(node, "joint '" + from.name + "': " + attribute + " must be above 0",
                    "write what the arm can here, or in the application: " +
                        in_row(key_of(from.name) + row_of(attribute)));
    return std::nullopt;
  }

  void check_count() {
    const std::size_t count = chain_.joints.size();
    if (count > 0 && count <= urdf_max_joints) return;
    if (count == 0) {
      document_.error(document_.robot(), "the chain from base to tool has no joint that moves",
                      "say where the arm ends: " + in_row("tool = \"LINK\""));
      return;
    }
    document_.error(document_.robot(),
                    "the chain from base to tool has " + std::to_string(count) +
                        " joints that move, at most " + std::to_string(urdf_max_joints) + " are supported",
                    "name a shorter part of it: " + in_row("base = \"LINK\" or tool = \"LINK\""));
  }

  // Rows for joints that the chain does not have.
  void check_rows() {
    std::vector<std::string> known;
    for (const UrdfJoint& joint : chain_.joints) known.push_back(joint.name);
    for (const auto& [name, row] : row_.joints) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      failed_ = true;
      diagnostics_.error(row.position, "the arm has no joint " + quote(name),
                         suggest(name, known, "joints", "remove it"));
    }
  }

  void tell_defaults() {
    if (defaulted_.empty()) return;
    std::vector<std::string> names;
    for (const std::size_t index : defaulted_) names.push_back(chain_.joints[index].name);
    const UrdfJoint& first = chain_.joints[defaulted_.front()];
    diagnostics_.warning(
        row_.position,
        "nothing says how quickly joint" + std::string(names.size() > 1 ? "s " : " ") + listed(names) +
            " may change speed: taken is what comes to full velocity in 1 s, and to full acceleration in 0.2 "
            "s",
        "write what the arm can, of each joint, in " + row_.name + ": " + key_of(first.name) +
            " = { acceleration = " + shown(first.acceleration) + ", jerk = " + shown(first.jerk) + " }");
  }

  UrdfJointRow own(const UrdfJoint& joint) const {
    const auto found = row_.joints.find(joint.name);
    return found == row_.joints.end() ? UrdfJointRow{} : found->second;
  }

  void error(const DocumentJoint& joint, const std::string& what, std::string hint) {
    document_.error(joint.node, "joint '" + joint.name + "' " + what, std::move(hint));
  }

  static const char* unit(const UrdfJoint& joint) {
    return joint.kind == UrdfJoint::Kind::prismatic ? "m" : "rad";
  }
  static std::string per_second(const UrdfJoint& joint) { return std::string(unit(joint)) + "/s"; }
  std::string in_row(const std::string& text) const { return "write " + text + " in " + row_.name; }

  UrdfDocument document_;
  const UrdfRow& row_;
  Diagnostics& diagnostics_;
  UrdfChain chain_;
  std::vector<std::size_t> defaulted_;  // joints without acceleration or jerk
  bool failed_ = false;                 // by what the row says
};

}  // namespace

std::optional<UrdfChain> parse_urdf(std::string_view text, const std::string& file_name, const UrdfRow& row,
                                    Diagnostics& diagnostics) {
  return Reader(text, file_name, row, diagnostics).read();
}

std::optional<UrdfChain> read_urdf(const std::filesystem::path& file, const UrdfRow& row,
                                   Diagnostics& diagnostics) {
  const auto text = read_source(file, diagnostics);
  return text ? parse_urdf(*text, file.generic_string(), row, diagnostics) : std::nullopt;
}

}  // namespace flexrf::config_gen
