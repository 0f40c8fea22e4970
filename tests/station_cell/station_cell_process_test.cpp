// From the list in CSV to the station: an application with a simulated link, in virtual time.
#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

struct Result {
  nlohmann::json stirrer;
  nlohmann::json link;
  std::string digest;
};

Result run_for_three_seconds() {
  const Folder folder;
  const Ending ending =
      run(folder, {place::station_cell, "--virtual-time", "3s", "--digest", "--report", "report"});
  CHECK_EQUAL(ending.exit_code, 0);
  const Report report(folder / "report");
  return {report.last("stirrer.feedback"), report.last("line.feedback"),
          report["run"].at("digest").get<std::string>()};
}

// The link is cut for half a second in the middle.
void a_register_map_becomes_values_that_survive_a_cut_link() {
  const Result result = run_for_three_seconds();
  CHECK_EQUAL(result.stirrer.at("greatest_speed").get<double>(), 1.5);
  CHECK_EQUAL(result.stirrer.at("gaps").get<int>(), 1);
  CHECK_EQUAL(result.stirrer.at("recoveries").get<int>(), 1);
  CHECK_EQUAL(result.link.at("connections").get<int>(), 2);
}

void the_same_run_has_the_same_digest() {
  CHECK_EQUAL(run_for_three_seconds().digest, run_for_three_seconds().digest);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {CONTAINED_TEST(a_register_map_becomes_values_that_survive_a_cut_link),
                              CONTAINED_TEST(the_same_run_has_the_same_digest)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
