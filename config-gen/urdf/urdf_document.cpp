#include "config-gen/urdf/urdf_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "config-gen/model/words.hpp"
#include "config-gen/urdf/urdf_transform.hpp"

namespace flexrf::config_gen {

UrdfDocument::UrdfDocument(std::string_view text, const std::string& file, Diagnostics& diagnostics)
    : text_(text), file_(intern(file)), diagnostics_(diagnostics), lines_{0} {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') lines_.push_back(i + 1);
}

Position UrdfDocument::place(std::size_t offset) const {
  const auto next = std::upper_bound(lines_.begin(), lines_.end(), std::min(offset, text_.size()));
  return {file_, static_cast<std::uint32_t>(next - lines_.begin()),
          static_cast<std::uint32_t>(std::min(offset, text_.size()) - *(next - 1) + 1)};
}

Position UrdfDocument::position(const pugi::xml_node& node) const {
  const std::ptrdiff_t offset = node.offset_debug();  // of the name, behind the '<'
  return place(offset > 0 ? static_cast<std::size_t>(offset) - 1 : 0);
}

void UrdfDocument::error(const pugi::xml_node& node, std::string text, Hint hint) {
  failed_ = true;
  diagnostics_.error(position(node), std::move(text), std::move(hint));
}

void UrdfDocument::warning(const pugi::xml_node& node, std::string text, Hint hint) {
  diagnostics_.warning(position(node), std::move(text), std::move(hint));
}

bool UrdfDocument::read() {
  const pugi::xml_parse_result parsed = document_.load_buffer(text_.data(), text_.size());
  if (!parsed) {
    failed_ = true;
    diagnostics_.error(place(static_cast<std::size_t>(parsed.offset)),
                       std::string("not well-formed XML: ") + parsed.description(),
                       "the file may be cut off: get it anew, or have xmllint say more");
    return false;
  }
  if (!is_robot()) return false;
  read_links();
  read_joints();
  if (!failed_) connect();
  return !failed_;
}

bool UrdfDocument::is_robot() {
  const pugi::xml_node root = robot();
  if (std::string_view(root.name()) != "robot") {
    error(root, "the outermost element is <" + std::string(root.name()) + ">, not <robot>",
          "a URDF is needed; SDF and MJCF are converted by the tools of their simulators");
    return false;
  }
  for (const pugi::xml_node& child : root.children()) {
    if (!std::string_view(child.name()).starts_with("xacro:")) continue;
    error(child, "this is a xacro file: <" + std::string(child.name()) + "> makes no sense in a URDF",
          "make the URDF of it, where its package is installed: xacro FILE.xacro > FILE.urdf");
    return false;
  }
  name_ = root.attribute("name").value();
  if (name_.empty()) error(root, "<robot> has no name", "write <robot name=\"...\">");
  const std::vector<std::string> versions = {"", "1", "1.0", "1.1", "1.2"};
  const std::string version = root.attribute("version").value();
  if (std::find(versions.begin(), versions.end(), version) == versions.end()) {
    warning(root, "version " + quote(version) + " of URDF is not known: it is read as 1.2",
            "see what it has that 1.2 has not");
  }
  return true;
}

void UrdfDocument::read_links() {
  for (const pugi::xml_node& link : robot().children("link")) {
    const std::string name = link.attribute("name").value();
    if (name.empty()) {
      error(link, "a link has no name", "write <link name=\"...\">");
    } else if (!links_.emplace(name, link).second) {
      error(link, "link '" + name + "' is there twice", "rename or remove one");
    } else {
      link_names_.push_back(name);
      read_meshes(link);
    }
  }
  if (links_.empty()) error(robot(), "the robot has no links", "a URDF has at least a base and a tool");
}

void UrdfDocument::read_meshes(const pugi::xml_node& link) {
  for (const pugi::xml_node& visual : link.children("visual")) {
    const pugi::xml_node mesh = visual.child("geometry").child("mesh");
    const std::string name = mesh.attribute("filename").value();
    const bool is_known = std::any_of(meshes_.begin(), meshes_.end(),
                                      [&name](const UrdfMesh& known) { return known.name == name; });
    if (!name.empty() && !is_known) meshes_.push_back({name, position(mesh)});
  }
}

void UrdfDocument::read_joints() {
  std::set<std::string> names;
  for (const pugi::xml_node& node : robot().children("joint")) {
    DocumentJoint joint;
    joint.node = node;
    joint.name = node.attribute("name").value();
    joint.type = node.attribute("type").value();
    if (joint.name.empty()) {
      error(node, "a joint has no name", "write <joint name=\"...\" type=\"...\">");
      continue;
    }
    if (!names.insert(joint.name).second)
      error(node, "joint '" + joint.name + "' is there twice", "rename or remove one");
    joint.parent = read_end(joint, "parent");
    joint.child = read_end(joint, "child");
    read_origin(joint);
    check_type(joint);
    joints_.push_back(std::move(joint));
  }
}

std::string UrdfDocument::read_end(const DocumentJoint& joint, const char* end) {
  const pugi::xml_node element = joint.node.child(end);
  const std::string link = element.attribute("link").value();
  if (link.empty()) {
    error(element ? element : joint.node, "joint '" + joint.name + "' has no " + end + " link",
          "write <" + std::string(end) + " link=\"...\"/>");
  } else if (!links_.contains(link)) {
    error(element, "joint '" + joint.name + "': there is no link '" + link + "'",
          suggest(link, link_names_, "links", "add <link name=\"...\"/> of this name"));
  }
  return link;
}

bool UrdfDocument::read_numbers(const DocumentJoint& joint, const char* attribute, std::span<double> values,
                                const char* hint) {
  const pugi::xml_node origin = joint.node.child("origin");
  const pugi::xml_attribute found = origin.attribute(attribute);
  if (!found) return false;
  if (parse_numbers(found.value(), values)) return true;
  error(origin,
        "joint '" + joint.name + "': " + attribute + "=\"" + found.value() + "\" is not " +
            (values.size() == 3 ? "three" : "four") + " numbers up to 1e6",
        hint);
  return false;
}

void UrdfDocument::read_origin(DocumentJoint& joint) {
  read_numbers(joint, "xyz", joint.origin.position, "x, y and z in m, as xyz=\"0 0 0.24\"");
  std::array<double, 3> rpy{};
  const bool has_rpy = read_numbers(joint, "rpy", rpy, "roll, pitch and yaw in rad, as rpy=\"0 1.5708 0\"");
  joint.origin.rotation = rotation_of(rpy);
  std::array<double, 4> quaternion{};
  if (!read_numbers(joint, "quat_xyzw", quaternion,
                    "a quaternion of length 1, as quat_xyzw=\"0 0 0.7071068 0.7071068\""))
    return;
  const pugi::xml_node origin = joint.node.child("origin");
  if (has_rpy) {
    error(origin, "joint '" + joint.name + "' is turned twice, by rpy and by quat_xyzw",
          "keep the one that is meant");
  } else if (!(std::hypot(std::hypot(quaternion[0], quaternion[1], quaternion[2]), quaternion[3]) > 1e-6)) {
    error(origin, "joint '" + joint.name + "': quat_xyzw has no length",
          "no rotation is quat_xyzw=\"0 0 0 1\"");
  } else {
    joint.origin.rotation = rotation_of_quaternion(quaternion);
  }
}

void UrdfDocument::check_type(const DocumentJoint& joint) {
  const std::vector<std::string> types = {"revolute", "continuous", "prismatic",
                                          "fixed",    "floating",   "planar"};
  if (std::find(types.begin(), types.end(), joint.type) != types.end()) return;
  error(joint.node,
        "joint '" + joint.name + "' has " +
            (joint.type.empty() ? std::string("no type") : "the unknown type '" + joint.type + "'"),
        suggest(joint.type, types, "types", ""));
}

void UrdfDocument::connect() {
  for (const DocumentJoint& joint : joints_) {
    below_[joint.parent].push_back(&joint);
    const auto [known, is_first] = above_.emplace(joint.child, &joint);
    if (is_first) continue;
    error(joint.node,
          "link '" + joint.child + "' hangs on more than one joint: '" + known->second->name + "' and '" +
              joint.name + "'",
          "closed chains are not supported: leave out the joint that closes it");
  }
  if (failed_) return;
  for (const std::string& link : link_names_)
    if (!above_.contains(link)) roots_.push_back(link);
  // What hangs on a root is found from it; a loop is not.
  std::vector<std::string> reached = roots_;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const DocumentJoint* joint : below(reached[i])) reached.push_back(joint->child);
  if (reached.size() == links_.size()) return;
  const auto lost = std::find_if(link_names_.begin(), link_names_.end(), [&reached](const std::string& link) {
    return std::find(reached.begin(), reached.end(), link) == reached.end();
  });
  error(links_.at(*lost), "the joints around link '" + *lost + "' form a loop",
        "in a URDF each link hangs on the one before, from the base on");
}

const DocumentJoint* UrdfDocument::above(const std::string& link) const {
  const auto found = above_.find(link);
  return found == above_.end() ? nullptr : found->second;
}

const std::vector<const DocumentJoint*>& UrdfDocument::below(const std::string& link) const {
  static const std::vector<const DocumentJoint*> none;
  const auto found = below_.find(link);
  return found == below_.end() ? none : found->second;
}

}  // namespace flexrf::config_gen
