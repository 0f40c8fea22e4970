// Holds: true only while their lease lives, which is refreshed, released or runs out, and never revives.
#include "runtime/parameters/tests/parameter_bench.hpp"

namespace flexrf {
namespace {

using namespace test;
using std::chrono::milliseconds;

void a_hold_lives_as_long_as_its_lease(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1, 1), start_time).kind,
                   AnswerKind::accepted);
  assert_false(cell.component.runtime.jog[0]);
  assert_true(cell.component.runtime.jog[1]);
  assert_true(cell.seen().jog[1]);
  cell.parameters.before_step(start_time + milliseconds{249});
  assert_true(cell.component.runtime.jog[1]);
  // Refreshed at 249 ms, it lives until 499.
  assert_int_equal(
      cell.parameters.apply(lease_request(RequestKind::refresh, 5, 2, 1), start_time + milliseconds{249})
          .kind,
      AnswerKind::accepted);
  cell.parameters.before_step(start_time + milliseconds{498});
  assert_true(cell.component.runtime.jog[1]);
  cell.parameters.before_step(start_time + milliseconds{499});
  assert_false(cell.component.runtime.jog[1]);
  assert_false(cell.seen().jog[1]);
  // It never revives: not by a refresh, not by its number.
  expect_refused(
      cell.parameters.apply(lease_request(RequestKind::refresh, 5, 3, 1), start_time + milliseconds{500}),
      sample::jog, "the lease has ended: press again");
  expect_refused(
      cell.parameters.apply(lease_request(RequestKind::hold, 5, 4, 1), start_time + milliseconds{500}),
      sample::jog, "the lease was used before: each press has its own");
  expect_refused(
      cell.parameters.apply(lease_request(RequestKind::hold, 4, 1, 1), start_time + milliseconds{500}),
      sample::jog, "the lease was used before: each press has its own");
  assert_false(cell.component.runtime.jog[1]);
  // A new press is a new lease.
  assert_int_equal(
      cell.parameters.apply(lease_request(RequestKind::hold, 6, 1, 1), start_time + milliseconds{501}).kind,
      AnswerKind::accepted);
  assert_true(cell.component.runtime.jog[1]);
}

void a_request_that_finds_the_lease_overdue_cannot_save_it(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1), start_time).kind,
                   AnswerKind::accepted);
  // No step came in between.
  expect_refused(
      cell.parameters.apply(lease_request(RequestKind::refresh, 5, 2), start_time + milliseconds{250}),
      sample::jog, "the lease has ended: press again");
  assert_false(cell.component.runtime.jog[0]);
}

void a_refresh_must_be_newer_and_of_the_same_lease(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 7), start_time).kind,
                   AnswerKind::accepted);
  expect_refused(
      cell.parameters.apply(lease_request(RequestKind::refresh, 5, 7), start_time + milliseconds{200}),
      sample::jog, "the refresh is older than the last: its sequence did not increase");
  ParameterRequest other = lease_request(RequestKind::refresh, 5, 8);
  other.requester = 2;
  assert_int_equal(cell.parameters.apply(other, start_time + milliseconds{200}).kind, AnswerKind::refused);
  expect_refused(
      cell.parameters.apply(lease_request(RequestKind::refresh, 6, 8), start_time + milliseconds{200}),
      sample::jog, "this lease was never begun: press again");
  cell.parameters.before_step(start_time + milliseconds{250});
  assert_false(cell.component.runtime.jog[0]);
  // Number 6 was seen before it began: a press that arrives after its refresh starts nothing.
  assert_int_equal(
      cell.parameters.apply(lease_request(RequestKind::hold, 6, 9), start_time + milliseconds{260}).kind,
      AnswerKind::refused);
}

void a_lease_is_counted_from_when_the_person_acted(void**) {
  Cell& cell = begin();
  ParameterRequest press = lease_request(RequestKind::hold, 5, 1);
  press.issued_at = start_time;
  expect_refused(cell.parameters.apply(press, start_time + milliseconds{250}), sample::jog,
                 "the press waited too long: press again");
  press = lease_request(RequestKind::hold, 6, 1);
  press.issued_at = start_time + milliseconds{300};
  assert_int_equal(cell.parameters.apply(press, start_time + milliseconds{500}).kind, AnswerKind::accepted);
  cell.parameters.before_step(start_time + milliseconds{549});
  assert_true(cell.component.runtime.jog[0]);
  cell.parameters.before_step(start_time + milliseconds{550});
  assert_false(cell.component.runtime.jog[0]);
  // From the future: counted from now.
  press = lease_request(RequestKind::hold, 7, 1);
  press.issued_at = Time::max();
  assert_int_equal(cell.parameters.apply(press, start_time + milliseconds{600}).kind, AnswerKind::accepted);
  cell.parameters.before_step(start_time + milliseconds{850});
  assert_false(cell.component.runtime.jog[0]);
}

void one_hand_at_a_hold(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1), start_time).kind,
                   AnswerKind::accepted);
  ParameterRequest other = lease_request(RequestKind::hold, 6, 1);
  other.requester = 2;
  expect_refused(cell.parameters.apply(other, start_time), sample::jog, "another holds it");
  // Released by its holder, it does not pass on to the one who was refused.
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::release, 5, 2), start_time).kind,
                   AnswerKind::accepted);
  assert_false(cell.component.runtime.jog[0]);
  assert_int_equal(cell.parameters.apply(other, start_time).kind, AnswerKind::refused);
  assert_false(cell.component.runtime.jog[0]);
  other.lease = 7;
  assert_int_equal(cell.parameters.apply(other, start_time).kind, AnswerKind::accepted);
  assert_true(cell.component.runtime.jog[0]);
  // Nobody else releases it.
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::release, 7, 2), start_time).kind,
                   AnswerKind::accepted);
  assert_true(cell.component.runtime.jog[0]);
}

void a_release_that_overtakes_its_press_prevents_it(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::release, 5, 2), start_time).kind,
                   AnswerKind::accepted);
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1), start_time).kind,
                   AnswerKind::refused);
  assert_false(cell.component.runtime.jog[0]);
}

void a_release_is_never_stale(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1), start_time).kind,
                   AnswerKind::accepted);
  assert_int_equal(cell.parameters.apply(set_to(sample::step, 0.05), start_time).kind, AnswerKind::accepted);
  ParameterRequest release = lease_request(RequestKind::release, 5, 2);
  release.expected = 1;
  assert_int_equal(cell.parameters.apply(release, start_time).kind, AnswerKind::accepted);
  assert_false(cell.component.runtime.jog[0]);
}

void stop_ends_all_leases_but_no_presses(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1, 0), start_time).kind,
                   AnswerKind::accepted);
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 6, 1, 1), start_time).kind,
                   AnswerKind::accepted);
  ParameterRequest press = request_of(RequestKind::press);
  press.add_presses(sample::go);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::accepted);
  cell.parameters.end_all_leases(start_time);
  assert_false(cell.component.runtime.jog[0]);
  assert_false(cell.seen().jog[1]);
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::refresh, 6, 2, 1), start_time).kind,
                   AnswerKind::refused);
  assert_int_equal(cell.component.runtime.go, 1);
  assert_true(cell.parameters.after_step(start_time).is_ok());
  assert_int_equal(cell.component.runtime.go, 0);
}

void a_component_constructed_anew_has_no_live_lease(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1), start_time).kind,
                   AnswerKind::accepted);
  cell.component.runtime = sample::default_runtime;
  assert_true(
      cell.parameters.connect(cell.component, &cell.slot.control(), &sample::default_runtime, cell.scratch)
          .is_ok());
  assert_true(cell.parameters.adopt(&sample::default_runtime, start_time).is_ok());
  assert_int_equal(cell.parameters.sequence(), 3);
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::refresh, 5, 2), start_time).kind,
                   AnswerKind::refused);
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 3), start_time).kind,
                   AnswerKind::refused);
  assert_false(cell.component.runtime.jog[0]);
}

/// Who asks is refused with the reason; who has all that it needs is not.
void a_command_that_can_do_nothing_says_what_it_needs(void**) {
  static constexpr CommandNeed needs[] = {
      {CommandNeed::Kind::motion, "", 0, "needs motion"},
      {CommandNeed::Kind::runtime, "enabled", 2U, "needs enabled to be on"},
      {CommandNeed::Kind::runtime, "mode", 0b110U, "needs mode to be manual or automatic"},
  };
  static sample::SampleComponent component;
  static ComponentType type = component.component_type();
  static ParameterDescriptor parameters[std::size(sample::runtime_parameters)];
  std::copy(std::begin(sample::runtime_parameters), std::end(sample::runtime_parameters), parameters);
  parameters[sample::go].needs = needs;
  type.runtime.parameters = parameters;
  component.set_type_in_force(type);
  static ParameterScratch scratch;
  static RuntimeParameters runtime;
  assert_true(runtime.connect(component, nullptr, &sample::default_runtime, scratch).is_ok());
  ParameterRequest press = request_of(RequestKind::press);
  press.add_presses(sample::go);
  component.runtime.enabled = false;
  component.runtime.mode = 0;
  assert_string_equal(runtime.unmet_need(press, false), "needs motion");
  assert_string_equal(runtime.unmet_need(press, true), "needs enabled to be on");
  component.runtime.enabled = true;
  assert_string_equal(runtime.unmet_need(press, true), "needs mode to be manual or automatic");
  component.runtime.mode = 2;
  assert_null(runtime.unmet_need(press, true));
  // A value needs nothing, whatever its button does.
  assert_null(runtime.unmet_need(set_to(sample::step, 0.02), false));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_hold_lives_as_long_as_its_lease),
      cmocka_unit_test(a_request_that_finds_the_lease_overdue_cannot_save_it),
      cmocka_unit_test(a_refresh_must_be_newer_and_of_the_same_lease),
      cmocka_unit_test(a_lease_is_counted_from_when_the_person_acted),
      cmocka_unit_test(one_hand_at_a_hold),
      cmocka_unit_test(a_release_that_overtakes_its_press_prevents_it),
      cmocka_unit_test(a_release_is_never_stale),
      cmocka_unit_test(stop_ends_all_leases_but_no_presses),
      cmocka_unit_test(a_component_constructed_anew_has_no_live_lease),
      cmocka_unit_test(a_command_that_can_do_nothing_says_what_it_needs),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
