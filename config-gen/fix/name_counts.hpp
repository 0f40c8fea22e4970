// How often each name stands in the tables and lists of a cell, and where one of them declares it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config-gen/model/position.hpp"
#include "config-gen/read/csv.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

struct NameCount {
  std::size_t references = 0;  // all places but those that declare it
  Position declared_at;        // the first; none: it is a key or a word of FlexRF's, or the name of a file
};

// Counts whole parts of names: "jog.step" and "axis[2].jog" are places of "jog". What people write to be read
// by people, as a summary, has no names in it.
class NameCounts {
 public:
  void add(const Node& table);
  void add(const CsvTable& list);

  const NameCount& of(std::string_view name) const;

 private:
  void add_table(const Node& table, std::size_t depth);
  void add_text(std::string_view text);
  void declare(const std::string& name, const Position& position);

  std::map<std::string, NameCount, std::less<>> counts_;
};

// "jog.step" as "jog" and "step", "axis[2]" as "axis" and "2".
std::vector<std::string> parts_of_name(std::string_view name);

// The parts in which two names differ; the names themselves where they have other numbers of parts.
std::vector<std::pair<std::string, std::string>> differing_parts(std::string_view one,
                                                                 std::string_view other);

}  // namespace flexrf::config_gen
