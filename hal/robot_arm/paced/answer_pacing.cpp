#include "hal/robot_arm/paced/answer_pacing.hpp"

namespace flexrf {
namespace {

// So far behind, an answer may still be one of ours that was long on its way.
constexpr std::uint32_t longest_way = 256;

}  // namespace

void AnswerPacing::begin(const PacingLimits& limits) noexcept {
  *this = AnswerPacing{};
  limits_ = limits;
  number_ = limits.first_number;
}

bool AnswerPacing::is_free(Time now) noexcept {
  if (!waits_) return true;
  if (now - sent_at_ < (heard_ ? limits_.answer : limits_.search)) return false;
  waits_ = false;
  given_up_ = true;
  // What is said to nobody is not lost.
  if (heard_) ++counters_.lost;
  return true;
}

std::uint32_t AnswerPacing::number_next() noexcept {
  if (++number_ == 0) number_ = 1;
  return number_;
}

void AnswerPacing::sent(Time now) noexcept {
  ++counters_.sent;
  sent_at_ = now;
  waits_ = true;
  given_up_ = false;
}

AnswerPacing::Answer AnswerPacing::judge(std::uint32_t number, Time now) noexcept {
  const std::uint32_t behind = number_ - number;
  if (number == 0 ? numbers_ : behind >= longest_way) {
    ++counters_.foreign;
    return Answer::foreign;
  }
  numbers_ = number != 0;
  heard_ = true;
  heard_at_ = now;
  if (waits_ && (number == 0 || behind == 0)) {
    waits_ = false;
    ++counters_.answered;
    return Answer::in_time;
  }
  ++counters_.late;
  return Answer::late;
}

bool AnswerPacing::has_fallen_silent(Time now) noexcept {
  if (!heard_ || now - heard_at_ <= limits_.silence) return false;
  heard_ = numbers_ = false;
  return true;
}

}  // namespace flexrf
