#include "config-gen/read/robot_row.hpp"

#include <cmath>

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

std::optional<double> read_number(Row& row, const char* key, bool above_zero, Diagnostics& diagnostics) {
  const Node* value = row.any(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != Node::Kind::integer && value->kind != Node::Kind::real) {
    row.wrong_kind(*value, key, "a number", "write it without quotes, in rad or m and their derivatives");
    return std::nullopt;
  }
  const double number =
      value->kind == Node::Kind::integer ? static_cast<double>(value->integer) : value->real;
  if (std::abs(number) <= urdf_greatest_number && (!above_zero || number > 0)) return number;
  diagnostics.error(
      value->position, quote(key) + " of " + row.name() + " is " + (number > 0 ? "too great" : "too small"),
      std::string("it must be ") + (above_zero ? "above 0, and at most 1e6" : "from -1e6 to 1e6"));
  return std::nullopt;
}

UrdfJointRow read_joint(const Node& node, const std::string& name, Diagnostics& diagnostics) {
  UrdfJointRow joint;
  joint.position = node.key_position;
  Row row(node, name, diagnostics);
  joint.lower = read_number(row, "lower", false, diagnostics);
  joint.upper = read_number(row, "upper", false, diagnostics);
  joint.velocity = read_number(row, "velocity", true, diagnostics);
  joint.acceleration = read_number(row, "acceleration", true, diagnostics);
  joint.jerk = read_number(row, "jerk", true, diagnostics);
  joint.home = read_number(row, "home", false, diagnostics);
  row.finish();
  return joint;
}

std::optional<UrdfFrame> read_frame(Row& row, const char* key) {
  const auto link = row.text(key);
  if (!link) return std::nullopt;
  return UrdfFrame{*link, row.position(key)};
}

void read_table(const Node& table, RobotRow& robot, Diagnostics& diagnostics) {
  Row row(table, robot.urdf.name, diagnostics);
  robot.file = row.required_text("file", "add file = \"arm.urdf\", relative to the application's folder");
  robot.urdf.position = row.position("file");
  robot.urdf.base = read_frame(row, "base");
  robot.urdf.tool = read_frame(row, "tool");
  if (const Node* packages = row.list_of_texts("packages"))
    for (const Node& folder : packages->children) robot.packages.push_back(folder.text);
  if (const Node* joints = row.table("joint")) {
    for (const Node& joint : joints->children) {
      const std::string name = "joint " + quote(joint.key) + " in " + robot.urdf.name;
      if (joint.kind == Node::Kind::table)
        robot.urdf.joints.emplace(joint.key, read_joint(joint, name, diagnostics));
      else
        row.wrong_kind(joint, "joint." + joint.key, "a table",
                       "write joint." + joint.key + " = { acceleration = 5.0, jerk = 50.0 }");
    }
  }
  row.finish();
}

}  // namespace

RobotRow read_robot_row(Row& row, const std::string& key, const std::string& device,
                        Diagnostics& diagnostics) {
  RobotRow robot;
  robot.urdf.name = "[device." + device + "." + key + "]";
  robot.urdf.position = row.position(key);
  const Node* value = row.any(key);
  if (value == nullptr) return robot;
  if (value->kind == Node::Kind::table) {
    read_table(*value, robot, diagnostics);
  } else if (value->kind == Node::Kind::text) {
    robot.file = value->text;
    robot.urdf.name += ", with file = \"" + value->text + "\"";
  } else {
    row.wrong_kind(*value, key, "a text or a table",
                   "write " + key + " = \"FILE\", or " + robot.urdf.name + " with file = \"FILE\"");
  }
  return robot;
}

}  // namespace flexrf::config_gen
