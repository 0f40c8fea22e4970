#include "config-gen/urdf/urdf_path.hpp"

#include <algorithm>
#include <map>

#include "config-gen/model/words.hpp"
#include "config-gen/urdf/urdf_transform.hpp"

namespace flexrf::config_gen {
namespace {

// Moving joints of what hangs on a link.
struct Load {
  std::size_t moving = 0;
  std::size_t longest = 0;  // most in a row that no other joint leads
};

std::string listed_names(const std::vector<const DocumentJoint*>& joints) {
  std::vector<std::string> names;
  for (const DocumentJoint* joint : joints) names.push_back(joint->name);
  return listed(names);
}

class PathFinder {
 public:
  PathFinder(UrdfDocument& document, const UrdfRow& row, Diagnostics& diagnostics)
      : document_(document), row_(row), diagnostics_(diagnostics) {}

  std::optional<UrdfPath> find() {
    if (!check_frame(row_.base) || !check_frame(row_.tool)) return std::nullopt;
    UrdfPath path;
    const auto start = find_start(path);
    if (!start) return std::nullopt;
    weigh();
    const auto tool = row_.tool ? row_.tool->link : find_tool(*start);
    if (!tool) return std::nullopt;
    for (std::string link = *tool; link != *start;) {
      const DocumentJoint* joint = document_.above(link);
      if (joint == nullptr) return away_from_base(*tool);  // only one that the row names
      path.joints.push_back(joint);
      link = joint->parent;
    }
    std::reverse(path.joints.begin(), path.joints.end());
    return path;
  }

 private:
  bool check_frame(const std::optional<UrdfFrame>& frame) {
    if (!frame || document_.links().contains(frame->link)) return true;
    std::vector<std::string> links;
    for (const auto& [name, node] : document_.links()) links.push_back(name);
    diagnostics_.error(frame->position,
                       quote(std::string(document_.file())) + " has no link " + quote(frame->link),
                       suggest(frame->link, links, "links", "name one of the file's links"));
    return false;
  }

  // The base may be a frame beside the chain: what carries it without moving is where the chain begins.
  std::optional<std::string> find_start(UrdfPath& path) {
    const auto& roots = document_.roots();
    if (!row_.base && roots.size() > 1) {
      document_.error(
          document_.links().at(roots[1]),
          "links '" + roots[0] + "' and '" + roots[1] + "' are both without a joint that carries them",
          "an arm has one base: " + in_row("base = \"" + roots[0] + "\""));
      return std::nullopt;
    }
    std::string link = row_.base ? row_.base->link : roots.front();
    UrdfTransform base;  // in the frame of `link`
    for (const DocumentJoint* joint = document_.above(link); joint != nullptr && !joint->moves();
         joint = document_.above(link)) {
      base = compose(joint->origin, base);
      link = joint->parent;
    }
    path.start = inverse(base);
    return link;
  }

  void weigh() {
    std::vector<std::string> order = document_.roots();
    for (std::size_t i = 0; i < order.size(); ++i)
      for (const DocumentJoint* joint : document_.below(order[i])) order.push_back(joint->child);
    std::reverse(order.begin(), order.end());
    for (const std::string& link : order) {
      Load& load = loads_[link];
      for (const DocumentJoint* joint : document_.below(link)) {
        const Load branch = weight(*joint);
        load.moving += branch.moving;
        load.longest = std::max(load.longest, branch.longest);
      }
    }
  }

  // Of a joint and what hangs on it.
  Load weight(const DocumentJoint& joint) {
    Load load = loads_[joint.child];
    if (joint.moves()) ++load.moving;
    if (joint.moves() && !joint.mimics()) ++load.longest;
    return load;
  }

  std::optional<std::string> find_tool(const std::string& start) {
    std::string link = start;
    std::size_t joints = 0;
    while (true) {
      std::vector<const DocumentJoint*> branches;
      for (const DocumentJoint* joint : document_.below(link))
        if (weight(*joint).moving > 0) branches.push_back(joint);
      if (branches.empty()) break;
      const DocumentJoint* next = branches.front();
      if (branches.size() > 1) {
        next = main_branch(branches, joints);
        if (next == nullptr && !is_hand(branches, joints)) return ambiguous(link, branches);
        if (next == nullptr) {
          tell_hand(link, branches);
          break;
        }
      }
      if (next->moves()) ++joints;
      link = next->child;
    }
    return fixed_frame(link);
  }

  // Beside rods that others lead.
  const DocumentJoint* main_branch(const std::vector<const DocumentJoint*>& branches, std::size_t joints) {
    const DocumentJoint* main = nullptr;
    for (const DocumentJoint* branch : branches) {
      if (weight(*branch).longest == 0) continue;
      if (main != nullptr) return nullptr;
      main = branch;
    }
    return main != nullptr && weight(*main).longest >= joints ? main : nullptr;
  }

  bool is_hand(const std::vector<const DocumentJoint*>& branches, std::size_t joints) {
    return std::all_of(branches.begin(), branches.end(), [this, joints](const DocumentJoint* branch) {
      return weight(*branch).longest < joints;
    });
  }

  std::nullopt_t ambiguous(const std::string& link, const std::vector<const DocumentJoint*>& branches) {
    document_.error(
        branches[1]->node,
        "link '" + link + "' carries more than one chain: those of joints " + listed_names(branches),
        "say where the arm ends: " + in_row("tool = \"LINK\"") +
            "; an arm is one chain, from its base to its tool");
    return std::nullopt;
  }

  void tell_hand(const std::string& link, const std::vector<const DocumentJoint*>& branches) {
    const bool mimics = std::any_of(branches.begin(), branches.end(),
                                    [](const DocumentJoint* joint) { return joint->mimics(); });
    diagnostics_.warning(document_.position(branches.front()->node),
                         "the arm ends at link '" + link + "': the joints beyond it, from " +
                             listed_names(branches) + " on, are no part of it" +
                             (mimics ? " (<mimic> is not supported: nothing follows)" : ""),
                         "a gripper is a device of its own; where this is what is meant, " +
                             in_row("tool = \"" + link + "\""));
  }

  // What is fixed to the link: its only end, or the one whose name is the custom for it.
  std::string fixed_frame(const std::string& link) {
    std::vector<std::string> frames = {link};
    std::vector<std::string> ends, customary;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      bool is_end = true;
      for (const DocumentJoint* joint : document_.below(frames[i])) {
        if (joint->moves()) continue;
        is_end = false;
        frames.push_back(joint->child);
      }
      if (is_end && i > 0) ends.push_back(frames[i]);
      if (frames[i] == "tool0" || frames[i].ends_with("_tool0")) customary.push_back(frames[i]);
    }
    if (ends.size() == 1) return ends.front();
    if (customary.size() == 1) return customary.front();
    if (ends.empty()) return link;
    frames.erase(frames.begin());
    diagnostics_.warning(document_.position(document_.links().at(link)),
                         "the arm's tool is link '" + link +
                             "' itself, as more than one frame is fixed to it: " + listed(frames),
                         "name the one that is meant: " + in_row("tool = \"LINK\""));
    return link;
  }

  std::nullopt_t away_from_base(const std::string& tool) {
    diagnostics_.error(row_.tool->position,
                       "link '" + tool + "' does not hang on " +
                           (row_.base ? "the base '" + row_.base->link + "'" : "the base"),
                       "name a base that lies before the tool, or is fixed to what does");
    return std::nullopt;
  }

  std::string in_row(const std::string& text) const { return "write " + text + " in " + row_.name; }

  UrdfDocument& document_;
  const UrdfRow& row_;
  Diagnostics& diagnostics_;
  std::map<std::string, Load> loads_;
};

}  // namespace

std::optional<UrdfPath> find_path(UrdfDocument& document, const UrdfRow& row, Diagnostics& diagnostics) {
  return PathFinder(document, row, diagnostics).find();
}

}  // namespace flexrf::config_gen
