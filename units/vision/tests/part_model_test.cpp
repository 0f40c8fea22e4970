#include "units/vision/part_model.hpp"

#include <cmath>
#include <string>

#include "tests/cmocka.hpp"
#include "units/vision/tests/known_parts.hpp"

namespace flexrf::part_model_test {
namespace {

using namespace flexrf::user;

constexpr double pi = std::numbers::pi;

/// Why this catalogue is refused; empty: it is not.
template <class Change>
std::string refusal(const Change& change) {
  PartCatalogue catalogue = catalogue_of_tests();
  change(catalogue);
  KnownParts parts;
  const Status status = parts.take(catalogue);
  if (status.is_ok()) return {};
  assert_true(parts.all().empty());
  return status.cause();
}

bool tells(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

void a_part_is_as_it_was_drawn(void**) {
  const auto parts = known_parts();
  assert_int_equal(parts.size(), 4);
  const auto& block = parts[0];
  assert_string_equal(block.name.data(), "block");
  assert_int_equal(block.corner_count, 4);
  assert_true(std::abs(block.area - 0.05 * 0.03) < 1e-12);
  assert_true(std::abs(block.perimeter - 0.16) < 1e-12);
  assert_true(block.middle.norm() < 1e-12);
  assert_true(std::abs(block.radius - std::hypot(0.025, 0.015)) < 1e-12);
  const auto& disc = parts[1];
  assert_int_equal(disc.corner_count, 24);
  assert_true(std::abs(disc.area - pi * 0.02 * 0.02) < 2e-5);
  assert_true(parts_of_tests().find(4) == nullptr && parts_of_tests().find(no_kind) == nullptr);
}

/// A block looks the same turned by a half turn, a hexagon by a sixth, a disc by anything: it is taken each
/// 15 degrees. Fingers that change places are no other way.
void a_grasp_is_turned_by_the_symmetry(void**) {
  const auto parts = known_parts();
  assert_int_equal(parts[0].grasp_count, 4);
  assert_true(std::abs(parts[0].grasps[1].x - 0.012) < 1e-9 && std::abs(parts[0].grasps[2].x + 0.012) < 1e-9);
  assert_int_equal(parts[1].grasp_count, 12);
  assert_int_equal(parts[2].grasp_count, 3);
  assert_int_equal(parts[3].grasp_count, 4);
}

void what_is_no_part_is_told(void**) {
  assert_string_equal(refusal([](PartCatalogue&) {}).c_str(), "");
  assert_true(tells(refusal([](PartCatalogue& all) { all.parts = {}; }), "there is no part in it"));
  assert_true(
      tells(refusal([](PartCatalogue& all) { all.table = {}; }), "give the colour of the bare table"));
  assert_true(tells(refusal([](PartCatalogue& all) {
                      all.parts[1].grasps[1] = {0.005, 0, 0, 0.03};
                      all.parts[1].grasps[2] = {0.006, 0, 0, 0.03};
                    }),
                    "'disc' has more than 24 grasps"));
  assert_true(tells(refusal([](PartCatalogue& all) { all.parts[1].set_name(""); }),
                    "part 2 has no name, but one behind it has"));
  assert_true(tells(refusal([](PartCatalogue& all) { all.parts[2].height = 0; }),
                    "'hexagon' needs a height above 0 m"));
  assert_true(tells(refusal([](PartCatalogue& all) { all.parts[1].radius = 0; }),
                    "'disc' needs an outline of at least 3 corners, or a radius"));
  assert_true(tells(refusal([](PartCatalogue& all) { all.parts[1].radius = -0.02; }), "'disc'"));
  assert_true(tells(refusal([](PartCatalogue& all) { all.parts[0].radius = 0.02; }),
                    "'block' has an outline and a radius"));
  assert_true(
      tells(refusal([](PartCatalogue& all) { std::swap(all.parts[0].outline[0], all.parts[0].outline[1]); }),
            "'block' has an outline that crosses itself"));
  assert_true(
      tells(refusal([](PartCatalogue& all) { std::swap(all.parts[0].outline[1], all.parts[0].outline[3]); }),
            "'block' has an outline that does not run counter-clockwise"));
  assert_true(
      tells(refusal([](PartCatalogue& all) { all.parts[3].bin.size[1] = 0; }), "'bracket' has a bin"));
  assert_true(tells(refusal([](PartCatalogue& all) { all.parts[3].grasps[0].width = -0.1; }),
                    "'bracket' has a grasp with a width below 0 m"));
}

/// Such parts are seen, and left where they are.
void a_part_needs_no_bin(void**) {
  assert_string_equal(refusal([](PartCatalogue& all) { all.parts[3].bin = {}; }).c_str(), "");
}

}  // namespace
}  // namespace flexrf::part_model_test

int main() {
  using namespace flexrf::part_model_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_part_is_as_it_was_drawn), cmocka_unit_test(a_grasp_is_turned_by_the_symmetry),
      cmocka_unit_test(what_is_no_part_is_told), cmocka_unit_test(a_part_needs_no_bin)};
  return cmocka_run_group_tests_name("part model", tests, nullptr, nullptr);
}
