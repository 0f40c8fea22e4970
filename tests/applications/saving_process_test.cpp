// The configuration file and the other files of the command line, as somebody meets them who runs the built
// program: what is told at the start, a second run, values that survive, a save that fails.
#include <sys/ptrace.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

std::vector<std::string> words(const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{place::application, "--no-realtime", "--standstill-limit", "10min"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<std::string> words_with_file(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"--config", "cell.xml"});
  return words(more);
}

bool is_saved(const Folder& folder, const std::string& text) {
  return wait_until([&] { return contents_of(folder / "cell.xml").find(text) != std::string::npos; });
}

void values_survive_a_power_cut_and_the_next_start() {
  const Folder folder;
  {
    Process process(folder, words_with_file());
    process.type("g");
    CHECK(is_saved(folder, "<gain>3</gain>"));
    process.send(SIGKILL);
    CHECK_EQUAL(process.wait().signal, SIGKILL);
  }
  const std::string saved = contents_of(folder / "cell.xml");
  const Ending next = run(folder, words_with_file({"--report", "report"}));
  CHECK_EQUAL(next.exit_code, 0);
  CHECK_EQUAL(next.errors.find("previous"), std::string::npos);
  CHECK_EQUAL(Report(folder / "report").last("tuner.values").at("gain"), 3.0);
  // No more is kept than what was set.
  CHECK_EQUAL(contents_of(folder / "cell.xml"), saved);
}

void where_nothing_is_set_nothing_is_written() {
  const Folder folder;
  CHECK_EQUAL(run(folder, words_with_file()).exit_code, 0);
  CHECK(access((folder / "cell.xml").c_str(), F_OK) != 0);
}

// [stop-73]
void a_second_run_with_the_same_file_is_refused() {
  const Folder folder;
  CHECK(symlink("cell.xml", (folder / "other.xml").c_str()) == 0);
  Process process(folder, words_with_file());
  process.type("g");
  CHECK(is_saved(folder, "<gain>3</gain>"));
  process.type("d");
  // It was replaced more than once.
  CHECK(is_saved(folder, "<gain>1</gain>"));
  for (const char* const name : {"cell.xml", "other.xml"}) {
    const Ending second = run(folder, words({"--config", name, "--report", "second"}));
    CHECK_EQUAL(second.exit_code, 2);
    CHECK_CONTAINS(second.errors, std::string{"configuration file "} + name + " is used already by process " +
                                      std::to_string(process.id()));
    CHECK(access((folder / "second").c_str(), F_OK) != 0);
  }
  process.end_input();
  CHECK_EQUAL(process.wait().exit_code, 0);
  CHECK_EQUAL(run(folder, words_with_file()).exit_code, 0);
}

/// What lies in the way of the file that is written beside the one there is.
void obstruct(const Folder& folder) {
  CHECK(mkdir((folder / "cell.xml.new").c_str(), 0700) == 0);
}

// [stop-72]
void a_save_that_fails_is_an_error_and_in_the_exit_code() {
  const Folder folder;
  obstruct(folder);
  const Ending ending = run(folder, words_with_file({"--report", "report"}), "g");
  CHECK_EQUAL(ending.exit_code, 1);
  CHECK_CONTAINS(ending.errors, "error tuned: the values were not saved: cannot create");
  CHECK_CONTAINS(ending.output, "Values not saved: cannot create");
  CHECK_CONTAINS(Report(folder / "report")["run"].at("not_saved").get<std::string>(), "cell.xml.new");
}

/// A service is always ended by a signal: what failed is not to hide behind that.
// [stop-72]
void a_save_that_fails_is_seen_behind_a_signal() {
  const Folder folder;
  obstruct(folder);
  Process process(folder, words_with_file());
  process.type("g");
  process.wait_for_error("the values were not saved");
  process.send(SIGTERM);
  CHECK_EQUAL(process.wait().exit_code, 1);
}

// [stop-62]
void a_report_that_fails_is_seen_behind_a_signal() {
  const Folder folder;
  Process process(folder, words_with_file({"--report", "/dev/full"}));
  process.type("g");
  CHECK(is_saved(folder, "<gain>3</gain>"));
  process.send(SIGTERM);
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.exit_code, 1);
  CHECK_CONTAINS(ending.errors, "--report /dev/full: No space left on device");
}

void check_refused(const Folder& folder, const std::string& option, const std::string& value,
                   const std::string& why) {
  const bool is_of_panel = option.starts_with("--panel") || option.starts_with("--tls");
  std::vector<std::string> given = words({option, value});
  if (is_of_panel) given[0] = place::keyboard;  // which has one
  if (option == "--tls-key") given.insert(given.end(), {"--tls-certificate", "file"});
  const Ending ending = run(folder, given);
  CHECK_EQUAL(ending.exit_code, 1);
  const std::string name = is_of_panel ? "keyboard" : "tuned";
  CHECK_CONTAINS(ending.errors, name + ": " + option + " " + value + ": " + why);
  CHECK_EQUAL(ending.output, std::string{});
}

// [stop-72]
void a_pipe_or_a_folder_is_told_at_the_start() {
  const Folder folder;
  CHECK(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(mkdir((folder / "folder").c_str(), 0700) == 0);
  write_file(folder / "file", "");
  for (const char* const option :
       {"--keys", "--config", "--report", "--panel-users", "--tls-certificate", "--tls-key"}) {
    check_refused(folder, option, "pipe", "it is a pipe; name a file");
    check_refused(folder, option, "folder", "it is a folder; name a file");
  }
}

void what_is_not_there_is_told_at_the_start() {
  const Folder folder;
  for (const char* const option : {"--config", "--report"})
    check_refused(folder, option, "nowhere/file", "there is no folder 'nowhere'; make it first");
  for (const char* const option : {"--keys", "--panel-users", "--tls-certificate"})
    check_refused(folder, option, "nowhere/file", "No such file or directory");
}

void a_report_is_not_written_over_another_file() {
  const Folder folder;
  write_file(folder / "cell.xml", "<flexrf checksum=\"edited\"/>\n");
  CHECK(symlink("cell.xml", (folder / "report").c_str()) == 0);
  for (const char* const name : {"cell.xml", "report"}) {
    const Ending ending = run(folder, words_with_file({"--report", name}));
    CHECK_EQUAL(ending.exit_code, 1);
    CHECK_CONTAINS(ending.errors, std::string{"--report "} + name + ": this is the file of --config");
  }
  CHECK_CONTAINS(contents_of(folder / "cell.xml"), "edited");
}

/// Of the process's threads.
pid_t thread_named(pid_t process, const std::string& name) {
  const std::string tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& entry : std::filesystem::directory_iterator(tasks)) {
    if (contents_of(entry.path() / "comm") == name + "\n") return std::stoi(entry.path().filename());
  }
  return 0;
}

/// A thread that does nothing any more, from a moment on in which it sleeps: whoever is stopped elsewhere may
/// hold a lock that all need, of the library or of a sanitizer.
class StoppedThread {
 public:
  StoppedThread(pid_t process, const std::string& name) : thread_(thread_named(process, name)) {
    CHECK(thread_ > 0);
    const std::string call =
        "/proc/" + std::to_string(process) + "/task/" + std::to_string(thread_) + "/syscall";
    const std::string sleeps = std::to_string(SYS_clock_nanosleep) + " ";
    CHECK(wait_until([&] {
      if (!contents_of(call).starts_with(sleeps)) return false;
      stop();
      if (contents_of(call).starts_with(sleeps)) return true;
      go_on();
      return false;
    }));
  }
  StoppedThread(const StoppedThread&) = delete;
  StoppedThread& operator=(const StoppedThread&) = delete;
  ~StoppedThread() {
    if (is_stopped_) go_on();
  }

  /// It is this process's until its end was seen.
  void wait_for_end() {
    CHECK(waitpid(thread_, nullptr, __WALL) == thread_);
    is_stopped_ = false;
  }

 private:
  void stop() {
    CHECK(ptrace(PTRACE_SEIZE, thread_, nullptr, nullptr) == 0);
    is_stopped_ = true;
    CHECK(ptrace(PTRACE_INTERRUPT, thread_, nullptr, nullptr) == 0);
    CHECK(waitpid(thread_, nullptr, __WALL) == thread_);
  }
  void go_on() noexcept {
    ptrace(PTRACE_DETACH, thread_, nullptr, nullptr);
    is_stopped_ = false;
  }

  pid_t thread_;
  bool is_stopped_ = false;
};

/// As on a disk that does not answer: units, supervision and log go on, and the end does not wait for ever.
// [exec-35]
void a_writing_that_hangs_holds_nobody_up() {
  const Folder folder;
  Process process(folder, words_with_file({"--report", "report"}));
  process.type("g");
  CHECK(is_saved(folder, "<gain>3</gain>"));
  StoppedThread saver(process.id(), "saver");
  process.type("dn");
  process.wait_for_error("it changed its own values, and they are refused: gain: nan");
  process.send(SIGTERM);
  process.wait_for_error("the values were not saved: 'cell.xml': its file system does not answer");
  saver.wait_for_end();
  CHECK_EQUAL(process.wait().exit_code, 2);  // for the fault
  CHECK_EQUAL(Report(folder / "report").last("tuner.values").at("gain"), 1.0);
  CHECK_CONTAINS(contents_of(folder / "cell.xml"), "<gain>3</gain>");
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(values_survive_a_power_cut_and_the_next_start),
      CONTAINED_TEST(where_nothing_is_set_nothing_is_written),
      CONTAINED_TEST(a_second_run_with_the_same_file_is_refused),
      CONTAINED_TEST(a_save_that_fails_is_an_error_and_in_the_exit_code),
      CONTAINED_TEST(a_save_that_fails_is_seen_behind_a_signal),
      CONTAINED_TEST(a_report_that_fails_is_seen_behind_a_signal),
      CONTAINED_TEST(a_pipe_or_a_folder_is_told_at_the_start),
      CONTAINED_TEST(what_is_not_there_is_told_at_the_start),
      CONTAINED_TEST(a_report_is_not_written_over_another_file),
      CONTAINED_TEST(a_writing_that_hangs_holds_nobody_up),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
