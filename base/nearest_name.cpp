#include "base/nearest_name.hpp"

#include <algorithm>
#include <array>

namespace flexrf {
namespace {

constexpr std::size_t longest = 63;

}  // namespace

std::size_t edit_distance(std::string_view from, std::string_view to) noexcept {
  if (from.size() > longest || to.size() > longest) return std::max(from.size(), to.size());
  using Row = std::array<std::size_t, longest + 1>;
  Row before{};
  Row above{};
  Row row{};
  for (std::size_t j = 0; j <= to.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (from[i - 1] == to[j - 1] ? 0U : 1U);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = above;
    above = row;
  }
  return above[to.size()];
}

NearestName::NearestName(std::string_view word) noexcept
    // One slip for every three letters: beyond that it is another word.
    : word_(word), limit_((word.size() + 1) / 3) {}

void NearestName::offer(std::string_view known) noexcept {
  const std::size_t distance = edit_distance(word_, known);
  if (distance > limit_ || (!best_.empty() && distance == limit_)) return;
  if (distance >= std::max(word_.size(), known.size())) return;
  best_ = known;
  limit_ = distance;
}

}  // namespace flexrf
