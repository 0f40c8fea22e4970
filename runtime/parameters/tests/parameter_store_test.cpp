#include "runtime/parameters/parameter_store.hpp"

#include <atomic>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "runtime/core/scalar_types.hpp"
#include "runtime/parameters/tests/parameter_bench.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::parameter_store_test {
namespace {

using namespace test;
using std::chrono::milliseconds;

void values_in_force_are_published_at_the_start(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.sequence(), 1);
  assert_int_equal(cell.seen_sequence(), 1);
  assert_true(cell.seen().step == 0.01);
  assert_true(cell.parameters.has_any());
}

void a_set_comes_into_force_as_a_whole(void**) {
  Cell& cell = begin();
  ParameterRequest request = set_to(sample::step, 0.05);
  const float gains[2] = {5, 6};
  request.add(sample::gains, sizeof(float), gains, sizeof(gains));
  const std::uint8_t automatic = 2;
  request.add(sample::mode, 0, &automatic, 1);
  const ParameterAnswer answer = cell.parameters.apply(request, start_time + milliseconds{1});
  assert_int_equal(answer.kind, AnswerKind::accepted);
  assert_int_equal(answer.correlation, 42);
  assert_int_equal(answer.sequence, 2);
  assert_true(cell.component.runtime.step == 0.05);
  assert_true(cell.component.runtime.gains[0] == 1.0F);
  assert_true(cell.component.runtime.gains[2] == 6.0F);
  assert_int_equal(cell.seen().mode, 2);
  assert_int_equal(cell.seen_sequence(), 2);
}

void a_set_that_fails_changes_nothing(void**) {
  Cell& cell = begin();
  const int asked = cell.component.asked;
  static std::byte before[sizeof(sample::Runtime)];
  std::memcpy(before, &cell.component.runtime, sizeof(before));
  ParameterRequest request = set_to(sample::step, 0.05);
  const float gain = 11;
  request.add(sample::gains, 8, &gain, sizeof(gain));
  expect_refused(cell.parameters.apply(request, start_time), sample::gains,
                 "gains[2]: 11 lies outside 0 to 10");
  expect_refused(
      cell.parameters.apply(set_to(sample::step, std::numeric_limits<double>::quiet_NaN()), start_time),
      sample::step, "step: nan is not a finite number");
  expect_refused(cell.parameters.apply(set_to(sample::mode, std::uint8_t{3}), start_time), sample::mode,
                 "mode: 3 is no value of Mode, which has 3");
  expect_refused(cell.parameters.apply(set_to(sample::step, 0.05F), start_time), sample::step,
                 "4 bytes at 0 of 'step' are no whole elements");
  expect_refused(cell.parameters.apply(set_to(sample::gains, 0.5F, 12), start_time), sample::gains,
                 "4 bytes at 12 of 'gains' are no whole elements");
  expect_refused(cell.parameters.apply(set_to(99, 0.5F), start_time), 99,
                 "there is no runtime parameter number 99");
  expect_refused(cell.parameters.apply(set_to(sample::go, std::uint32_t{1}), start_time), sample::go,
                 "a button is pressed, not set");
  expect_refused(cell.parameters.apply(set_to(sample::jog, true), start_time), sample::jog,
                 "a hold is held under a lease, not set");
  ParameterRequest broken = set_to(sample::step, 0.05);
  broken.changes[0].position = 600;
  assert_int_equal(cell.parameters.apply(broken, start_time).kind, AnswerKind::refused);
  // The author's accept is asked only about what passed the checks.
  assert_int_equal(cell.component.asked, asked);
  assert_memory_equal(&cell.component.runtime, before, sizeof(before));
  assert_int_equal(cell.seen_sequence(), 1);
}

void the_component_may_refuse_the_set(void**) {
  Cell& cell = begin();
  expect_refused(cell.parameters.apply(set_to(sample::limits, sample::Limits{2, 1}), start_time),
                 no_parameter, "low is not below high");
  assert_true(cell.component.runtime.limits.low == -1);
  // Members one by one: fields that agree only together come in one request.
  ParameterRequest request = set_to(sample::limits, 2.0, offsetof(sample::Limits, low));
  const float high = 3;
  request.add(sample::limits, offsetof(sample::Limits, high), &high, sizeof(high));
  assert_int_equal(cell.parameters.apply(request, start_time).kind, AnswerKind::accepted);
  assert_true(cell.component.runtime.limits.low == 2);
  assert_true(cell.component.runtime.limits.high == 3);
}

void what_was_seen_too_long_ago_is_stale(void**) {
  Cell& cell = begin();
  ParameterRequest request = set_to(sample::step, 0.05);
  request.expected = 1;
  assert_int_equal(cell.parameters.apply(request, start_time).kind, AnswerKind::accepted);
  const ParameterAnswer answer = cell.parameters.apply(request, start_time);
  assert_int_equal(answer.kind, AnswerKind::stale);
  assert_int_equal(answer.sequence, 2);
  // A press and the step after it publish, but change no setting.
  ParameterRequest press = request_of(RequestKind::press);
  press.add_presses(sample::go);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::accepted);
  assert_true(cell.parameters.after_step(start_time).is_ok());
  assert_int_equal(cell.parameters.sequence(), 4);
  request.expected = 2;
  assert_int_equal(cell.parameters.apply(request, start_time).kind, AnswerKind::accepted);
  // What was never published cannot have been seen.
  request.expected = 9;
  assert_int_equal(cell.parameters.apply(request, start_time).kind, AnswerKind::stale);
}

void sequences_wrap_around(void**) {
  Cell& cell = begin();
  cell.slot.control().start_sequence_at(std::numeric_limits<std::uint64_t>::max() - 1);
  ParameterRequest request = set_to(sample::step, 0.05);
  assert_int_equal(cell.parameters.apply(request, start_time).kind, AnswerKind::accepted);
  ParameterRequest press = request_of(RequestKind::press);
  press.add_presses(sample::go);
  // 0 means "never published" and is left out.
  assert_int_equal(cell.parameters.apply(press, start_time).sequence, 1);
  request.expected = std::numeric_limits<std::uint64_t>::max();
  const ParameterAnswer answer = cell.parameters.apply(request, start_time);
  assert_int_equal(answer.kind, AnswerKind::accepted);
  assert_int_equal(answer.sequence, 2);
  assert_int_equal(cell.parameters.apply(request, start_time).kind, AnswerKind::stale);
}

void presses_are_counted_until_the_step_has_seen_them(void**) {
  Cell& cell = begin();
  ParameterRequest press = request_of(RequestKind::press);
  press.add_presses(sample::go, 2);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::accepted);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::accepted);
  assert_int_equal(cell.component.runtime.go, 4);
  assert_int_equal(cell.seen().go, 4);
  assert_true(cell.parameters.after_step(start_time).is_ok());
  assert_int_equal(cell.component.runtime.go, 0);
  assert_int_equal(cell.seen().go, 0);
  const std::uint64_t sequence = cell.parameters.sequence();
  assert_true(cell.parameters.after_step(start_time).is_ok());
  assert_int_equal(cell.parameters.sequence(), sequence);

  press = request_of(RequestKind::press);
  press.add_presses(sample::go, 0xFFFFFFFF);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::accepted);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::accepted);
  assert_true(cell.component.runtime.go == 0xFFFFFFFF);
  press.add_presses(sample::enabled);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::refused);
}

void reset_gives_the_values_of_the_tables(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1), start_time).kind,
                   AnswerKind::accepted);
  ParameterRequest request = set_to(sample::step, 0.05);
  const std::int8_t small = 3;
  request.add(sample::small, 0, &small, sizeof(small));
  assert_int_equal(cell.parameters.apply(request, start_time).kind, AnswerKind::accepted);
  ParameterRequest reset = request_of(RequestKind::reset);
  reset.add_name(sample::step);
  assert_int_equal(cell.parameters.apply(reset, start_time).kind, AnswerKind::accepted);
  assert_true(cell.component.runtime.step == 0.01);
  assert_int_equal(cell.component.runtime.small, 3);
  reset = request_of(RequestKind::reset);
  assert_int_equal(cell.parameters.apply(reset, start_time).kind, AnswerKind::accepted);
  assert_int_equal(cell.component.runtime.small, -5);
  assert_true(cell.component.runtime.jog[0]);
  reset.add_name(99);
  assert_int_equal(cell.parameters.apply(reset, start_time).kind, AnswerKind::refused);
}

void a_member_begins_with_the_tables_or_with_another_members_values(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1), start_time).kind,
                   AnswerKind::accepted);
  sample::Runtime other = sample::default_runtime;
  other.step = 0.07;
  other.go = 3;
  other.jog[1] = true;
  ParameterRequest clone = request_of(RequestKind::clone);
  const std::int8_t small = 9;
  clone.add(sample::small, 0, &small, sizeof(small));
  expect_refused(cell.parameters.apply(clone, start_time), no_parameter, "there is no member to clone");
  assert_int_equal(cell.parameters.apply(clone, start_time, &other).kind, AnswerKind::accepted);
  assert_true(cell.component.runtime.step == 0.07);
  assert_int_equal(cell.component.runtime.small, 9);
  // Neither its presses nor its holds, nor those the member had before.
  assert_int_equal(cell.component.runtime.go, 0);
  assert_false(cell.component.runtime.jog[0]);
  assert_false(cell.component.runtime.jog[1]);

  ParameterRequest activate = request_of(RequestKind::activate);
  assert_int_equal(cell.parameters.apply(activate, start_time).kind, AnswerKind::accepted);
  assert_int_equal(cell.component.runtime.small, -5);
  const double step = 5;
  activate.add(sample::step, 0, &step, sizeof(step));
  assert_int_equal(cell.parameters.apply(activate, start_time).kind, AnswerKind::refused);

  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 6, 1), start_time).kind,
                   AnswerKind::accepted);
  assert_int_equal(cell.parameters.apply(request_of(RequestKind::retire), start_time).kind,
                   AnswerKind::accepted);
  assert_false(cell.component.runtime.jog[0]);
}

void saved_values_are_checked_before_they_are_taken(void**) {
  Cell& cell = begin();
  sample::Runtime saved = sample::default_runtime;
  saved.step = 0.5;
  const Status out_of_range = cell.parameters.adopt(&saved, start_time);
  assert_string_equal(out_of_range.cause(), "step: 0.5 m lies outside 0.001 to 0.1 m");
  saved.step = 0.02;
  saved.limits = {5, 4};
  const Status refused = cell.parameters.adopt(&saved, start_time);
  assert_string_equal(refused.cause(), "low is not below high");
  assert_true(cell.component.runtime.step == 0.01);
  saved.limits = {4, 5};
  saved.go = 1;
  saved.jog[0] = true;
  assert_true(cell.parameters.adopt(&saved, start_time).is_ok());
  assert_true(cell.component.runtime.step == 0.02);
  assert_int_equal(cell.component.runtime.go, 0);
  assert_false(cell.component.runtime.jog[0]);
}

bool is_set(const Cell& cell, std::size_t offset, std::size_t size) {
  static std::vector<std::byte> values;
  static SetMarks marks;
  cell.parameters.settings().read(values, marks);
  return marks.any(offset, size);
}
#define IS_SET(cell, field) is_set(cell, offsetof(sample::Runtime, field), sizeof(sample::Runtime::field))

/// As whoever saves sees it.
double step_to_save(const Cell& cell) {
  static std::vector<std::byte> values;
  static SetMarks marks;
  cell.parameters.settings().read(values, marks);
  return load<double>(values.data() + offsetof(sample::Runtime, step));
}

void what_somebody_set_is_remembered(void**) {
  Cell& cell = begin();
  static std::atomic<std::uint64_t> revision;
  revision = 0;
  cell.parameters.set_revision(revision);
  assert_false(IS_SET(cell, step));
  // Also where it is the value of the tables.
  assert_int_equal(cell.parameters.apply(set_to(sample::step, 0.01), start_time).kind, AnswerKind::accepted);
  assert_true(IS_SET(cell, step));
  assert_false(IS_SET(cell, gains));
  assert_int_equal(revision.load(), 1);
  // The same again changes nothing.
  assert_int_equal(cell.parameters.apply(set_to(sample::step, 0.01), start_time).kind, AnswerKind::accepted);
  assert_int_equal(revision.load(), 1);
  assert_int_equal(cell.parameters.apply(set_to(sample::step, 0.02), start_time).kind, AnswerKind::accepted);
  assert_int_equal(revision.load(), 2);
  assert_true(step_to_save(cell) == 0.02);
  // One that is refused neither.
  assert_int_equal(cell.parameters.apply(set_to(sample::limits, sample::Limits{2, 1}), start_time).kind,
                   AnswerKind::refused);
  assert_false(IS_SET(cell, limits));
  // What is not kept, a press, a hold.
  assert_int_equal(cell.parameters.apply(set_to(sample::scratch, 3.0), start_time).kind,
                   AnswerKind::accepted);
  ParameterRequest press = request_of(RequestKind::press);
  press.add_presses(sample::go);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::accepted);
  assert_true(cell.parameters.after_step(start_time).is_ok());
  assert_int_equal(revision.load(), 2);
  // Back to the tables.
  ParameterRequest reset = request_of(RequestKind::reset);
  reset.add_name(sample::step);
  assert_int_equal(cell.parameters.apply(reset, start_time).kind, AnswerKind::accepted);
  assert_false(IS_SET(cell, step));
  assert_int_equal(revision.load(), 3);
  // A member that is cloned: what differs from the tables.
  static sample::Runtime other;
  other = sample::default_runtime;
  other.gains[1] = 7;
  assert_int_equal(cell.parameters.apply(request_of(RequestKind::clone), start_time, &other).kind,
                   AnswerKind::accepted);
  assert_true(IS_SET(cell, gains));
  assert_false(IS_SET(cell, step));
  assert_int_equal(cell.parameters.apply(request_of(RequestKind::activate), start_time).kind,
                   AnswerKind::accepted);
  assert_false(IS_SET(cell, gains));
}

void press_go(Cell& cell) {
  ParameterRequest press = request_of(RequestKind::press);
  press.add_presses(sample::go);
  assert_int_equal(cell.parameters.apply(press, start_time).kind, AnswerKind::accepted);
}

void what_a_component_changes_itself_is_shown(void**) {
  Cell& cell = begin();
  const std::uint64_t before = cell.seen_sequence();
  cell.component.runtime.step = 0.05;
  assert_true(cell.parameters.after_step(start_time).is_ok());
  assert_true(cell.seen().step == 0.05);
  assert_int_equal(cell.seen_sequence(), before + 1);
  // Who had seen the values before does not know them any more.
  ParameterRequest request = set_to(sample::step, 0.06);
  request.expected = before;
  assert_int_equal(cell.parameters.apply(request, start_time).kind, AnswerKind::stale);
  // Nothing more happens in the next step.
  assert_true(cell.parameters.after_step(start_time).is_ok());
  assert_int_equal(cell.seen_sequence(), before + 1);
}

/// In a step that saw a press a person asked for it.
void what_a_component_changes_itself_is_kept_after_a_press_only(void**) {
  for (const bool is_pressed : {false, true}) {
    Cell& cell = begin();
    static std::atomic<std::uint64_t> revision;
    revision = 0;
    cell.parameters.set_revision(revision);
    if (is_pressed) press_go(cell);
    cell.component.runtime.step = 0.05;
    cell.component.runtime.limits.low = -3;
    cell.component.runtime.scratch = 8;
    assert_true(cell.parameters.after_step(start_time).is_ok());
    assert_int_equal(IS_SET(cell, step), is_pressed);
    assert_int_equal(IS_SET(cell, limits.low), is_pressed);
    assert_false(IS_SET(cell, limits.high));
    assert_false(IS_SET(cell, scratch));
    assert_int_equal(revision.load(), is_pressed ? 1 : 0);
    if (is_pressed) assert_true(step_to_save(cell) == 0.05);
    // The press counts for its own step.
    cell.component.runtime.step = 0.06;
    assert_true(cell.parameters.after_step(start_time).is_ok());
    assert_int_equal(revision.load(), is_pressed ? 1 : 0);
  }
}

/// The file keeps what a person set, whatever a unit makes of it afterwards, by itself or by a request that
/// names nobody.
void what_a_person_set_is_kept_as_it_was_set(void**) {
  for (const RequestKind kind : {RequestKind::set, RequestKind::reset, RequestKind::clone}) {
    Cell& cell = begin();
    static std::atomic<std::uint64_t> revision;
    revision = 0;
    cell.parameters.set_revision(revision);
    assert_int_equal(cell.parameters.apply(set_to(sample::step, 0.02), start_time).kind,
                     AnswerKind::accepted);
    assert_int_equal(revision.load(), 1);
    cell.component.runtime.step = 0.05;
    assert_true(cell.parameters.after_step(start_time).is_ok());
    static sample::Runtime other;
    other = sample::default_runtime;
    ParameterRequest request = request_of(kind);
    const std::int8_t small = 9;
    if (kind != RequestKind::reset) request.add(sample::small, 0, &small, sizeof(small));
    request.keeps = false;
    assert_int_equal(cell.parameters.apply(request, start_time, &other).kind, AnswerKind::accepted);
    assert_true(cell.seen().step == (kind == RequestKind::set ? 0.05 : 0.01));
    assert_int_equal(revision.load(), 1);
    assert_true(IS_SET(cell, step));
    assert_false(IS_SET(cell, small));
    assert_true(step_to_save(cell) == 0.02);
    // Another value that a person sets leaves it alone, too.
    assert_int_equal(cell.parameters.apply(set_to(sample::enabled, true), start_time).kind,
                     AnswerKind::accepted);
    assert_int_equal(revision.load(), 2);
    assert_true(step_to_save(cell) == 0.02);
    // The same value again: it is in force, and in the file already.
    assert_int_equal(cell.parameters.apply(set_to(sample::step, 0.02), start_time).kind,
                     AnswerKind::accepted);
    assert_true(cell.seen().step == 0.02);
    assert_int_equal(revision.load(), 2);
  }
}

void what_a_component_must_not_set_itself_goes_back(void**) {
  Cell& cell = begin();
  assert_int_equal(cell.parameters.apply(set_to(sample::step, 0.03), start_time).kind, AnswerKind::accepted);
  assert_int_equal(cell.parameters.apply(lease_request(RequestKind::hold, 5, 1), start_time).kind,
                   AnswerKind::accepted);
  const std::uint64_t before = cell.seen_sequence();
  cell.component.runtime.step = std::numeric_limits<double>::quiet_NaN();
  cell.component.runtime.gains[2] = 5;
  Status status = cell.parameters.after_step(start_time);
  assert_string_equal(
      status.cause(),
      "it changed its own values, and they are refused: step: nan is not a finite number; they "
      "are as before");
  assert_true(cell.component.runtime.step == 0.03);
  assert_true(cell.component.runtime.gains[2] == 3);
  assert_true(cell.component.runtime.jog[0]);
  assert_int_equal(cell.seen_sequence(), before);
  assert_true(step_to_save(cell) == 0.03);
  assert_false(IS_SET(cell, gains));
  // Out of its range, no value of its enumeration, refused by the component itself.
  cell.component.runtime.gains[0] = 11;
  assert_false(cell.parameters.after_step(start_time).is_ok());
  cell.component.runtime.mode = 3;
  assert_false(cell.parameters.after_step(start_time).is_ok());
  cell.component.runtime.limits.low = 4;
  status = cell.parameters.after_step(start_time);
  assert_string_equal(
      status.cause(),
      "it changed its own values, and they are refused: low is not below high; they are as before");
  assert_true(cell.component.runtime.limits.low == -1);
  // In initialise(), too.
  cell.component.runtime.step = 7;
  assert_false(cell.parameters.adopt(&cell.component.runtime, start_time).is_ok());
  assert_true(cell.component.runtime.step == 0.03);
}

// A component without runtime parameters, and one with too many.
class OtherComponent : public Component {
 public:
  explicit OtherComponent(const ComponentType& type) : type_(type) {}
  const ComponentType& component_type() const noexcept override { return type_; }
  ParameterMemory parameter_memory() noexcept override { return {}; }

 private:
  const ComponentType& type_;
};

void what_has_no_parameters_refuses_all_but_the_population(void**) {
  static const ComponentType none{"none", "", {}, {}, {}, {}};
  static OtherComponent component(none);
  static RuntimeParameters parameters;
  static ParameterScratch scratch;
  assert_true(parameters.connect(component, nullptr, nullptr, scratch).is_ok());
  assert_false(parameters.has_any());
  assert_true(parameters.adopt(nullptr, start_time).is_ok());
  parameters.before_step(start_time);
  assert_true(parameters.after_step(start_time).is_ok());
  parameters.end_all_leases(start_time);
  assert_int_equal(parameters.apply(set_to(0, 1.0), start_time).kind, AnswerKind::refused);
  assert_int_equal(parameters.apply(request_of(RequestKind::activate), start_time).kind,
                   AnswerKind::accepted);
  assert_int_equal(parameters.apply(request_of(RequestKind::retire), start_time).kind, AnswerKind::accepted);
}

void too_large_parameters_are_refused_at_the_start(void**) {
  static const TypeDescriptor large{"Large", "", max_runtime_size + 1, 1, 1, {}, {}, {}, false};
  static const ComponentType type{"large", "", {}, {&large, {}}, {}, {}};
  static OtherComponent component(type);
  static RuntimeParameters parameters;
  static ParameterScratch scratch;
  component.set_name("large");
  const Status status = parameters.connect(component, nullptr, nullptr, scratch);
  assert_string_equal(
      status.cause(),
      "large: runtime parameters of 4097 bytes, at most 4096 are possible: move large ones to the "
      "configuration");
}

}  // namespace
}  // namespace flexrf::parameter_store_test

int main() {
  using namespace flexrf::parameter_store_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(values_in_force_are_published_at_the_start),
      cmocka_unit_test(a_set_comes_into_force_as_a_whole),
      cmocka_unit_test(a_set_that_fails_changes_nothing),
      cmocka_unit_test(the_component_may_refuse_the_set),
      cmocka_unit_test(what_was_seen_too_long_ago_is_stale),
      cmocka_unit_test(sequences_wrap_around),
      cmocka_unit_test(presses_are_counted_until_the_step_has_seen_them),
      cmocka_unit_test(reset_gives_the_values_of_the_tables),
      cmocka_unit_test(a_member_begins_with_the_tables_or_with_another_members_values),
      cmocka_unit_test(saved_values_are_checked_before_they_are_taken),
      cmocka_unit_test(what_somebody_set_is_remembered),
      cmocka_unit_test(what_a_component_changes_itself_is_shown),
      cmocka_unit_test(what_a_component_changes_itself_is_kept_after_a_press_only),
      cmocka_unit_test(what_a_person_set_is_kept_as_it_was_set),
      cmocka_unit_test(what_a_component_must_not_set_itself_goes_back),
      cmocka_unit_test(what_has_no_parameters_refuses_all_but_the_population),
      cmocka_unit_test(too_large_parameters_are_refused_at_the_start),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
