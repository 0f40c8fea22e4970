// Live status view: a few lines at the bottom of the terminal, redrawn in place, the log scrolling above.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/executive/output_thread.hpp"
#include "runtime/run/status_content.hpp"

namespace flexrf {

/// All functions: one thread (not real-time), for which nothing waits. While the terminal does not take more,
/// frames are left out; one that does not let itself be opened anew is waited for.
class StatusView final : public TerminalView {
 public:
  /// `descriptor`: a terminal. While the view lives, the log is to be drained to nowhere (drain_log(-1))
  /// where it would go to a terminal too: the view shows it.
  explicit StatusView(Cell& cell, int descriptor = STDOUT_FILENO);
  ~StatusView() override { finish(); }
  StatusView(const StatusView&) = delete;
  StatusView& operator=(const StatusView&) = delete;

  /// A terminal that understands control sequences (TERM is neither empty nor `dumb`).
  static bool is_possible(int descriptor = STDOUT_FILENO) noexcept;
  /// On standard output; null when that is no such terminal.
  static std::unique_ptr<TerminalView> make(Cell& cell);

  /// Draws when 200 ms have passed since the last frame, else does nothing.
  void draw(Time now) override;
  /// Shows the rest of the log, takes the view away, leaves the terminal as it was. No draw() after it.
  void finish();

 private:
  struct Size {
    std::size_t rows;
    std::size_t columns;
    bool operator==(const Size&) const = default;
  };

  Size size() const noexcept;
  /// To the first line of the frame before.
  void rewind(std::string& frame) const;
  void add_log(std::string& frame);
  bool flush();

  StatusContent content_;
  int descriptor_;  // of our own, so that writing without waiting is not everybody's
  bool owns_descriptor_ = false;
  std::string pending_;  // what the terminal did not take yet
  Time drawn_at_{};
  Size drawn_size_{0, 0};
  std::size_t drawn_rows_ = 0;
  std::uint64_t logged_ = 0;  // number of the last line of the log that was shown
  bool finished_ = false;
};

}  // namespace flexrf
