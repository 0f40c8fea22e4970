// The helper's verbs: who may, when, in which order, and what is left when the helper dies in between.
#include "image/helper/verbs.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "image/helper/state_answer.hpp"
#include "image/helper/tests/pc.hpp"

namespace flexrf::helper {
namespace {

using std::chrono::minutes;

const std::string start_verify = "start --no-block flexrf-update@verify.service";
const std::string start_install = "start --no-block flexrf-update@install.service";

Request request(Verb verb) {
  Request request;
  request.verb = verb;
  request.user = "anna";
  request.password = right_password;
  request.size = 6;
  request.slot = boot::Slot::b;
  return request;
}

std::string refusal(const Answer& answer) {
  return std::to_string(answer.status) + ' ' + answer.why;
}

class Bench {
 public:
  Bench() { pc.is_ready(); }

  Answer ask(const Request& request) { return verbs->perform(request, "uid 990, process 7"); }
  std::string answer_to(Verb verb) { return refusal(ask(request(verb))); }
  std::string part(const std::string& token, std::uint64_t offset, const std::string& bytes) {
    Request part;
    part.verb = Verb::part;
    part.upload = token;
    part.offset = offset;
    part.bytes = bytes;
    return refusal(ask(part));
  }
  /// The helper died and was started anew.
  void starts_anew() {
    verbs.emplace(pc.files, pc.surroundings, pc.word, [this] { return pc.now; });
  }
  std::string state() {
    return state_answer(pc.files, read_facts(pc.files, seconds{1}),
                        {pc.motion(), {}, seconds{60}, verbs->received()});
  }
  std::string phase() {
    const std::string text = state();
    const std::size_t at = text.find("\"phase\":\"") + 9;
    return text.substr(at, text.find('"', at) - at);
  }

  Pc pc;
  std::optional<Verbs> verbs{std::in_place, pc.files, pc.surroundings, pc.word, [this] { return pc.now; }};
};

void only_an_admin_with_the_right_password_may() {
  Bench bench;
  bench.pc.has_users("olga:engineer", "anna:admin");
  for (const Verb verb : {Verb::upload, Verb::install, Verb::choose, Verb::restart}) {
    Request asked = request(verb);
    asked.user = "olga";
    CHECK_CONTAINS(refusal(bench.ask(asked)), "403 this needs the role admin");
    bench.pc.now += minutes{20};
    asked.user = "nobody";
    CHECK_CONTAINS(refusal(bench.ask(asked)), "403 user or password is wrong");
    asked = request(verb);
    asked.password = "a wrong password";
    CHECK_CONTAINS(refusal(bench.ask(asked)), "403 user or password is wrong");
    asked.password = std::string(1000, 'x');
    CHECK_CONTAINS(refusal(bench.ask(asked)), "403 user or password is wrong");
    bench.pc.now += minutes{20};
  }
  CHECK_CONTAINS(bench.pc.said.back(),
                 "restart by 'anna' from uid 990, process 7: refused: user or password is wrong");
  CHECK(bench.pc.systemd.empty());
  CHECK_EQUAL(bench.phase(), "none");
}

void wrong_passwords_are_slowed() {
  Bench bench;
  Request wrong = request(Verb::restart);
  wrong.password = "a wrong password";
  unsigned refused_early = 0;
  for (int i = 0; i < 10; ++i) {
    const Answer answer = bench.ask(wrong);
    if (answer.status == 429) ++refused_early;
    CHECK_EQUAL(answer.retry_after_s > 0, answer.status == 429);
  }
  CHECK_EQUAL(refused_early, 6U);
  // Now the right one has to wait, too, and then it is as it was.
  CHECK_CONTAINS(bench.answer_to(Verb::restart), "429 too many wrong passwords; try again in 1 s");
  bench.pc.now += seconds{1};
  CHECK_EQUAL(bench.answer_to(Verb::restart), "200 ");
}

void a_lesser_user_does_not_end_the_delays() {
  Bench bench;
  bench.pc.has_users("olga:viewer", "anna:admin");
  Request wrong = request(Verb::restart);
  wrong.password = "a wrong password";
  Request lesser = request(Verb::restart);
  lesser.user = "olga";
  unsigned early = 0;
  for (int i = 0; i < 5; ++i) {
    early += bench.ask(wrong).status == 429 ? 1U : 0U;
    early += bench.ask(lesser).status == 429 ? 1U : 0U;
  }
  CHECK(early > 0);
}

void users_that_cannot_be_read_are_no_users() {
  Bench bench;
  // What stands in the file, or where it leads, is nobody's business.
  Pc::write(bench.pc.files.users, "root:secret-of-others:x\n");
  const std::string why = bench.answer_to(Verb::upload);
  CHECK_CONTAINS(why, "503 who may log in cannot be read");
  CHECK(why.find("secret") == std::string::npos);
}

void an_upload_is_verified_by_a_unit() {
  Bench bench;
  const Answer begun = bench.ask(request(Verb::upload));
  CHECK_EQUAL(begun.status, 200U);
  CHECK_CONTAINS(bench.pc.said.back(), "upload by 'anna' from uid 990, process 7, 6 bytes: accepted");
  CHECK_EQUAL(bench.phase(), "receiving");
  CHECK_EQUAL(bench.part(begun.upload, 0, "bun"), "200 ");
  CHECK_CONTAINS(bench.state(), R"("phase":"receiving","received":3,"size":6,"percent":50)");
  CHECK_EQUAL(bench.part(begun.upload, 3, "dle"), "200 ");
  CHECK_EQUAL(text_of_file(bench.pc.bundle()), "bundle");
  CHECK_EQUAL(bench.pc.asked_systemd(start_verify), 1);
  CHECK_EQUAL(bench.phase(), "verifying");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 the bundle is being verified");
  CHECK_CONTAINS(bench.answer_to(Verb::upload), "409 the bundle before this one is being verified");
  bench.pc.result(Job::verify, "state=running\npercent=40\n");
  CHECK_CONTAINS(bench.state(), R"("phase":"verifying","received":6,"size":6,"percent":40)");
  bench.pc.result(
      Job::verify,
      "state=done\npercent=100\napplication=pick-station\nversion=20270101T000000Z-1\nbuilt=2000\n");
  CHECK_CONTAINS(bench.state(), R"("phase":"verified")");
  CHECK_CONTAINS(bench.state(),
                 R"("version":"20270101T000000Z-1","application":"pick-station","older":false,"why":""}})");
  // A new one begins: what was verified is gone with its results.
  CHECK_EQUAL(bench.answer_to(Verb::upload), "200 ");
  CHECK(!bench.pc.has(bench.pc.bundle()));
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 the bundle is not here yet");
  bench.pc.now += minutes{11};
  bench.verbs->tick();
  CHECK_CONTAINS(bench.state(), R"("phase":"none","received":0,"size":0,"percent":0)");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 there is no verified bundle");
}

void what_is_no_good_is_told_and_removed() {
  Bench bench;
  bench.pc.has_verified_bundle();
  bench.pc.result(Job::verify, "state=failed\nwhy=it is signed by nobody whom this PC knows\n");
  bench.verbs->tick();
  bench.pc.now += minutes{10};
  bench.verbs->tick();
  CHECK(!bench.pc.has(bench.pc.bundle()));
  CHECK_CONTAINS(bench.state(), R"("phase":"failed")");
  CHECK_CONTAINS(bench.state(), R"("why":"it is signed by nobody whom this PC knows")");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 there is no verified bundle");
  CHECK_EQUAL(bench.answer_to(Verb::upload), "200 ");
}

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

void an_older_bundle_has_to_be_meant() {
  Bench bench;
  bench.pc.has_verified_bundle("999");
  CHECK_CONTAINS(bench.state(), R"("older":true)");
  CHECK_CONTAINS(bench.answer_to(Verb::install), "409 the bundle is older than what runs");
  const std::string permission = permission_for_older(bench.pc.files.update);
  CHECK(!bench.pc.has(permission));
  Request meant = request(Verb::install);
  meant.older = true;
  CHECK_EQUAL(refusal(bench.ask(meant)), "200 ");
  CHECK(bench.pc.has(permission));
  bench.verbs->tick();
  CHECK(bench.pc.has(permission));
  bench.pc.result(Job::install, "state=failed\nwhy=\n");
  bench.verbs->tick();
  CHECK(!bench.pc.has(permission));
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

void a_slot_is_chosen_that_is_whole() {
  Bench bench;
  CHECK_CONTAINS(bench.answer_to(Verb::choose), "409 slot B has no whole version");
  Request running = request(Verb::choose);
  running.slot = boot::Slot::a;
  CHECK_CONTAINS(refusal(bench.ask(running)), "409 slot A is chosen already");
  bench.pc.choose({"mark-whole", "B", bench.pc.files.command_line});
  CHECK_EQUAL(bench.answer_to(Verb::choose), "200 ");
  CHECK_CONTAINS(bench.pc.said.back(), "choose by 'anna' from uid 990, process 7, slot B: accepted");
  CHECK(bench.pc.says("primary=B"));
  CHECK_CONTAINS(
      bench.state(),
      R"("slot":"A","boot":"only","confirmed":true,"slots":{"A":{"version":"20261128T001500Z-4fb48992","whole":true,"primary":false},"B":{"version":"","whole":true,"primary":true}})");
  CHECK_EQUAL(refusal(bench.ask(running)), "200 ");
  CHECK(bench.pc.says("primary=A"));
  fs::remove_all(bench.pc.files.choice);
  CHECK_CONTAINS(bench.answer_to(Verb::choose), "503 cannot open");
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
  CHECK_CONTAINS(bench.state(), "flexrf-update@install.service did not begin within 60 s");
  CHECK_EQUAL(bench.pc.asked_systemd("stop --no-block flexrf-update@install.service"), 1);
}

void after_a_restart_of_the_pc_nothing_of_an_update_is_left() {
  Bench bench;
  bench.pc.has_verified_bundle();
  Pc::write(permission_for_older(bench.pc.files.update), "");
  for (const Job job : {Job::verify, Job::install}) CHECK(remove_result(bench.pc.files.update, job));
  bench.starts_anew();
  bench.verbs->tick();
  CHECK(bench.pc.has(bench.pc.bundle()));
  bench.pc.now += minutes{10};
  bench.verbs->tick();
  CHECK(fs::is_empty(bench.pc.files.update.folder));
  CHECK_EQUAL(bench.phase(), "none");
}

void the_state_tells_all() {
  Bench bench;
  Pc::write(bench.pc.files.boot_notice, "choice0.env was damaged\n");
  fs::create_directory(bench.pc.files.notices);
  Pc::write(bench.pc.files.notices + "/data",
            "the data partition was made anew\n\xff" + std::string(500, 'x') + '\n');
  Pc::write(bench.pc.files.version,
            "application=pick-station\nversion=v1\nbuilt=1795824900\ndevelopment_key=yes\n");
  Pc::write(bench.pc.files.update.folder + "/version-a", "version=of another time\n");
  Pc::write(bench.pc.files.update.folder + "/version-b", "application=pick-station\nversion=v0\n");
  bench.pc.choose({"mark-whole", "B", bench.pc.files.command_line});
  const std::string text = bench.state();
  CHECK_CONTAINS(
      text,
      R"({"ok":true,"application":"pick-station","version":"v1","built":1795824900,"slot":"A","boot":"only","confirmed":true,)");
  CHECK_CONTAINS(
      text,
      R"("slots":{"A":{"version":"v1","whole":true,"primary":true},"B":{"version":"v0","whole":true,"primary":false}},"claimed":true,)");
  CHECK_CONTAINS(
      text,
      R"("development_key":true,"notices":["choice0.env was damaged","the data partition was made anew",)");
  CHECK_CONTAINS(
      text,
      R"("healthy_for_s":0,"healthy_needed_s":60,"why_not_healthy":"","update":{"phase":"none","received":0,"size":0,"percent":0,"version":"","application":"","older":false,"why":""}})");
  // Without any of these files it still is an answer.
  for (const std::string& file : {bench.pc.files.version, bench.pc.files.users, bench.pc.files.command_line})
    fs::remove(file);
  fs::remove_all(bench.pc.files.choice);
  CHECK_CONTAINS(bench.state(), R"("built":0,"slot":"","boot":"unknown","confirmed":false)");
}

}  // namespace
}  // namespace flexrf::helper

int main() {
  using namespace flexrf::helper;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(only_an_admin_with_the_right_password_may),
      CONTAINED_TEST(wrong_passwords_are_slowed),
      CONTAINED_TEST(a_lesser_user_does_not_end_the_delays),
      CONTAINED_TEST(users_that_cannot_be_read_are_no_users),
      CONTAINED_TEST(an_upload_is_verified_by_a_unit),
      CONTAINED_TEST(what_is_no_good_is_told_and_removed),
      CONTAINED_TEST(installing_forbids_motion_first),
      CONTAINED_TEST(an_installation_that_failed_may_be_tried_again),
      CONTAINED_TEST(nothing_is_done_while_the_cell_may_move),
      CONTAINED_TEST(a_start_at_the_last_moment_is_waited_for_and_then_counts),
      CONTAINED_TEST(what_cannot_be_started_leaves_nothing_behind),
      CONTAINED_TEST(a_version_that_is_not_confirmed_installs_nothing),
      CONTAINED_TEST(an_older_bundle_has_to_be_meant),
      CONTAINED_TEST(a_slot_is_chosen_that_is_whole),
      CONTAINED_TEST(what_a_helper_began_the_next_one_goes_on_with),
      CONTAINED_TEST(a_unit_that_never_begins_is_given_up),
      CONTAINED_TEST(after_a_restart_of_the_pc_nothing_of_an_update_is_left),
      CONTAINED_TEST(the_state_tells_all),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
