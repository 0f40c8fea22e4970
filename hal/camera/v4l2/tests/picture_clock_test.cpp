// Which stamps are believed, and when the middle of an exposure was.
#include "hal/camera/v4l2/picture_clock.hpp"

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;

constexpr Time beginning{std::chrono::seconds(100)};
constexpr Duration period = milliseconds(40);

PictureClock clock_of(const ExposurePlan& plan) {
  PictureClock clock;
  clock.begin(plan, beginning);
  return clock;
}

/// Of a picture that is stamped 100 ms after the beginning and taken 5 ms later: how much before it was taken
/// it was exposed, in ms.
std::int64_t age(StampSource source, const ExposurePlan& plan) {
  PictureClock clock = clock_of(plan);
  const Time stamp = beginning + milliseconds(100);
  const Time now = stamp + milliseconds(5);
  const Time exposed = clock.exposed_at({source, stamp}, now);
  assert_true(clock.source() == source);
  return std::chrono::duration_cast<milliseconds>(now - exposed).count();
}

void a_picture_is_of_the_middle_of_its_exposure(void**) {
  const ExposurePlan rolling{.period = period, .exposure = milliseconds(8), .readout = milliseconds(30)};
  const ExposurePlan global{
      .period = period, .exposure = milliseconds(8), .readout = milliseconds(30), .rolling = false};
  assert_int_equal(age(StampSource::end_of_frame, rolling), 5 + 19);
  assert_int_equal(age(StampSource::end_of_frame, global), 5 + 34);
  assert_int_equal(age(StampSource::arrival, rolling), 19);
  assert_int_equal(age(StampSource::arrival, global), 34);
  // 4 ms after the begin of a global shutter, 19 of a rolling one, which would be later than now.
  assert_int_equal(age(StampSource::begin_of_exposure, global), 1);
  assert_int_equal(age(StampSource::begin_of_exposure, rolling), 0);
}

void what_is_not_known_is_half_of_a_period(void**) {
  assert_int_equal(age(StampSource::end_of_frame, {.period = period}), 5 + 20);
  assert_int_equal(age(StampSource::arrival, {.period = period}), 20);
  assert_int_equal(age(StampSource::end_of_frame, {.period = period, .exposure = milliseconds(10)}), 5 + 15);
}

bool is_believed(PictureClock& clock, StampSource source, Time stamp, Time now) {
  const Time exposed = clock.exposed_at({source, stamp}, now);
  assert_true(exposed <= now);
  return clock.source() == source;
}

void a_stamp_ahead_of_now_is_not_believed(void**) {
  PictureClock clock = clock_of({.period = period});
  const Time now = beginning + milliseconds(100);
  assert_false(is_believed(clock, StampSource::end_of_frame, now + milliseconds(1), now));
  assert_true(is_believed(clock, StampSource::end_of_frame, now, now));
}

void a_stamp_older_than_the_picture_can_be_is_not_believed(void**) {
  struct Column {
    StampSource source;
    Duration oldest;
  };
  for (const Column& column :
       {Column{StampSource::end_of_frame, period}, Column{StampSource::begin_of_exposure, 2 * period}}) {
    const Time looked = beginning + milliseconds(500);
    for (const bool too_old : {false, true}) {
      PictureClock clock = clock_of({.period = period});
      clock.note_none(looked);
      const Time stamp = looked - column.oldest - (too_old ? milliseconds(1) : milliseconds(0));
      assert_int_equal(is_believed(clock, column.source, stamp, looked + milliseconds(10)), !too_old);
    }
  }
}

/// A thread that was held up finds pictures that waited: they are as old as they say.
void pictures_that_waited_are_believed(void**) {
  PictureClock clock = clock_of({.period = period});
  clock.note_none(beginning);
  const Time late = beginning + milliseconds(900);
  for (int picture = 1; picture <= 4; ++picture)
    assert_true(is_believed(clock, StampSource::end_of_frame, beginning + picture * period, late));
}

void a_stamp_that_comes_again_or_goes_back_is_not_believed(void**) {
  PictureClock clock = clock_of({.period = period});
  const Time first = beginning + milliseconds(100);
  const Time now = first + period;
  assert_true(is_believed(clock, StampSource::end_of_frame, first, now));
  assert_false(is_believed(clock, StampSource::end_of_frame, first, now));
  assert_false(is_believed(clock, StampSource::end_of_frame, first - milliseconds(1), now));
  assert_true(is_believed(clock, StampSource::end_of_frame, first + milliseconds(1), now));
}

void times_rise_whatever_stamps_do(void**) {
  PictureClock clock = clock_of({.period = period});
  Time before{};
  const Time now = beginning + milliseconds(100);
  for (const StampSource source : {StampSource::arrival, StampSource::arrival, StampSource::end_of_frame,
                                   StampSource::begin_of_exposure, StampSource::arrival}) {
    const Time exposed = clock.exposed_at({source, now - milliseconds(3)}, now);
    assert_true(exposed > before);
    before = exposed;
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_picture_is_of_the_middle_of_its_exposure),
      cmocka_unit_test(what_is_not_known_is_half_of_a_period),
      cmocka_unit_test(a_stamp_ahead_of_now_is_not_believed),
      cmocka_unit_test(a_stamp_older_than_the_picture_can_be_is_not_believed),
      cmocka_unit_test(pictures_that_waited_are_believed),
      cmocka_unit_test(a_stamp_that_comes_again_or_goes_back_is_not_believed),
      cmocka_unit_test(times_rise_whatever_stamps_do),
  };
  return cmocka_run_group_tests_name("picture clock", tests, nullptr, nullptr);
}
