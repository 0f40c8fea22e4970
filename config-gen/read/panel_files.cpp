#include "config-gen/read/panel_files.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/ascii.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

const char* content_type_of(const fs::path& file) {
  constexpr std::array<std::pair<const char*, const char*>, 6> types{{{".stl", "model/stl"},
                                                                      {".dae", "model/vnd.collada+xml"},
                                                                      {".obj", "model/obj"},
                                                                      {".glb", "model/gltf-binary"},
                                                                      {".png", "image/png"},
                                                                      {".jpg", "image/jpeg"}}};
  const std::string extension = file.extension().string();
  for (const auto& [suffix, type] : types)
    if (equal_without_case(extension, suffix)) return type;
  return "application/octet-stream";
}

// Where a mesh lies, and the address by which the page asks for it, relative to the page's robots.
struct MeshPlace {
  fs::path file;  // empty: it was found nowhere
  fs::path address;
};

constexpr std::string_view package_scheme = "package://";

// package://NAME/PATH: PATH in a folder NAME that one of the row's folders holds, or is; else one beside or
// around the URDF, as packages lie when they are downloaded.
MeshPlace place_in_package(const DeviceResource& robot, const std::string& mesh) {
  const fs::path within = fs::path(mesh.substr(package_scheme.size())).lexically_normal();
  MeshPlace place{{}, "packages" / within};
  if (within.empty() || within.is_absolute() || *within.begin() == "..") return place;
  std::vector<fs::path> folders = robot.packages;
  for (const fs::path& folder : robot.packages)
    if (folder.filename() == *within.begin()) folders.push_back(folder.parent_path());
  for (fs::path around = robot.file.parent_path();; around = around.parent_path()) {
    folders.push_back(around);
    if (around == around.parent_path()) break;
  }
  for (const fs::path& folder : folders) {
    if (!fs::is_regular_file(folder / within)) continue;
    place.file = (folder / within).lexically_normal();
    return place;
  }
  return place;
}

MeshPlace place_of(const DeviceResource& robot, const std::string& mesh) {
  if (mesh.starts_with(package_scheme)) return place_in_package(robot, mesh);
  MeshPlace place{{}, fs::path(mesh).lexically_normal()};
  const fs::path file = (robot.file.parent_path() / place.address).lexically_normal();
  if (mesh.find("://") == std::string::npos && place.address.is_relative() && fs::is_regular_file(file))
    place.file = file;
  return place;
}

// A robot can be led without its meshes, so one that is not there is no error.
void add_meshes(Assembly& assembly, const DeviceResource& robot) {
  std::vector<const UrdfMesh*> missing;
  for (const UrdfMesh& mesh : robot.chain->meshes) {
    const MeshPlace place = place_of(robot, mesh.name);
    const fs::path path = ("robots" / place.address).lexically_normal();
    if (place.file.empty() || *path.begin() == "..") {
      missing.push_back(&mesh);
      continue;
    }
    const std::string named = "the mesh " + quote(mesh.name);
    const auto clashes = [&](const PanelFile& known) {
      return known.path == path.generic_string() && known.file != place.file;
    };
    const auto& files = assembly.model.panel.files;
    if (const auto known = std::find_if(files.begin(), files.end(), clashes); known != files.end()) {
      assembly.diagnostics.error(mesh.position,
                                 named + " is another one than " + known->file.generic_string(),
                                 "two robots cannot share a mesh's path: rename one");
      continue;
    }
    add_panel_file(assembly.model, {path.generic_string(), content_type_of(place.file), place.file});
  }
  if (missing.empty()) return;
  const std::string first = quote(missing.front()->name);
  const std::string more = missing.size() == 1 ? "" : " and " + std::to_string(missing.size() - 1) + " more";
  assembly.diagnostics.warning(
      missing.front()->position,
      "the mesh " + first + more + (missing.size() == 1 ? " is" : " are") +
          " not found: the panel shows the robot without",
      missing.front()->name.starts_with(package_scheme)
          ? "say where packages lie: packages = [\"FOLDER\"] in the device's urdf = { file = ..., packages = "
            "... }, "
            "relative to the application's folder"
          : "a path relative to the URDF's folder, as \"meshes/base.stl\", or package://NAME/PATH");
}

}  // namespace

void add_panel_file(Model& model, PanelFile file) {
  const auto is_known = [&file](const PanelFile& known) { return known.path == file.path; };
  if (std::any_of(model.panel.files.begin(), model.panel.files.end(), is_known)) return;
  model.files.push_back(file.file);
  model.panel.files.push_back(std::move(file));
}

const DeviceResource* robot_of(const Model& model, Index device) {
  const Interface& interface = model.interfaces[model.devices[device].interface];
  for (const DeviceResource& resource : model.devices[device].resources)
    if (interface.resources[resource.resource].reader == Resource::Reader::urdf) return &resource;
  return nullptr;
}

void add_robot_files(Assembly& assembly, Index device) {
  const DeviceResource* robot = robot_of(assembly.model, device);
  if (robot == nullptr || !robot->chain) return;
  add_panel_file(assembly.model,
                 {"robots/" + assembly.model.devices[device].name + ".urdf", "application/xml", robot->file});
  add_meshes(assembly, *robot);
}

bool is_address(const std::string& text) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return inet_pton(AF_INET, text.c_str(), bytes.data()) == 1 ||
         inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1;
}

}  // namespace flexrf::config_gen
