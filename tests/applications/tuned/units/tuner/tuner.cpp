#include "units/tuner/tuner.hpp"

#include <limits>

namespace flexrf::user {

Status Tuner::initialise() {
  learns_ = false;
  return {};
}

void Tuner::step(const Tick& /*tick*/) {
  if (const auto key = keys.pop()) {
    obey(static_cast<char>(key->character));
    ++feedback.keys_done;
  }
  if (learns_) ++runtime.learned;
}

void Tuner::obey(char key) {
  switch (key) {
    case 'l':  // without an end
      learns_ = true;
      return;
    case 'g':
      runtime.gain = 3;
      return;
    case 'd':  // the value that the table has
      runtime.gain = 1;
      return;
    case 't':
      ++runtime.tries;
      return;
    case 'n':
      runtime.gain = std::numeric_limits<double>::quiet_NaN();
      runtime.offset = 0.5;
      return;
    case 'r':
      runtime.gain = 11;
      return;
    default:
      return;
  }
}

}  // namespace flexrf::user
