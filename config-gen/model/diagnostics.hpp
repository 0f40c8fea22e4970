// What is wrong with the tables: all of it at once, sorted by place, each with what to do about it.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

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
};

class Diagnostics {
 public:
  void error(const Position& position, std::string text, std::string hint);
  void warning(const Position& position, std::string text, std::string hint);

  // Errors added until leave() belong to this instance of a group. The same error in several instances of one
  // group is kept once, with the first instance.
  void enter(std::string instance, const Position& instantiated);
  void leave();

  bool failed() const;  // an error, not only warnings
  std::vector<Diagnostic> sorted() const;
  // `file:line:column: error: text`, then `file:line:column: hint: text`, sorted by file and place.
  void print(std::ostream& out) const;

 private:
  void add(Severity severity, const Position& position, std::string text, std::string hint);

  struct Instance {
    std::string name;
    Position position;
  };
  std::vector<Diagnostic> all_;
  std::vector<Instance> instances_;
};

}  // namespace flexrf::config_gen
