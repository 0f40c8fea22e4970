// What changes while an application runs: members of a population, configuration, a unit that is restarted;
// and its groups.
#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

using fixture::CheckFailed;

const Application& crowd = application::application;
constexpr std::uint16_t gain = 0;  // numbers of runtime parameters, as in the tables
constexpr std::uint16_t falter = 0;
constexpr std::uint16_t dose = 1;

ParameterRequest request_to(std::uint16_t component, RequestKind kind) {
  ParameterRequest request;
  request.component = component;
  request.kind = kind;
  return request;
}

ParameterRequest with_gain(ParameterRequest request, std::uint32_t value) {
  CHECK(request.add(gain, 0, &value, sizeof(value)));
  return request;
}

void accept(Running& running, const ParameterRequest& request) {
  const ParameterAnswer answer = running.ask(request);
  if (answer.kind != AnswerKind::accepted) throw CheckFailed{std::string{"not accepted: "} + answer.reason};
}

void refuse(Running& running, const ParameterRequest& request, const char* reason) {
  const ParameterAnswer answer = running.ask(request);
  CHECK_EQUAL(answer.kind, AnswerKind::refused);
  CHECK_CONTAINS(std::string{answer.reason}, reason);
}

nlohmann::json gathered(Running& running, const char* field) {
  return running.newest("gatherer.feedback", field);
}

std::uint64_t looks_of(Running& running) {
  const nlohmann::json looks = gathered(running, "looks");
  return looks.is_null() ? 0 : looks.get<std::uint64_t>();
}

bool has_gains(Running& running, const std::vector<std::uint32_t>& gains) {
  return wait_until([&] { return gathered(running, "gains") == nlohmann::json(gains); });
}

void wait_for_start(Running& running) {
  CHECK(wait_until([&] { return gathered(running, "seen") == 2; }));
}

void check_nothing_torn(Running& running) {
  CHECK_EQUAL(gathered(running, "torn").get<int>(), 0);
  CHECK_EQUAL(gathered(running, "unexplained").get<int>(), 0);
}

// ---- populations

void members_are_activated_cloned_and_retired() {
  Running running(crowd);
  wait_for_start(running);
  CHECK(has_gains(running, {1, 1, 0, 0, 0, 0, 0, 0}));
  CHECK(wait_until([&] { return gathered(running, "retired") == 6; }));
  const std::uint16_t first = running.unit("walker[0]");
  const auto member = [&](int n) { return static_cast<std::uint16_t>(first + n); };
  accept(running, with_gain(request_to(member(5), RequestKind::activate), 7));
  CHECK(has_gains(running, {1, 1, 0, 0, 0, 7, 0, 0}));
  ParameterRequest clone = request_to(member(2), RequestKind::clone);
  clone.source = member(5);
  accept(running, clone);
  CHECK(has_gains(running, {1, 1, 7, 0, 0, 7, 0, 0}));
  accept(running, request_to(member(0), RequestKind::retire));
  CHECK(has_gains(running, {0, 1, 7, 0, 0, 7, 0, 0}));
  refuse(running, request_to(member(0), RequestKind::retire), "not active");
  refuse(running, request_to(member(1), RequestKind::activate), "active already");
  refuse(running, request_to(running.unit("gatherer"), RequestKind::activate), "not a member");
  refuse(running, with_gain(request_to(member(1), RequestKind::set), 1001), "gain");
  check_nothing_torn(running);
  CHECK_EQUAL(running.stop().exit_code, 0);
}

void under_load_nothing_is_torn_and_every_request_answered() {
  Running running(crowd);
  wait_for_start(running);
  const std::uint16_t first = running.unit("walker[0]");
  for (std::uint32_t round = 0; round < 100; ++round) {
    const auto active = static_cast<std::uint16_t>(first + 2 + round % 3);
    const auto copy = static_cast<std::uint16_t>(first + 5 + round % 3);
    accept(running, with_gain(request_to(active, RequestKind::activate), 1 + round));
    ParameterRequest clone = request_to(copy, RequestKind::clone);
    clone.source = active;
    accept(running, clone);
    accept(running, with_gain(request_to(active, RequestKind::set), 500 + round));
    accept(running, request_to(active, RequestKind::retire));
    accept(running, request_to(copy, RequestKind::retire));
  }
  // A look that began after the last of them.
  const std::uint64_t looks = looks_of(running);
  CHECK(wait_until([&] { return looks_of(running) > looks + 1; }));
  CHECK(has_gains(running, {1, 1, 0, 0, 0, 0, 0, 0}));
  check_nothing_torn(running);
  CHECK_EQUAL(running.stop().exit_code, 0);
}

// ---- groups

void each_instance_of_a_group_has_its_own() {
  Running running(crowd);
  CHECK(wait_until([&] { return gathered(running, "relayed_gains") == nlohmann::json({10, 11, 12}); }));
  accept(running, with_gain(request_to(running.unit("pair[1].walker"), RequestKind::set), 500));
  CHECK(wait_until([&] { return gathered(running, "relayed_gains") == nlohmann::json({10, 501, 12}); }));
  check_nothing_torn(running);
  CHECK_EQUAL(running.stop().exit_code, 0);
}

// ---- reconfiguration

nlohmann::json stride_of(Running& running, const char* slot) {
  return running.newest(slot, "stride");
}

void reconfiguration_is_done_or_rolled_back() {
  Running running(crowd);
  wait_for_start(running);
  const std::uint16_t one = running.unit("walker[0]");
  const std::uint16_t other = running.unit("pair[0].walker");
  using Changes = std::vector<ConfigurationChange>;

  const ReconfigureResult done =
      running.executive().reconfigure(Changes{{one, "stride", "5"}, {other, "stride", "6"}});
  CHECK_EQUAL(done.outcome, ReconfigureOutcome::done);
  CHECK(wait_until(
      [&] { return stride_of(running, "marks[0]") == 5 && stride_of(running, "relayed[0]") == 6; }));

  // The second refuses in initialise(): the first gets its old value back, too.
  const ReconfigureResult back =
      running.executive().reconfigure(Changes{{one, "stride", "7"}, {other, "stride", "13"}});
  CHECK_EQUAL(back.outcome, ReconfigureOutcome::rolled_back);
  CHECK_EQUAL(back.causes.size(), 1U);
  CHECK_CONTAINS(back.causes[0], "a stride of 13 is unlucky");
  const std::uint64_t steps = running.state("walker[0]").steps;
  CHECK(wait_until([&] { return running.state("walker[0]").steps > steps + 10; }));
  CHECK(wait_until(
      [&] { return stride_of(running, "marks[0]") == 5 && stride_of(running, "relayed[0]") == 6; }));

  const ReconfigureResult refused =
      running.executive().reconfigure(Changes{{one, "stride", "101"}, {other, "strid", "2"}});
  CHECK_EQUAL(refused.outcome, ReconfigureOutcome::refused);
  CHECK_EQUAL(refused.causes.size(), 2U);
  CHECK_CONTAINS(refused.causes[1], "stride");
  CHECK_EQUAL(refused.owners.size(), 0U);
  check_nothing_torn(running);
  // What failed was undone: no fault.
  CHECK_EQUAL(running.stop().exit_code, 0);
}

// ---- restart

void press_falter(Running& running) {
  ParameterRequest press = request_to(running.unit("patient"), RequestKind::press);
  CHECK(press.add_presses(falter));
  accept(running, press);
}

// [stop-4] [stop-6] [stop-38]
void a_unit_is_restarted_once_and_motion_needs_a_new_start() {
  Running running(crowd);
  const std::uint16_t patient = running.unit("patient");
  const auto feedback = [&](const char* field) { return running.newest("patient.feedback", field); };
  // Without autostart nothing moves before a person says so.
  CHECK(wait_until([&] { return feedback("inhibited") == true; }));
  running.start_motion();
  CHECK(wait_until([&] { return feedback("inhibited") == false; }));
  const double much = 4.0;
  ParameterRequest set = request_to(patient, RequestKind::set);
  CHECK(set.add(dose, 0, &much, sizeof(much)));
  accept(running, set);
  CHECK(wait_until([&] { return running.state("patient").steps > 20; }));

  press_falter(running);
  CHECK(wait_until([&] { return running.control().faults() == 1; }));
  CHECK(wait_until([&] { return running.state("patient").life.load() == Life::running; }));
  CHECK(wait_until([&] { return feedback("inhibited") == true; }));
  CHECK(feedback("steps").get<std::uint64_t>() >= 1);
  CHECK_EQUAL(running.newest("patient.values", "dose").get<double>(), much);
  CHECK(!running.control().may_move());
  running.start_motion();
  CHECK(wait_until([&] { return feedback("inhibited") == false; }));

  press_falter(running);
  CHECK(wait_until([&] { return running.control().faults() == 2; }));
  CHECK(wait_until([&] { return running.state("patient").life.load() == Life::fault; }));
  // Its thread goes on without it; the policy does not come again.
  const std::uint64_t looks = looks_of(running);
  CHECK(wait_until([&] { return looks_of(running) > looks + 1000; }));
  CHECK_EQUAL(running.state("patient").life.load(), Life::fault);
  CHECK_EQUAL(running.stop().exit_code, 2);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(members_are_activated_cloned_and_retired),
      TEST_APART(under_load_nothing_is_torn_and_every_request_answered),
      TEST_APART(each_instance_of_a_group_has_its_own),
      TEST_APART(reconfiguration_is_done_or_rolled_back),
      TEST_APART(a_unit_is_restarted_once_and_motion_needs_a_new_start),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
