#include "config-gen/read/library.hpp"

#include <algorithm>

#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/shared_values.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sorted_tables(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// All folders below this one, at any depth.
std::vector<fs::path> sorted_folders(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, ignored))
    if (entry.is_directory(ignored)) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders;
}

// ROOT/NAME/NAME.toml, and whatever lies in a folder called interface, at any depth.
bool stands_for_itself(const fs::path& table, const fs::path& root) {
  const fs::path folder = table.parent_path();
  return folder.filename() == "interface" ||
         (folder.filename() == table.stem() && folder.parent_path() == root);
}

// Each folder once, however often and in whatever spelling it is given.
void remove_repeated(std::vector<fs::path>& folders) {
  std::vector<fs::path> kept;
  std::vector<fs::path> canonical;
  for (const fs::path& folder : folders) {
    const fs::path same = fs::weakly_canonical(folder);
    if (std::find(canonical.begin(), canonical.end(), same) != canonical.end()) continue;
    canonical.push_back(same);
    kept.push_back(folder.lexically_normal());
  }
  folders = std::move(kept);
}

}  // namespace

Library::Library(Model& model, SearchPaths paths, Diagnostics& diagnostics)
    : model_(model), paths_(std::move(paths)), diagnostics_(diagnostics) {
  for (auto* folders : {&paths_.types, &paths_.units, &paths_.interfaces, &paths_.drivers})
    remove_repeated(*folders);
  for (fs::path& folder : paths_.library) folder = fs::weakly_canonical(folder);
  // Types that belong to one unit, interface or driver lie beside it.
  for (const auto& folders : {paths_.units, paths_.interfaces, paths_.drivers})
    for (const fs::path& folder : folders)
      for (const fs::path& inner : sorted_folders(folder))
        if (inner.filename() == "types") paths_.types.push_back(inner);
  remove_repeated(paths_.types);
  find_types();
  find_tables(paths_.units, units_, "unit", false);
  find_tables(paths_.interfaces, interfaces_, "interface", true);
}

void Library::add_entry(Entries& entries, const std::string& name, const fs::path& file,
                        const std::string& what) {
  const auto [entry, is_new] = entries.try_emplace(name, Entry{file, false, false, std::nullopt});
  if (!is_new && !fs::equivalent(entry->second.file, file))
    diagnostics_.error(
        {intern(file.generic_string()), 1, 1}, "the " + what + " " + quote(name) + " is declared twice",
        "the other one is " + entry->second.file.generic_string() + ": rename one of the two files");
}

void Library::find_types() {
  for (const fs::path& folder : paths_.types)
    for (const fs::path& file : sorted_tables(folder))
      add_entry(types_, camel_case(file.stem().string()), file, "type");
}

void Library::find_tables(const std::vector<fs::path>& folders, Entries& entries, const std::string& what,
                          bool as_class) {
  for (const fs::path& folder : folders)
    for (const fs::path& inner : sorted_folders(folder))
      for (const fs::path& file : sorted_tables(inner)) {
        const std::string name = file.stem().string();
        if (stands_for_itself(file, folder))
          add_entry(entries, as_class ? camel_case(name) : name, file, what);
      }
}

void Library::find_drivers() {
  if (drivers_found_) return;
  drivers_found_ = true;
  for (const fs::path& folder : paths_.drivers)
    for (const fs::path& inner : sorted_folders(folder)) {
      if (inner.filename() == "types") continue;
      for (const fs::path& file : sorted_tables(inner)) {
        Diagnostics unused;  // a broken driver is reported by the run that generates it
        const auto root = parse_file(file, unused);
        if (!root) continue;
        const Node* name = root->find("name");
        const Node* interface = root->find("interface");
        if (name == nullptr || interface == nullptr) continue;
        drivers_.push_back({file, interface->text, name->text, name->position, std::nullopt, false});
      }
    }
}

const fs::path* Library::library_with(const fs::path& file) const {
  const auto found = std::find_if(paths_.library.begin(), paths_.library.end(), [&](const fs::path& folder) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end();
  });
  return found == paths_.library.end() ? nullptr : &*found;
}

std::string_view Library::space_of(const fs::path& file) const {
  return library_with(fs::weakly_canonical(file)) == nullptr ? user_space : library_space;
}

std::string Library::include_path(const fs::path& file, const std::string& header) {
  const fs::path place = fs::weakly_canonical(file).parent_path();
  const fs::path* library = library_with(place);
  const fs::path root = library == nullptr ? place.parent_path().parent_path() : library->parent_path();
  std::string path = (place.lexically_relative(root) / header).generic_string();
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  const bool is_quoted = path.find('"') == std::string::npos || path.find('>') == std::string::npos;
  if (!is_quoted || std::any_of(path.begin(), path.end(), is_control))
    diagnostics_.error({intern(file.generic_string()), 1, 1}, quote(path) + " cannot stand in an #include",
                       "rename the folder: leave out ends of lines, and one of the signs \" and >");
  return path;
}

std::optional<Node> Library::parse(const fs::path& file) {
  model_.files.push_back(file);
  auto table = parse_file(file, diagnostics_);
  if (table) share_values(*table, diagnostics_);
  return table;
}

template <typename Read>
std::optional<Index> Library::get(Entries& entries, const std::string& name, const Position& place,
                                  const std::string& what, const std::string& otherwise, Read read) {
  const auto found = entries.find(name);
  if (found == entries.end()) {
    std::vector<std::string> known;
    for (const auto& [key, entry] : entries) known.push_back(key);
    diagnostics_.error(place, "unknown " + what + " " + quote(name),
                       suggest(name, known, what + "s", otherwise));
    return std::nullopt;
  }
  Entry& entry = found->second;
  if (entry.reading) {
    diagnostics_.error(place, name + " contains itself",
                       "a type has a fixed size: remove the field that leads back to it");
    return std::nullopt;
  }
  if (entry.read) return entry.index;
  const std::size_t deeper = what == "type" ? 1 : 0;
  if (depth_ + deeper > max_nesting) {
    diagnostics_.error(place, name + " would be nested deeper than " + std::to_string(max_nesting) + " types",
                       "a type of types of types: put the fields into fewer types");
    return std::nullopt;
  }
  entry.reading = true;
  depth_ += deeper;
  if (const auto root = parse(entry.file)) entry.index = read(*this, *root, entry.file);
  depth_ -= deeper;
  entry.reading = false;
  entry.read = true;
  return entry.index;
}

std::optional<Index> Library::type(const std::string& name, const Position& place) {
  return get(types_, name, place, "type", "declare it in types/" + snake_case(name) + ".toml",
             read_type_table);
}

std::optional<Index> Library::unit(const std::string& name, const Position& place) {
  return get(units_, name, place, "unit type", "declare it in units/" + name + "/" + name + ".toml",
             read_unit_table);
}

std::optional<Index> Library::interface(const std::string& name, const Position& place) {
  const std::string file = snake_case(name);
  return get(interfaces_, name, place, "interface",
             "declare it in hal/" + file + "/interface/" + file + ".toml", read_interface_table);
}

std::optional<Index> Library::driver(Index interface, const std::string& name, const Position& place) {
  find_drivers();
  const std::string& wanted = model_.interfaces[interface].class_name;
  std::vector<std::string> known;
  for (DriverEntry& entry : drivers_) {
    if (entry.interface != wanted) continue;
    known.push_back(entry.name);
    if (entry.name != name) continue;
    if (!entry.read) {
      entry.read = true;
      if (const auto root = parse(entry.file)) entry.index = read_driver_table(*this, *root, entry.file);
    }
    return entry.index;
  }
  diagnostics_.error(place, "unknown driver " + quote(name) + " of " + wanted,
                     suggest(name, known, "drivers", "no driver of " + wanted + " is in the search folders"));
  return std::nullopt;
}

void Library::read_types(const fs::path& folder) {
  for (const fs::path& file : sorted_tables(folder)) {
    const std::string name = camel_case(file.stem().string());
    if (!types_.contains(name)) add_entry(types_, name, file, "type");
    type(name, {intern(file.generic_string()), 1, 1});
  }
}

std::optional<Index> Library::read_unit(const fs::path& file) {
  const auto root = parse(file);
  return root ? read_unit_table(*this, *root, file) : std::nullopt;
}

std::optional<Index> Library::read_interface(const fs::path& file) {
  const std::string name = camel_case(file.stem().string());
  if (!interfaces_.contains(name)) add_entry(interfaces_, name, file, "interface");
  return interface(name, {intern(file.generic_string()), 1, 1});
}

std::optional<Index> Library::read_driver(const fs::path& file) {
  const auto root = parse(file);
  return root ? read_driver_table(*this, *root, file) : std::nullopt;
}

}  // namespace flexrf::config_gen
