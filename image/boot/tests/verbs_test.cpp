#include "image/boot/verbs.hpp"

#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "image/boot/blocks.hpp"
#include "image/boot/environment.hpp"
#include "image/boot/tests/lost_power.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf::boot::verbs_test {
namespace {

using Words = std::vector<std::string>;

Running running_slot(Slot slot) {
  return {slot, "confirmed", 1};
}

LostPowerDisk new_disk() {
  LostPowerDisk disk;
  CHECK(perform({"create"}, disk, {}).exit == Exit::done);
  return disk;
}

std::string answer(LostPowerDisk& disk, const Words& words, const Running& running = {}) {
  const Outcome outcome = perform(words, disk, running);
  CHECK(outcome.exit == Exit::done);
  CHECK(outcome.said.empty());
  return outcome.answer;
}

void expect_refusal(LostPowerDisk& disk, const Words& words, const Running& running, const char* part) {
  const std::string before = answer(disk, {"status"});
  const Outcome outcome = perform(words, disk, running);
  CHECK(outcome.exit == Exit::refused);
  CHECK_EQUAL(outcome.said.size(), 1u);
  CHECK_CONTAINS(outcome.said.front(), part);
  CHECK_EQUAL(answer(disk, {"status"}), before);
}

void a_new_disk_has_one_slot() {
  LostPowerDisk disk = new_disk();
  CHECK_EQUAL(answer(disk, {"get-primary"}), "A\n");
  CHECK_EQUAL(answer(disk, {"get-state", "A"}), "good\n");
  CHECK_EQUAL(answer(disk, {"get-state", "B"}), "bad\n");
  CHECK_EQUAL(answer(disk, {"status"}, running_slot(Slot::a)),
              "primary=A\nA=whole,unconfirmed\nB=not-whole\ntrial=0000000001\nattempts=0\nrunning=A\n"
              "boot=confirmed\nconfirmed=no\ncopies=equal\n");
  const Outcome again = perform({"create"}, disk, {});
  CHECK(again.exit == Exit::refused);
  CHECK_CONTAINS(again.said.front(), "there already");
}

void rauc_installs() {
  LostPowerDisk disk = new_disk();
  answer(disk, {"set-state", "A", "good"}, running_slot(Slot::a));
  answer(disk, {"set-state", "B", "bad"});
  answer(disk, {"set-primary", "B"});
  CHECK_EQUAL(answer(disk, {"get-primary"}), "B\n");
  CHECK_EQUAL(answer(disk, {"get-state", "B"}), "bad\n");
  answer(disk, {"mark-whole", "B", "B"});
  CHECK_EQUAL(answer(disk, {"get-state", "B"}), "good\n");
  CHECK_CONTAINS(answer(disk, {"status"}, running_slot(Slot::b)), "B=whole,unconfirmed\n");
  answer(disk, {"confirm", "B"}, running_slot(Slot::b));
  CHECK_CONTAINS(answer(disk, {"status"}, running_slot(Slot::b)), "confirmed=yes\n");
  // Back by hand: what is confirmed stays so.
  answer(disk, {"set-primary", "A"});
  CHECK_CONTAINS(answer(disk, {"status"}), "primary=A\nA=whole,confirmed\nB=whole,confirmed\n");
}

void each_choice_begins_a_trial_of_its_own() {
  LostPowerDisk disk = new_disk();
  answer(disk, {"set-primary", "B"});
  disk.put(attempts_name, block_of(Attempts{2, 3, Slot::b, {}}));
  CHECK_CONTAINS(answer(disk, {"status"}), "trial=0000000002\nattempts=3\n");
  answer(disk, {"mark-whole", "B", "B"});
  CHECK_CONTAINS(answer(disk, {"status"}), "trial=0000000002\nattempts=3\n");
  answer(disk, {"set-primary", "B"});
  CHECK_CONTAINS(answer(disk, {"status"}), "trial=0000000004\nattempts=0\n");
}

void the_last_whole_slot_stays() {
  LostPowerDisk disk = new_disk();
  expect_refusal(disk, {"unmark-whole", "A"}, {}, "nothing would be left to boot");
  expect_refusal(disk, {"set-state", "A", "bad"}, {}, "install a version into slot B");
  answer(disk, {"mark-whole", "B", "B"});
  answer(disk, {"unmark-whole", "A"});
  answer(disk, {"unmark-whole", "A"});
  expect_refusal(disk, {"unmark-whole", "B"}, {}, "nothing would be left");
}

void only_what_runs_and_is_whole_is_confirmed() {
  LostPowerDisk disk = new_disk();
  expect_refusal(disk, {"confirm", "B"}, running_slot(Slot::a), "slot A runs");
  expect_refusal(disk, {"confirm", "A"}, {}, "rauc.slot=");
  expect_refusal(disk, {"set-state", "B", "good"}, running_slot(Slot::b), "not marked as whole");
}

void what_came_up_has_its_attempts_back() {
  LostPowerDisk disk = new_disk();
  expect_refusal(disk, {"came-up", "A"}, running_slot(Slot::a), "has not been confirmed");
  const auto count = [&](unsigned attempts) {
    disk.put(attempts_name, block_of(Attempts{1, attempts, Slot::a, Slot::b}));
  };
  count(2);
  answer(disk, {"confirm", "A"}, running_slot(Slot::a));
  CHECK(Environment(disk).attempts() == (Attempts{0, 0, Slot::a, Slot::b}));
  count(3);
  expect_refusal(disk, {"came-up", "A"}, running_slot(Slot::b), "slot A does not run");
  expect_refusal(disk, {"came-up", "A"}, {}, "slot A does not run");
  const Choice choice = Environment(disk).choice();
  answer(disk, {"came-up", "A"}, running_slot(Slot::a));
  CHECK(Environment(disk).attempts() == (Attempts{0, 0, Slot::a, Slot::b}));
  CHECK(Environment(disk).choice() == choice);
}

void a_fallback_that_is_healthy_stays() {
  LostPowerDisk disk = new_disk();
  answer(disk, {"mark-whole", "B", "B"});
  answer(disk, {"set-primary", "B"});  // trial 3
  // One that fell back from another trial, before this one was chosen, does not undo this one.
  answer(disk, {"confirm", "A"}, {Slot::a, "fallback", 2});
  CHECK_EQUAL(answer(disk, {"get-primary"}), "B\n");
  answer(disk, {"confirm", "A"}, {Slot::a, "fallback", 3});
  CHECK_EQUAL(answer(disk, {"get-primary"}), "A\n");
}

void the_kernels_command_line_is_read() {
  Running running =
      running_from("BOOT_IMAGE=/vmlinuz ro rauc.slot=B flexrf.boot=trial flexrf.trial=0000000041 quiet\n");
  CHECK(running.slot == Slot::b);
  CHECK_EQUAL(running.why, "trial");
  CHECK_EQUAL(running.trial, 41u);
  running = running_from("rauc.slot=C flexrf.boot=\x1B[2J flexrf.trial=99999999999");
  CHECK(!running.slot);
  CHECK_EQUAL(running.why, "");
  CHECK_EQUAL(running.trial, 0u);
  running = running_from("xrauc.slot=A");
  CHECK(!running.slot);
  CHECK(!running_from("").slot);
}

void wrong_words_are_told() {
  const std::vector<std::pair<Words, const char*>> all = {
      {{}, "a verb is missing"},
      {{"get-current"}, "there is no verb 'get-current'"},
      {{"set-primary"}, "lacks an argument"},
      {{"mark-whole", "A"}, "lacks an argument"},
      {{"get-primary", "A"}, "an argument too many"},
      {{"get-state", "a"}, "there is no slot 'a'"},
      {{"set-state", "A", "ugly"}, "there is no state 'ugly'"},
  };
  for (const auto& [words, part] : all) {
    LostPowerDisk disk = new_disk();
    const Outcome outcome = perform(words, disk, {});
    CHECK(outcome.exit == Exit::usage);
    CHECK_CONTAINS(outcome.said.front(), part);
  }
}

void a_mark_waits_for_the_partitions() {
  LostPowerDisk disk = new_disk();
  const Outcome outcome = perform({"mark-whole", "B", "B", "no-such-partition"}, disk, {});
  CHECK(outcome.exit == Exit::failed);
  CHECK_EQUAL(answer(disk, {"get-state", "B"}), "bad\n");
}

// One copy is enough to go on with, and the next change makes the other one whole.
void a_damaged_copy_is_told_and_written_anew() {
  for (const char* damaged : copy_names) {
    LostPowerDisk disk = new_disk();
    disk.put(damaged, "");
    Outcome outcome = perform({"get-primary"}, disk, {});
    CHECK(outcome.exit == Exit::done);
    CHECK_EQUAL(outcome.answer, "A\n");
    CHECK_CONTAINS(outcome.said.front(), std::string(damaged) + " is damaged");
    outcome = perform({"set-primary", "B"}, disk, {});
    CHECK(outcome.exit == Exit::done);
    CHECK_EQUAL(answer(disk, {"get-primary"}), "B\n");
  }
}

Outcome repaired(LostPowerDisk& disk, const Running& running, Exit code, const char* part) {
  Outcome outcome = perform({"repair"}, disk, running);
  CHECK(outcome.exit == code);
  if (*part != '\0') CHECK_CONTAINS(outcome.said.front(), part);
  if (code != Exit::failed) CHECK(perform({"repair"}, disk, running).exit == Exit::done);
  return outcome;
}

void what_can_be_repaired_is() {
  LostPowerDisk disk = new_disk();
  repaired(disk, running_slot(Slot::a), Exit::done, "");
  disk.put(copy_names[1], std::string(1024, '\0'));
  repaired(disk, running_slot(Slot::a), Exit::repaired, "choice1.env is damaged: it does not begin");
  disk.put(attempts_name, "");
  repaired(disk, running_slot(Slot::a), Exit::repaired, "attempts.env is damaged");
  disk.put(copy_names[0], block_of(Choice{7, Slot::a, 7, {Marks{true, true}, Marks{true, false}}}));
  repaired(disk, running_slot(Slot::a), Exit::repaired, "was cut short; completed");
  CHECK_CONTAINS(answer(disk, {"status"}), "B=whole,unconfirmed\n");
}

void with_no_copy_left_what_runs_is_kept() {
  LostPowerDisk disk = new_disk();
  disk.put(copy_names[0], "");
  disk.put(copy_names[1], std::string(3, 'x'));
  disk.put(attempts_name, block_of(Attempts{1, 3, Slot::b, {}}));
  const Outcome outcome = perform({"get-primary"}, disk, {});
  CHECK(outcome.exit == Exit::failed);
  CHECK_CONTAINS(outcome.said.front(), "run 'repair'");
  repaired(disk, {}, Exit::failed, "no rauc.slot=A or =B");
  repaired(disk, running_slot(Slot::b), Exit::repaired, "slot B runs and is kept");
  // Attempts of a former trial with the same number are forgotten.
  CHECK_CONTAINS(answer(disk, {"status"}),
                 "primary=B\nA=not-whole\nB=whole,unconfirmed\ntrial=0000000001\nattempts=0\n");
}

void without_any_whole_slot_what_runs_is_marked() {
  LostPowerDisk disk = new_disk();
  const std::string none = block_of(Choice{5, Slot::a, 5, {}});
  disk.put(copy_names[0], none);
  disk.put(copy_names[1], none);
  repaired(disk, running_slot(Slot::b), Exit::repaired, "no slot is marked as whole");
  CHECK_CONTAINS(answer(disk, {"status"}), "primary=B\nA=not-whole\nB=whole,unconfirmed\n");
}

// Somebody started it by hand.
void a_slot_that_runs_without_its_mark_is_told() {
  LostPowerDisk disk = new_disk();
  const Outcome outcome = perform({"repair"}, disk, {Slot::b, "manual", 1});
  CHECK(outcome.exit == Exit::done);
  CHECK_CONTAINS(outcome.said.front(), "slot B runs but is not marked as whole");
  CHECK_EQUAL(answer(disk, {"get-state", "B"}), "bad\n");
}

void what_cannot_be_written_is_told_and_nothing_changes() {
  LostPowerDisk disk = new_disk();
  disk.is_read_only = true;
  for (const Words& words :
       {Words{"set-primary", "B"}, Words{"mark-whole", "B", "B"}, Words{"set-state", "A", "good"}}) {
    const Outcome outcome = perform(words, disk, running_slot(Slot::a));
    CHECK(outcome.exit == Exit::failed);
    CHECK_CONTAINS(outcome.said.front(), "read-only");
  }
  CHECK_CONTAINS(answer(disk, {"status"}), "primary=A\nA=whole,unconfirmed\nB=not-whole\n");
  disk.put(copy_names[0], "");
  repaired(disk, running_slot(Slot::a), Exit::failed, "could not be mended");
}

void the_counter_ends_with_a_message() {
  const std::string last = block_of(Choice{last_counter, Slot::a, 1, {Marks{true, true}, Marks{}}});
  LostPowerDisk disk({{copy_names[0], last}, {copy_names[1], last}, {attempts_name, block_of(Attempts{})}});
  const Outcome outcome = perform({"set-primary", "B"}, disk, {});
  CHECK(outcome.exit == Exit::failed);
  CHECK_CONTAINS(outcome.said.front(), "at its end");
}

// Bytes that nobody thought of: no verb crashes, and a repair leaves what every verb can use.
void damaged_bytes_are_survived() {
  std::mt19937 random(14);
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random()) % limit; };
  for (int round = 0; round < 3000; ++round) {
    LostPowerDisk disk = new_disk();
    const std::string good = block_of(Choice{9, Slot::b, 8, {Marks{true, true}, Marks{true, false}}});
    for (const char* name : {copy_names[0], copy_names[1], attempts_name}) {
      std::string bytes = name == attempts_name ? block_of(Attempts{8, 1, Slot::b, {}}) : good;
      switch (below(4)) {
        case 0:
          break;
        case 1:
          for (std::size_t i = 0; i <= below(4); ++i)
            bytes[below(bytes.size())] = static_cast<char>(random());
          break;
        case 2:
          bytes.resize(below(2000), static_cast<char>(random()));
          break;
        default:
          for (char& byte : bytes) byte = static_cast<char>(random());
      }
      disk.put(name, bytes);
    }
    for (const Words& words : {Words{"status"}, Words{"get-primary"}, Words{"get-state", "A"}}) {
      const Exit code = perform(words, disk, running_slot(Slot::a)).exit;
      CHECK(code == Exit::done || code == Exit::failed);
    }
    const Exit code = perform({"repair"}, disk, running_slot(Slot::a)).exit;
    CHECK(code == Exit::done || code == Exit::repaired);
    CHECK_CONTAINS(answer(disk, {"status"}), "copies=equal");
    CHECK_EQUAL(answer(disk, {"get-state", "A"}), "good\n");
  }
}

}  // namespace
}  // namespace flexrf::boot::verbs_test

int main() {
  using namespace flexrf::boot::verbs_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_new_disk_has_one_slot),
      CONTAINED_TEST(rauc_installs),
      CONTAINED_TEST(each_choice_begins_a_trial_of_its_own),
      CONTAINED_TEST(the_last_whole_slot_stays),
      CONTAINED_TEST(only_what_runs_and_is_whole_is_confirmed),
      CONTAINED_TEST(what_came_up_has_its_attempts_back),
      CONTAINED_TEST(a_fallback_that_is_healthy_stays),
      CONTAINED_TEST(the_kernels_command_line_is_read),
      CONTAINED_TEST(wrong_words_are_told),
      CONTAINED_TEST(a_mark_waits_for_the_partitions),
      CONTAINED_TEST(a_damaged_copy_is_told_and_written_anew),
      CONTAINED_TEST(what_can_be_repaired_is),
      CONTAINED_TEST(with_no_copy_left_what_runs_is_kept),
      CONTAINED_TEST(without_any_whole_slot_what_runs_is_marked),
      CONTAINED_TEST(a_slot_that_runs_without_its_mark_is_told),
      CONTAINED_TEST(what_cannot_be_written_is_told_and_nothing_changes),
      CONTAINED_TEST(the_counter_ends_with_a_message),
      CONTAINED_TEST(damaged_bytes_are_survived),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
