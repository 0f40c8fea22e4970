#include "config-gen/fix/name_counts.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "config-gen/fix/word_place.hpp"

namespace flexrf::config_gen {
namespace {

bool is_prose(std::string_view key) {
  constexpr std::array<std::string_view, 4> keys = {"summary", "label", "confirm", "menu"};
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

void NameCounts::add(const Node& table) {
  add_table(table, 0);
}

void NameCounts::add_table(const Node& table, std::size_t depth) {
  for (const Node& child : table.children) {
    // A row [KIND.NAME] declares its name, but for [slot.NAME] and [queue.NAME]: those come to be where they
    // are written.
    const bool is_row = depth == 1 && child.kind == Node::Kind::table && table.kind == Node::Kind::table &&
                        table.key != "slot" && table.key != "queue";
    if (is_row)
      declare(child.key, child.key_position);
    else if (!child.key.empty())
      add_text(child.key);
    if (child.kind == Node::Kind::table && !(depth == 0 && child.key == "renamed"))
      add_table(child, depth + 1);
    if (child.kind == Node::Kind::array) add_table(child, depth + 1);
    if (child.kind != Node::Kind::text || is_prose(child.key)) continue;
    if (table.key == "out")
      declare(child.text, child.position);
    else
      add_text(child.text);
  }
}

void NameCounts::add(const CsvTable& list) {
  const std::optional<std::size_t> names = list.column("name");
  for (const CsvCell& header : list.header) add_text(header.text);
  for (const CsvRow& row : list.rows)
    for (std::size_t column = 0; column < row.cells.size(); ++column)
      if (names == column)
        declare(row[column].text, row[column].position);
      else
        add_text(row[column].text);
}

void NameCounts::add_text(std::string_view text) {
  for (std::string& part : parts_of_name(text)) ++counts_[std::move(part)].references;
}

void NameCounts::declare(const std::string& name, const Position& position) {
  NameCount& count = counts_[name];
  if (!count.declared_at) count.declared_at = position;
}

const NameCount& NameCounts::of(std::string_view name) const {
  static const NameCount none;
  const auto found = counts_.find(name);
  return found == counts_.end() ? none : found->second;
}

std::vector<std::string> parts_of_name(std::string_view name) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < name.size();) {
    std::size_t end = at;
    while (end < name.size() && is_bare(name[end])) ++end;
    if (end > at) parts.emplace_back(name.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::vector<std::pair<std::string, std::string>> differing_parts(std::string_view one,
                                                                 std::string_view other) {
  const std::vector<std::string> parts = parts_of_name(one);
  const std::vector<std::string> others = parts_of_name(other);
  if (parts.size() != others.size()) return {{std::string(one), std::string(other)}};
  std::vector<std::pair<std::string, std::string>> differing;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i] != others[i]) differing.emplace_back(parts[i], others[i]);
  return differing;
}

}  // namespace flexrf::config_gen
