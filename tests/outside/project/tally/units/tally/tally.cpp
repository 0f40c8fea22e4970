#include "units/tally/tally.hpp"

void Tally::step(const flexrf::Tick& /*tick*/) {
  while (keys.pop()) ++presses_;
  count.publish({presses_});
}
