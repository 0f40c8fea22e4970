#include "hal/new_interface/conformance/new_interface_conformance.hpp"

#include "tests/conformance.hpp"

namespace flexrf {
namespace {

MakeNewInterfaceWorld make_world = nullptr;

template <Verdict (*Run)(NewInterfaceWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

bool command(NewInterfaceWorld& world, bool on) {
  world.cycle(&on);
  world.cycle(nullptr);  // what came of it is known in the next one
  return world.is_on() == on && world.feedback().on == on;
}

Verdict it_follows_what_it_is_commanded(NewInterfaceWorld& world) {
  if (!world.start()) return Verdict::failed;
  return verdict(command(world, true) && command(world, false) && command(world, true) &&
                 world.feedback().switched == 3);
}

Verdict it_is_off_until_it_is_commanded(NewInterfaceWorld& world) {
  if (!world.start()) return Verdict::failed;
  world.cycle(nullptr);
  return verdict(!world.is_on() && !world.feedback().on);
}

Verdict while_inhibited_it_is_off_and_remembers_no_command(NewInterfaceWorld& world) {
  if (!world.start() || !command(world, true)) return Verdict::failed;
  world.device().set_inhibited(true);
  const bool on = true;
  world.cycle(&on);
  if (world.is_on()) return Verdict::failed;
  world.device().set_inhibited(false);
  world.cycle(nullptr);
  return verdict(!world.is_on());
}

Verdict its_safe_state_is_off(NewInterfaceWorld& world) {
  if (!world.start() || !command(world, true)) return Verdict::failed;
  return verdict(world.device().make_safe() && !world.is_on());
}

}  // namespace

int run_new_interface_conformance(const char* driver, MakeNewInterfaceWorld make) {
  make_world = make;
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<it_follows_what_it_is_commanded>),
      cmocka_unit_test(judged<it_is_off_until_it_is_commanded>),
      cmocka_unit_test(judged<while_inhibited_it_is_off_and_remembers_no_command>),
      cmocka_unit_test(judged<its_safe_state_is_off>),
  };
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
