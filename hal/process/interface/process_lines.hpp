#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/time.hpp"
#include "hal/process/interface/process.hpp"

namespace flexrf {

/// Lines made of the bytes that a program prints, bounded in number and length [process-lines-2]. One thread.
class ProcessLines {
 public:
  /// Forgets all, the counters too.
  void restart() noexcept;
  void begin_run(std::uint64_t run) noexcept { run_ = run; }

  void put(ProcessSource source, std::string_view bytes, Time now) noexcept;
  /// What was printed without an end of line is a line once no more can come [process-lines-1].
  void finish(Time now) noexcept;
  bool take(ProcessLine& line) noexcept;

  std::uint64_t lines() const noexcept { return count_; }
  std::uint64_t dropped() const noexcept { return dropped_; }
  std::uint64_t cut() const noexcept { return cut_; }

 private:
  struct Part {
    std::array<char, sizeof(ProcessLine::content)> text{};
    std::size_t size = 0;
    bool begun = false;
    bool cut = false;
  };

  void append(Part& part, std::string_view bytes) noexcept;
  void end_line(ProcessSource source, Time now) noexcept;

  std::array<Part, 2> parts_{};  // by source
  std::array<ProcessLine, Process::line_capacity> ring_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint64_t run_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t cut_ = 0;
};

}  // namespace flexrf
