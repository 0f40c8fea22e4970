#include "config-gen/read/parts.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "config-gen/model/words.hpp"
#include "config-gen/read/device_list.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

using Words = std::set<std::string>;

std::string line(std::string_view key, const Words& words) {
  std::string text;
  for (const std::string& word : words)
    if (is_build_word(word)) text += " " + word;
  return text.empty() ? "" : std::string(key) + text + "\n";
}

std::string text_of(const Node& table, std::string_view key, const std::string& otherwise = "") {
  const Node* value = table.find(key);
  return value != nullptr && value->kind == Node::Kind::text ? value->text : otherwise;
}

// A text, or all texts of a list.
Words texts_of(const Node& table, std::string_view key) {
  Words words;
  const Node* value = table.find(key);
  if (value == nullptr) return words;
  if (value->kind == Node::Kind::text) words.insert(value->text);
  for (const Node& element : value->children)
    if (element.kind == Node::Kind::text) words.insert(element.text);
  return words;
}

std::vector<const Node*> rows(const Node& root, std::string_view section) {
  std::vector<const Node*> found;
  if (const Node* table = root.find(section))
    for (const Node& row : table->children) found.push_back(&row);
  return found;
}

std::optional<Node> read(const fs::path& table) {
  Diagnostics unused;
  return parse_file(table, unused);
}

void add_listed(Node& table, const fs::path& folder, std::vector<fs::path>& lists) {
  Diagnostics unused;
  try {
    add_listed_devices(table, folder, unused, lists);
  } catch (const GivenUp&) {
    // A list with a thousand errors.
  }
}

std::string parts_of_unit(const Node& root, const std::string& stem) {
  Words interfaces;
  for (const Node* device : rows(root, "device")) interfaces.merge(texts_of(*device, "interface"));
  return line("name", {stem}) + line("interfaces", interfaces);
}

std::string parts_of_interface(const Node& root, const std::string& stem) {
  return line("name", {stem}) + line("class", {text_of(root, "class", camel_case(stem))});
}

std::string parts_of_driver(const Node& root, const std::string& stem) {
  Words interfaces = texts_of(root, "interface");
  interfaces.merge(texts_of(root, "on"));
  Words ports;
  for (const char* kind : {"input", "output"})
    if (root.find(kind) != nullptr) ports.insert(kind);
  return line("name", {text_of(root, "name", stem)}) + line("class", texts_of(root, "interface")) +
         line("interfaces", interfaces) + line("ports", ports) +
         line("libraries", texts_of(root, "libraries")) + line("packages", texts_of(root, "packages"));
}

constexpr int most_arguments = 3;  // in one text: a bound for texts that are not meant

// All that a text can mean: with an argument of a group in it, each value that there is for one.
void add_meant(const std::string& text, const Words& values, int arguments, Words& words) {
  const std::size_t begin = text.find("${");
  const std::size_t end = text.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) {
    words.insert(text);
  } else if (arguments < most_arguments) {
    for (const std::string& value : values)
      add_meant(text.substr(0, begin) + value + text.substr(end + 1), values, arguments + 1, words);
  }
}

Words meant(const Words& texts, const Words& values) {
  Words words;
  for (const std::string& text : texts) add_meant(text, values, 0, words);
  return words;
}

std::string parts_of_application(const fs::path& table) {
  std::vector<fs::path> files{table};
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(table.parent_path() / "groups", ignored))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::vector<Node> roots;
  std::vector<fs::path> lists;
  for (const fs::path& file : files) {
    auto root = read(file);
    if (!root) continue;
    add_listed(*root, table.parent_path(), lists);
    roots.push_back(std::move(*root));
  }

  Words values;
  for (const Node& root : roots) {
    for (const Node* group : rows(root, "group"))
      if (const Node* with = group->find("with"))
        for (const Node& value : with->children) values.merge(texts_of(*with, value.key));
    for (const Node* argument : rows(root, "argument")) values.merge(texts_of(*argument, "default"));
  }
  Words units;
  Words drivers;
  for (const Node& root : roots) {
    for (const Node* unit : rows(root, "unit")) units.merge(meant(texts_of(*unit, "type"), values));
    for (const Node* device : rows(root, "device"))
      for (const std::string& interface : meant(texts_of(*device, "interface"), values))
        for (const std::string& driver : meant(texts_of(*device, "drivers"), values))
          drivers.insert(interface + "/" + driver);
  }
  std::string text = line("units", units) + line("drivers", drivers);
  for (const fs::path& list : lists) text += "list " + list.generic_string() + "\n";
  return text;
}

}  // namespace

bool is_build_word(std::string_view word) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_.+-/:").find(c) != std::string_view::npos;
  };
  return !word.empty() && std::all_of(word.begin(), word.end(), is_plain);
}

std::string list_parts(Target::Kind kind, const fs::path& table) {
  if (kind == Target::Kind::application) return parts_of_application(table);
  const auto root = read(table);
  if (!root) return "";
  const std::string stem = table.stem().string();
  switch (kind) {
    case Target::Kind::unit:
      return parts_of_unit(*root, stem);
    case Target::Kind::interface:
      return parts_of_interface(*root, stem);
    case Target::Kind::driver:
      return parts_of_driver(*root, stem);
    case Target::Kind::application:
    case Target::Kind::types:
      break;
  }
  return "";
}

}  // namespace flexrf::config_gen
