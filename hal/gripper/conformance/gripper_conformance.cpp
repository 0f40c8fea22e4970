#include "hal/gripper/conformance/gripper_conformance.hpp"

#include "hal/gripper/conformance/gripper_cases.hpp"
#include "tests/conformance.hpp"

namespace flexrf {
namespace {

using namespace gripper_cases;

MakeGripperWorld make_world = nullptr;

template <Verdict (*Run)(GripperWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

// [gripper-3] [gripper-12] [gripper-20] [gripper-22]
void holds_in_all_orders(void**) {
  conclude(no_order_of_events_moves_it(make_world));
}

CMUnitTest test(const char* name, CMUnitTestFunction run) {
  return {name, run, nullptr, nullptr, nullptr};
}

}  // namespace

int run_gripper_conformance(const char* driver, MakeGripperWorld make) {
  make_world = make;
  using enum GripperFarEnd;
  const CMUnitTest tests[] = {
      test("does nothing by itself", judged<does_nothing_by_itself>),
      test("follows once it is activated", judged<follows_once_it_is_activated>),
      test("activated again, it stays as it is", judged<activated_again_it_stays_as_it_is>),
      test("opens and closes", judged<opens_and_closes>),
      test("moves from the command on", judged<moves_from_the_command_on>),
      test("goes in between, or refuses", judged<goes_in_between_or_refuses>),
      test("says what it does not do", judged<says_what_it_does_not_do>),
      test("keeps to its reach", judged<keeps_to_its_reach>),
      test("never follows what is no number", judged<nonsense_is_a_fault_and_never_followed<0>>),
      test("never follows an infinite speed", judged<nonsense_is_a_fault_and_never_followed<1>>),
      test("never follows a negative force", judged<nonsense_is_a_fault_and_never_followed<2>>),
      test("slower takes longer", judged<slower_takes_longer>),
      test("object in between", judged<tells_an_object_it_gripped>),
      test("hollow object, gripped from inside", judged<tells_a_hollow_object>),
      test("object lost", judged<tells_an_object_that_is_lost>),
      test("a new goal replaces the one before", judged<a_new_goal_replaces_the_one_before>),
      test("halts, or goes on to its end", judged<halts_or_goes_on_to_its_end>),
      test("halted it holds what it holds", judged<halted_it_holds_what_it_holds>),
      test("inhibited it ends its motion and forgets", judged<inhibited_it_ends_its_motion_and_forgets>),
      test("made safe it holds what it holds", judged<made_safe_it_holds_what_it_holds>),
      test("made safe it releases, where it shall", judged<made_safe_it_releases_where_it_shall>),
      test("made safe and silent, it confirms nothing",
           judged<made_safe_while_it_is_not_heard_it_confirms_nothing<silent>>),
      test("made safe and unplugged, it confirms nothing",
           judged<made_safe_while_it_is_not_heard_it_confirms_nothing<unplugged>>),
      test("made safe and without power, it confirms nothing",
           judged<made_safe_while_it_is_not_heard_it_confirms_nothing<off>>),
      test("no order of events moves it", holds_in_all_orders),
      test("fingers that do not move: no air, or jammed", judged<fingers_that_do_not_move_are_told>),
      test("silent peer", judged<is_heard_again<silent>>),
      test("garbage for an answer", judged<is_heard_again<damaged>>),
      test("cable out and in again", judged<is_heard_again<unplugged>>),
      test("power out and in again", judged<is_heard_again<off>>),
      test("without power it is no longer activated", judged<without_power_it_is_no_longer_activated>),
      test("its own fault, ended by activation", judged<its_own_fault_is_told_and_ended_by_activation>),
      test("switches that contradict each other", judged<switches_that_contradict_are_told>),
  };
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
