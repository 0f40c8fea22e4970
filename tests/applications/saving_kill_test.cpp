// An application that saves all the time is killed at random points: what is found afterwards is the file as
// it was or as it was to become, and every start takes it.
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <ctime>
#include <random>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

int kills = 30;

std::string text_of(const Folder& folder, const char* file) {
  return contents_of(folder / file);
}

/// As whoever looked at this moment, or as the disk after a loss of power: never a part of it.
bool is_whole(const std::string& text) {
  return text.starts_with("<?xml") && text.ends_with("</flexrf>\n");
}

/// The number that the unit had learned when the file was written. All of the file has to be there.
std::uint64_t learned(const std::string& text) {
  const std::string opening = "<learned>";
  const std::size_t at = text.find(opening);
  CHECK(at != std::string::npos);
  CHECK(is_whole(text));
  return std::stoull(text.substr(at + opening.size()));
}

bool exists(const std::string& path) {
  struct stat found {};
  return stat(path.c_str(), &found) == 0;
}

bool is_half_written(const Folder& folder) {
  return exists(folder / "cell.xml.new") || exists(folder / "cell.xml.previous.new");
}

void sleep_for(std::chrono::microseconds time) {
  const timespec pause{0, time.count() * 1000};
  nanosleep(&pause, nullptr);
}

void killed_while_saving_it_starts_with_what_was_saved() {
  constexpr unsigned seed = 11;
  std::mt19937 random(seed);
  // Several writings take place in this time.
  std::uniform_int_distribution<int> microseconds(0, 120'000);
  const Folder folder;
  std::uint64_t known = 0;
  int left_behind = 0;
  // A busy machine may end each writing before the signal arrives, so the test goes on until one kill has met
  // a writing. Where none can, this does not end.
  for (int kill = 0; kill < kills || left_behind == 0; ++kill) {
    Process process(
        folder, {place::application, "--config", "cell.xml", "--no-realtime", "--standstill-limit", "10min"});
    process.type("l");
    const std::string before = text_of(folder, "cell.xml");
    CHECK(wait_until([&] { return text_of(folder, "cell.xml") != before || process.has_ended(); }));
    sleep_for(std::chrono::microseconds{microseconds(random)});
    // Half of them where it hurts most, after a close look.
    if (kill % 2 == 0) {
      const auto is_being_written = [&] {
        CHECK(is_whole(text_of(folder, "cell.xml")));
        return is_half_written(folder);
      };
      // Without a pause: a file is half written for less than one.
      CHECK(wait_until(is_being_written, std::chrono::microseconds{0}));
    }
    process.send(SIGKILL);
    const Ending ending = process.wait();
    CHECK_EQUAL(ending.signal, SIGKILL);
    // The start before took the file as it was, without a word; only the first had none.
    CHECK_EQUAL(ending.errors.find("error:"), std::string::npos);
    CHECK_EQUAL(ending.errors.find("previous"), std::string::npos);
    const std::uint64_t now = learned(text_of(folder, "cell.xml"));
    CHECK(now > known);
    known = now;
    if (exists(folder / "cell.xml.previous")) CHECK(learned(text_of(folder, "cell.xml.previous")) <= now);
    left_behind += is_half_written(folder) ? 1 : 0;
  }
  print_message("%d kills left a file half written beside the whole one\n", left_behind);
  // One that goes on to its end.
  const Ending last = run(folder, {place::application, "--config", "cell.xml", "--no-realtime",
                                   "--standstill-limit", "10min", "--report", "report"});
  CHECK_EQUAL(last.exit_code, 0);
  CHECK_EQUAL(Report(folder / "report").last("tuner.values").at("learned"), known);
}

}  // namespace
}  // namespace flexrf::whole

/// An argument: how often.
int main(int argument_count, char** arguments) {
  using namespace flexrf::whole;
  if (argument_count > 1) kills = std::stoi(arguments[1]);
  const CMUnitTest tests[] = {CONTAINED_TEST(killed_while_saving_it_starts_with_what_was_saved)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
