#include "image/boot/tests/grub_commands.hpp"

#include <regex.h>

#include <algorithm>
#include <cstddef>

#include "image/boot/tests/grub_environment.hpp"

namespace flexrf::boot {
namespace {

using Words = std::vector<std::string>;

const std::string* file_at(const GrubMachine& machine, const std::string& path) {
  const auto found = machine.files.find(path);
  return found == machine.files.end() || machine.unreadable.count(path) != 0 ? nullptr : &found->second;
}

// [ A = B ], [ A != B ], [ A <= B ], [ -s FILE ].
bool test(const GrubMachine& machine, Words words) {
  if (words.back() != "]") throw ScriptError("a test without its end");
  words.pop_back();
  if (words.size() == 3 && words[1] == "-s") {
    const auto file = machine.files.find(words[2]);  // looks at the size, and reads nothing
    return file != machine.files.end() && !file->second.empty();
  }
  if (words.size() != 4) throw ScriptError("a test of another form than those known here");
  if (words[2] == "=") return words[1] == words[3];
  if (words[2] == "!=") return words[1] != words[3];
  if (words[2] == "<=") return words[1] <= words[3];
  throw ScriptError("unknown test " + words[2]);
}

// -f FILE NAME...
struct EnvironmentArguments {
  std::string file;
  Words names;
};

EnvironmentArguments environment_arguments(const Words& words) {
  if (words.size() < 4 || words[1] != "-f") throw ScriptError(words[0] + " without -f, or without names");
  return {words[2], {words.begin() + 3, words.end()}};
}

bool load_env(GrubMachine& machine, const Words& words) {
  const EnvironmentArguments arguments = environment_arguments(words);
  const std::string* const file = file_at(machine, arguments.file);
  if (file == nullptr) return false;
  const auto found = grub_variables(*file);
  if (!found) return false;
  for (const auto& [name, value] : *found)
    if (std::find(arguments.names.begin(), arguments.names.end(), name) != arguments.names.end())
      machine.variables[name] = value;
  return true;
}

bool save_env(GrubMachine& machine, const Words& words) {
  const EnvironmentArguments arguments = environment_arguments(words);
  const std::string* const file = file_at(machine, arguments.file);
  if (file == nullptr || !grub_variables(*file)) return false;
  std::string block = *file;
  for (const std::string& name : arguments.names) {
    const auto value = machine.variables.find(name);
    if (value == machine.variables.end()) throw ScriptError("save_env of a variable without a value");
    if (!grub_set(block, name, value->second)) return false;
  }
  if (machine.loses_writes) return true;
  if (!machine.can_write) return false;
  machine.files[arguments.file] = block;
  return true;
}

// GRUB compiles the pattern as a POSIX extended one, as here.
bool regexp(GrubMachine& machine, const Words& words) {
  struct Target {
    std::size_t group;
    std::string name;
  };
  std::vector<Target> targets;
  std::size_t i = 1;
  for (; i < words.size() && words[i].rfind("--set=", 0) == 0; ++i) {
    const std::size_t colon = words[i].find(':');
    if (colon != 7) throw ScriptError("a group without its number");
    targets.push_back({static_cast<std::size_t>(words[i][6] - '0'), words[i].substr(8)});
  }
  if (words.size() != i + 2) return false;
  regex_t pattern;
  if (regcomp(&pattern, words[i].c_str(), REG_EXTENDED) != 0) throw ScriptError("no pattern: " + words[i]);
  regmatch_t groups[10];
  const std::string& text = words[i + 1];
  const bool is_match = regexec(&pattern, text.c_str(), 10, groups, 0) == 0;
  regfree(&pattern);
  if (!is_match) return false;
  for (const Target& target : targets) {
    if (groups[target.group].rm_so < 0) throw ScriptError("a group that is not in the pattern");
    const auto begin = static_cast<std::size_t>(groups[target.group].rm_so);
    const auto end = static_cast<std::size_t>(groups[target.group].rm_eo);
    machine.variables[target.name] = text.substr(begin, end - begin);
  }
  return true;
}

// --set=NAME --part-uuid (DEVICE)
bool probe(GrubMachine& machine, const Words& words) {
  if (words.size() != 4 || words[1].rfind("--set=", 0) != 0 || words[2] != "--part-uuid")
    throw ScriptError("'probe' of another form than the one known here");
  const auto found = machine.partitions.find(words[3]);
  if (found == machine.partitions.end()) return false;
  machine.variables[words[1].substr(6)] = found->second;
  return true;
}

bool set(GrubMachine& machine, const Words& words) {
  const std::size_t equals = words.size() == 2 ? words[1].find('=') : std::string::npos;
  if (equals == std::string::npos) throw ScriptError("'set' takes one NAME=VALUE");
  machine.variables[words[1].substr(0, equals)] = words[1].substr(equals + 1);
  return true;
}

bool linux_kernel(GrubMachine& machine, Started& started, const Words& words) {
  if (words.size() < 2 || file_at(machine, words[1]) == nullptr) return false;
  // Seen with GRUB 2.06: setting the new one unloads the old one, and frees the command line that is the new
  // one's by then.
  if (!started.kernel.empty())
    throw ScriptError("a second kernel, which GRUB would start without its command line");
  started.kernel = words[1];
  started.options.assign(words.begin() + 2, words.end());
  started.initrd.clear();
  return true;
}

bool initrd(GrubMachine& machine, Started& started, const Words& words) {
  if (words.size() != 2 || file_at(machine, words[1]) == nullptr || started.kernel.empty()) return false;
  started.initrd = words[1];
  return true;
}

}  // namespace

bool run_grub_command(GrubMachine& machine, Started& started, const std::vector<std::string>& words) {
  const std::string& name = words[0];
  if (name == "[") return test(machine, words);
  if (name == "set") return set(machine, words);
  if (name == "unset") {
    if (words.size() != 2) throw ScriptError("'unset' takes one name");
    machine.variables.erase(words[1]);
    return true;
  }
  if (name == "load_env") return load_env(machine, words);
  if (name == "save_env") return save_env(machine, words);
  if (name == "regexp") return regexp(machine, words);
  if (name == "probe") return probe(machine, words);
  if (name == "linux") return linux_kernel(machine, started, words);
  if (name == "initrd") return initrd(machine, started, words);
  if (name == "echo" || name == "sleep") return true;
  if (name == "boot") {
    if (started.kernel.empty()) return false;
    throw GrubHasLeft{};
  }
  if (name == "reboot") {
    started = {};
    started.has_restarted = true;
    throw GrubHasLeft{};
  }
  throw ScriptError("unknown command " + name);
}

}  // namespace flexrf::boot
