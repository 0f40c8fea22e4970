// flexrf-helper: says on an industrial PC whether anything may move, and confirms the version that runs
// (docs/image.md). Runs as root, beside the application, which has no rights.

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string>

#include "base/standard_descriptors.hpp"
#include "image/helper/helper.hpp"
#include "image/helper/panel_health.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::helper;

constexpr const char* usage =
    "flexrf-helper [OPTION...]\n"
    "Says whether anything may move on this PC, and confirms the version that runs when it is healthy.\n"
    "options:\n"
    "  --word FILE                  gets the word; else /run/flexrf-helper/motion\n"
    "  --users FILE                 who may log in; else /data/flexrf/panel-users\n"
    "  --folder DIR                 the boot choice; else /boot/efi/flexrf\n"
    "  --kernel-command-line FILE   tells which version runs; else /proc/cmdline\n"
    "  --certificate FILE           the panel's; else /data/flexrf/panel.crt\n"
    "  --port N                     the panel's; else 8443\n"
    "  --healthy-for SECONDS        until a version confirms itself; else 60\n"
    "  --trial SECONDS              until one that does not gives up its turn; else 600\n"
    "Exit code: 0 ended by a signal; 1 wrong usage.\n";

constexpr Duration interval = std::chrono::seconds{1};
constexpr Duration wait_for_panel = std::chrono::seconds{5};

void say(const std::string& line) {
  std::fprintf(stderr, "flexrf-helper: %s\n", line.c_str());
}

int misuse(const std::string& what) {
  say(what);
  std::fputs(usage, stderr);
  return 1;
}

/// systemd ends everything in order first.
void restart() {
  char program[] = "/usr/bin/systemctl";
  char verb[] = "reboot";
  char* const words[] = {program, verb, nullptr};
  pid_t child = 0;
  if (const int error = posix_spawn(&child, program, nullptr, nullptr, words, environ); error != 0) {
    say(std::string{"the PC cannot be restarted: "} + std::strerror(error));
    return;
  }
  waitpid(child, nullptr, 0);
}

template <class Number>
bool parse(const char* text, Number least, Number most, Number& number) {
  const char* const end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, number);
  return error == std::errc{} && rest == end && number >= least && number <= most;
}

}  // namespace

int main(int argument_count, char** words) {
  hold_standard_descriptors();
  Files files;
  Limits limits;
  std::uint16_t port = 8443;
  int healthy = 60;
  int trial = 600;
  for (int i = 1; i < argument_count; ++i) {
    const std::string word = words[i];
    if (word == "--help" || word == "-h") {
      std::fputs(usage, stdout);
      return 0;
    }
    std::string* const value = word == "--word"                  ? &files.word
                               : word == "--users"               ? &files.users
                               : word == "--folder"              ? &files.choice
                               : word == "--kernel-command-line" ? &files.command_line
                               : word == "--certificate"         ? &files.certificate
                                                                 : nullptr;
    const bool is_number = word == "--port" || word == "--healthy-for" || word == "--trial";
    if (value == nullptr && !is_number) return misuse("there is no option '" + word + "'");
    if (++i == argument_count) return misuse(word + " needs a value");
    if (value != nullptr) {
      *value = words[i];
    } else if (word == "--port") {
      if (!parse<std::uint16_t>(words[i], 1, 65535, port))
        return misuse("--port is a number from 1 to 65535");
    } else if (!parse(words[i], 1, 86'400, word == "--trial" ? trial : healthy)) {
      return misuse(word + " is a number of seconds, from 1 to 86400");
    }
  }
  limits.healthy = std::chrono::seconds{healthy};
  limits.trial = std::chrono::seconds{trial};

  std::signal(SIGPIPE, SIG_IGN);
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGTERM);
  sigaddset(&ending, SIGINT);
  sigprocmask(SIG_BLOCK, &ending, nullptr);
  const Surroundings surroundings{[&] { return why_not_healthy(port, files.certificate, wait_for_panel); },
                                  &say, &restart};
  Helper helper(files, limits, surroundings, MonotonicClock::now());
  constexpr timespec pause{interval / std::chrono::seconds{1}, 0};
  do helper.look(MonotonicClock::now());
  while (sigtimedwait(&ending, nullptr, &pause) < 0);
  return 0;
}
