// What the live status view says, as lines of text; knows nothing of terminals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/face/directory.hpp"
#include "runtime/face/observed_slots.hpp"
#include "runtime/face/statistics.hpp"

namespace flexrf {

struct StatusLine {
  enum class Style : std::uint8_t { plain, title, alarm, faint };
  Style style = Style::plain;
  std::string text;
};

/// One thread, which is not real-time. Allocates.
class StatusContent {
 public:
  explicit StatusContent(const Cell& cell)
      : cell_(&cell),
        directory_(cell),
        slots_(cell),
        statistics_(cell),
        faults_(cell),
        cycles_(directory_.threads().size()) {}

  /// At most `rows` lines. What does not fit is left out from the least important on: feedback, then units,
  /// then threads; faults stay.
  std::vector<StatusLine> lines(Time now, std::size_t rows);

 private:
  struct Section {
    std::vector<StatusLine> lines;
    std::string what;  // is left out: "3 more units"
  };

  StatusLine heading(Time now) const;
  std::vector<StatusLine> faults() const;
  Section threads(Time now);
  Section units() const;
  Section feedback();
  StatusLine operation() const;

  const Cell* cell_;
  Directory directory_;
  ObservedSlots slots_;
  Statistics statistics_;
  FaultPlaces faults_;
  Time begun_{};                       // when the mode was first seen to be running
  Time last_{};                        // of the call before
  std::vector<std::uint64_t> cycles_;  // of each thread, at the call before
};

}  // namespace flexrf
