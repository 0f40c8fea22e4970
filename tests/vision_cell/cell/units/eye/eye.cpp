#include "units/eye/eye.hpp"

#include <algorithm>
#include <cstring>

#include "units/vision/tests/drawn_table.hpp"

namespace flexrf::user {
namespace {

const Pose tool = tool_above(0.45, 0, 0.45);
constexpr Duration exposure_to_delivery = std::chrono::milliseconds(33);

}  // namespace

Status Eye::initialise() {
  DrawnTable table(tool);
  for (const LaidPart& part : laid_parts) table.put(known_parts()[part.kind], part.pose);
  table.put(rectangle_of_tests(0.04, 0.03, 0.06, {70, 70, 75}), {{0.56, -0.07}, 0.4});
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    table.picture(5, static_cast<std::uint32_t>(i + 1));
    pictures_[i].assign(table.bytes().begin(), table.bytes().end());
  }
  return {};
}

void Eye::step(const Tick& tick) {
  tool_pose.publish(tool);
  TargetInHand hand{};
  hand.track = runtime.track;
  in_hand.publish(hand);
  if (tick.number % 3 != 0) return;
  auto loan = frames.loan();
  if (!loan) return;
  const Time taken = tick.now - exposure_to_delivery;
  loan->width = 640;
  loan->height = 480;
  loan->stride = 1920;
  loan->size = 1920 * 480;
  loan->format = PixelFormat::rgb24;
  loan->time = nanoseconds(taken);
  loan->sequence = ++count_;
  if (runtime.covered)
    std::fill_n(loan->data().begin(), loan->size, std::uint8_t{2});
  else
    std::memcpy(loan->data().data(), pictures_[count_ % pictures_.size()].data(), loan->size);
  loan.publish(taken);
  ++feedback.pictures;
}

}  // namespace flexrf::user
