// What the live status view says, as lines of text; knows nothing of terminals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/executive/cell.hpp"

namespace flexrf {

struct StatusLine {
  enum class Style : std::uint8_t { plain, title, alarm, faint };
  Style style = Style::plain;
  std::string text;
};

/// Reads what the threads publish of themselves, and feedback as the observer: the observer's thread only.
/// Allocates.
class StatusContent {
 public:
  explicit StatusContent(Cell& cell);

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
  Section feedback() const;
  StatusLine keys() const;

  Cell* cell_;
  Time begun_{};                       // when the mode was first seen to be running
  Time last_{};                        // of the call before
  std::vector<std::uint64_t> cycles_;  // of each thread, at the call before
};

}  // namespace flexrf
