// flexrf-boot-choice: which of the two versions on the disk of an industrial PC boots (docs/image.md).

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/standard_descriptors.hpp"
#include "image/boot/folder_medium.hpp"
#include "image/boot/verbs.hpp"

namespace {

using namespace flexrf::boot;

constexpr const char* usage =
    "flexrf-boot-choice [OPTION...] VERB [ARGUMENT...]\n"
    "Says and sets which of the two versions on this disk boots, and repairs what says so.\n";
constexpr const char* options_help =
    "options:\n"
    "  --folder DIR                where the files are; else /boot/efi/flexrf\n"
    "  --kernel-command-line FILE  tells which slot runs; else /proc/cmdline\n"
    "  --notice FILE               holds afterwards what was said, for the panel; no file if nothing was\n"
    "Exit code: 0 done; 1 wrong usage; 2 something was damaged and is repaired; 3 something cannot be read,\n"
    "written or locked; 4 refused, as the state does not allow it.\n";

constexpr std::chrono::seconds lock_wait{10};

struct Arguments {
  std::string folder = "/boot/efi/flexrf";
  std::string kernel_command_line = "/proc/cmdline";
  std::string notice;
  std::vector<std::string> words;
};

int end(Exit code) {
  return static_cast<int>(code);
}

void say(const std::string& line) {
  std::fprintf(stderr, "flexrf-boot-choice: %s\n", line.c_str());
}

int misuse(const std::string& what) {
  say(what);
  std::fprintf(stderr, "%s%s%s", usage, verbs_help, options_help);
  return end(Exit::usage);
}

// Whoever looks at it finds the lines of before or these, never half of them.
bool leave_notice(const std::string& path, const std::vector<std::string>& lines) {
  if (lines.empty()) return ::unlink(path.c_str()) == 0 || errno == ENOENT;
  const std::string fresh = path + ".new";
  std::ofstream file(fresh, std::ios::trunc);
  for (const std::string& line : lines) file << line << '\n';
  file.close();
  return file.good() && std::rename(fresh.c_str(), path.c_str()) == 0;
}

int run(const Arguments& arguments) {
  std::ifstream file(arguments.kernel_command_line);
  const std::string command_line{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  FolderMedium medium;
  Outcome outcome;
  if (const flexrf::Status opened = medium.open(arguments.folder, lock_wait); opened)
    outcome = perform(arguments.words, medium, running_from(command_line));
  else
    outcome = {Exit::failed, {}, {opened.cause()}};
  for (const std::string& line : outcome.said) say(line);
  std::fputs(outcome.answer.c_str(), stdout);
  if (std::fflush(stdout) != 0) outcome.exit = Exit::failed;
  if (!arguments.notice.empty() && !leave_notice(arguments.notice, outcome.said)) {
    say("cannot write " + arguments.notice + ": " + std::strerror(errno));
    if (outcome.exit == Exit::done) outcome.exit = Exit::failed;
  }
  return end(outcome.exit);
}

}  // namespace

int main(int argument_count, char** words) {
  flexrf::hold_standard_descriptors();
  Arguments arguments;
  int i = 1;
  for (; i < argument_count && words[i][0] == '-'; ++i) {
    const std::string word = words[i];
    if (word == "--help" || word == "-h") {
      std::printf("%s%s%s", usage, verbs_help, options_help);
      return end(Exit::done);
    }
    std::string* const value = word == "--folder"                ? &arguments.folder
                               : word == "--kernel-command-line" ? &arguments.kernel_command_line
                               : word == "--notice"              ? &arguments.notice
                                                                 : nullptr;
    if (value == nullptr) return misuse("there is no option '" + word + "'");
    if (++i == argument_count) return misuse(word + " needs a value");
    *value = words[i];
  }
  arguments.words.assign(words + i, words + argument_count);
  if (const auto wrong = misuse_of(arguments.words)) return misuse(*wrong);
  return run(arguments);
}
