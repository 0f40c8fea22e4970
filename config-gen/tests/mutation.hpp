// Tables changed at random, for tests of what config-gen makes of them. A number says which change: the same
// number makes the same change of the same tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config-gen/model/target.hpp"
#include "config-gen/tests/temporary_folder.hpp"

namespace flexrf::config_gen::tests {

// SplitMix64 (Steele, Lea, Flood 2014): the same numbers with every compiler.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  std::size_t below(std::size_t count) { return count == 0 ? 0 : static_cast<std::size_t>(next() % count); }
  bool one_in(std::size_t count) { return below(count) == 0; }
  template <class List>
  const auto& of(const List& list) {
    return list[below(std::size(list))];
  }

 private:
  std::uint64_t state_;
};

void write_file(const std::filesystem::path& file, const std::string& text);

// An application with all that its tables can name.
struct Cell {
  std::filesystem::path table;
  SearchPaths paths;
  std::vector<std::filesystem::path> files;  // what its check reads
};

// A copy of the repository's tables, lists and data sheets, in a folder of its own that goes with the object.
class TableTree {
 public:
  explicit TableTree(const std::filesystem::path& repository);

  const std::filesystem::path& root() const { return folder_.path(); }
  // Applications, and the small cells that the generator's tests are made of, broken ones too.
  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<std::string>& words() const { return words_; }  // all that stands in double quotes

 private:
  void add(const std::filesystem::path& table, const SearchPaths& paths);

  TemporaryFolder folder_;
  std::vector<Cell> cells_;
  std::vector<std::string> words_;
};

// Some files of a cell changed, and as they were again when the object goes.
class Mutation {
 public:
  // `may_change` tells which of the cell's files are touched.
  Mutation(const TableTree& tree, const Cell& cell, std::uint64_t number,
           const std::function<bool(const std::filesystem::path&)>& may_change);
  ~Mutation();
  Mutation(const Mutation&) = delete;
  Mutation& operator=(const Mutation&) = delete;

  // What was changed, for whoever reads a failure: files, and the lines that differ, shortened.
  std::string description() const;
  bool empty() const { return before_.empty(); }

 private:
  void store(const std::filesystem::path& file, const std::string& text);
  void rename_word(const Cell& cell, Dice& dice,
                   const std::function<bool(const std::filesystem::path&)>& may_change);

  std::map<std::filesystem::path, std::string> before_;
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> renamed_;  // from, to
};

}  // namespace flexrf::config_gen::tests
