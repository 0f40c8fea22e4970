// A set of CPUs, as the kernel writes it: "0-2,5".
#pragma once

#include <sched.h>

#include <cstddef>
#include <string_view>

#include "base/status.hpp"

namespace flexrf {

/// CPUs 0 to 1023. Any thread.
class CpuSet {
 public:
  CpuSet() noexcept { CPU_ZERO(&mask_); }
  explicit CpuSet(const cpu_set_t& mask) noexcept : mask_(mask) {}
  static CpuSet of(int cpu) noexcept {
    CpuSet set;
    set.add(cpu);
    return set;
  }
  /// Those that this process may run on: its main thread's.
  static CpuSet allowed() noexcept;
  /// Reads "0-2,5"; an empty text is the empty set.
  static Result<CpuSet> parse(std::string_view text) noexcept;

  void add(int cpu) noexcept { CPU_SET(static_cast<std::size_t>(cpu), &mask_); }
  bool contains(int cpu) const noexcept {
    return cpu >= 0 && cpu < CPU_SETSIZE && CPU_ISSET(static_cast<std::size_t>(cpu), &mask_);
  }
  bool is_empty() const noexcept { return count() == 0; }
  int count() const noexcept { return CPU_COUNT(&mask_); }
  /// −1 in an empty set.
  int lowest() const noexcept;
  int highest() const noexcept;
  CpuSet united_with(const CpuSet& other) const noexcept;
  CpuSet without(const CpuSet& other) const noexcept;
  CpuSet common_with(const CpuSet& other) const noexcept;
  bool operator==(const CpuSet& other) const noexcept { return CPU_EQUAL(&mask_, &other.mask_) != 0; }

  const cpu_set_t& mask() const noexcept { return mask_; }
  /// As "0-2,5" into `text`, cut at capacity. @returns text.
  const char* write(char* text, std::size_t capacity) const noexcept;

 private:
  cpu_set_t mask_;
};

/// A set's text for a message: `CpuText(set).text`.
struct CpuText {
  explicit CpuText(const CpuSet& set) noexcept { set.write(text, sizeof(text)); }
  char text[128];
};

}  // namespace flexrf
