#include "benchmarks/visual_servoing/first_look.hpp"

#include <algorithm>
#include <array>

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

// Steps of one picture are nearer to each other than this, and farther from those of the next.
constexpr Duration of_one_picture = 16ms;

}  // namespace

FirstLook::FirstLook(WallCell& cell) : cell_(cell), since_(MonotonicClock::now()) {
  collect();
  waits();
}

void FirstLook::collect() {
  const Time now = MonotonicClock::now();
  cell_.executive().cell().step_traces()->ask(now + 1s);
  for (const char* const name : {"attention", "tracks"})
    for (const std::size_t thread : cell_.threads(name)) collect(thread, true);
  for (const std::size_t thread : cell_.threads("recognition")) collect(thread, false);
  since_ = now;
}

void FirstLook::collect(std::size_t thread, bool posts) {
  std::array<TracedStep, StepTrace::most> steps;
  const StepTrace& trace = cell_.executive().cell().step_traces()->of(thread);
  const std::size_t count = trace.copy(since_, steps).count;
  for (std::size_t i = 0; i < count; ++i) {
    const Time ended = steps[i].begin + steps[i].took;
    if (ended <= since_) continue;
    (posts ? posted_ : looked_).push_back(posts ? ended : steps[i].begin);
  }
}

std::vector<double> FirstLook::waits() {
  std::sort(posted_.begin(), posted_.end());
  std::sort(looked_.begin(), looked_.end());
  std::vector<double> microseconds;
  Time picture{};
  for (const Time posted : posted_) {
    if (posted - picture < of_one_picture) continue;
    picture = posted;
    const auto look = std::lower_bound(looked_.begin(), looked_.end(), posted);
    if (look != looked_.end()) microseconds.push_back(seconds(*look - posted) * 1e6);
  }
  posted_.clear();
  looked_.clear();
  return microseconds;
}

}  // namespace flexrf::bench
