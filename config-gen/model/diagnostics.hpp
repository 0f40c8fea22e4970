// What is wrong with the tables: all of it at once, sorted by place, each with what to do about it.
#pragma once

#include <array>
#include <cstddef>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "config-gen/model/hint.hpp"
#include "config-gen/model/position.hpp"

namespace flexrf::config_gen {

enum class Severity { error, warning };

struct Diagnostic {
  Severity severity = Severity::error;
  Position position;
  std::string text;
  std::string hint;       // empty: none
  std::string instance;   // the group instance in which it was found ("axis[2]"), empty outside of groups
  Position instantiated;  // the row of that instance
  std::optional<Replacement> replacement;  // of a word at `position`, where that is what the hint says
};

// Thrown where it makes no sense to go on; read() and check() end there. So what one mistake makes is
// bounded, in messages, time and memory.
struct GivenUp {};

class Diagnostics {
 public:
  void error(const Position& position, std::string text, Hint hint);
  void warning(const Position& position, std::string text, Hint hint);

  // Adds the error, and nothing after it is looked at: throws GivenUp.
  [[noreturn]] void give_up(const Position& position, std::string text, Hint hint);

  // Errors added until leave() belong to this instance of a group. The same error in several instances of one
  // group is kept once, with the first instance.
  void enter(std::string instance, const Position& instantiated);
  void leave();

  bool failed() const;  // an error, not only warnings
  std::size_t errors() const { return counts_[static_cast<std::size_t>(Severity::error)].all; }
  bool gave_up() const { return gave_up_; }  // also after more than max_errors
  std::vector<Diagnostic> sorted() const;
  // `file:line:column: error: text`, then `file:line:column: hint: text`, sorted by file and place. Of more
  // than max_messages_shown the first errors, and how many are left out.
  void print(std::ostream& out) const;

 private:
  void add(Severity severity, const Position& position, std::string text, Hint hint);

  struct Instance {
    std::string name;
    Position position;
  };
  // What is wrong with all instances, or all rows of a list, is said once: alike are messages of one place
  // that differ within brackets only.
  using Key = std::tuple<Position, Severity, std::string>;
  struct Alike {
    std::size_t first = 0;           // in all_
    std::set<std::string> messages;  // with the instances they are of
  };

  std::vector<Diagnostic> all_;  // of each kind the first
  std::map<Key, Alike> alike_;
  struct Count {
    std::size_t different = 0;
    std::size_t all = 0;
    std::size_t left_out = 0;  // warnings only
  };
  std::array<Count, 2> counts_;  // by severity
  bool gave_up_ = false;
  std::vector<Instance> instances_;
};

}  // namespace flexrf::config_gen
