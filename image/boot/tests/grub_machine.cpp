#include "image/boot/tests/grub_machine.hpp"

#include <sstream>
#include <utility>

#include "image/boot/tests/grub_commands.hpp"

namespace flexrf::boot {
namespace {

class Run {
 public:
  explicit Run(GrubMachine& machine) : machine_(machine) {}

  Started start(const ScriptCommands& script, std::optional<std::size_t> chosen) {
    machine_.variables = machine_.firmware;
    execute(script);
    if (!chosen) {
      if (machine_.variables["timeout"] != "0") throw ScriptError("GRUB would wait for somebody");
      chosen = static_cast<std::size_t>(std::stoul(machine_.variables["default"]));
    }
    if (*chosen >= entries_.size()) throw ScriptError("there is no such entry");
    const ScriptCommand& entry = *entries_[*chosen];
    if (entry.words.size() > 3) throw ScriptError("a menu entry with options that are not known here");
    const bool is_unrestricted = entry.words.size() == 3 && text_of(entry.words[2]) == "--unrestricted";
    // Who knows the password may start all; the default has to start without one.
    if (machine_.variables["superusers"].empty()) throw ScriptError("everybody may do everything");
    if (is_unrestricted != (*chosen == 0)) throw ScriptError("an entry with, or without, a password");
    try {
      execute(entry.body);
    } catch (const GrubHasLeft&) {
      return started_;
    }
    return {};
  }

 private:
  static std::string text_of(const ScriptWord& word) {
    std::string text;
    for (const ScriptPart& part : word) text += part.text;
    return text;
  }

  std::string value_of(const std::string& name) const {
    if (name[0] >= '0' && name[0] <= '9') {
      const auto number = static_cast<std::size_t>(name[0] - '0');
      return number < arguments_.size() ? arguments_[number] : std::string{};
    }
    const auto found = machine_.variables.find(name);
    return found == machine_.variables.end() ? std::string{} : found->second;
  }

  void expand(const ScriptWord& word, std::vector<std::string>& words) const {
    std::string text;
    bool is_word = false;
    for (const ScriptPart& part : word) {
      if (!part.is_variable || part.is_quoted) {
        text += part.is_variable ? value_of(part.text) : part.text;
        is_word = is_word || part.is_quoted || !part.text.empty();
        continue;
      }
      std::istringstream values(value_of(part.text));
      bool is_first = true;
      for (std::string value; values >> value; is_first = false) {
        if (!is_first) {
          words.push_back(text);
          text.clear();
        }
        text += value;
        is_word = true;
      }
    }
    if (is_word && !(text.empty() && machine_.loses_empty_words)) words.push_back(text);
  }

  bool execute(const ScriptCommands& commands) {
    bool is_good = true;
    for (const ScriptCommand& command : commands) is_good = execute(command);
    return is_good;
  }

  bool execute(const ScriptCommand& command) {
    try {
      switch (command.kind) {
        case ScriptCommand::Kind::conditional:
          return execute_conditional(command);
        case ScriptCommand::Kind::function:
          functions_[text_of(command.words[0])] = &command.body;
          return true;
        case ScriptCommand::Kind::menu_entry:
          entries_.push_back(&command);
          return true;
        case ScriptCommand::Kind::simple:
          break;
      }
      return execute_simple(command);
    } catch (const ScriptError& error) {
      const std::string text = error.what();
      if (text.rfind("line ", 0) == 0) throw;
      throw ScriptError("line " + std::to_string(command.line) + ": " + text);
    }
  }

  bool execute_conditional(const ScriptCommand& command) {
    for (const ScriptBranch& branch : command.branches)
      if (execute(branch.condition)) return execute(branch.body);
    return execute(command.otherwise);
  }

  bool execute_simple(const ScriptCommand& command) {
    std::vector<std::string> words;
    for (const ScriptWord& word : command.words) expand(word, words);
    if (words.empty()) throw ScriptError("a command without a word");
    const auto function = functions_.find(words[0]);
    if (function != functions_.end()) {
      std::swap(arguments_, words);
      const bool is_good = execute(*function->second);
      std::swap(arguments_, words);
      return is_good;
    }
    if (words[0] == "source") {
      const auto file = words.size() == 2 ? machine_.files.find(words[1]) : machine_.files.end();
      if (file == machine_.files.end()) return false;
      sources_.push_back(parse_script(file->second));
      return execute(sources_.back());
    }
    if (words[0] == "password_pbkdf2") return words.size() == 3;
    return run_grub_command(machine_, started_, words);
  }

  GrubMachine& machine_;
  Started started_;
  std::map<std::string, const ScriptCommands*> functions_;
  std::vector<const ScriptCommand*> entries_;
  std::vector<std::string> arguments_;  // of the function that is called, its name first
  std::vector<ScriptCommands> sources_;
};

}  // namespace

std::string Started::option(const std::string& name) const {
  for (const std::string& option : options)
    if (option.rfind(name + '=', 0) == 0) return option.substr(name.size() + 1);
  return {};
}

std::string Started::command_line() const {
  std::string line;
  for (const std::string& option : options) line += option + ' ';
  return line;
}

Started GrubMachine::start(const ScriptCommands& script) {
  return Run(*this).start(script, std::nullopt);
}

Started GrubMachine::start_entry(const ScriptCommands& script, std::size_t entry) {
  return Run(*this).start(script, entry);
}

}  // namespace flexrf::boot
