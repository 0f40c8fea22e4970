// AnswerPacing: for a controller that answers each packet once, and paces us by its answers. It says when the
// next packet goes out, and what an answer is worth. Without I/O.
#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

struct PacingLimits {
  Duration answer{};               ///< a packet unanswered for so long is lost, and the next goes out
  Duration silence{};              ///< without any answer for so long, the controller is no longer there
  Duration search{};               ///< from packet to packet while it is not there
  std::uint32_t first_number = 0;  ///< the first packet has the next one
};

/// Since begin().
struct PacingCounters {
  std::uint64_t sent = 0;
  std::uint64_t answered = 0;  ///< in time
  std::uint64_t lost = 0;      ///< packets without an answer in time
  std::uint64_t late = 0;      ///< answers after their packet was given up, or told twice
  std::uint64_t foreign = 0;   ///< what is no answer to us
};

/// One thread; never blocks, never allocates.
class AnswerPacing {
 public:
  enum class Answer : std::uint8_t { in_time, late, foreign };

  void begin(const PacingLimits& limits) noexcept;

  /// The next packet may go out: the one before is answered, or given up. Once for each packet.
  bool is_free(Time now) noexcept;
  /// The packet before was given up: nobody knows whether the controller has it.
  bool has_given_up() const noexcept { return given_up_; }
  /// Of the packet that goes out now; never 0.
  std::uint32_t number_next() noexcept;
  void sent(Time now) noexcept;

  /// `number` as the answer says; 0: it says none, and is taken as the answer to the last packet, unless the
  /// controller has numbered its answers since it was heard. A number that is none of the last packets', as
  /// one of a session before, is foreign.
  Answer judge(std::uint32_t number, Time now) noexcept;
  void count_foreign(std::uint64_t datagrams = 1) noexcept { counters_.foreign += datagrams; }

  /// Looks at the clock, after all answers were judged. True: it is not heard any more, and was.
  bool has_fallen_silent(Time now) noexcept;
  bool is_heard() const noexcept { return heard_; }
  /// A packet is on its way, and its answer may come.
  bool is_waiting() const noexcept { return waits_; }
  const PacingCounters& counters() const noexcept { return counters_; }

 private:
  PacingLimits limits_;
  PacingCounters counters_;
  std::uint32_t number_ = 0;
  bool waits_ = false;
  bool given_up_ = false;
  bool heard_ = false;
  bool numbers_ = false;  // its answers, since it is heard
  Time sent_at_{};
  Time heard_at_{};
};

}  // namespace flexrf
