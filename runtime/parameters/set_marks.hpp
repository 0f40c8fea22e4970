// Which values of a component somebody has set: those are kept in the configuration file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace flexrf {

/// A flag for each byte of a struct of parameters: set by a person, a script or a unit, also where that is
/// the value of the tables. What is not marked follows the tables. One thread at a time; only the constructor
/// allocates. Offsets and sizes are bytes within the struct.
class SetMarks {
 public:
  SetMarks() = default;
  explicit SetMarks(std::size_t size) : flags_(size) {}

  std::size_t size() const noexcept { return flags_.size(); }
  /// True when something was not marked before.
  bool mark(std::size_t offset, std::size_t size) noexcept { return fill(offset, size, 1); }
  /// True when something was marked before.
  bool clear(std::size_t offset, std::size_t size) noexcept { return fill(offset, size, 0); }
  /// Whether anything in there is marked.
  bool any(std::size_t offset, std::size_t size) const noexcept {
    const auto begin = flags_.begin() + static_cast<std::ptrdiff_t>(offset);
    return std::find(begin, begin + static_cast<std::ptrdiff_t>(size), 1) !=
           begin + static_cast<std::ptrdiff_t>(size);
  }
  std::span<std::uint8_t> flags() noexcept { return flags_; }
  std::span<const std::uint8_t> flags() const noexcept { return flags_; }

 private:
  bool fill(std::size_t offset, std::size_t size, std::uint8_t flag) noexcept {
    const auto begin = flags_.begin() + static_cast<std::ptrdiff_t>(offset);
    const auto end = begin + static_cast<std::ptrdiff_t>(size);
    const bool changes = std::find(begin, end, 1 - flag) != end;
    std::fill(begin, end, flag);
    return changes;
  }

  std::vector<std::uint8_t> flags_;
};

}  // namespace flexrf
