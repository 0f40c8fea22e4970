// flexrf-power-cut as scripts call it.
#include <sys/stat.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "image/power_cut/tests/hand_made_log.hpp"
#include "places.hpp"

namespace flexrf::power_cut {
namespace {

class Bench {
 public:
  Bench() {
    HandMadeLog log;
    log.add(0, 1, 0);
    log.add(0, 0, flush_flag);
    log.add(8, 2, fua_flag);
    write_file(folder_ / "log", log.bytes());
    write_file(folder_ / "base", std::string(64 * 1024, 'b'));
  }
  std::string operator/(const char* name) const { return folder_ / name; }

  /// What it said, on either, behind its exit code.
  std::string run(const std::string& arguments) const {
    const std::string command = std::string(place::tool) + ' ' + arguments + " 2>&1";
    std::FILE* const pipe = popen(command.c_str(), "r");
    CHECK(pipe != nullptr);
    std::string output;
    for (int character = std::getc(pipe); character != EOF; character = std::getc(pipe))
      output += static_cast<char>(character);
    const int status = pclose(pipe);
    CHECK(WIFEXITED(status));
    return std::to_string(WEXITSTATUS(status)) + ' ' + output;
  }
  std::string files() const { return "--log " + folder_ / "log" + " --base " + folder_ / "base"; }

 private:
  Folder folder_;
};

void a_log_is_described() {
  const Bench bench;
  CHECK_EQUAL(bench.run("describe " + bench.files()),
              "0 3 entries: 2 writes of 1536 bytes in all, 1 of them with FUA; 1 flushes\n"
              "sectors of 512 bytes; disk of 65536 bytes; points 0 to 3\n");
  CHECK_EQUAL(bench.run("points --count 10 --seed 1 " + bench.files()), "0 0\n1\n2\n3\n");
}

void a_disk_is_built_and_the_base_stays() {
  const Bench bench;
  CHECK_EQUAL(bench.run("build --point 3 --seed 5 --output " + bench / "disk" + " " + bench.files()),
              "0 point 3, seed 5: 2 writes for certain, 0 of 0 others\n");
  const std::string disk = bytes_of(bench / "disk");
  CHECK_EQUAL(disk, marked_bytes(0, 0) + std::string(7 * 512, 'b') + marked_bytes(2, 0) + marked_bytes(2, 1) +
                        std::string(64 * 1024 - 10 * 512, 'b'));
  CHECK_EQUAL(bytes_of(bench / "base"), std::string(64 * 1024, 'b'));
}

// A hole of the base stays one: an image of gigabytes has few blocks.
void holes_stay_holes() {
  const Bench bench;
  std::filesystem::resize_file(bench / "base", std::uintmax_t{256} << 20);
  CHECK_CONTAINS(bench.run("build --point 3 --seed 5 --output " + bench / "disk" + " " + bench.files()),
                 "0 point 3");
  struct stat found {};
  CHECK(stat((bench / "disk").c_str(), &found) == 0);
  CHECK_EQUAL(found.st_size, off_t{256} << 20);
  CHECK(found.st_blocks * 512 < (off_t{1} << 20));
}

void wrong_words_are_told() {
  const Bench bench;
  const std::string disk = bench / "disk";
  CHECK_CONTAINS(bench.run(""), "1 flexrf-power-cut: a command is missing");
  CHECK_CONTAINS(bench.run("fly"), "1 flexrf-power-cut: there is no command 'fly'");
  CHECK_CONTAINS(bench.run("describe --log x"), "1 flexrf-power-cut: 'describe' needs --base");
  CHECK_CONTAINS(bench.run("describe --point 1"), "1 flexrf-power-cut: 'describe' has no option '--point'");
  CHECK_CONTAINS(bench.run("describe --log"), "1 flexrf-power-cut: --log needs a value");
  CHECK_CONTAINS(bench.run("describe --log a --log b --base c"), "1 flexrf-power-cut: --log is given twice");
  CHECK_CONTAINS(bench.run("points --count -1 --seed 1 " + bench.files()),
                 "--count takes a whole number from 0, not '-1'");
  CHECK_CONTAINS(bench.run("build --point 4 --seed 1 --output " + disk + " " + bench.files()),
                 "1 flexrf-power-cut: there is no point 4; the log's points are 0 to 3");
  CHECK_CONTAINS(bench.run("--help"), "0 flexrf-power-cut describe");
  CHECK(!std::filesystem::exists(disk));
}

void files_that_do_not_fit_are_told() {
  const Bench bench;
  const std::string rest = " --point 1 --seed 1 " + bench.files();
  CHECK_CONTAINS(bench.run("describe --log /no/such --base " + bench / "base"),
                 "2 flexrf-power-cut: cannot read /no/such");
  CHECK_CONTAINS(bench.run("describe --base /no/such --log " + bench / "log"),
                 "2 flexrf-power-cut: cannot read /no/such");
  CHECK_CONTAINS(bench.run("describe --log " + bench / "base" + " --base " + bench / "base"),
                 "2 flexrf-power-cut: this is no log of writes");
  CHECK_CONTAINS(bench.run("build --output " + bench / "base" + rest),
                 "it is never written over, remove it first");
  CHECK_EQUAL(bytes_of(bench / "base"), std::string(64 * 1024, 'b'));
  CHECK_CONTAINS(bench.run("build --output /no/such/disk" + rest),
                 "2 flexrf-power-cut: cannot make /no/such/disk");
}

}  // namespace
}  // namespace flexrf::power_cut

int main() {
  using namespace flexrf::power_cut;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_log_is_described),
      CONTAINED_TEST(a_disk_is_built_and_the_base_stays),
      CONTAINED_TEST(holes_stay_holes),
      CONTAINED_TEST(wrong_words_are_told),
      CONTAINED_TEST(files_that_do_not_fit_are_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
