// A PC that GRUB has just been loaded on: its files, and what a grub.cfg does with them until a kernel is
// started.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "image/boot/tests/grub_script.hpp"

namespace flexrf::boot {

/// How GRUB left.
struct Started {
  std::string kernel;                ///< the file's path; empty if none was started
  std::vector<std::string> options;  ///< the kernel's command line
  std::string initrd;
  bool has_restarted = false;  ///< by `reboot`, in place of a kernel

  /// The value of an option of the kernel's command line; empty if it is not there.
  std::string option(const std::string& name) const;
  std::string command_line() const;
};

struct GrubMachine {
  std::map<std::string, std::string> files;       ///< by path, "(hd0,gpt2)/flexrf/choice0.env"
  std::map<std::string, std::string> partitions;  ///< unique identifiers by device, "(hd0,gpt5)"
  std::map<std::string, std::string> firmware = {{"prefix", "(hd0,gpt2)/grub"},
                                                 {"root", "hd0,gpt2"}};  ///< variables at the start
  std::map<std::string, std::string> variables;                          ///< since then
  std::set<std::string> unreadable;  ///< paths that are there, but fail when they are read
  bool can_write = true;             ///< else save_env fails
  bool loses_writes = false;         ///< save_env says that all went well, and nothing is on the disk
  bool loses_empty_words =
      false;  ///< an empty word in quotes vanishes; the manual leaves open whether it does

  /// The script, then the entry that boots without anybody: the timeout is 0. Throws ScriptError for what
  /// GRUB would stop at, or ask a password for.
  Started start(const ScriptCommands& script);
  /// An entry that a person chooses, with the password.
  Started start_entry(const ScriptCommands& script, std::size_t entry);
};

}  // namespace flexrf::boot
