// flexrf-helper beside an application whose panel speaks TLS, as both are on an industrial PC: what stands in
// the way of motion, and what ends it.
#include <csignal>
#include <filesystem>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/helper_pc.hpp"

namespace flexrf::whole {
namespace {

void health_ends_what_stands_in_the_way_of_motion() {
  const Pc pc;
  Process helper(pc.folder, pc.helper());
  helper.wait_for_error(
      "this version cannot confirm itself yet: the panel cannot be reached: Connection refused");
  CHECK_CONTAINS(pc.word(), "this version has not confirmed itself");
  Process application(pc.folder, pc.application());
  application.wait_for_error("this machine does not permit motion: this version has not confirmed itself");
  helper.wait_for_error("the version in slot A has confirmed itself: it boots from now on");
  application.wait_for_error("this machine permits motion");
  CHECK_EQUAL(pc.word(), "permitted\n");
  application.send(SIGTERM);
  CHECK_EQUAL(application.wait().exit_code, 128 + SIGTERM);
  helper.send(SIGTERM);
  CHECK_EQUAL(helper.wait().exit_code, 0);
  // The word outlives it, and so does the confirmation.
  CHECK_EQUAL(pc.word(), "permitted\n");
  Process again(pc.folder, pc.helper());
  again.wait_for_error("motion is permitted");
}

void an_application_that_stands_still_is_not_healthy() {
  const Pc pc;
  Process application(pc.folder, pc.application());
  Process helper(pc.folder, pc.helper("80000"));
  helper.wait_for_error(
      "the application is healthy; this version confirms itself when it has been so for 80000 s");
  application.send(SIGSTOP);
  helper.wait_for_error(
      "this version cannot confirm itself yet: the panel has not proved who it is: no answer in time");
  application.send(SIGCONT);
}

/// Somebody else took the port: OpenSSL's own server, which says 200 to everything, with a key of its own.
void another_who_answers_does_not_count() {
  const Pc pc;
  make_certificate(pc.folder, "other");
  std::filesystem::create_directories(pc.folder / "api/v1");
  write_file(pc.folder / "api/v1/health", "fine\n");
  const auto server = [&](const std::string& name) -> std::vector<std::string> {
    return {"openssl", "s_server", "-quiet",      "-accept", "127.0.0.1:" + pc.port,
            "-WWW",    "-cert",    name + ".crt", "-key",    name + ".key"};
  };
  Process helper(pc.folder, pc.helper());
  {
    Process other(pc.folder, server("other"));
    helper.wait_for_error("this version cannot confirm itself yet: the panel has not proved who it is: ");
    helper.wait_for_error("certificate verify failed");
    CHECK_CONTAINS(pc.word(), "this version has not confirmed itself");
  }
  // The same with the panel's key is believed: it was the key that was missed.
  Process right(pc.folder, server("panel"));
  helper.wait_for_error("the version in slot A has confirmed itself");
}

void an_encryption_of_long_ago_does_not_count() {
  const Pc pc;
  Process helper(pc.folder, pc.helper());
  Process plain(pc.folder, {"openssl", "s_server", "-quiet", "-accept", "127.0.0.1:" + pc.port, "-www",
                            "-no_tls1_2", "-no_tls1_3", "-cert", "panel.crt", "-key", "panel.key"});
  helper.wait_for_error("this version cannot confirm itself yet: the panel has not proved who it is: ");
  CHECK_CONTAINS(pc.word(), "this version has not confirmed itself");
}

void wrong_words_are_told() {
  const Folder folder;
  const auto errors = [&](const std::vector<std::string>& words, int exit_code) {
    std::vector<std::string> all{place::helper};
    all.insert(all.end(), words.begin(), words.end());
    const Ending ending = run(folder, all);
    CHECK_EQUAL(ending.exit_code, exit_code);
    return ending.errors + ending.output;
  };
  CHECK_CONTAINS(errors({"--wrod", "x"}, 1), "there is no option '--wrod'");
  CHECK_CONTAINS(errors({"--word"}, 1), "--word needs a value");
  CHECK_CONTAINS(errors({"--port", "0"}, 1), "--port is a number from 1 to 65535");
  CHECK_CONTAINS(errors({"--trial", "9e9"}, 1), "--trial is a number of seconds, from 1 to 86400");
  CHECK_CONTAINS(errors({"--help"}, 0), "Says whether anything may move on this PC");
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(health_ends_what_stands_in_the_way_of_motion),
      CONTAINED_TEST(an_application_that_stands_still_is_not_healthy),
      CONTAINED_TEST(another_who_answers_does_not_count),
      CONTAINED_TEST(an_encryption_of_long_ago_does_not_count),
      CONTAINED_TEST(wrong_words_are_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
