// Of a list of known names, the one that a misspelt word most likely meant.
#pragma once

#include <cstddef>
#include <string_view>

namespace flexrf {

/// Edits (insert, delete, replace, swap of neighbours: Damerau 1964, optimal string alignment) that turn one
/// word into the other. Words longer than 63 bytes count as unlike any other.
std::size_t edit_distance(std::string_view from, std::string_view to) noexcept;

/// Offer all known names, then ask. Allocates nothing; the names must outlive it.
class NearestName {
 public:
  explicit NearestName(std::string_view word) noexcept;
  void offer(std::string_view known) noexcept;
  /// Empty when no name is near enough to have been meant.
  std::string_view best() const noexcept { return best_; }

 private:
  std::string_view word_;
  std::string_view best_;
  std::size_t limit_;
};

}  // namespace flexrf
