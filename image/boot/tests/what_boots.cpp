// boot_choice_what_boots FOLDER GRUB_CFG: which slot GRUB starts with these files of a disk, as "A only";
// before and after the repair that the version which it starts begins with. Exit code 1, and why, where
// nothing starts, or after the repair something is damaged.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

#include "image/boot/tests/pc.hpp"
#include "image/boot/verbs.hpp"

namespace {

using namespace flexrf::boot;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

int tell(const std::string& folder, const char* grub_cfg) {
  const ScriptCommands script = read_script(grub_cfg);
  Files files;
  for (const char* name : {copy_names[0], copy_names[1], attempts_name})
    files[name] = text_of(folder + '/' + name);
  const Running first = switch_on(script, files);
  if (!first.slot) {
    std::puts("GRUB starts no slot");
    return 1;
  }
  LostPowerDisk disk(files);
  const Outcome repaired = perform({"repair"}, disk, first);
  for (const std::string& line : repaired.said) std::printf("%s\n", line.c_str());
  if (repaired.exit != Exit::done && repaired.exit != Exit::repaired) return 1;
  disk.settle();
  for (auto& [name, bytes] : files) {
    const flexrf::Result<std::string> now = disk.read(name);
    bytes = now ? *now : std::string{};
  }
  const Running second = switch_on(script, files);
  std::printf("%c %s\n", letter_of(*first.slot), first.why.c_str());
  if (second.slot == first.slot) return 0;
  std::puts("after the repair another slot starts");
  return 1;
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 3) return 2;
  try {
    return tell(arguments[1], arguments[2]);
  } catch (const std::exception& failure) {
    std::printf("%s\n", failure.what());
    return 1;
  }
}
