#include "config-gen/urdf/urdf_words.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

using Words = std::vector<std::string>;

// URDF 1.0 to 1.2, as urdfdom reads it, and our own <flexrf>.
const std::map<std::string, Words>& attributes_of_elements() {
  static const std::map<std::string, Words> known = {
      {"origin", {"xyz", "rpy", "quat_xyzw"}},
      {"parent", {"link"}},
      {"child", {"link"}},
      {"axis", {"xyz"}},
      {"limit", {"lower", "upper", "velocity", "effort", "acceleration", "deceleration", "jerk"}},
      {"safety_controller", {"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"}},
      {"mimic", {"joint", "multiplier", "offset"}},
      {"flexrf", {"acceleration", "jerk", "home"}}};
  return known;
}

const Words& elements_without_effect() {
  static const Words known = {
      "dynamics", "calibration", "hardwareInterface", "joint_properties", "transmission", "gazebo", "sensor"};
  return known;
}

bool is_of_another_program(const std::string& word) {
  return word.find(':') != std::string::npos || word.starts_with("xmlns");
}

void check_attributes(const DocumentJoint& joint, const pugi::xml_node& node, const Words& known,
                      UrdfDocument& document) {
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    const std::string word = attribute.name();
    if (is_of_another_program(word) || std::find(known.begin(), known.end(), word) != known.end()) continue;
    document.error(node,
                   "joint '" + joint.name + "': <" + node.name() + "> has the attribute " + quote(word) +
                       ", and what it means is not known",
                   suggest(word, known, "attributes", "remove it"));
  }
}

}  // namespace

void check_words(const DocumentJoint& joint, UrdfDocument& document) {
  check_attributes(joint, joint.node, {"name", "type"}, document);
  Words elements;
  for (const auto& [element, attributes] : attributes_of_elements()) elements.push_back(element);
  std::set<std::string> seen;
  for (const pugi::xml_node& node : joint.node.children()) {
    if (node.type() != pugi::node_element) continue;
    const std::string word = node.name();
    const bool is_second = !seen.insert(word).second;
    if (const auto found = attributes_of_elements().find(word); found != attributes_of_elements().end()) {
      if (is_second) {
        document.error(node, "joint '" + joint.name + "' has a second <" + word + ">",
                       "keep the one that is meant");
      }
      check_attributes(joint, node, found->second, document);
      continue;
    }
    const Words& without_effect = elements_without_effect();
    if (is_second || is_of_another_program(word) ||
        std::find(without_effect.begin(), without_effect.end(), word) != without_effect.end())
      continue;
    const std::string text = "joint '" + joint.name + "' has <" + printable(word) + ">, which no URDF has";
    if (nearest(word, elements).empty()) {
      document.warning(node, text + ": it is passed over", "remove it, or see what it is meant to say");
    } else {
      document.error(node, text, suggest(word, elements, "elements", "remove it"));
    }
  }
}

}  // namespace flexrf::config_gen
