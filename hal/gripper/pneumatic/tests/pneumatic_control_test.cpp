#include "hal/gripper/pneumatic/pneumatic_control.hpp"

#include <cstring>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::pneumatic;

constexpr Time start{std::chrono::seconds(1)};
constexpr Duration cycle = std::chrono::milliseconds(10);
constexpr Reeds at_open{.open = true};
constexpr Reeds at_closed{.closed = true};
constexpr Reeds between{};
constexpr ControlPlan plan{.travel_timeout = std::chrono::milliseconds(200),
                           .dead_time = std::chrono::milliseconds(30)};

// A control, cycle by cycle.
class Bench {
 public:
  explicit Bench(const ControlPlan& settings) { control_.begin(settings); }
  Control& control() { return control_; }
  End step(const std::optional<Reeds>& reeds) {
    control_.receive(reeds, now_ += cycle);
    return control_.valve();
  }
  End steps(int count, const std::optional<Reeds>& reeds) {
    for (int i = 1; i < count; ++i) step(reeds);
    return step(reeds);
  }
  bool says(const char* words) const { return std::strstr(control_.trouble().cause(), words) != nullptr; }

 private:
  Control control_;
  Time now_ = start;
};

void both_valves_are_off_for_the_dead_time_between(void**) {
  Bench bench(plan);
  assert_true(bench.step(at_open) == End::none);
  bench.control().go(End::closed);
  assert_true(bench.control().valve() == End::closed);
  assert_true(bench.step(between) == End::closed);
  bench.control().go(End::open);
  assert_true(bench.control().valve() == End::none);
  assert_true(bench.steps(2, between) == End::none);
  assert_true(bench.step(between) == End::open);
}

void the_valve_stays_on_at_the_end(void**) {
  Bench bench(plan);
  bench.step(at_open);
  bench.control().go(End::closed);
  bench.steps(5, between);
  assert_true(bench.steps(50, at_closed) == End::closed);
  assert_false(bench.control().is_moving());
  assert_true(bench.control().state()->object == GripperObject::none);
}

// What the switches say tells the causes apart, as far as it does.
void what_did_not_arrive_is_told_by_what_is_seen(void**) {
  Bench no_air(plan);
  no_air.step(at_open);
  no_air.control().go(End::closed);
  no_air.steps(25, at_open);
  assert_int_equal(no_air.control().trouble().code(), StatusCode::timeout);
  assert_true(no_air.says("did not leave the other end"));

  Bench jammed(plan);
  jammed.step(at_closed);
  jammed.control().go(End::open);
  jammed.steps(25, between);
  assert_true(jammed.says("between the ends"));

  ControlPlan strict = plan;
  strict.object_between = false;
  Bench blocked(strict);
  blocked.step(at_open);
  blocked.control().go(End::closed);
  blocked.steps(25, between);
  assert_int_equal(blocked.control().trouble().code(), StatusCode::timeout);
  assert_false(blocked.control().state()->holds_object());

  Bench broken(plan);
  broken.step(at_open);
  broken.control().go(End::closed);
  broken.steps(25, Reeds{.open = true, .closed = true});
  assert_int_equal(broken.control().trouble().code(), StatusCode::device_fault);
  assert_true(broken.says("both reed switches"));
}

// The valve that was in vain goes back to where the fingers are, so that they stay when the air returns.
void after_a_time_out_nothing_waits_for_the_air(void**) {
  Bench two_coils(plan);
  two_coils.step(at_open);
  two_coils.control().go(End::closed);
  assert_true(two_coils.steps(40, at_open) == End::open);

  ControlPlan centred = plan;
  centred.closed_centre = true;
  Bench closed_centre(centred);
  closed_centre.step(at_open);
  closed_centre.control().go(End::closed);
  assert_true(closed_centre.steps(40, at_open) == End::none);
}

void a_time_out_is_over_with_the_next_command(void**) {
  Bench bench(plan);
  bench.step(at_open);
  bench.control().go(End::closed);
  bench.steps(40, at_open);
  assert_false(bench.control().trouble().is_ok());
  bench.control().go(End::closed);
  assert_true(bench.control().trouble().is_ok() && bench.control().is_moving());
  bench.step(at_closed);
  assert_true(bench.control().trouble().is_ok());
  assert_false(bench.control().is_moving());
}

void fingers_that_leave_their_end_by_themselves_are_told(void**) {
  Bench bench(plan);
  bench.step(at_open);
  bench.control().go(End::closed);
  bench.step(at_closed);
  bench.step(between);
  assert_int_equal(bench.control().trouble().code(), StatusCode::device_fault);
  assert_true(bench.says("is the air on"));
  bench.step(at_closed);
  assert_true(bench.control().trouble().is_ok());
}

void lines_that_are_away_end_all_and_begin_with_valves_off(void**) {
  Bench bench(plan);
  bench.step(at_open);
  bench.control().go(End::closed);
  bench.step(between);
  assert_true(bench.step(std::nullopt) == End::none);
  assert_false(bench.control().state().has_value());
  assert_int_equal(bench.control().trouble().code(), StatusCode::unavailable);
  bench.control().go(End::open);
  assert_true(bench.steps(10, between) == End::none);
  assert_true(bench.control().trouble().is_ok());
  assert_false(bench.control().state()->opening.has_value());
}

void nothing_moves_on_switches_that_contradict(void**) {
  Bench bench(plan);
  bench.step(Reeds{.open = true, .closed = true});
  bench.control().go(End::closed);
  assert_true(bench.control().valve() == End::none);
  assert_false(bench.control().state()->activated);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(both_valves_are_off_for_the_dead_time_between),
      cmocka_unit_test(the_valve_stays_on_at_the_end),
      cmocka_unit_test(what_did_not_arrive_is_told_by_what_is_seen),
      cmocka_unit_test(after_a_time_out_nothing_waits_for_the_air),
      cmocka_unit_test(a_time_out_is_over_with_the_next_command),
      cmocka_unit_test(fingers_that_leave_their_end_by_themselves_are_told),
      cmocka_unit_test(lines_that_are_away_end_all_and_begin_with_valves_off),
      cmocka_unit_test(nothing_moves_on_switches_that_contradict),
  };
  return cmocka_run_group_tests_name("pneumatic control", tests, nullptr, nullptr);
}
