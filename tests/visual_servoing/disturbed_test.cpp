// The cell of apps/visual-servoing while a person leaves nothing as it is: nothing is touched, and it picks
// on whenever it is let.
#include <cstdio>

#include "tests/visual_servoing/disturber.hpp"
#include "tests/visual_servoing/pick_judge.hpp"

namespace flexrf::visual_servoing {
namespace {

// [picker-3] [picker-5]
template <std::uint64_t seed>
void nothing_is_touched() {
  ServoingCell cell(seed);
  Disturber person(cell, seed);
  std::uint64_t contacts = 0;
  cell.run(std::chrono::minutes(5), [&] {
    person.look();
    if (cell.table().contacts == contacts) return;
    contacts = cell.table().contacts;
    std::printf("seed %d, %.3f s, a contact, while: %s\n  the person's last deed: %s\n",
                static_cast<int>(seed), cell.elapsed(), cell.message().c_str(), person.deed().c_str());
  });
  CHECK_EQUAL(cell.table().contacts, 0U);
  CHECK(cell.picker().lost_parts <= person.tables());
  constexpr std::uint64_t least_binned = 5;  // 10 to 35 are usual
  CHECK(cell.picker().binned >= least_binned);
}

}  // namespace
}  // namespace flexrf::visual_servoing

int main() {
  using namespace flexrf::visual_servoing;
  const CMUnitTest tests[] = {TEST_APART(nothing_is_touched<601>), TEST_APART(nothing_is_touched<602>),
                              TEST_APART(nothing_is_touched<603>), TEST_APART(nothing_is_touched<604>)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
