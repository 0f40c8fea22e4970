// Somebody else on this machine says whether anything may move: by a file, whatever it is.
#include "runtime/executive/motion_permit.hpp"

#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::motion_permit_test {
namespace {

struct Machine {
  char folder[32] = "/tmp/flexrf-permit-XXXXXX";
  std::string file = std::string{mkdtemp(folder)} + "/motion";
  Control control{{}};
  MotionPermit permit{control, "cell", file};
  Time now{std::chrono::seconds{1}};

  Machine() { control.rise_to(Mode::running); }
  ~Machine() { std::filesystem::remove_all(folder); }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  /// As whoever permits has to: the whole word at once.
  void say(const std::string& word) {
    std::ofstream(file + ".new") << word;
    std::filesystem::rename(file + ".new", file);
  }
  void look() {
    permit.observe(now);
    now += MotionPermit::interval;
  }
  std::string why_not() { return control.check_start().cause(); }
};

// [stop-92]
void no_word_is_no_permission() {
  Machine machine;
  machine.control.permit_motion_at_power_on();
  machine.look();
  CHECK(!machine.control.may_move());
  CHECK_CONTAINS(machine.why_not(),
                 "this machine has not permitted motion: " + machine.file + ": No such file");
  CHECK(!machine.control.start_motion());
}

// [stop-92]
void the_word_permits_a_start_and_gives_none() {
  Machine machine;
  machine.control.permit_motion_at_power_on();
  machine.look();
  machine.say("permitted\n");
  machine.look();
  CHECK(!machine.control.may_move());
  CHECK(machine.control.start_motion().is_ok());
  CHECK(machine.control.may_move());
}

// [stop-93]
void another_word_stops_what_moves_until_the_next_start() {
  Machine machine;
  machine.say("permitted");
  machine.look();
  CHECK(machine.control.start_motion().is_ok());
  machine.say("it is being updated\nand more\n");
  machine.look();
  CHECK(!machine.control.may_move());
  CHECK_EQUAL(machine.why_not(), std::string{"this machine does not permit motion: it is being updated"});
  CHECK_EQUAL(machine.control.withdrawals(), 1U);
  machine.say("permitted\n");
  machine.look();
  CHECK(!machine.control.may_move());
  CHECK(machine.control.start_motion().is_ok());
  std::filesystem::remove(machine.file);
  machine.look();
  CHECK(!machine.control.may_move());
}

/// A reason that changes is told; one that stays withdraws nothing again.
void the_newest_reason_is_told() {
  Machine machine;
  machine.say("nobody has claimed it\n");
  machine.look();
  machine.look();
  CHECK_EQUAL(machine.control.withdrawals(), 1U);
  machine.say("it is being updated\n");
  machine.look();
  CHECK_CONTAINS(machine.why_not(), "it is being updated");
}

// [stop-92]
void whatever_else_stands_there_permits_nothing() {
  Machine machine;
  machine.say("");
  machine.look();
  CHECK_CONTAINS(machine.why_not(), "is empty");
  for (const char* const word : {"\npermitted\n", "permitted by nobody\n", "Permitted\n", " permitted\n"}) {
    machine.say(word);
    machine.look();
    CHECK(!machine.control.start_motion());
  }
  machine.say(std::string(100'000, 'x'));
  machine.look();
  CHECK(!machine.control.start_motion());
  machine.say("\x1b[2Jno\xff\r\n");
  machine.look();
  CHECK_CONTAINS(machine.why_not(), "motion: ?[2Jno??");
  std::filesystem::remove(machine.file);
  std::filesystem::create_directory(machine.file);
  machine.look();
  CHECK_CONTAINS(machine.why_not(), "Invalid argument");
  std::filesystem::remove(machine.file);
  // Without a writer: it would keep whoever opens it.
  CHECK_EQUAL(mkfifo(machine.file.c_str(), 0600), 0);
  machine.look();
  CHECK(!machine.control.start_motion());
}

void it_is_asked_ten_times_a_second() {
  Machine machine;
  machine.say("permitted\n");
  machine.look();
  machine.say("no\n");
  machine.permit.observe(machine.now - std::chrono::milliseconds{1});
  CHECK(machine.control.start_motion().is_ok());
  machine.permit.observe(machine.now);
  CHECK(!machine.control.may_move());
}

void without_a_file_nobody_is_asked() {
  Control control{{}};
  control.rise_to(Mode::running);
  MotionPermit permit(control, "cell", "");
  permit.observe(Time{std::chrono::seconds{1}});
  CHECK(control.start_motion().is_ok());
}

}  // namespace
}  // namespace flexrf::fixture::motion_permit_test

int main() {
  using namespace flexrf::fixture::motion_permit_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(no_word_is_no_permission),
      CONTAINED_TEST(the_word_permits_a_start_and_gives_none),
      CONTAINED_TEST(another_word_stops_what_moves_until_the_next_start),
      CONTAINED_TEST(the_newest_reason_is_told),
      CONTAINED_TEST(whatever_else_stands_there_permits_nothing),
      CONTAINED_TEST(it_is_asked_ten_times_a_second),
      CONTAINED_TEST(without_a_file_nobody_is_asked),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
