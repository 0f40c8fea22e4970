#include <array>
#include <cmath>
#include <random>

#include "hal/robot_arm/paced/answer_pacing.hpp"
#include "hal/robot_arm/paced/joint_follower.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;
using Answer = AnswerPacing::Answer;

constexpr Time beginning{std::chrono::seconds(1)};

AnswerPacing pacing() {
  AnswerPacing pacing;
  pacing.begin({.answer = milliseconds(12), .silence = milliseconds(60), .search = milliseconds(100)});
  return pacing;
}

std::uint32_t say(AnswerPacing& pacing, Time now) {
  assert_true(pacing.is_free(now));
  const std::uint32_t number = pacing.number_next();
  pacing.sent(now);
  return number;
}

std::uint32_t say_and_hear(AnswerPacing& pacing) {
  const std::uint32_t number = say(pacing, beginning);
  assert_true(pacing.judge(number, beginning) == Answer::in_time);
  return number;
}

void one_packet_is_on_its_way(void**) {
  AnswerPacing it = pacing();
  const std::uint32_t number = say(it, beginning);
  assert_false(it.is_free(beginning + milliseconds(7)));
  assert_true(it.judge(number, beginning + milliseconds(7)) == Answer::in_time);
  assert_true(it.is_free(beginning + milliseconds(7)));
  assert_int_equal(it.counters().answered, 1);
  assert_int_equal(it.counters().lost, 0);
}

void a_controller_that_is_not_heard_is_asked_seldom_and_loses_nothing(void**) {
  AnswerPacing it = pacing();
  say(it, beginning);
  assert_false(it.is_free(beginning + milliseconds(99)));
  assert_true(it.is_free(beginning + milliseconds(100)));
  assert_int_equal(it.counters().lost, 0);
  assert_false(it.has_fallen_silent(beginning + milliseconds(1000)));
}

void what_is_not_answered_in_time_is_lost_and_may_come_late(void**) {
  AnswerPacing it = pacing();
  Time now = beginning;
  it.judge(say(it, now), now);
  const std::uint32_t first = say(it, now);
  now += milliseconds(12);
  assert_true(it.is_free(now));
  assert_true(it.has_given_up());
  const std::uint32_t second = say(it, now);
  assert_false(it.has_given_up());
  assert_int_equal(it.counters().lost, 1);
  assert_true(it.judge(first, now) == Answer::late);
  // The second is still on its way.
  assert_false(it.is_free(now));
  assert_true(it.judge(second, now) == Answer::in_time);
  assert_int_equal(it.counters().late, 1);
  assert_int_equal(it.counters().foreign, 0);
}

void what_nobody_asked_is_foreign(void**) {
  AnswerPacing it = pacing();
  const std::uint32_t number = say(it, beginning);
  assert_true(it.judge(number + 1, beginning) == Answer::foreign);
  assert_true(it.judge(number - 1000, beginning) == Answer::foreign);
  assert_false(it.is_heard());
  assert_int_equal(it.counters().foreign, 2);
  // A second time is no new answer.
  assert_true(it.judge(number, beginning) == Answer::in_time);
  assert_true(it.judge(number, beginning) == Answer::late);
}

void a_controller_that_does_not_number_its_answers_is_understood(void**) {
  AnswerPacing it = pacing();
  for (int i = 0; i < 3; ++i) {
    say(it, beginning);
    assert_true(it.judge(0, beginning) == Answer::in_time);
  }
  assert_int_equal(it.counters().answered, 3);
}

/// Who numbered an answer numbers all: one without is somebody else's.
void a_controller_that_numbers_its_answers_numbers_all(void**) {
  AnswerPacing it = pacing();
  const std::uint32_t number = say(it, beginning);
  assert_true(it.judge(number, beginning) == Answer::in_time);
  say(it, beginning);
  assert_true(it.judge(0, beginning) == Answer::foreign);
  // After a silence another one may be there.
  assert_true(it.has_fallen_silent(beginning + milliseconds(61)));
  assert_true(it.judge(0, beginning + milliseconds(62)) == Answer::in_time);
}

/// Numbers begin where the session says: what was said in the one before is no answer in this one.
void answers_of_a_session_before_are_foreign(void**) {
  AnswerPacing before = pacing();
  std::array<std::uint32_t, 3> old{};
  for (std::uint32_t& number : old) number = say_and_hear(before);
  AnswerPacing it;
  it.begin({.answer = milliseconds(12),
            .silence = milliseconds(60),
            .search = milliseconds(100),
            .first_number = 5000});
  assert_int_equal(say(it, beginning), 5001);
  for (const std::uint32_t number : old) assert_true(it.judge(number, beginning) == Answer::foreign);
  assert_false(it.is_heard());
  assert_true(it.judge(5001, beginning) == Answer::in_time);
}

void silence_is_noticed_once(void**) {
  AnswerPacing it = pacing();
  it.judge(say(it, beginning), beginning);
  assert_false(it.has_fallen_silent(beginning + milliseconds(60)));
  assert_true(it.has_fallen_silent(beginning + milliseconds(61)));
  assert_false(it.has_fallen_silent(beginning + milliseconds(62)));
  assert_false(it.is_heard());
}

constexpr double cycle = 0.007;

KinematicChain chain() {
  KinematicChain chain;
  chain.joint_count = 2;
  for (ChainJoint& joint : chain.joints) {
    joint.lower = -2;
    joint.upper = 2;
    joint.velocity = 3;
    joint.acceleration = 9;
  }
  return chain;
}

/// Cycles with these limits kept to, as the controller sees them.
class Watched {
 public:
  Watched() { follower.begin(chain_, cycle); }
  double next() {
    const double before = follower.set_point()[0];
    const double after = follower.next()[0];
    const double velocity = (after - before) / cycle;
    kept_ = kept_ && std::abs(velocity) <= 3 + 1e-9 && std::abs(after) <= 2 + 1e-12 &&
            std::abs(velocity - velocity_) <= 9 * cycle + 1e-9;
    velocity_ = velocity;
    return after;
  }
  bool kept() const { return kept_; }

  JointFollower follower;

 private:
  KinematicChain chain_ = chain();
  double velocity_ = 0;
  bool kept_ = true;
};

void a_jump_is_approached_and_not_passed(void**) {
  Watched arm;
  arm.follower.command({1.5, 0});
  double farthest = 0;
  for (int i = 0; i < 400; ++i) farthest = std::max(farthest, arm.next());
  assert_true(arm.kept());
  assert_true(farthest <= 1.5 + 1e-12);
  assert_true(arm.follower.set_point()[0] == 1.5);
  assert_true(arm.follower.is_at_rest());
}

void what_moves_within_the_limits_is_met_exactly(void**) {
  Watched arm;
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    // Fastest 2.5 rad/s, accelerated with 7.8 rad/s^2 at most.
    const double wanted = 0.8 * (1 - std::cos(3.125 * i * cycle));
    arm.follower.command({wanted, 0});
    worst = std::max(worst, std::abs(arm.next() - wanted));
  }
  assert_true(arm.kept());
  assert_true(worst < 1e-9);
}

void it_keeps_to_its_limits_whatever_it_is_commanded(void**) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-5, 5);
  for (int run = 0; run < 50; ++run) {
    Watched arm;
    double wanted = 0;
    for (int i = 0; i < 500; ++i) {
      if (random() % 20 == 0) wanted = anywhere(random);
      if (random() % 3 == 0) wanted += anywhere(random) * 0.01;
      arm.follower.command({wanted, 0});
      arm.next();
    }
    assert_true(arm.kept());
  }
}

void braking_ends_at_rest_and_stays(void**) {
  Watched arm;
  arm.follower.command({1.5, 0});
  for (int i = 0; i < 40; ++i) arm.next();
  arm.follower.brake();
  for (int i = 0; i < 100; ++i) arm.next();
  assert_true(arm.kept());
  assert_true(arm.follower.is_at_rest());
  const double rest = arm.follower.set_point()[0];
  assert_true(rest > 0.1 && rest < 1.5);
  arm.follower.command({0, 0});
  assert_true(arm.next() == rest);
}

void after_a_cycle_without_it_a_joint_begins_at_rest(void**) {
  Watched arm;
  arm.follower.command({1.5, 0});
  for (int i = 0; i < 40; ++i) arm.next();
  arm.follower.stand();
  const double before = arm.follower.set_point()[0];
  assert_true(arm.follower.next()[0] - before <= 9 * cycle * cycle + 1e-12);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_packet_is_on_its_way),
      cmocka_unit_test(a_controller_that_is_not_heard_is_asked_seldom_and_loses_nothing),
      cmocka_unit_test(what_is_not_answered_in_time_is_lost_and_may_come_late),
      cmocka_unit_test(what_nobody_asked_is_foreign),
      cmocka_unit_test(a_controller_that_does_not_number_its_answers_is_understood),
      cmocka_unit_test(a_controller_that_numbers_its_answers_numbers_all),
      cmocka_unit_test(answers_of_a_session_before_are_foreign),
      cmocka_unit_test(silence_is_noticed_once),
      cmocka_unit_test(a_jump_is_approached_and_not_passed),
      cmocka_unit_test(what_moves_within_the_limits_is_met_exactly),
      cmocka_unit_test(it_keeps_to_its_limits_whatever_it_is_commanded),
      cmocka_unit_test(braking_ends_at_rest_and_stays),
      cmocka_unit_test(after_a_cycle_without_it_a_joint_begins_at_rest),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
