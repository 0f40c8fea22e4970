#include "units/tuner/tuner.hpp"

#include <limits>

namespace flexrf::user {
namespace {

// Numbers of its runtime parameters, as in its table.
constexpr std::uint16_t gain = 0;
constexpr std::uint16_t learned = 2;

}  // namespace

Status Tuner::initialise() {
  learns_ = false;
  return {};
}

void Tuner::step(const Tick& tick) {
  ParameterAnswer answer;
  while (cell.take_answer(answer)) continue;
  if (const auto key = keys.pop()) {
    obey(static_cast<char>(key->character), tick.now);
    ++feedback.keys_done;
  }
  if (learns_) set_and_keep(learned, runtime.learned + 1, tick.now);
}

/// By a request to itself, which is in force in the next step. What it writes into its values is not kept.
template <class T>
void Tuner::set_and_keep(std::uint16_t parameter, T value, Time now) {
  ParameterRequest request;
  request.component = cell.self();
  request.add(parameter, 0, &value, sizeof(value));
  cell.send(request, now, true);
}

void Tuner::obey(char key, Time now) {
  switch (key) {
    case 'l':  // without an end
      learns_ = true;
      return;
    case 'g':
      set_and_keep(gain, 3.0, now);
      return;
    case 'o':  // by itself
      runtime.gain = 4;
      return;
    case 'd':  // the value that the table has
      set_and_keep(gain, 1.0, now);
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
