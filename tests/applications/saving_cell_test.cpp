// What is kept in the configuration file while an application runs: what somebody set, when, and who says so.
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>

#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

const Application& tuned = application::application;
// Numbers of the tuner's runtime parameters, as in its table.
constexpr std::uint16_t gain = 0;
constexpr std::uint16_t offset = 1;

Options with_file(const Folder& folder) {
  Options options;
  options.configuration_file = folder / "cell.xml";
  return options;
}

/// As its table would have it.
Application with_policy(SavePolicy policy) {
  Application application = tuned;
  application.save = policy;
  return application;
}

/// Only when somebody asks for it.
Application on_command() {
  SavePolicy policy;
  policy.on_change = false;
  return with_policy(policy);
}

template <class T>
void set(Running& running, std::uint16_t parameter, T value) {
  ParameterRequest request;
  request.component = running.unit("tuner");
  CHECK(request.add(parameter, 0, &value, sizeof(value)));
  CHECK_EQUAL(running.ask(request).kind, AnswerKind::accepted);
}

std::string file(const Folder& folder) {
  return contents_of(folder / "cell.xml");
}

bool holds(const Folder& folder, const std::string& text) {
  return file(folder).find(text) != std::string::npos;
}

bool is_saved(const Folder& folder, const std::string& text) {
  return wait_until([&] { return holds(folder, text); });
}

Status save_now(Running& running) {
  ValueSaver& saver = running.executive().saver();
  const Result<std::uint64_t> number = saver.request();
  if (!number) return number.status();
  CHECK(wait_until([&] { return saver.state().answered >= *number; }));
  return saver.state().failure;
}

void what_is_set_is_saved_after_quiet_and_nothing_else() {
  const Folder folder;
  Running running(tuned, with_file(folder));
  ValueSaver& saver = running.executive().saver();
  CHECK(saver.state().has_file);
  CHECK(!saver.state().unsaved);
  set(running, gain, 2.5);
  CHECK(is_saved(folder, "<gain>2.5</gain>"));
  // The value that the table has, but somebody chose it.
  set(running, offset, 0.25);
  CHECK(is_saved(folder, "<offset unit=\"m\">0.25</offset>"));
  CHECK(!holds(folder, "learned"));
  CHECK(!holds(folder, "length"));
  CHECK(wait_until([&] { return !saver.state().unsaved; }));
  CHECK(saver.state().saved_at > 0);
  // What is given back to the tables is no longer in it.
  ParameterRequest reset;
  reset.kind = RequestKind::reset;
  reset.component = running.unit("tuner");
  reset.add_name(gain);
  CHECK_EQUAL(running.ask(reset).kind, AnswerKind::accepted);
  CHECK(wait_until([&] { return !holds(folder, "gain"); }));
  CHECK(holds(folder, "offset"));
  CHECK_EQUAL(running.stop().exit_code, 0);
}

void configuration_that_is_set_is_saved_and_no_other() {
  const Folder folder;
  Running running(tuned, with_file(folder));
  const std::uint16_t tuner = running.unit("tuner");
  // The value that it has already: somebody chose it all the same.
  const ReconfigureResult done = running.executive().reconfigure({{tuner, "rows", "3"}});
  CHECK_EQUAL(done.outcome, ReconfigureOutcome::done);
  CHECK(is_saved(folder, "<rows>3</rows>"));
  CHECK(!holds(folder, "length"));
  CHECK_EQUAL(running.executive().reconfigure({{tuner, "rows", "9"}}).outcome, ReconfigureOutcome::refused);
  CHECK_EQUAL(running.executive().reconfigure({{tuner, "length", "4"}}).outcome, ReconfigureOutcome::done);
  CHECK(is_saved(folder, "<length unit=\"m\">4</length>"));
  CHECK_EQUAL(running.stop().exit_code, 0);
}

void on_command_it_is_written_when_somebody_asks() {
  const Folder folder;
  const Application application = on_command();
  Running running(application, with_file(folder));
  ValueSaver& saver = running.executive().saver();
  CHECK(!saver.state().on_change);
  set(running, gain, 2.5);
  CHECK(saver.state().unsaved);
  CHECK(save_now(running).is_ok());
  CHECK(holds(folder, "<gain>2.5</gain>"));
  CHECK(!saver.state().unsaved);
  set(running, gain, 4.0);
  CHECK(saver.state().unsaved);
  CHECK_EQUAL(running.stop().exit_code, 0);
  // Nobody asked for this one.
  CHECK(holds(folder, "<gain>2.5</gain>"));
}

void without_a_file_nothing_is_saved_and_that_is_told() {
  Running running(tuned);
  CHECK(!running.executive().saver().state().has_file);
  const Status status = save_now(running);
  CHECK_EQUAL(status.code(), StatusCode::not_permitted);
  CHECK_CONTAINS(status.cause(), "--config FILE");
  CHECK_EQUAL(running.stop().exit_code, 0);
}

void a_save_that_fails_is_told_and_tried_again() {
  const Folder folder;
  Running running(tuned, with_file(folder));
  ValueSaver& saver = running.executive().saver();
  // A folder that is not empty is in the way of what is written beside the file.
  const std::string obstacle = folder / "cell.xml.new";
  CHECK(mkdir(obstacle.c_str(), 0700) == 0);
  set(running, gain, 2.5);
  const Status failed = save_now(running);
  CHECK(!failed);
  CHECK_CONTAINS(failed.cause(), "cell.xml.new");
  CHECK(saver.state().unsaved);
  CHECK(rmdir(obstacle.c_str()) == 0);
  CHECK(is_saved(folder, "<gain>2.5</gain>"));
  CHECK(wait_until([&] { return saver.state().failure.is_ok() && !saver.state().unsaved; }));
  CHECK_EQUAL(running.stop().exit_code, 0);
}

void a_unit_changes_its_own_values() {
  const Folder folder;
  Running running(tuned, with_file(folder));
  running.type("g");
  CHECK(wait_until([&] { return running.newest("tuner.values", "gain") == 3.0; }));
  CHECK(is_saved(folder, "<gain>3</gain>"));
  // The value that the table has.
  running.type("d");
  CHECK(is_saved(folder, "<gain>1</gain>"));
  // What nobody asked for is in force, and not kept: not even where it would be written for another reason.
  constexpr std::uint64_t writings = 2;
  CHECK(wait_until([&] { return running.executive().saver().state().writings == writings; }));
  running.type("o");
  CHECK(wait_until([&] { return running.newest("tuner.values", "gain") == 4.0; }));
  CHECK(!running.executive().saver().state().unsaved);
  CHECK_EQUAL(running.executive().saver().state().writings, writings);
  set(running, offset, 0.5);
  CHECK(is_saved(folder, "<offset unit=\"m\">0.5</offset>"));
  CHECK(holds(folder, "<gain>1</gain>"));
  CHECK(wait_until([&] { return running.executive().saver().state().writings > writings; }));
  running.type("t");
  CHECK(wait_until([&] { return running.newest("tuner.values", "tries") == 1; }));
  CHECK(save_now(running).is_ok());
  CHECK(!holds(folder, "tries"));
  CHECK_EQUAL(running.stop().exit_code, 0);
}

/// `key`: has it set its gain to a value that nobody may set, and another value that would be right.
void check_is_refused(const char* key) {
  const Folder folder;
  Running running(tuned, with_file(folder));
  set(running, gain, 2.5);
  running.type(key);
  UnitState& state = running.state("tuner");
  CHECK(wait_until([&] { return state.life.load() == Life::fault; }));
  CHECK_CONTAINS(state.fault.read().cause(), "it changed its own values, and they are refused: gain: ");
  CHECK_EQUAL(running.newest("tuner.values", "gain"), 2.5);
  CHECK_EQUAL(running.newest("tuner.values", "offset"), 0.25);
  CHECK(save_now(running).is_ok());
  CHECK(holds(folder, "<gain>2.5</gain>"));
  CHECK(!holds(folder, "offset"));
  // It can be initialised again, with them.
  std::atomic<bool> again{false};
  running.executive().act(ComponentAction::initialise, running.unit("tuner"),
                          [&](const Status& status) { again = status.is_ok(); });
  CHECK(wait_until([&] { return again.load(); }));
  CHECK_EQUAL(running.newest("tuner.values", "gain"), 2.5);
  CHECK_EQUAL(running.stop().exit_code, 2);
}

void a_unit_that_sets_itself_no_number_is_in_fault_with_its_last_good_values() {
  check_is_refused("n");
}

void a_unit_that_leaves_a_range_is_in_fault_with_its_last_good_values() {
  check_is_refused("r");
}

/// There is no quiet to wait for.
void a_unit_that_never_rests_is_saved_all_the_same() {
  const Folder folder;
  Running running(tuned, with_file(folder));
  running.type("l");
  CHECK(is_saved(folder, "<learned>"));
  const std::string first = file(folder);
  CHECK(wait_until([&] { return file(folder) != first; }));
  CHECK_EQUAL(running.stop().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(what_is_set_is_saved_after_quiet_and_nothing_else),
      TEST_APART(configuration_that_is_set_is_saved_and_no_other),
      TEST_APART(on_command_it_is_written_when_somebody_asks),
      TEST_APART(without_a_file_nothing_is_saved_and_that_is_told),
      TEST_APART(a_save_that_fails_is_told_and_tried_again),
      TEST_APART(a_unit_changes_its_own_values),
      TEST_APART(a_unit_that_sets_itself_no_number_is_in_fault_with_its_last_good_values),
      TEST_APART(a_unit_that_leaves_a_range_is_in_fault_with_its_last_good_values),
      TEST_APART(a_unit_that_never_rests_is_saved_all_the_same),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
