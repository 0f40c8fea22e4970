// A cell with a simulated camera, in virtual time.
#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

struct Result {
  nlohmann::json finder;
  nlohmann::json camera;
  std::string digest;
};

Result run_for_a_passage() {
  const Folder folder;
  const Ending ending =
      run(folder, {place::watched_belt, "--virtual-time", "3950ms", "--digest", "--report", "report"});
  CHECK_EQUAL(ending.exit_code, 0);
  const Report report(folder / "report");
  return {report.last("finder.feedback"), report.last("camera.feedback"),
          report["run"].at("digest").get<std::string>()};
}

// A part passes in four seconds, of which the last little is left out; some pictures are lost or damaged on
// purpose.
void the_part_is_found_all_along_the_belt() {
  const Result result = run_for_a_passage();
  CHECK(result.finder.at("greatest_place").get<double>() > 0.9);
  CHECK(result.finder.at("found").get<int>() > 90);
  CHECK_EQUAL(result.finder.at("found"), result.finder.at("pictures"));
  CHECK_EQUAL(result.camera.at("frames"), result.finder.at("pictures"));
  CHECK(result.camera.at("lost_frames").get<int>() > 0);
  CHECK(result.camera.at("damaged_frames").get<int>() > 0);
  const int left_out =
      result.camera.at("lost_frames").get<int>() + result.camera.at("damaged_frames").get<int>();
  CHECK_EQUAL(result.finder.at("gaps").get<int>(), left_out);
  CHECK_EQUAL(result.finder.at("blind").get<int>(), 0);
  CHECK(result.camera.at("present").get<bool>());
}

void the_same_run_has_the_same_digest() {
  CHECK_EQUAL(run_for_a_passage().digest, run_for_a_passage().digest);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {CONTAINED_TEST(the_part_is_found_all_along_the_belt),
                              CONTAINED_TEST(the_same_run_has_the_same_digest)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
