#include "config-gen/read/tree.hpp"

#include <toml++/toml.h>

#include <algorithm>

#include "config-gen/model/source_text.hpp"

namespace flexrf::config_gen {
namespace {

Position at(std::string_view file, const toml::source_position& place) {
  return {file, place.line, place.column};
}

Node convert(const toml::node& node, std::string_view file) {
  Node result;
  result.position = at(file, node.source().begin);
  if (const auto* table = node.as_table()) {
    result.kind = Node::Kind::table;
    for (const auto& [key, value] : *table) {
      Node child = convert(value, file);
      child.key = std::string(key.str());
      child.key_position = at(file, key.source().begin);
      if (child.kind == Node::Kind::table && !value.as_table()->is_inline())
        child.position = child.key_position;
      result.children.push_back(std::move(child));
    }
    std::stable_sort(result.children.begin(), result.children.end(),
                     [](const Node& a, const Node& b) { return a.key_position < b.key_position; });
  } else if (const auto* array = node.as_array()) {
    result.kind = Node::Kind::array;
    for (const toml::node& element : *array) result.children.push_back(convert(element, file));
  } else if (const auto* text = node.as_string()) {
    result.kind = Node::Kind::text;
    result.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = Node::Kind::integer;
    result.integer = integer->get();
  } else if (const auto* real = node.as_floating_point()) {
    result.kind = Node::Kind::real;
    result.real = real->get();
  } else if (const auto* truth = node.as_boolean()) {
    result.kind = Node::Kind::boolean;
    result.boolean = truth->get();
  } else {
    result.kind = Node::Kind::other;
  }
  return result;
}

std::string hint_for(std::string_view description) {
  const auto says = [&](std::string_view part) { return description.find(part) != std::string_view::npos; };
  if (says("cannot redefine")) return "rename one of the two, or remove it";
  if (says("end-of-file")) return "something opened above is never closed: look for a missing ], }, or quote";
  if (says("parsing string") || says("literal string") || says("basic string") || says("control characters"))
    return "add the closing quote on the same line";
  if (says("expected value")) return "write a value after the =";
  if (says("could not determine value type") || says("expected a comment or whitespace") ||
      says("expected comma"))
    return "texts, durations and sizes are written in double quotes, as in \"7 ms\"";
  if (says("table header")) return "a table starts with a line as [unit.jog]";
  return "the file must be valid TOML 1.0: https://toml.io/en/v1.0.0";
}

// "Error while parsing string: ..." as "this is not TOML: while reading a string: ...".
std::string text_for(std::string_view description) {
  if (description.find("cannot redefine") != std::string_view::npos) {
    const std::size_t quote = description.find('\'');
    if (quote != std::string_view::npos)
      return std::string(description.substr(quote)) + " is written twice in this file";
  }
  if (description.find("control characters") != std::string_view::npos)
    return "this is not TOML: a text without its closing quote";
  constexpr std::string_view start = "Error while parsing ";
  if (!description.starts_with(start)) return "this is not TOML: " + std::string(description);
  description.remove_prefix(start.size());
  const std::size_t colon = description.find(": ");
  if (colon == std::string_view::npos) return "this is not TOML: " + std::string(description);
  return "this is not TOML: " + std::string(description.substr(colon + 2)) + " (in its " +
         std::string(description.substr(0, colon)) + ")";
}

}  // namespace

const Node* Node::find(std::string_view name) const {
  for (const Node& child : children)
    if (child.key == name) return &child;
  return nullptr;
}

std::string kind_text(Node::Kind kind) {
  switch (kind) {
    case Node::Kind::boolean:
      return "true or false";
    case Node::Kind::integer:
      return "a whole number";
    case Node::Kind::real:
      return "a number with a fraction";
    case Node::Kind::text:
      return "a text";
    case Node::Kind::array:
      return "a list";
    case Node::Kind::table:
      return "a table";
    case Node::Kind::other:
      break;
  }
  return "a date or time";
}

std::optional<Node> parse_text(std::string_view toml, const std::filesystem::path& file,
                               Diagnostics& diagnostics) {
  const std::string_view name = intern(file.generic_string());
  if (!check_utf8(toml, name, diagnostics) || !check_nesting(toml, name, diagnostics)) return std::nullopt;
  try {
    const toml::table table = toml::parse(toml, name);
    Node root = convert(table, name);
    root.position = root.key_position = {name, 1, 1};
    return root;
  } catch (const toml::parse_error& error) {
    diagnostics.error(at(name, error.source().begin), text_for(error.description()),
                      hint_for(error.description()));
    return std::nullopt;
  }
}

std::optional<Node> parse_file(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const auto text = read_source(file, diagnostics);
  return text ? parse_text(*text, file, diagnostics) : std::nullopt;
}

}  // namespace flexrf::config_gen
