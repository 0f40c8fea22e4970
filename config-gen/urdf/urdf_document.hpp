// The links and joints of a URDF, before anything is asked of them. Private to config-gen/urdf.
#pragma once

#include <map>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/urdf_chain.hpp"

namespace flexrf::config_gen {

struct DocumentJoint {
  pugi::xml_node node;
  std::string name;
  std::string type;
  std::string parent;
  std::string child;
  UrdfTransform origin;

  bool moves() const { return type != "fixed"; }
  // Another joint leads it.
  bool mimics() const { return static_cast<bool>(node.child("mimic")); }
};

// A forest: each link hangs on one joint at most, and no joints form a loop.
class UrdfDocument {
 public:
  // `text` outlives the document.
  UrdfDocument(std::string_view text, const std::string& file, Diagnostics& diagnostics);

  // False where the file is no robot: then it has been said why.
  bool read();

  const std::string& name() const { return name_; }
  std::string_view file() const { return file_; }
  const std::vector<std::string>& roots() const { return roots_; }
  const std::vector<UrdfMesh>& meshes() const { return meshes_; }
  const std::map<std::string, pugi::xml_node>& links() const { return links_; }
  // The joint that carries the link; none carries a root.
  const DocumentJoint* above(const std::string& link) const;
  const std::vector<const DocumentJoint*>& below(const std::string& link) const;

  pugi::xml_node robot() const { return document_.document_element(); }
  Position position(const pugi::xml_node& node) const;
  void error(const pugi::xml_node& node, std::string text, Hint hint);
  void warning(const pugi::xml_node& node, std::string text, Hint hint);
  bool failed() const { return failed_; }

 private:
  Position place(std::size_t offset) const;
  bool is_robot();
  void read_links();
  void read_meshes(const pugi::xml_node& link);
  void read_joints();
  std::string read_end(const DocumentJoint& joint, const char* end);
  void read_origin(DocumentJoint& joint);
  // True where the joint's origin has this attribute, and no error.
  bool read_numbers(const DocumentJoint& joint, const char* attribute, std::span<double> values,
                    const char* hint);
  void check_type(const DocumentJoint& joint);
  void connect();

  std::string_view text_;
  std::string_view file_;
  Diagnostics& diagnostics_;
  bool failed_ = false;
  pugi::xml_document document_;
  std::vector<std::size_t> lines_;  // where each begins
  std::string name_;
  std::map<std::string, pugi::xml_node> links_;
  std::vector<std::string> link_names_;  // in the file's order
  std::vector<DocumentJoint> joints_;
  std::map<std::string, const DocumentJoint*> above_;
  std::map<std::string, std::vector<const DocumentJoint*>> below_;
  std::vector<std::string> roots_;
  std::vector<UrdfMesh> meshes_;
};

}  // namespace flexrf::config_gen
