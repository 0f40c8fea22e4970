#include "config-gen/read/arguments.hpp"

#include <algorithm>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/literal.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::string_view index_name = "index";

std::string text_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::boolean:
      return node.boolean ? "true" : "false";
    case Node::Kind::integer:
      return std::to_string(node.integer);
    case Node::Kind::real:
      return literal_text(Literal{node.real, {}, {}});
    default:
      return node.text;
  }
}

// As `value`, in the place of `node`.
void replace(Node& node, const Node& value) {
  Node result = value;
  result.key = node.key;
  result.key_position = node.key_position;
  result.position = node.position;
  node = std::move(result);
}

Node integer_node(std::size_t value) {
  Node node;
  node.kind = Node::Kind::integer;
  node.integer = static_cast<std::int64_t>(value);
  return node;
}

Node broken_node() {
  Node node;
  node.broken = true;
  return node;
}

class Filler {
 public:
  Filler(const Arguments& arguments, std::optional<std::size_t> index, bool in_group,
         Diagnostics& diagnostics)
      : arguments_(arguments), index_(index), in_group_(in_group), diagnostics_(diagnostics) {
    for (const auto& [name, value] : arguments) known_.push_back(name);
    known_.emplace_back(index_name);
  }

  void fill(Node& node, bool keep_index) {
    if (node.kind == Node::Kind::text || node.cell) fill_text(node, keep_index);
    for (Node& child : node.children) fill(child, keep_index);
  }

 private:
  void fill_text(Node& node, bool keep_index) {
    std::size_t start = 0;
    while ((start = node.text.find("${", start)) != std::string::npos) {
      const std::size_t end = node.text.find('}', start);
      if (end == std::string::npos) {
        diagnostics_.error(node.position, "a ${ without its }", "write arguments as \"${name}\"");
        node.broken = true;
        return;
      }
      const std::string name = node.text.substr(start + 2, end - start - 2);
      if (name == index_name && keep_index) {
        start = end;
        continue;
      }
      const auto value = look_up(name, node.position);
      node.broken = !value || value->broken;
      if (node.broken) return;
      if (start == 0 && end + 1 == node.text.size()) {
        replace(node, *value);
        return;
      }
      const std::string text = text_of(*value);
      node.text.replace(start, end + 1 - start, text);
      start += text.size();
    }
  }

  std::optional<Node> look_up(const std::string& name, const Position& position) {
    if (name == index_name && index_) return integer_node(*index_);
    if (const auto found = arguments_.find(name); found != arguments_.end()) return found->second;
    if (!in_group_)
      diagnostics_.error(position, "${" + name + "} has no meaning here",
                         "arguments exist in group tables, and ${index} in [group.NAME] rows");
    else
      diagnostics_.error(position, "unknown argument " + quote(name), suggest(name, known_, "arguments", ""));
    return std::nullopt;
  }

  const Arguments& arguments_;
  std::optional<std::size_t> index_;
  bool in_group_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_;
};

// Arguments are scalars; a text needs no capacity, because it ends up in values that have theirs.
std::optional<Field> argument_field(Row& row, const Node& node) {
  std::vector<std::string> words;
  for (int i = 0; i <= static_cast<int>(Scalar::text); ++i)
    words.push_back(scalar_name(static_cast<Scalar>(i)));
  if (!row.has("type")) row.missing("type", "add type = \"text\", or another scalar");
  const auto scalar = row.word("type", words);
  if (!scalar) return std::nullopt;
  Field field;
  field.name = node.key;
  field.position = node.key_position;
  field.type.scalar = static_cast<Scalar>(*scalar);
  field.capacity = 4096;
  return field;
}

}  // namespace

void fill_in(Node& node, const Arguments& arguments, std::optional<std::size_t> index, bool in_group,
             Diagnostics& diagnostics) {
  Filler filler(arguments, index, in_group, diagnostics);
  for (Node& section : node.children) {
    if (section.key == "argument" || section.key == "port") continue;
    filler.fill(section, section.key == "group");
  }
}

Arguments read_arguments(Library& library, const Node& group, const Node* with, const Node& row) {
  Diagnostics& diagnostics = library.diagnostics();
  Arguments arguments;
  std::vector<std::string> known;
  for (const Node* node : named_rows(library, group, "argument", "an argument")) {
    known.push_back(node->key);
    if (node->key == index_name)
      diagnostics.error(node->key_position, "an argument cannot be named 'index'",
                        "${index} is the instance's number: choose another name");
    Row argument(*node, "[argument." + node->key + "]", diagnostics);
    argument.summary();
    const auto field = argument_field(argument, *node);
    const Node* initial = argument.any("default");
    argument.finish();
    const Node* given = with != nullptr ? with->find(node->key) : nullptr;
    const Node* value = given != nullptr ? given : initial;
    if (value == nullptr) {
      diagnostics.error(
          with != nullptr ? with->key_position : row.key_position,
          "[group." + row.key + "] gives no argument " + quote(node->key),
          "add with = { " + node->key + " = ... }; it is declared at " + to_string(node->key_position));
      arguments.emplace(node->key, broken_node());
      continue;
    }
    const bool good =
        field && !value->broken &&
        read_literal(library.model(), *field, *value, "the argument " + quote(node->key), diagnostics);
    arguments.emplace(node->key, good ? *value : broken_node());
  }
  if (with != nullptr)
    for (const Node& given : with->children)
      if (std::find(known.begin(), known.end(), given.key) == known.end())
        diagnostics.error(given.key_position,
                          "unknown argument " + quote(given.key) + " of the group's table",
                          suggest(given.key, known, "arguments", "this group has no arguments: remove it"));
  return arguments;
}

}  // namespace flexrf::config_gen
