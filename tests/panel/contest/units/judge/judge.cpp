#include "units/judge/judge.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {

void Judge::step(const Tick& /*tick*/) {
  constexpr std::uint64_t beats_of_a_round = 10;
  if (!runtime.frozen) ++beats_;
  Standing now{};
  now.round = beats_ / beats_of_a_round;
  for (std::size_t i = 0; i < std::min(efforts.size(), now.entrants.size()); ++i) {
    const auto told = efforts[i].latest();
    if (!told || told->count == 0) continue;
    const auto number = static_cast<std::uint32_t>(i);
    const double place = static_cast<double>(i);
    Entrant& entrant = now.entrants[i];
    entrant.active = true;
    entrant.trial = i == 2;
    entrant.mood = told->last[(told->count - 1) % told->last.size()].mood;
    entrant.number = number;
    entrant.parent = i == 2 ? 1 : number;
    entrant.heats = static_cast<std::uint32_t>(told->count);
    entrant.score = 1 + 0.5 * std::sin(0.5 * static_cast<double>(now.round) + place);
    entrant.price = 100 * (place + 1);
    entrant.habits = {0.5 + 0.5 * place, -0.25 * place};
  }
  feedback.saved += runtime.save;
  standing.publish(now);
}

}  // namespace flexrf::user
