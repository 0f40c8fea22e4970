// What only a real program shows: who starts it, what it inherits, and that nothing of it is left behind.
#include "hal/process/linux/linux_process.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "hal/driver/device_bench.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr int patience = 20000;  // of a millisecond and more

void rest() {
  const timespec millisecond{0, 1'000'000};
  nanosleep(&millisecond, nullptr);
}

/// Of /proc/<id>/stat: its state and its parent. 'Z': it has ended, or is not there.
struct Standing {
  char state = 'Z';
  int parent = 0;
};
Standing standing_of(int id) {
  Standing standing;
  const std::string path = "/proc/" + std::to_string(id) + "/stat";
  std::FILE* file = std::fopen(path.c_str(), "r");
  if (file == nullptr) return standing;
  if (std::fscanf(file, "%*d (%*[^)]) %c %d", &standing.state, &standing.parent) != 2) standing = {};
  std::fclose(file);
  return standing;
}

bool ends(int id) {
  for (int i = 0; i < patience; ++i) {
    if (standing_of(id).state == 'Z') return true;
    rest();
  }
  return false;
}

class Shell {
 public:
  explicit Shell(const std::string& script, const char* executable = "/bin/sh") {
    auto& configuration = bench_.configuration();
    configuration.set_executable(executable);
    configuration.set_arguments("-c '" + script + "'");
    configuration.start_timeout = 30.0;
    configuration.stop_timeout = 0.05;
  }
  Status begin() { return bench_.driver().initialise(); }
  LinuxProcess& process() { return bench_.driver(); }

  /// What it printed, when it has ended or has printed `count` lines.
  std::vector<std::string> lines(std::size_t count) {
    std::vector<std::string> all;
    for (int i = 0; i < patience; ++i) {
      bench_.receive(MonotonicClock::now() - bench_.now());
      ProcessLine line;
      while (bench_.driver().read_line(line)) all.emplace_back(line.content_view());
      if (all.size() >= count || bench_.driver().state().phase == ProcessPhase::idle) break;
      bench_.send();
      rest();
    }
    return all;
  }

 private:
  DeviceBench<LinuxProcess> bench_{nullptr};
};

bool run_the_helper_is_there_before_and_starts_it() {
  Shell shell("echo ready; exec sleep 1000");
  const int helper = shell.process().helper();
  if (standing_of(helper).parent != getpid()) return false;
  if (!shell.begin() || shell.lines(1).empty()) return false;
  const int id = shell.process().state().id;
  const bool started_by_it = standing_of(id).parent == helper;
  shell.process().stop();
  return started_by_it && ends(id);
}

/// Descriptors 0, 1 and 2, and the one with which ls reads the folder.
bool run_it_inherits_no_descriptor() {
  Shell shell("exec ls /proc/self/fd");
  return shell.begin() && shell.lines(100) == std::vector<std::string>{"0", "1", "2", "3"};
}

bool run_it_inherits_no_signal_mask_and_no_policy() {
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  sigprocmask(SIG_BLOCK, &blocked, &before);
  bool good = false;
  {
    Shell shell("grep -E \"SigBlk|SigIgn\" /proc/self/status");
    good = shell.begin() && shell.lines(2) == std::vector<std::string>{"SigBlk:\t0000000000000000",
                                                                       "SigIgn:\t0000000000000000"};
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  return good;
}

bool run_what_it_started_ends_with_it() {
  Shell shell("sleep 1000 > /dev/null 2>&1 & echo $!");
  if (!shell.begin()) return false;
  const std::vector<std::string> lines = shell.lines(1);
  return lines.size() == 1 && ends(std::stoi(lines[0]));
}

/// A process like the application is killed: neither the helper nor the program is left.
bool run_all_end_with_the_application() {
  int ids[2];
  if (pipe(ids) != 0) return false;
  const pid_t application = fork();
  if (application == 0) {
    Shell shell("trap \"\" TERM HUP; echo ready; while :; do sleep 1; done");
    if (!shell.begin() || shell.lines(1).empty()) _exit(1);
    const int told[2] = {shell.process().helper(), shell.process().state().id};
    if (write(ids[1], told, sizeof told) != sizeof told) _exit(1);
    for (;;) pause();
  }
  close(ids[1]);
  int told[2] = {0, 0};
  const bool began = read(ids[0], told, sizeof told) == sizeof told;
  close(ids[0]);
  kill(application, SIGKILL);
  waitpid(application, nullptr, 0);
  return began && ends(told[0]) && ends(told[1]);
}

bool is_refused(const char* executable, const char* directory, const char* hint) {
  DeviceBench<LinuxProcess> bench(nullptr);
  bench.configuration().set_executable(executable);
  bench.configuration().set_working_directory(directory);
  const Status status = bench.driver().initialise();
  return status.code() == StatusCode::not_found &&
         std::string(status.cause()).find(hint) != std::string::npos;
}

bool run_what_cannot_be_run_says_why() {
  return is_refused("/nowhere/nothing", "/", "is it installed") &&
         is_refused("/etc/passwd", "/", "is it executable") &&
         is_refused("/bin/sh", "/nowhere", "working_directory");
}

bool run_what_is_too_long_is_refused() {
  DeviceBench<LinuxProcess> bench(nullptr);
  std::string many;
  for (int i = 0; i < 200; ++i) many += "a ";
  bench.configuration().set_executable("/bin/sh");
  bench.configuration().set_arguments(many);
  return bench.driver().initialise().code() == StatusCode::invalid_argument;
}

template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

}  // namespace

int main() {
#define CASE(name) \
  { #name, judged < run_##name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(the_helper_is_there_before_and_starts_it),
      CASE(it_inherits_no_descriptor),
      CASE(it_inherits_no_signal_mask_and_no_policy),
      CASE(what_it_started_ends_with_it),
      CASE(all_end_with_the_application),
      CASE(what_cannot_be_run_says_why),
      CASE(what_is_too_long_is_refused),
  };
#undef CASE
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
