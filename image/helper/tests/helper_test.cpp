// The helper's decisions: its word, the version's confirmation, the turn that is given up. The panel, the
// clock and the restart are the test's.
#include "image/helper/helper.hpp"

#include <algorithm>
#include <string>

#include "image/boot/blocks.hpp"
#include "image/helper/state_answer.hpp"
#include "image/helper/tests/pc.hpp"

namespace flexrf::helper::helper_test {
namespace {

void the_word_says_what_stands_against_motion() {
  Facts facts;
  facts.choice_failure = "the folder is not there";
  CHECK_CONTAINS(permission_of(facts), "nobody has claimed this PC");
  facts.is_claimed = true;
  facts.update = Phase::installing;
  CHECK_EQUAL(permission_of(facts), "an update is being installed");
  facts.update = Phase::installed;
  CHECK_EQUAL(permission_of(facts), "an update was installed: the PC has to be restarted");
  facts.update = Phase::unknown;
  facts.update_failure = "its file is damaged";
  CHECK_CONTAINS(permission_of(facts), "cannot be told: its file is damaged; restart the PC");
  facts.update = Phase::verifying;
  CHECK_CONTAINS(permission_of(facts), "cannot be told: the folder is not there");
  facts.choice = boot::choice_of_new_disk();
  CHECK_CONTAINS(permission_of(facts), "boot loader");
  facts.running.slot = boot::Slot::a;
  CHECK_CONTAINS(permission_of(facts), "has not confirmed itself");
  // The other one's mark is no help.
  facts.choice->of(boot::Slot::b) = {true, true};
  CHECK_CONTAINS(permission_of(facts), "has not confirmed itself");
  facts.choice->of(boot::Slot::a) = {true, true};
  facts.address_on_trial = "enp0s2";
  CHECK_CONTAINS(permission_of(facts), "the address of enp0s2 is on trial");
  facts.address_on_trial.clear();
  CHECK_EQUAL(permission_of(facts), "permitted");
  facts.is_claimed = false;
  CHECK_CONTAINS(permission_of(facts), "nobody has claimed this PC");
}

void a_minute_of_health_confirms_the_version() {
  Pc pc;
  pc.claim();
  Helper helper = pc.helper();
  pc.run(helper, 60);  // the first and the last of these are 59 s apart
  CHECK_CONTAINS(pc.motion(), "has not confirmed itself");
  CHECK(pc.says("A=whole,unconfirmed"));
  pc.run(helper, 1);
  CHECK_EQUAL(pc.motion(), "permitted\n");
  CHECK(pc.says("A=whole,confirmed"));
  CHECK_CONTAINS(pc.said.at(pc.said.size() - 2), "slot A has confirmed itself");
  // From then on the panel is not asked: what runs is what boots.
  pc.panel.why_not_healthy = "unit robot is in fault";
  pc.run(helper, 1000);
  CHECK_EQUAL(pc.motion(), "permitted\n");
  CHECK_EQUAL(pc.asked_systemd("reboot"), 0);
}

void each_slot_is_told_what_ran_in_the_other_one() {
  Pc pc;
  Helper delivered = pc.helper();
  pc.run(delivered, 2);
  pc.choose({"mark-whole", "B", pc.files.command_line});
  pc.boots("B", "trial");
  Pc::write(pc.files.version, "application=pick-station\nversion=second\nbuilt=2000\n");
  Helper second = pc.helper();
  pc.run(second, 2);
  const std::string state = state_answer(pc.files, read_facts(pc.files, seconds{1}), {});
  CHECK_CONTAINS(
      state,
      R"("slots":{"A":{"version":"20261128T001500Z-4fb48992","whole":true,"primary":true,"driver_changes":[]},"B":{"version":"second")");
  // Who cannot note it says so, and does all else.
  fs::remove_all(pc.files.update.folder);
  Helper third = pc.helper();
  pc.run(third, 2);
  CHECK_EQUAL(std::count_if(pc.said.begin(), pc.said.end(),
                            [](const std::string& line) { return line.find("will not know") != line.npos; }),
              1);
}

void the_minute_begins_anew_after_each_gap() {
  Pc pc;
  pc.claim();
  Helper helper = pc.helper();
  pc.run(helper, 50);
  pc.panel.why_not_healthy = "unit robot is in fault: no answer";
  pc.run(helper, 1);
  CHECK_CONTAINS(pc.said.back(), "cannot confirm itself yet: unit robot is in fault: no answer");
  pc.panel.why_not_healthy = "";
  pc.run(helper, 60);
  CHECK(pc.says("A=whole,unconfirmed"));
  pc.now += seconds{20};  // nobody looked: the helper stood still, or was started anew
  pc.run(helper, 60);
  CHECK(pc.says("A=whole,unconfirmed"));
  pc.run(helper, 1);
  CHECK(pc.says("A=whole,confirmed"));
}

void an_unclaimed_pc_confirms_itself_and_does_not_move() {
  Pc pc;
  Helper helper = pc.helper();
  pc.run(helper, 100);
  CHECK(pc.says("A=whole,confirmed"));
  CHECK_CONTAINS(pc.motion(), "nobody has claimed this PC");
  pc.claim();
  pc.run(helper, 1);
  CHECK_EQUAL(pc.motion(), "permitted\n");
  // Others than an admin cannot claim it, and a file that others may read counts for nothing.
  pc.has_users("olga:operator");
  pc.run(helper, 1);
  CHECK_CONTAINS(pc.motion(), "nobody has claimed this PC");
  pc.claim();
  pc.run(helper, 1);
  CHECK_EQUAL(pc.motion(), "permitted\n");
  fs::permissions(pc.files.users, fs::perms::others_read, fs::perm_options::add);
  pc.run(helper, 1);
  CHECK_CONTAINS(pc.motion(), "nobody has claimed this PC");
}

void restarts_once_after_ten_minutes(Pc& pc) {
  Helper helper = pc.helper();
  pc.run(helper, 600);
  CHECK_EQUAL(pc.asked_systemd("reboot"), 0);
  pc.run(helper, 30);
  CHECK_EQUAL(pc.asked_systemd("reboot"), 1);
}

void a_version_on_trial_that_is_not_healthy_gives_up_its_turn_once() {
  Pc pc;
  pc.claim();
  pc.choose({"set-primary", "B"});
  pc.choose({"mark-whole", "B", pc.files.command_line});
  pc.boots("B", "trial");
  pc.panel.why_not_healthy = "device arm is in fault: it does not answer";
  restarts_once_after_ten_minutes(pc);
  CHECK_CONTAINS(pc.said.back(), "gives up its turn");
  CHECK_CONTAINS(pc.motion(), "has not confirmed itself");
}

/// A PC whose slots are both whole and which runs slot A, confirmed, at its third counted start.
struct ThirdStart {
  Pc pc;
  ThirdStart() {
    pc.claim();
    pc.choose({"confirm", "A"});
    pc.choose({"mark-whole", "B", pc.files.command_line});
    pc.boots("A", "confirmed");
    const boot::Choice choice = *read_facts(pc.files, seconds{1}).choice;
    Pc::write(pc.files.choice + "/attempts.env",
              boot::block_of(boot::Attempts{choice.trial, 3, boot::Slot::a, {}}));
    CHECK(pc.says("attempts=3"));
  }
};

void a_confirmed_version_that_comes_up_has_its_starts_back() {
  ThirdStart start;
  Pc& pc = start.pc;
  // No other version would mend a device.
  pc.panel.why_not_healthy = "device arm is in fault: it does not answer";
  Helper helper = pc.helper();
  pc.run(helper, 60);
  CHECK(pc.says("attempts=3"));
  CHECK_EQUAL(pc.motion(), "permitted\n");
  pc.run(helper, 1);
  CHECK(pc.says("attempts=0"));
  // From then on nobody asks, whatever becomes of the application.
  pc.panel.has_answered = false;
  pc.run(helper, 2000);
  CHECK_EQUAL(pc.asked_systemd("reboot"), 0);
}

void a_confirmed_version_that_does_not_come_up_gives_up_its_turn() {
  ThirdStart start;
  Pc& pc = start.pc;
  pc.panel.has_answered = false;
  pc.panel.why_not_healthy = "the panel does not answer";
  restarts_once_after_ten_minutes(pc);
  CHECK_CONTAINS(pc.said.back(), "does not answer, in 10 min: it gives up its turn");
  // The other one tells of it.
  pc.boots("B", "fallback");
  Pc::write(pc.files.update.folder + "/version-a", "version=first\n");
  Helper instead = pc.helper();
  pc.run(instead, 1);
  CHECK_CONTAINS(text_of_file(pc.files.notices + "/fallback"),
                 "slot A, version first, was started three times and did not come up; version ");
  // With no other version there is nobody to give it to.
  ThirdStart alone;
  alone.pc.panel = pc.panel;
  alone.pc.choose({"unmark-whole", "B"});
  Helper other = alone.pc.helper();
  alone.pc.run(other, 2000);
  CHECK_EQUAL(alone.pc.asked_systemd("reboot"), 0);
}

/// The number of the trial that the choice means.
std::string trial_of(const Pc& pc) {
  for (int number = 1; number < 10; ++number) {
    std::string text = "000000000" + std::to_string(number);
    if (pc.says("trial=" + text)) return text;
  }
  return {};
}

void what_was_fallen_back_to_becomes_the_primary_unless_somebody_decides_anew() {
  Pc pc;
  pc.claim();
  pc.choose({"confirm", "A"});
  pc.choose({"set-primary", "B"});
  pc.choose({"mark-whole", "B", pc.files.command_line});
  Pc::write(pc.files.command_line, "rauc.slot=A flexrf.boot=fallback flexrf.trial=" + trial_of(pc) + '\n');
  Helper helper = pc.helper();
  pc.run(helper, 60);
  CHECK_EQUAL(pc.motion(), "permitted\n");
  CHECK(pc.says("primary=B"));
  CHECK_EQUAL(text_of_file(pc.files.notices + "/fallback"),
              "slot B could not be started; version 20261128T001500Z-4fb48992 in slot A runs in its place\n");
  pc.run(helper, 1);
  CHECK(pc.says("primary=A"));
  // An update, or a person, means B again: that is a new trial.
  pc.choose({"set-primary", "B"});
  pc.run(helper, 200);
  CHECK(pc.says("primary=B"));
}

void a_version_without_another_one_never_restarts() {
  for (const char* const why : {"only", "fallback", "unknown", "manual"}) {
    Pc pc;
    pc.claim();
    pc.boots("A", why);
    pc.panel.why_not_healthy = "device arm is in fault: it does not answer";
    Helper helper = pc.helper();
    pc.run(helper, 2000);
    CHECK_EQUAL(pc.asked_systemd("reboot"), 0);
  }
  Pc pc;  // on trial, and the other slot is no longer whole
  pc.boots("A", "trial");
  pc.panel.why_not_healthy = "device arm is in fault: it does not answer";
  Helper helper = pc.helper();
  pc.run(helper, 2000);
  CHECK_EQUAL(pc.asked_systemd("reboot"), 0);
}

void without_the_choice_nothing_moves_and_it_is_said_once() {
  Pc pc;
  pc.claim();
  fs::remove_all(pc.files.choice);
  Helper helper = pc.helper();
  pc.run(helper, 100);
  CHECK_CONTAINS(pc.motion(), "cannot be told: cannot open " + pc.files.choice);
  CHECK_EQUAL(pc.said.size(), 3U);  // the word, health, and why it cannot be confirmed
}

void an_update_forbids_motion_until_the_pc_was_restarted() {
  Pc pc;
  pc.is_ready();
  pc.has_verified_bundle();
  Helper helper = pc.helper();
  const auto word = [&] {
    pc.run(helper, 1);
    return pc.motion();
  };
  CHECK_EQUAL(word(), "permitted\n");
  for (const char* const state : {"starting", "running"}) {
    pc.result(Job::install, std::string{"state="} + state + "\npercent=3\n");
    CHECK_EQUAL(word(), "an update is being installed\n");
  }
  pc.result(Job::install, "state=done\npercent=100\n");
  CHECK_EQUAL(word(), "an update was installed: the PC has to be restarted\n");
  // Half a line is none: nobody knows what is going on.
  pc.result(Job::install, "stat");
  CHECK_CONTAINS(word(), "does not say how far it is; restart the PC");
  pc.result(Job::install, "state=failed\nwhy=the disk is full\n");
  CHECK_EQUAL(word(), "permitted\n");
}

void the_word_is_held_whatever_is_true() {
  Pc pc;
  pc.is_ready();
  Helper helper = pc.helper();
  pc.run(helper, 1);
  CHECK(pc.word.hold("an update is being installed"));
  pc.run(helper, 3);
  CHECK_EQUAL(pc.motion(), "an update is being installed\n");
  pc.word.release();
  CHECK_EQUAL(pc.motion(), "permitted\n");
  // One that cannot be left does not hold, and is not believed to.
  fs::remove(pc.files.word);
  fs::create_directory(pc.files.word);
  CHECK(!pc.word.hold("an update is being installed"));
  CHECK_EQUAL(pc.word.text(), "permitted");
}

void a_word_that_cannot_be_left_is_left_when_it_can() {
  Pc pc("/run");
  pc.claim();
  Helper helper = pc.helper();
  pc.run(helper, 5);
  CHECK_CONTAINS(pc.said.front(), "the word about motion cannot be left");
  fs::create_directory(fs::path(pc.files.word).parent_path());
  pc.run(helper, 1);
  CHECK_CONTAINS(pc.motion(), "has not confirmed itself");
}

}  // namespace
}  // namespace flexrf::helper::helper_test

int main() {
  using namespace flexrf::helper::helper_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(the_word_says_what_stands_against_motion),
      CONTAINED_TEST(a_minute_of_health_confirms_the_version),
      CONTAINED_TEST(each_slot_is_told_what_ran_in_the_other_one),
      CONTAINED_TEST(the_minute_begins_anew_after_each_gap),
      CONTAINED_TEST(an_unclaimed_pc_confirms_itself_and_does_not_move),
      CONTAINED_TEST(a_version_on_trial_that_is_not_healthy_gives_up_its_turn_once),
      CONTAINED_TEST(a_confirmed_version_that_comes_up_has_its_starts_back),
      CONTAINED_TEST(a_confirmed_version_that_does_not_come_up_gives_up_its_turn),
      CONTAINED_TEST(what_was_fallen_back_to_becomes_the_primary_unless_somebody_decides_anew),
      CONTAINED_TEST(a_version_without_another_one_never_restarts),
      CONTAINED_TEST(without_the_choice_nothing_moves_and_it_is_said_once),
      CONTAINED_TEST(an_update_forbids_motion_until_the_pc_was_restarted),
      CONTAINED_TEST(the_word_is_held_whatever_is_true),
      CONTAINED_TEST(a_word_that_cannot_be_left_is_left_when_it_can),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
