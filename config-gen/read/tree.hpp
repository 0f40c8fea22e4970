// A TOML file as a tree that keeps what toml++ loses: source order, and the place of every key and value.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/position.hpp"

namespace flexrf::config_gen {

struct Node {
  enum class Kind { boolean, integer, real, text, array, table, other };
  Kind kind = Kind::table;
  Position position;      // of the value; of a table made by a header or a dotted key, of its key
  Position key_position;  // of the key, in tables
  std::string key;
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;
  std::string text;
  bool broken = false;         // what it should be is unknown, and was reported
  bool cell = false;           // of a list in CSV: `kind` is what it looks like, `text` what stands there
  Position listed;             // of a row that stands in a list: where the table names that list
  std::vector<Node> children;  // of a table by source position, of an array in order

  const Node* find(std::string_view name) const;
};

// "a text", "a whole number", ...: what a value is, for messages.
std::string kind_text(Node::Kind kind);

// Nothing when the file cannot be read or has a syntax error, which is then in `diagnostics`.
std::optional<Node> parse_file(const std::filesystem::path& file, Diagnostics& diagnostics);
std::optional<Node> parse_text(std::string_view toml, const std::filesystem::path& file,
                               Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
