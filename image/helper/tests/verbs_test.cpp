// The helper's verbs: who may, uploads, the choice, and what the state tells.
#include <string>

#include "image/helper/tests/bench.hpp"

namespace flexrf::helper::verbs_test {
namespace {

void only_an_admin_with_the_right_password_may() {
  Bench bench;
  bench.pc.has_users("olga:engineer", "anna:admin");
  for (const Verb verb : {Verb::upload, Verb::install, Verb::choose, Verb::network, Verb::keep_network,
                          Verb::hosts, Verb::restart}) {
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
  CHECK_CONTAINS(
      bench.state(),
      R"("version":"20270101T000000Z-1","application":"pick-station","older":false,"driver_changes":[],"why":""},)");
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

void a_slot_is_chosen_that_is_whole() {
  Bench bench;
  CHECK_CONTAINS(bench.answer_to(Verb::choose), "409 slot B has no whole version");
  Request running = request(Verb::choose);
  running.slot = boot::Slot::a;
  CHECK_CONTAINS(refusal(bench.ask(running)), "409 slot A is chosen already");
  bench.pc.choose({"mark-whole", "B", bench.pc.files.command_line});
  Pc::write(bench.pc.files.version, "version=v1\nbuilt=1000\ndrivers=arm=canopen\n");
  Pc::write(bench.pc.files.update.folder + "/version-b", "version=v0\ndrivers=arm=simulated\n");
  CHECK_CONTAINS(bench.answer_to(Verb::choose),
                 "409 that version has other drivers (arm: canopen -> simulated); ask again with "
                 "'other_drivers' if that is meant");
  fs::remove(bench.pc.files.update.folder + "/version-b");
  CHECK_CONTAINS(bench.answer_to(Verb::choose), "409 that version does not say which drivers");
  Request meant = request(Verb::choose);
  meant.other_drivers = true;
  CHECK_EQUAL(refusal(bench.ask(meant)), "200 ");
  CHECK_CONTAINS(bench.pc.said.back(), "choose by 'anna' from uid 990, process 7, slot B: accepted");
  CHECK(bench.pc.says("primary=B"));
  CHECK_CONTAINS(
      bench.state(),
      R"("slots":{"A":{"version":"v1","whole":true,"primary":false,"driver_changes":[]},"B":{"version":"","whole":true,"primary":true,"driver_changes":[{"device":"arm","from":"canopen","to":""}]}})");
  CHECK_EQUAL(refusal(bench.ask(running)), "200 ");
  CHECK(bench.pc.says("primary=A"));
  fs::remove_all(bench.pc.files.choice);
  CHECK_CONTAINS(bench.answer_to(Verb::choose), "503 cannot open");
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
  fs::create_directory(bench.pc.files.notices);
  Pc::write(bench.pc.files.notices + "/boot", "choice0.env was damaged\n");
  Pc::write(bench.pc.files.notices + "/data.new", "half a li");
  Pc::write(bench.pc.files.notices + "/data",
            "the data partition was made anew\n\xff" + std::string(500, 'x') + '\n');
  Pc::write(bench.pc.files.version,
            "application=pick-station\nversion=v1\nbuilt=1795824900\ndevelopment_key=yes\n"
            "drivers=arm=canopen,lamp=gpio\n");
  Pc::write(bench.pc.files.update.folder + "/version-a", "version=of another time\n");
  Pc::write(bench.pc.files.update.folder + "/version-b",
            "application=pick-station\nversion=v0\ndrivers=arm=simulated,valve=gpio\n");
  bench.pc.choose({"mark-whole", "B", bench.pc.files.command_line});
  const std::string text = bench.state();
  CHECK_CONTAINS(
      text,
      R"({"ok":true,"application":"pick-station","version":"v1","built":1795824900,"drivers":"arm=canopen,lamp=gpio","slot":"A","boot":"only","confirmed":true,)");
  CHECK_CONTAINS(
      text,
      R"("slots":{"A":{"version":"v1","whole":true,"primary":true,"driver_changes":[]},"B":{"version":"v0","whole":true,"primary":false,"driver_changes":[)"
      R"({"device":"arm","from":"canopen","to":"simulated"},{"device":"lamp","from":"gpio","to":""},{"device":"valve","from":"","to":"gpio"}]}},"claimed":true,)");
  CHECK_CONTAINS(
      text,
      R"("development_key":true,"notices":["choice0.env was damaged","the data partition was made anew",)");
  CHECK_CONTAINS(
      text,
      R"("healthy_for_s":0,"healthy_needed_s":60,"why_not_healthy":"","update":{"phase":"none","received":0,"size":0,"percent":0,"version":"","application":"","older":false,"driver_changes":[],"why":""},"network":[{"interface":"enp0s2",)");
  // Without any of these files it still is an answer.
  for (const std::string& file : {bench.pc.files.version, bench.pc.files.users, bench.pc.files.command_line})
    fs::remove(file);
  fs::remove_all(bench.pc.files.choice);
  CHECK_CONTAINS(bench.state(), R"("built":0,"drivers":"","slot":"","boot":"unknown","confirmed":false)");
}

}  // namespace
}  // namespace flexrf::helper::verbs_test

int main() {
  using namespace flexrf::helper::verbs_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(only_an_admin_with_the_right_password_may),
      CONTAINED_TEST(wrong_passwords_are_slowed),
      CONTAINED_TEST(a_lesser_user_does_not_end_the_delays),
      CONTAINED_TEST(users_that_cannot_be_read_are_no_users),
      CONTAINED_TEST(an_upload_is_verified_by_a_unit),
      CONTAINED_TEST(what_is_no_good_is_told_and_removed),
      CONTAINED_TEST(a_slot_is_chosen_that_is_whole),
      CONTAINED_TEST(after_a_restart_of_the_pc_nothing_of_an_update_is_left),
      CONTAINED_TEST(the_state_tells_all),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
