// The cell of apps/visual-servoing for longer than anybody looks on: it does not run out of parts that it can
// take.
#include <cstdio>

#include "tests/visual_servoing/pick_judge.hpp"

namespace flexrf::visual_servoing {
namespace {

void it_picks_on_and_on() {
  constexpr double interval = 300;                 // s
  constexpr std::uint64_t least_in_interval = 40;  // 50 are usual
  ServoingCell cell(1);
  std::uint64_t before = 0;
  double next = interval;
  cell.run(std::chrono::minutes(30), [&] {
    if (cell.elapsed() < next) return;
    const std::uint64_t binned = cell.picker().binned;
    std::printf("until %.0f s: %d parts\n", next, static_cast<int>(binned - before));
    CHECK(binned - before >= least_in_interval);
    before = binned;
    next += interval;
  });
  CHECK(next > 1800);
  CHECK_EQUAL(cell.table().contacts, 0U);
}

}  // namespace
}  // namespace flexrf::visual_servoing

int main() {
  using namespace flexrf::visual_servoing;
  const CMUnitTest tests[] = {CONTAINED_TEST(it_picks_on_and_on)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
