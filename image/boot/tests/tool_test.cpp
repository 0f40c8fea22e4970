// flexrf-boot-choice as RAUC, systemd and people call it.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf::boot {
namespace {

namespace fs = std::filesystem;

class Pc {
 public:
  Pc() {
    char name[] = "/tmp/flexrf-boot-choice-tool-XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path_ = name;
    fs::create_directory(path_ + "/flexrf");
    runs("A flexrf.boot=confirmed flexrf.trial=0000000001");
  }
  Pc(const Pc&) = delete;
  Pc& operator=(const Pc&) = delete;
  ~Pc() { fs::remove_all(path_); }

  void runs(const std::string& slot) const {
    std::ofstream(path_ + "/cmdline") << "BOOT_IMAGE=/vmlinuz rauc.slot=" << slot << " quiet\n";
  }
  std::string operator/(const char* name) const { return path_ + "/" + name; }

  std::string command(const std::string& arguments) const {
    return std::string(place::tool) + " --folder " + path_ + "/flexrf --kernel-command-line " + path_ +
           "/cmdline " + arguments + " 2>&1";
  }

  /// What it said, on either, behind its exit code: "0 A\n".
  std::string run(const std::string& arguments) const {
    std::FILE* const pipe = popen(command(arguments).c_str(), "r");
    CHECK(pipe != nullptr);
    std::string output;
    for (int character = std::getc(pipe); character != EOF; character = std::getc(pipe))
      output += static_cast<char>(character);
    const int status = pclose(pipe);
    CHECK(WIFEXITED(status));
    return std::to_string(WEXITSTATUS(status)) + ' ' + output;
  }

 private:
  std::string path_;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void rauc_gets_its_answers() {
  const Pc pc;
  CHECK_EQUAL(pc.run("create"), "0 ");
  CHECK_EQUAL(pc.run("get-primary"), "0 A\n");
  CHECK_EQUAL(pc.run("get-state B"), "0 bad\n");
  CHECK_EQUAL(pc.run("set-state A good"), "0 ");
  CHECK_EQUAL(pc.run("set-state B bad"), "0 ");
  CHECK_EQUAL(pc.run("set-primary B"), "0 ");
  CHECK_EQUAL(pc.run("mark-whole B " + pc / "cmdline"), "0 ");
  CHECK_EQUAL(pc.run("get-state B"), "0 good\n");
  CHECK_EQUAL(pc.run("get-primary"), "0 B\n");
  pc.runs("B flexrf.boot=trial flexrf.trial=0000000004");
  CHECK_EQUAL(pc.run("confirm B"), "0 ");
  CHECK_CONTAINS(pc.run("status"), "running=B\nboot=trial\nconfirmed=yes\n");
}

void refusals_and_failures_have_their_codes() {
  const Pc pc;
  CHECK_CONTAINS(pc.run("get-primary"), "3 flexrf-boot-choice: no copy of the boot choice can be read");
  CHECK_EQUAL(pc.run("create"), "0 ");
  CHECK_CONTAINS(pc.run("unmark-whole A"), "4 flexrf-boot-choice: slot A keeps its mark");
  CHECK_CONTAINS(pc.run("confirm B"), "4 ");
  CHECK_CONTAINS(pc.run("fly"), "1 flexrf-boot-choice: there is no verb 'fly'");
  CHECK_CONTAINS(pc.run("--fold x"), "1 flexrf-boot-choice: there is no option '--fold'");
  CHECK_CONTAINS(pc.run("--notice"), "1 flexrf-boot-choice: --notice needs a value");
  CHECK_CONTAINS(pc.run("--help"), "set-primary SLOT");
  CHECK_CONTAINS(pc.run("--folder /no/such/folder get-primary"),
                 "3 flexrf-boot-choice: cannot open /no/such/folder");
}

void a_repair_leaves_a_line_for_the_panel() {
  const Pc pc;
  CHECK_EQUAL(pc.run("create"), "0 ");
  const std::string notice = pc / "notice";
  std::ofstream(notice) << "of an earlier boot";
  CHECK_EQUAL(pc.run("--notice " + notice + " repair"), "0 ");
  CHECK(!fs::exists(notice));
  fs::resize_file(pc / "flexrf/choice1.env", 0);
  CHECK_CONTAINS(pc.run("--notice " + notice + " repair"),
                 "2 flexrf-boot-choice: choice1.env is damaged: it has 0 bytes");
  CHECK_EQUAL(text_of(notice),
              "choice1.env is damaged: it has 0 bytes instead of 1024; written anew from the other copy\n");
  CHECK_EQUAL(text_of(pc / "flexrf/choice0.env"), text_of(pc / "flexrf/choice1.env"));
  CHECK_CONTAINS(pc.run("--notice /no/such/folder/notice status"), "0 ");
  fs::resize_file(pc / "flexrf/choice1.env", 0);
  CHECK_CONTAINS(pc.run("--notice /no/such/folder/notice repair"), "cannot write /no/such/folder/notice");
}

// Somebody presses twice, and RAUC is at it as well: each change is made, one after the other.
void changes_at_the_same_time_are_all_made() {
  const Pc pc;
  CHECK_EQUAL(pc.run("create"), "0 ");
  constexpr int many = 24;
  pid_t children[many];
  for (int i = 0; i < many; ++i) {
    children[i] = fork();
    CHECK(children[i] >= 0);
    if (children[i] == 0) {
      const std::string command = pc.command(i % 2 == 0 ? "set-primary B" : "set-primary A");
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
  }
  int failures = 0;
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) ++failures;
  }
  CHECK_EQUAL(failures, 0);
  CHECK_CONTAINS(text_of(pc / "flexrf/choice0.env"), "choice=0000000025 ");
  CHECK_EQUAL(text_of(pc / "flexrf/choice0.env"), text_of(pc / "flexrf/choice1.env"));
}

}  // namespace
}  // namespace flexrf::boot

int main() {
  using namespace flexrf::boot;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(rauc_gets_its_answers),
      CONTAINED_TEST(refusals_and_failures_have_their_codes),
      CONTAINED_TEST(a_repair_leaves_a_line_for_the_panel),
      CONTAINED_TEST(changes_at_the_same_time_are_all_made),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
