// A PC from its power button to a running slot: its disk, and GRUB with the repository's grub.cfg.
#pragma once

#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "image/boot/choice.hpp"
#include "image/boot/environment.hpp"
#include "image/boot/tests/grub_machine.hpp"
#include "image/boot/tests/lost_power.hpp"

namespace flexrf::boot {

inline ScriptCommands read_script(const char* path) {
  std::ifstream file(path);
  const std::string source{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return parse_script(source);
}

inline std::string path_on_esp(const std::string& name) {
  return "(hd0,gpt2)/flexrf/" + name;
}

/// With both slots on the disk, whether they are whole or not, and these files.
inline GrubMachine machine_with(const Files& files) {
  GrubMachine machine;
  machine.partitions = {{"(hd0,gpt5)", "identifier-of-root-a"}, {"(hd0,gpt6)", "identifier-of-root-b"}};
  for (const auto& [name, bytes] : files)
    if (!bytes.empty()) machine.files[path_on_esp(name)] = bytes;
  for (const char* partition : {"(hd0,gpt3)/", "(hd0,gpt4)/"}) {
    machine.files[std::string(partition) + "vmlinuz"] = "kernel";
    machine.files[std::string(partition) + "initrd.img"] = "initrd";
    machine.files[std::string(partition) + "slot.env"] =
        "# GRUB Environment Block\nslot_options=isolcpus=1 quiet\n" + std::string(900, '#');
  }
  return machine;
}

/// What runs then, and tells the kernel's command line of; GRUB's counting is in the files.
inline Running switch_on(const ScriptCommands& script, Files& files) {
  GrubMachine machine = machine_with(files);
  const Started started = machine.start(script);
  for (const char* name : {copy_names[0], copy_names[1], attempts_name}) {
    const auto found = machine.files.find(path_on_esp(name));
    files[name] = found == machine.files.end() ? std::string{} : found->second;
  }
  return running_from(started.command_line());
}

}  // namespace flexrf::boot
