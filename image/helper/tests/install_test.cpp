// Installing an update: when, in which order, and what is left when somebody dies in between.
#include <string>

#include "image/helper/tests/bench.hpp"

namespace flexrf::helper::install_test {
namespace {

void installing_forbids_motion_first() {
  Bench bench;
  bench.pc.has_verified_bundle();
  Helper helper = bench.pc.helper();
  bench.pc.run(helper, 1);
  CHECK_EQUAL(bench.pc.motion(), "permitted\n");
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
  CHECK_EQUAL(bench.pc.asked_systemd(start_install), 1);
  CHECK_EQUAL(bench.pc.word_at_systemd, "an update is being installed\n");
  CHECK_EQUAL(bench.phase(), "installing");
  CHECK(!bench.pc.has(permission_for_older(bench.pc.files.update)));
  // The unit removes the file before it writes its own: that permits nothing.
  CHECK(remove_result(bench.pc.files.update, Job::install));
  bench.verbs->tick();
  bench.pc.run(helper, 3);
  CHECK_EQUAL(bench.pc.motion(), "an update is being installed\n");
  bench.pc.result(Job::install, "state=running\npercent=1\n");
  bench.verbs->tick();
  bench.pc.run(helper, 3);
  CHECK_EQUAL(bench.pc.motion(), "an update is being installed\n");
  for (const Verb verb : {Verb::upload, Verb::install, Verb::choose, Verb::restart})
    CHECK_CONTAINS(bench.answer_to(verb), "409 an update is being installed; wait until that is done");
  bench.pc.result(Job::install, "state=done\npercent=100\n");
  bench.pc.run(helper, 1);
  bench.verbs->tick();
  bench.pc.now += minutes{10};
  bench.verbs->tick();
  CHECK(!bench.pc.has(bench.pc.bundle()));
  CHECK_CONTAINS(bench.state(), R"("motion":"an update was installed: the PC has to be restarted\n")");
  CHECK_EQUAL(bench.phase(), "installed");
  for (const Verb verb : {Verb::upload, Verb::install})
    CHECK_CONTAINS(bench.answer_to(verb), "409 an update was installed; restart the PC first");
  CHECK_EQUAL(bench.answer_to(Verb::restart), "200 ");
  CHECK_EQUAL(bench.pc.asked_systemd("reboot"), 1);
}

void an_installation_that_failed_may_be_tried_again() {
  Bench bench;
  bench.pc.has_verified_bundle();
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
  bench.pc.result(Job::install, "state=failed\nwhy=the disk cannot be written\n");
  bench.verbs->tick();
  CHECK_EQUAL(bench.pc.motion(), "permitted\n");
  CHECK_CONTAINS(bench.state(), R"("why":"the disk cannot be written")");
  CHECK_EQUAL(bench.phase(), "failed");
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
  CHECK_EQUAL(bench.pc.asked_systemd(start_install), 2);
}

void nothing_is_done_while_the_cell_may_move() {
  Bench bench;
  bench.pc.has_verified_bundle();
  bench.pc.panel.may_move = true;
  for (const Verb verb : {Verb::install, Verb::choose, Verb::restart})
    CHECK_CONTAINS(bench.answer_to(verb), "409 the cell may move; stop motion first");
  bench.pc.panel = {"the panel cannot be reached: Connection refused", false, true};
  for (const Verb verb : {Verb::install, Verb::choose, Verb::restart})
    CHECK_CONTAINS(bench.answer_to(verb),
                   "503 whether the cell may move cannot be told: the panel cannot be reached");
  CHECK(bench.pc.systemd.empty());
  CHECK_EQUAL(bench.phase(), "verified");
}

void a_start_at_the_last_moment_is_waited_for_and_then_counts() {
  Bench bench;
  bench.pc.has_verified_bundle();
  Helper helper = bench.pc.helper();
  bench.pc.run(helper, 1);
  // Somebody gives Start between the question and the word: the word ends it.
  const auto ask = bench.pc.surroundings.ask_panel;
  int questions = 0;
  bench.pc.surroundings.ask_panel = [&](Duration wait) {
    PanelAnswer answer = ask(wait);
    answer.may_move = ++questions > 1 && questions < 4;
    return answer;
  };
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
  CHECK_EQUAL(questions, 4);
  // An application that does not obey: nothing is installed, and the word is taken back.
  bench.pc.result(Job::install, "state=failed\nwhy=\n");
  questions = 0;
  bench.pc.surroundings.ask_panel = [&](Duration wait) {
    PanelAnswer answer = ask(wait);
    bench.pc.now += seconds{1};
    answer.may_move = ++questions > 1;
    if (questions == 3) CHECK_EQUAL(bench.pc.motion(), "an update is being installed\n");
    return answer;
  };
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 the cell may move; stop motion first");
  CHECK_EQUAL(bench.pc.asked_systemd(start_install), 1);
  CHECK_EQUAL(bench.pc.motion(), "permitted\n");
}

void what_cannot_be_started_leaves_nothing_behind() {
  Bench bench;
  bench.pc.has_verified_bundle();
  bench.pc.systemd_failure = "systemctl ended with 5";
  CHECK_CONTAINS(bench.answer_to(Verb::install),
                 "503 flexrf-update@install.service cannot be started: systemctl ended with 5");
  CHECK_EQUAL(bench.phase(), "failed");
  CHECK_EQUAL(bench.pc.motion(), "permitted\n");
  CHECK_CONTAINS(bench.answer_to(Verb::restart), "503 the PC cannot be restarted: systemctl ended with 5");
  CHECK_EQUAL(bench.pc.motion(), "permitted\n");
  // A word that cannot be left forbids nothing: then nothing is installed.
  fs::remove(bench.pc.files.word);
  fs::create_directory(bench.pc.files.word);
  bench.pc.systemd_failure = "";
  CHECK_CONTAINS(bench.answer_to(Verb::install), "503 motion cannot be forbidden");
  CHECK_EQUAL(bench.pc.asked_systemd(start_install), 1);
}

void a_version_that_is_not_confirmed_installs_nothing() {
  Bench bench;
  bench.pc.has_verified_bundle();
  bench.pc.choose({"set-primary", "B"});
  bench.pc.choose({"mark-whole", "B", bench.pc.files.command_line});
  bench.pc.boots("B", "trial");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 this version has not confirmed itself");
  fs::remove_all(bench.pc.files.choice);
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 which version of this PC counts cannot be told");
  CHECK(bench.pc.systemd.empty());
}

/// With one version that cannot be well, as when a device is missing that it wants, an update is the way out.
void the_only_version_need_not_be_confirmed_for_an_update() {
  Bench bench;
  fs::remove_all(bench.pc.files.choice);
  fs::create_directory(bench.pc.files.choice);
  bench.pc.choose({"create"});
  bench.pc.has_verified_bundle();
  bench.pc.boots("?", "only");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 which slot runs cannot be told");
  bench.pc.boots("A", "only");
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
}

/// The file is there from the request on, and until the unit that installs has ended.
void permits_one_installation(Bench& bench, const Request& request, const std::string& permission) {
  CHECK_EQUAL(refusal(bench.ask(request)), "200 ");
  CHECK(bench.pc.has(permission));
  bench.verbs->tick();
  CHECK(bench.pc.has(permission));
  bench.pc.result(Job::install, "state=failed\nwhy=\n");
  bench.verbs->tick();
  CHECK(!bench.pc.has(permission));
}

void an_older_bundle_has_to_be_meant() {
  Bench bench;
  bench.pc.has_verified_bundle("999");
  CHECK_CONTAINS(bench.state(), R"("older":true)");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 the bundle is older than what runs");
  const std::string permission = permission_for_older(bench.pc.files.update);
  CHECK(!bench.pc.has(permission));
  Request meant = request(Verb::install);
  meant.older = true;
  permits_one_installation(bench, meant, permission);
  // Of one that is not older it permits nothing.
  bench.pc.has_verified_bundle("1000");
  Pc::write(permission, "");
  CHECK_EQUAL(refusal(bench.ask(meant)), "200 ");
  CHECK(!bench.pc.has(permission));
  // One of which nobody knows how old it is counts as older; what runs has to be known.
  bench.pc.result(Job::install, "state=failed\nwhy=\n");
  bench.pc.has_verified_bundle("soon");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 the bundle is older");
  fs::remove(bench.pc.files.version);
  CHECK_CONTAINS(refusal(bench.ask(meant)), "503 which version runs cannot be told");
}

/// A version with simulated drivers is healthy on every PC, so health cannot keep it off one with real
/// drivers.
void other_drivers_have_to_be_meant() {
  Bench bench;
  const std::string permission = permission_for_drivers(bench.pc.files.update);
  const auto runs_with = [&](const std::string& drivers) {
    Pc::write(bench.pc.files.version, "version=v1\nbuilt=1000\n" + drivers);
  };
  const auto holds = [&](const std::string& drivers) {
    bench.pc.result(Job::install, "state=failed\nwhy=\n");
    bench.pc.has_verified_bundle("2000\n" + drivers);
  };
  Request meant = request(Verb::install);
  meant.other_drivers = true;
  runs_with("drivers=arm=canopen,camera=v4l2,lamp=gpio,gripper=robotiq,valve=gpio\n");
  holds("drivers=arm=simulated,camera=simulated,gripper=simulated,valve=gpio,horn=gpio\n");
  CHECK_CONTAINS(bench.answer_to(Verb::install),
                 "409 that version has other drivers (arm: canopen -> simulated, camera: v4l2 -> "
                 "simulated, lamp: gpio -> none, and 2 more); ask again with 'other_drivers'");
  CHECK(!bench.pc.has(permission));
  permits_one_installation(bench, meant, permission);
  // The same drivers need no word, in whatever order they stand; the unit compares the lines.
  runs_with("drivers=arm=canopen,lamp=gpio\n");
  holds("drivers=lamp=gpio,arm=canopen\n");
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
  CHECK(bench.pc.has(permission));
  holds("drivers=arm=canopen,lamp=gpio\n");
  CHECK_EQUAL(refusal(bench.ask(meant)), "200 ");
  CHECK(!bench.pc.has(permission));
  // Neither of two versions is believed that does not tell them.
  holds("");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 that version does not say which drivers its devices");
  runs_with("");
  holds("drivers=arm=canopen\n");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 that version has other drivers (arm: none -> canopen)");
}

void what_a_helper_began_the_next_one_goes_on_with() {
  Bench bench;
  bench.pc.has_verified_bundle();
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
  bench.starts_anew();  // before systemd, or the unit, did anything
  bench.verbs->tick();
  CHECK_EQUAL(bench.pc.asked_systemd(start_install), 2);  // no second one, if systemd knows of the first
  bench.verbs->tick();
  CHECK_EQUAL(bench.pc.asked_systemd(start_install), 2);
  bench.pc.result(Job::install, "state=running\npercent=1\n");
  bench.starts_anew();
  bench.verbs->tick();
  CHECK_EQUAL(bench.pc.asked_systemd(start_install), 2);
  CHECK_EQUAL(bench.phase(), "installing");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 an update is being installed");
  bench.pc.result(Job::install, "state=done\npercent=100\n");
  bench.starts_anew();
  bench.verbs->tick();
  CHECK_EQUAL(bench.phase(), "installed");
}

void a_result_that_nobody_understands_forbids_all_but_a_restart() {
  Bench bench;
  bench.pc.has_verified_bundle();
  bench.pc.result(Job::install, "state=perhaps\n");
  for (const Verb verb : {Verb::upload, Verb::install, Verb::choose})
    CHECK_CONTAINS(bench.answer_to(verb), "409 whether an update is being installed cannot be told: ");
  CHECK_CONTAINS(bench.state(), "does not say how far it is");
  CHECK_EQUAL(bench.answer_to(Verb::restart), "200 ");
}

void a_unit_that_never_begins_is_given_up() {
  Bench bench;
  bench.pc.has_verified_bundle();
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
  bench.pc.now += seconds{59};
  bench.verbs->tick();
  CHECK_EQUAL(bench.phase(), "installing");
  bench.pc.now += seconds{1};
  bench.verbs->tick();
  CHECK_EQUAL(bench.phase(), "failed");
  CHECK_EQUAL(bench.pc.motion(), "permitted\n");
  CHECK_CONTAINS(bench.state(), "flexrf-update@install.service did not begin within 60 s");
  CHECK_EQUAL(bench.pc.asked_systemd("stop --no-block flexrf-update@install.service"), 1);
}

/// Each request is waited for from its own beginning on, not from that of the one before.
void a_later_request_has_a_wait_of_its_own() {
  Bench bench;
  bench.pc.has_verified_bundle();
  CHECK_EQUAL(bench.answer_to(Verb::install), "200 ");
  for (const char* state : {"state=running\n", "state=failed\nwhy=it is older\n"}) {
    bench.pc.result(Job::install, state);
    bench.verbs->tick();
  }
  bench.pc.now += seconds{61};
  bench.pc.result(Job::install, "state=starting\n");
  bench.verbs->tick();
  CHECK_EQUAL(bench.phase(), "installing");
  CHECK_EQUAL(bench.pc.asked_systemd("stop --no-block flexrf-update@install.service"), 0);
  CHECK_EQUAL(bench.pc.asked_systemd("start --no-block flexrf-update@install.service"), 2);
  bench.pc.now += seconds{60};
  bench.verbs->tick();
  CHECK_EQUAL(bench.phase(), "failed");
}

}  // namespace
}  // namespace flexrf::helper::install_test

int main() {
  using namespace flexrf::helper::install_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(installing_forbids_motion_first),
      CONTAINED_TEST(an_installation_that_failed_may_be_tried_again),
      CONTAINED_TEST(nothing_is_done_while_the_cell_may_move),
      CONTAINED_TEST(a_start_at_the_last_moment_is_waited_for_and_then_counts),
      CONTAINED_TEST(what_cannot_be_started_leaves_nothing_behind),
      CONTAINED_TEST(a_version_that_is_not_confirmed_installs_nothing),
      CONTAINED_TEST(the_only_version_need_not_be_confirmed_for_an_update),
      CONTAINED_TEST(an_older_bundle_has_to_be_meant),
      CONTAINED_TEST(other_drivers_have_to_be_meant),
      CONTAINED_TEST(what_a_helper_began_the_next_one_goes_on_with),
      CONTAINED_TEST(a_result_that_nobody_understands_forbids_all_but_a_restart),
      CONTAINED_TEST(a_unit_that_never_begins_is_given_up),
      CONTAINED_TEST(a_later_request_has_a_wait_of_its_own),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
