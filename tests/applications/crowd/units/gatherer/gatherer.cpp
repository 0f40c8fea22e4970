#include "units/gatherer/gatherer.hpp"

namespace flexrf::user {
namespace {

bool is_whole(const Mark& mark) {
  return mark.check == mark.number + mark.gain + mark.stride;
}

}  // namespace

void Gatherer::step(const Tick& /*tick*/) {
  ++feedback.looks;
  feedback.seen = 0;
  feedback.retired = 0;
  std::size_t member = 0;
  for (auto& one : marks) {
    const auto mark = one.latest();
    feedback.gains[member++] = mark ? mark->gain : 0;
    if (mark) {
      ++feedback.seen;
      if (!is_whole(*mark)) ++feedback.torn;
    } else if (mark.reason() == NullReason::writer_retired) {
      ++feedback.retired;
    } else if (mark.reason() != NullReason::nothing_yet && mark.reason() != NullReason::writer_stopped) {
      ++feedback.unexplained;
    }
  }
  member = 0;
  for (auto& one : relayed) {
    const auto mark = one.latest();
    feedback.relayed_gains[member++] = mark ? mark->gain : 0;
    if (mark && !is_whole(*mark)) ++feedback.torn;
  }
}

}  // namespace flexrf::user
