// GRUB's script language as its manual describes it (chapter 6, "Shell-like scripting"), as far as grub.cfg
// goes: whatever else stands in a script is an error here, so that nothing in it goes untested.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace flexrf::boot {

struct ScriptError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ScriptPart {
  std::string text;  ///< or the variable's name
  bool is_variable = false;
  bool is_quoted = false;  ///< a variable outside of quotes may become several words, or none
};
using ScriptWord = std::vector<ScriptPart>;

struct ScriptCommand;
using ScriptCommands = std::vector<ScriptCommand>;

struct ScriptBranch {
  ScriptCommands condition;
  ScriptCommands body;
};

struct ScriptCommand {
  enum class Kind { simple, conditional, function, menu_entry };

  Kind kind = Kind::simple;
  int line = 0;
  std::vector<ScriptWord> words;       ///< of a function its name alone, of a menu entry title and options
  std::vector<ScriptBranch> branches;  ///< if and elif
  ScriptCommands otherwise;            ///< else
  ScriptCommands body;                 ///< of a function or a menu entry
};

/// Throws ScriptError, with the line.
ScriptCommands parse_script(std::string_view source);

}  // namespace flexrf::boot
