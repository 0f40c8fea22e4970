#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "config-gen/urdf/urdf_chain.hpp"

namespace flexrf::config_gen {
namespace {

UrdfTransform compose(const UrdfTransform& a, const UrdfTransform& b) {
  UrdfTransform result;
  for (std::size_t row = 0; row < 3; ++row) {
    result.position[row] = a.position[row];
    for (std::size_t k = 0; k < 3; ++k) result.position[row] += a.rotation[3 * k + row] * b.position[k];
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += a.rotation[3 * k + row] * b.rotation[3 * column + k];
      result.rotation[3 * column + row] = sum;
    }
  }
  return result;
}

// URDF's fixed-axis roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll).
std::array<double, 9> rotation_of(const std::array<double, 3>& rpy) {
  const double cr = std::cos(rpy[0]), sr = std::sin(rpy[0]);
  const double cp = std::cos(rpy[1]), sp = std::sin(rpy[1]);
  const double cy = std::cos(rpy[2]), sy = std::sin(rpy[2]);
  std::array<double, 9> rotation = {cy * cp,
                                    sy * cp,
                                    -sp,
                                    cy * sp * sr - sy * cr,
                                    sy * sp * sr + cy * cr,
                                    cp * sr,
                                    cy * sp * cr + sy * sr,
                                    sy * sp * cr - cy * sr,
                                    cp * cr};
  // A quarter turn is meant exactly: the rounding of its cosine would only clutter the constants.
  for (double& entry : rotation) {
    const double whole = std::round(entry);
    if (std::abs(entry - whole) < 1e-12) entry = whole + 0.0;
  }
  return rotation;
}

bool parse_number(std::string_view text, double& value) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  const auto last = text.find_last_not_of(" \t\r\n");
  text = text.substr(first, last - first + 1);
  if (text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::abs(value) <= urdf_greatest_number;
}

bool parse_triple(const std::string& text, std::array<double, 3>& values) {
  std::istringstream words(text);
  std::string word;
  std::size_t count = 0;
  while (words >> word) {
    if (count == 3 || !parse_number(word, values[count])) return false;
    ++count;
  }
  return count == 3;
}

const std::string greatest_text = "1e6";

class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  UrdfResult read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
    if (!parsed) {
      fail_at(static_cast<std::size_t>(parsed.offset),
              std::string("not well-formed XML: ") + parsed.description());
      return finish();
    }
    const pugi::xml_node robot = document.document_element();
    if (std::string_view(robot.name()) != "robot") {
      fail(robot, "the outermost element is <" + std::string(robot.name()) + ">, not <robot>");
      return finish();
    }
    chain_.name = robot.attribute("name").value();
    if (chain_.name.empty()) fail(robot, "<robot> has no name");
    read_links(robot);
    read_joints(robot);
    if (errors_.empty()) follow_chain(robot);
    return finish();
  }

 private:
  struct Joint {
    pugi::xml_node node;
    std::string parent;
    std::string child;
    bool movable = false;
    UrdfJoint value;
  };

  void fail_at(std::size_t offset, std::string message, std::string hint = {}) {
    const std::string_view before = text_.substr(0, std::min(offset, text_.size()));
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const auto newline = before.rfind('\n');
    const std::size_t column =
        newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
    errors_.push_back({file_, line, column, std::move(message), std::move(hint)});
  }

  void fail(const pugi::xml_node& node, std::string message, std::string hint = {}) {
    const std::ptrdiff_t offset = node.offset_debug();  // of the name, behind the '<'
    fail_at(offset > 0 ? static_cast<std::size_t>(offset) - 1 : 0, std::move(message), std::move(hint));
  }

  void read_links(const pugi::xml_node& robot) {
    for (const pugi::xml_node& link : robot.children("link")) {
      const std::string name = link.attribute("name").value();
      if (name.empty()) {
        fail(link, "a link has no name");
      } else if (!links_.emplace(name, link).second) {
        fail(link, "link '" + name + "' is there twice");
      }
    }
    if (links_.empty()) fail(robot, "the robot has no links");
  }

  void read_joints(const pugi::xml_node& robot) {
    std::set<std::string> names;
    for (const pugi::xml_node& node : robot.children("joint")) {
      Joint joint;
      joint.node = node;
      joint.value.name = node.attribute("name").value();
      const std::string& name = joint.value.name;
      if (name.empty()) {
        fail(node, "a joint has no name");
        continue;
      }
      if (!names.insert(name).second) fail(node, "joint '" + name + "' is there twice");
      joint.parent = read_end(node, name, "parent");
      joint.child = read_end(node, name, "child");
      read_origin(joint);
      read_type(joint);
      if (joint.movable) {
        read_axis(joint);
        read_limits(joint);
      }
      joints_.push_back(joint);
    }
  }

  std::string read_end(const pugi::xml_node& node, const std::string& name, const char* end) {
    const pugi::xml_node element = node.child(end);
    const std::string link = element.attribute("link").value();
    if (link.empty()) {
      fail(element ? element : node, "joint '" + name + "' has no " + end + " link");
    } else if (!links_.contains(link)) {
      fail(element, "joint '" + name + "': there is no link '" + link + "'");
    }
    return link;
  }

  void read_origin(Joint& joint) {
    const pugi::xml_node origin = joint.node.child("origin");
    std::array<double, 3> rpy{};
    for (const auto& [attribute, values] :
         {std::pair{"xyz", &joint.value.origin.position}, std::pair{"rpy", &rpy}}) {
      const pugi::xml_attribute found = origin.attribute(attribute);
      if (found && !parse_triple(found.value(), *values)) {
        fail(origin, "joint '" + joint.value.name + "': " + attribute + "=\"" + found.value() +
                         "\" is not three numbers up to " + greatest_text);
      }
    }
    joint.value.origin.rotation = rotation_of(rpy);
  }

  void read_type(Joint& joint) {
    const std::string type = joint.node.attribute("type").value();
    const std::string start = "joint '" + joint.value.name + "' ";
    joint.movable = type == "revolute";
    if (type.empty()) {
      fail(joint.node, start + "has no type", "revolute or fixed");
    } else if (type == "continuous") {
      fail(joint.node, start + "is continuous, and an arm's joint needs limits",
           "make it revolute and give it <limit lower upper velocity>");
    } else if (type == "prismatic" || type == "floating" || type == "planar") {
      fail(joint.node, start + "is " + type + ": only revolute and fixed joints are supported");
    } else if (type != "revolute" && type != "fixed") {
      fail(joint.node, start + "has the unknown type '" + type + "'", "revolute or fixed");
    }
    if (const pugi::xml_node mimic = joint.node.child("mimic")) {
      fail(mimic, start + "follows another one: <mimic> is not supported");
    }
  }

  void read_axis(Joint& joint) {
    const pugi::xml_node axis = joint.node.child("axis");
    if (!axis) return;  // URDF's default, x
    std::array<double, 3>& value = joint.value.axis;
    if (!parse_triple(axis.attribute("xyz").value(), value)) {
      fail(axis,
           "joint '" + joint.value.name + "': the axis's xyz is not three numbers up to " + greatest_text);
      return;
    }
    const double length = std::hypot(value[0], value[1], value[2]);
    if (!(length > 1e-6)) {
      fail(axis, "joint '" + joint.value.name + "': the axis has no length");
      return;
    }
    for (double& entry : value) entry /= length;
  }

  // False, with an error, when the attribute is missing or no number.
  bool read_number(const pugi::xml_node& node, const std::string& joint, const char* attribute,
                   double& value) {
    const pugi::xml_attribute found = node.attribute(attribute);
    const std::string start = "joint '" + joint + "': <" + node.name() + "> ";
    if (!found) {
      fail(node, start + "has no " + attribute);
      return false;
    }
    if (!parse_number(found.value(), value)) {
      fail(node, start + attribute + "=\"" + found.value() + "\" is not a number up to " + greatest_text);
      return false;
    }
    return true;
  }

  void read_positive(const pugi::xml_node& node, const std::string& joint, const char* attribute,
                     double& value) {
    if (read_number(node, joint, attribute, value) && !(value > 0)) {
      fail(node, "joint '" + joint + "': " + attribute + " must be above 0");
    }
  }

  void read_limits(Joint& joint) {
    UrdfJoint& value = joint.value;
    bool range_known = false;
    const pugi::xml_node limit = joint.node.child("limit");
    if (!limit) {
      fail(joint.node, "joint '" + value.name + "' has no <limit>",
           "<limit lower upper velocity>, in rad and rad/s");
    } else {
      const bool lower = read_number(limit, value.name, "lower", value.lower);
      const bool upper = read_number(limit, value.name, "upper", value.upper);
      range_known = lower && upper && value.lower < value.upper;
      if (lower && upper && !range_known) {
        fail(limit, "joint '" + value.name + "': lower is not below upper");
      }
      read_positive(limit, value.name, "velocity", value.velocity);
    }
    const pugi::xml_node extra = joint.node.child("flexrf");
    if (!extra) {
      fail(joint.node, "joint '" + value.name + "' has no <flexrf>",
           "<flexrf acceleration jerk home>, in rad/s^2, rad/s^3 and rad: URDF has no place for them");
      return;
    }
    read_positive(extra, value.name, "acceleration", value.acceleration);
    read_positive(extra, value.name, "jerk", value.jerk);
    if (extra.attribute("home") && !read_number(extra, value.name, "home", value.home)) return;
    if (range_known && (value.home < value.lower || value.home > value.upper)) {
      fail(extra, "joint '" + value.name + "': home is outside the limits",
           extra.attribute("home") ? "" : "without home=\"...\" it is 0");
    }
  }

  void follow_chain(const pugi::xml_node& robot) {
    std::map<std::string, const Joint*> from_parent;
    std::map<std::string, const Joint*> to_child;
    for (const Joint& joint : joints_) {
      if (!from_parent.emplace(joint.parent, &joint).second) {
        fail(joint.node,
             "link '" + joint.parent + "' carries more than one joint: '" +
                 from_parent[joint.parent]->value.name + "' and '" + joint.value.name + "'",
             "an arm is one serial chain, from the base to the tool");
      }
      if (!to_child.emplace(joint.child, &joint).second) {
        fail(joint.node, "link '" + joint.child + "' hangs on more than one joint: '" +
                             to_child[joint.child]->value.name + "' and '" + joint.value.name + "'");
      }
    }
    if (!errors_.empty()) return;

    std::vector<std::string> roots;
    for (const pugi::xml_node& link : robot.children("link")) {
      const std::string name = link.attribute("name").value();
      if (!to_child.contains(name)) roots.push_back(name);
    }
    if (roots.empty()) {
      fail(robot, "the joints form a loop: no link is the base");
      return;
    }
    if (roots.size() > 1) {
      fail(links_.at(roots[1]),
           "links '" + roots[0] + "' and '" + roots[1] + "' are both without a joint that carries them",
           "an arm has one base");
      return;
    }
    UrdfTransform pending;  // fixed joints since the last movable one
    std::size_t followed = 0;
    for (auto next = from_parent.find(roots[0]); next != from_parent.end();
         next = from_parent.find(next->second->child)) {
      ++followed;
      const Joint& joint = *next->second;
      pending = compose(pending, joint.value.origin);
      if (!joint.movable) continue;
      chain_.joints.push_back(joint.value);
      chain_.joints.back().origin = pending;
      pending = {};
    }
    chain_.tool = pending;
    if (followed != joints_.size()) fail(robot, "some joints form a loop beside the chain");
    if (chain_.joints.empty()) fail(robot, "the chain has no joint that moves");
    if (chain_.joints.size() > urdf_max_joints) {
      fail(robot, "the chain has " + std::to_string(chain_.joints.size()) + " joints that move, at most " +
                      std::to_string(urdf_max_joints) + " are supported");
    }
  }

  UrdfResult finish() {
    UrdfResult result;
    std::stable_sort(errors_.begin(), errors_.end(), [](const UrdfError& a, const UrdfError& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    result.errors = std::move(errors_);
    if (result.errors.empty()) result.chain = std::move(chain_);
    return result;
  }

  std::string_view text_;
  std::string file_;
  std::map<std::string, pugi::xml_node> links_;
  std::vector<Joint> joints_;
  UrdfChain chain_;
  std::vector<UrdfError> errors_;
};

}  // namespace

UrdfResult parse_urdf(std::string_view text, const std::string& file_name) {
  return Reader(text, file_name).read();
}

UrdfResult read_urdf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    UrdfResult result;
    result.errors.push_back({file.string(), 0, 0, "the file cannot be read", ""});
    return result;
  }
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  return parse_urdf(text, file.string());
}

std::string UrdfError::text() const {
  std::string result = file;
  if (line > 0) result += ":" + std::to_string(line) + ":" + std::to_string(column);
  result += ": error: " + message;
  if (!hint.empty()) result += "\n  hint: " + hint;
  return result;
}

}  // namespace flexrf::config_gen
