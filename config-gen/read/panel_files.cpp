#include "config-gen/read/panel_files.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "config-gen/model/file_contents.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

void remove_comments(std::string& xml) {
  for (std::size_t begin = xml.find("<!--"); begin != std::string::npos; begin = xml.find("<!--", begin)) {
    const std::size_t end = xml.find("-->", begin);
    xml.erase(begin, end == std::string::npos ? end : end + 3 - begin);
  }
}

// What <mesh filename="..."/> elements name, each once.
std::vector<std::string> meshes_in(std::string xml) {
  remove_comments(xml);
  std::vector<std::string> meshes;
  for (std::size_t at = xml.find("<mesh"); at != std::string::npos; at = xml.find("<mesh", at + 1)) {
    const std::string element = xml.substr(at, xml.find('>', at) - at);
    const std::size_t key = element.find("filename");
    const std::size_t open = element.find_first_of("\"'", key);
    if (key == std::string::npos || open == std::string::npos) continue;
    const std::string name = element.substr(open + 1, element.find(element[open], open + 1) - open - 1);
    if (std::find(meshes.begin(), meshes.end(), name) == meshes.end()) meshes.push_back(name);
  }
  return meshes;
}

const char* content_type_of(const fs::path& file) {
  constexpr std::array<std::pair<const char*, const char*>, 6> types{{{".stl", "model/stl"},
                                                                      {".dae", "model/vnd.collada+xml"},
                                                                      {".obj", "model/obj"},
                                                                      {".glb", "model/gltf-binary"},
                                                                      {".png", "image/png"},
                                                                      {".jpg", "image/jpeg"}}};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const auto& [suffix, type] : types)
    if (extension == suffix) return type;
  return "application/octet-stream";
}

void add_mesh(Assembly& assembly, const fs::path& urdf, const std::string& mesh, const Position& position) {
  const std::string named = "the mesh " + quote(mesh) + " that " + quote(urdf.filename().string()) + " names";
  const fs::path relative = fs::path(mesh).lexically_normal();
  if (mesh.find("://") != std::string::npos || relative.is_absolute() || relative.empty() ||
      *relative.begin() == "..") {
    assembly.diagnostics.error(position, named + " is not beside it: no panel can show it",
                               "write a path relative to the URDF's folder, as \"meshes/base.stl\"");
    return;
  }
  const fs::path file = (urdf.parent_path() / relative).lexically_normal();
  const std::string path = "robots/" + relative.generic_string();
  if (!fs::is_regular_file(file)) {
    assembly.diagnostics.error(position, named + " does not exist",
                               "it is looked for at " + file.generic_string());
    return;
  }
  for (const PanelFile& known : assembly.model.panel.files) {
    if (known.path != path || known.file == file) continue;
    assembly.diagnostics.error(position, named + " is another one than " + known.file.generic_string(),
                               "two robots cannot share a mesh's path: rename one");
    return;
  }
  add_panel_file(assembly.model, {path, content_type_of(file), file});
}

}  // namespace

void add_panel_file(Model& model, PanelFile file) {
  const auto is_known = [&file](const PanelFile& known) { return known.path == file.path; };
  if (std::any_of(model.panel.files.begin(), model.panel.files.end(), is_known)) return;
  model.files.push_back(file.file);
  model.panel.files.push_back(std::move(file));
}

std::optional<fs::path> robot_of(const Model& model, Index device) {
  const Interface& interface = model.interfaces[model.devices[device].interface];
  for (const DeviceResource& resource : model.devices[device].resources)
    if (interface.resources[resource.resource].reader == Resource::Reader::urdf) return resource.file;
  return std::nullopt;
}

void add_robot_files(Assembly& assembly, Index device) {
  const std::optional<fs::path> urdf = robot_of(assembly.model, device);
  if (!urdf || !fs::is_regular_file(*urdf)) return;
  const Device& row = assembly.model.devices[device];
  add_panel_file(assembly.model, {"robots/" + row.name + ".urdf", "application/xml", *urdf});
  for (const std::string& mesh : meshes_in(contents_of(*urdf)))
    add_mesh(assembly, *urdf, mesh, row.resources.front().position);
}

bool is_address(const std::string& text) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return inet_pton(AF_INET, text.c_str(), bytes.data()) == 1 ||
         inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1;
}

}  // namespace flexrf::config_gen
