#include "image/power_cut/power_cut.hpp"

#include <algorithm>
#include <random>
#include <utility>

namespace flexrf::power_cut {
namespace {

// The library's distributions differ from one to the next, and a seed in a report has to give the same disk
// everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed, std::uint64_t point = 0)
      : engine_(seed * 0x9E3779B97F4A7C15u + point * 0xBF58476D1CE4E5B9u) {}

  std::uint64_t below(std::uint64_t limit) { return engine_() % limit; }
  bool flip() { return below(2) == 0; }

 private:
  std::mt19937_64 engine_;
};

Piece piece_of(const LogEntry& entry) noexcept {
  return {entry.disk_offset, entry.size, entry.log_offset};
}

struct Division {
  std::vector<bool> is_durable;       // by entry
  std::vector<std::size_t> possible;  // entries, ascending
};

Division divide(const WriteLog& log, std::size_t point) {
  Division division;
  division.is_durable.resize(log.entries.size());
  for (std::size_t i = 0; i < point; ++i) {
    const LogEntry& entry = log.entries[i];
    if (entry.is_flush) {
      for (const std::size_t flushed : division.possible) division.is_durable[flushed] = true;
      division.possible.clear();
    }
    if (entry.size == 0) continue;
    if (entry.is_fua)
      division.is_durable[i] = true;
    else
      division.possible.push_back(i);
  }
  if (point < log.entries.size() && log.entries[point].size > 0) division.possible.push_back(point);
  return division;
}

std::vector<std::size_t> kept_of(const std::vector<std::size_t>& possible, Dice& dice) {
  const std::uint64_t way = dice.below(8);
  if (way == 0) return {};
  std::vector<std::size_t> kept;
  for (const std::size_t entry : possible)
    if (way == 1 || dice.flip()) kept.push_back(entry);
  return kept;
}

void tear(const LogEntry& entry, Dice& dice, Remains& remains) {
  const std::uint64_t count = entry.size / tear_size;
  const std::uint64_t way = dice.below(4);
  const std::uint64_t border = dice.below(count + 1);
  remains.torn_of = entry.size;
  for (std::uint64_t i = 0; i < count; ++i) {
    const bool is_there = way == 0 ? i < border : way == 1 ? i >= border : dice.flip();
    if (!is_there) continue;
    remains.pieces.push_back(
        {entry.disk_offset + i * tear_size, tear_size, entry.log_offset + i * tear_size});
    remains.torn += tear_size;
  }
}

}  // namespace

Remains remains_after(const WriteLog& log, std::size_t point, std::uint64_t seed) {
  Dice dice(seed, point);
  const Division division = divide(log, point);
  const std::vector<std::size_t> kept = kept_of(division.possible, dice);
  Remains remains;
  remains.possible = division.possible.size();
  remains.kept = kept.size();
  auto next = kept.begin();
  for (std::size_t i = 0; i < log.entries.size(); ++i) {
    if (division.is_durable[i]) {
      remains.pieces.push_back(piece_of(log.entries[i]));
      ++remains.durable;
    } else if (next != kept.end() && *next == i) {
      ++next;
      if (next == kept.end())
        tear(log.entries[i], dice, remains);
      else
        remains.pieces.push_back(piece_of(log.entries[i]));
    }
  }
  return remains;
}

std::vector<std::size_t> chosen_points(const WriteLog& log, std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> points(log.entries.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = i;
  if (count >= points.size()) return points;
  if (count < 2) {
    points.resize(count);
    return points;
  }
  // The last one behind the first, then a draw for each of the others: a shuffle of what is left, ended
  // early.
  std::swap(points[1], points.back());
  Dice dice(seed);
  for (std::size_t i = 2; i < count; ++i)
    std::swap(points[i], points[i + static_cast<std::size_t>(dice.below(points.size() - i))]);
  points.resize(count);
  std::sort(points.begin(), points.end());
  return points;
}

}  // namespace flexrf::power_cut
