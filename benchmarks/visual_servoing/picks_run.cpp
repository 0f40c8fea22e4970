// One run of the cell in virtual time, judged by the truth: `servoing_picks FILE SEED SECONDS [disturbed]`
// writes what became of each approach as JSON; disturbed by a person all the time, or by nobody.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>

#include "benchmarks/visual_servoing/unreachable_judge.hpp"
#include "hal/scene/interface/part_catalogue.hpp"
#include "tests/visual_servoing/disturber.hpp"
#include "tests/visual_servoing/pick_judge.hpp"

namespace flexrf::bench {
namespace {

using visual_servoing::Approach;
using visual_servoing::Disturber;
using visual_servoing::PickJudge;
using visual_servoing::ServoingCell;
using Json = nlohmann::ordered_json;

Json miss(double at, std::uint16_t kind, const std::string& cause) {
  return {{"at", at}, {"part", part_catalogue[kind].name}, {"cause", cause}};
}

std::string cause_of(const Approach& approach) {
  if (!approach.binned) return approach.cause;
  char text[120];
  std::snprintf(text, sizeof(text), "in its bin, but off by %.1f mm and %.1f degrees",
                1000 * approach.place_error, approach.angle_error * 180 / std::numbers::pi);
  return text;
}

Json run(std::uint64_t seed, double seconds, bool is_disturbed) {
  ServoingCell cell(seed);
  PickJudge judge(cell);
  UnreachableJudge unreachable(cell);
  Disturber person(cell, seed);
  Json contacts = Json::array();
  std::uint64_t touched = 0;
  const RunSummary summary = cell.run(duration_of(seconds), [&] {
    if (cell.elapsed() > seconds) return;  // the arm comes to rest, whatever it was at
    judge.look();
    if (is_disturbed)
      person.look();
    else
      unreachable.look();
    if (cell.table().contacts != touched)
      contacts.push_back({{"at", cell.elapsed()}, {"while", cell.message() + " (" + person.deed() + ")"}});
    touched = cell.table().contacts;
  });
  Json misses = Json::array();
  std::size_t binned = 0;
  for (const Approach& approach : judge.approaches()) {
    if (approach.binned) ++binned;
    if (!approach.is_good()) misses.push_back(miss(approach.ended, approach.kind, cause_of(approach)));
  }
  Json wrong = Json::array();
  for (const UnreachableJudge::Wrong& one : unreachable.wrong())
    wrong.push_back(miss(one.at, one.kind, one.said));
  std::size_t truly_binned = 0;
  for (const std::uint32_t count : cell.table().binned) truly_binned += count;
  return {{"seed", seed},
          {"approaches", judge.approaches().size()},
          {"good", judge.good()},
          {"binned", binned},
          {"truly_binned", truly_binned},
          {"misses", misses},
          {"wrongly_unreachable", wrong},
          {"contacts", cell.table().contacts},
          {"first_contacts", contacts},
          {"judged_seconds", seconds},
          {"run_seconds", flexrf::seconds(summary.run_time)},
          {"wall_seconds", flexrf::seconds(summary.wall_time)}};
}

}  // namespace
}  // namespace flexrf::bench

int main(int count, char** arguments) {
  const bool is_disturbed = count == 5 && std::string_view{arguments[4]} == "disturbed";
  if (count != 4 && !is_disturbed) {
    std::fprintf(stderr, "servoing_picks FILE SEED SECONDS [disturbed]\n");
    return 1;
  }
  try {
    const auto result = flexrf::bench::run(std::strtoull(arguments[2], nullptr, 10),
                                           std::strtod(arguments[3], nullptr), is_disturbed);
    std::ofstream(arguments[1]) << result.dump(1) << '\n';
  } catch (const flexrf::fixture::CheckFailed& failed) {
    std::fprintf(stderr, "servoing_picks: %s\n", failed.message.c_str());
    return 1;
  }
  return 0;
}
