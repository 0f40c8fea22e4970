#include "units/source/source.hpp"

#include <algorithm>

namespace flexrf::user {

void Source::step(const Tick& tick) {
  Everything all;
  all.number = static_cast<std::int32_t>(tick.number);
  all.matrix_map()(2, 1) = configuration.vector_map()[1];
  all.row_map()[3] = runtime.gain;
  all.set_name("longer than it may be");
  all.colour = configuration.first;
  sample.publish(all);
  if (auto loan = picture.loan()) {
    loan->width = 4;
    std::ranges::fill(loan->data(), static_cast<std::uint8_t>(tick.number));
    loan.publish();
  }
  if (auto loan = usual_picture.loan()) {
    std::ranges::fill(loan->data(), static_cast<std::uint8_t>(tick.number));
    loan.publish();
  }
  if (auto loan = thumbnail.loan()) {
    *loan = {};
    loan->width = 16;
    loan->height = 12;
    loan->data.fill(static_cast<std::uint8_t>(tick.number));
    loan.publish();
  }
  for (std::uint32_t job = 0; job < 2; ++job) {  // one for each worker that is active
    jobs.push({static_cast<double>(job), static_cast<std::uint32_t>(tick.number)});
  }
  feedback.presses += runtime.go;
}

}  // namespace flexrf::user
