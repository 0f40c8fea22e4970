// One run of the cell in virtual time, judged by the truth: `visual_servoing_trial SEED SECONDS [-d] [-v]`;
// with -d a person disturbs it all the time. The last line is for programs: approaches, picks, good ones,
// contacts, touches, s of virtual time, digest.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/visual_servoing/disturber.hpp"
#include "tests/visual_servoing/pick_judge.hpp"
#include "tests/visual_servoing/way_judge.hpp"

int main(int count, char** arguments) {
  using namespace flexrf;
  using namespace flexrf::visual_servoing;
  if (count < 3) {
    std::fprintf(stderr, "visual_servoing_trial SEED SECONDS [-d] [-v]\n");
    return 1;
  }
  try {
    const std::uint64_t seed = std::strtoull(arguments[1], nullptr, 10);
    bool disturbs = false;
    bool tells = false;
    for (int i = 3; i < count; ++i) {
      disturbs = disturbs || std::string_view{arguments[i]} == "-d";
      tells = tells || std::string_view{arguments[i]} == "-v";
    }
    ServoingCell cell(seed);
    PickJudge judge(cell);
    WayJudge ways(cell);
    Disturber person(cell, seed);
    judge.verbose = person.verbose = tells;
    std::uint64_t contacts = 0;
    cell.run(duration_of(std::strtod(arguments[2], nullptr)), [&] {
      judge.look();
      ways.look();
      if (disturbs) person.look();
      if (cell.table().contacts != contacts)
        std::printf("%8.3f  contact, while: %s; the person's last deed: %s\n", cell.elapsed(),
                    cell.message().c_str(), person.deed().c_str());
      contacts = cell.table().contacts;
    });
    for (const Way& way : ways.ways())
      if (tells && way.farthest > most_beside_way)
        std::printf("%8.3f  state %d: a way of %.0f mm, begun at %.2f m/s, is left by %.1f mm\n", way.began,
                    static_cast<int>(way.state), 1000 * (way.to - way.from).norm(), way.speed,
                    1000 * way.farthest);
    std::size_t binned = 0;
    for (const Approach& one : judge.approaches()) {
      if (one.binned) ++binned;
      if (one.is_good()) continue;
      std::printf("%8.3f  missed, kind %d, %.2f mm, %.2f rad: %s\n", one.ended, one.kind,
                  1000 * one.place_error, one.angle_error,
                  one.binned ? "in its bin, but not exact" : one.cause.c_str());
    }
    std::printf("%zu %zu %zu %" PRIu64 " %" PRIu64 " %.1f %016" PRIx64 "\n", judge.approaches().size(),
                binned, judge.good(), cell.table().contacts, cell.table().touches, cell.elapsed(),
                cell.digest());
  } catch (const fixture::CheckFailed& failed) {
    std::fprintf(stderr, "%s\n", failed.message.c_str());
    return 1;
  }
  return 0;
}
