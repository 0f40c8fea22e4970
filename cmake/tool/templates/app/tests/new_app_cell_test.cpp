// The whole cell on a simulated clock.
#include <cmath>
#include <cstring>

#include "runtime/run/run_application.hpp"
#include "tests/cmocka.hpp"
#include "types/level.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace {

using namespace flexrf;
using namespace flexrf::user;
const Application& cell = flexrf::application::application;

const SlotRecord& slot(const char* name) {
  for (const SlotRecord& one : cell.slots) {
    if (std::strcmp(one.name, name) == 0) return one;
  }
  fail_msg("there is no slot %s", name);
  return cell.slots.front();
}

void the_level_is_reached(void**) {
  const char* words[] = {"new-app", "--virtual-time", "5s"};
  assert_int_equal(run_application(cell, 3, const_cast<char**>(words)), 0);
  // Steps of 5 s; then the cell comes to rest, in which threads are stepped more often.
  assert_in_range(slot("level").control->published(), 100, 200);
  assert_in_range(slot("smooth").control->published(), 1000, 1100);
  const SlotRecord& smooth = slot("smooth");
  assert_non_null(smooth.observer->latch(~std::uint64_t{0}));
  Level level;
  std::memcpy(&level, smooth.observer->payload(), sizeof(level));
  assert_true(std::abs(level.value - 1.0) < 1e-6);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(the_level_is_reached)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
