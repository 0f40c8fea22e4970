// What a power cut leaves, against rules that know nothing of how it is computed: for each 512 bytes of the
// disk, what may stand there.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "image/power_cut/disk_image.hpp"
#include "image/power_cut/power_cut.hpp"
#include "image/power_cut/tests/hand_made_log.hpp"

namespace flexrf::power_cut {
namespace {

constexpr std::uint64_t disk_size = 64 * 1024;
constexpr std::size_t pieces_of_disk = disk_size / 512;

struct Event {
  std::uint64_t sector;
  std::uint64_t sectors;
  std::uint64_t flags;
};

struct Recording {
  std::uint64_t sector_size = 512;
  std::vector<Event> events;

  std::string bytes() const {
    HandMadeLog log;
    log.sector_size = sector_size;
    for (const Event& event : events) log.add(event.sector, event.sectors, event.flags);
    return log.bytes();
  }
  std::size_t first_piece(std::size_t event) const { return events[event].sector * sector_size / 512; }
  std::size_t pieces(std::size_t event) const { return events[event].sectors * sector_size / 512; }
  bool writes(std::size_t event, std::size_t piece) const {
    return piece >= first_piece(event) && piece < first_piece(event) + pieces(event);
  }
};

std::string base_piece(std::size_t piece) {
  std::string bytes = "base " + std::to_string(piece);
  bytes.resize(512, ' ');
  return bytes;
}

std::string base_image() {
  std::string image;
  for (std::size_t piece = 0; piece < pieces_of_disk; ++piece) image += base_piece(piece);
  return image;
}

// After that many entries, and the one that is on its way: what may stand in one piece. By the words of the
// documentation: a flush makes durable what stands before it, FUA itself, and all else may be there or not.
std::set<std::string> allowed(const Recording& recording, std::size_t point, std::size_t piece) {
  std::set<std::string> texts = {base_piece(piece)};
  for (std::size_t i = 0; i <= point && i < recording.events.size(); ++i) {
    const Event& event = recording.events[i];
    if (i < point && (event.flags & flush_flag) != 0) {
      // The newest write before is certain, and none from before it is possible any longer.
      std::string newest = base_piece(piece);
      for (std::size_t k = 0; k < i; ++k)
        if (recording.writes(k, piece)) newest = marked_bytes(k, piece - recording.first_piece(k));
      texts = {newest};
    }
    if (!recording.writes(i, piece)) continue;
    const std::string text = marked_bytes(i, piece - recording.first_piece(i));
    if (i < point && (event.flags & fua_flag) != 0)
      texts = {text};
    else
      texts.insert(text);
  }
  return texts;
}

class Bench {
 public:
  explicit Bench(const Recording& recording)
      : base_(write_file(folder_ / "base", base_image())),
        log_file_(write_file(folder_ / "log", recording.bytes())) {
    const Result<WriteLog> log = read_log(log_file_.descriptor(), disk_size);
    CHECK(log);
    log_ = *log;
  }
  const WriteLog& log() const { return log_; }

  std::string disk_after(const Remains& remains) const {
    const std::string path = folder_ / "disk";
    CHECK(make_image(path, base_, log_file_, remains));
    std::string disk = bytes_of(path);
    std::filesystem::remove(path);
    CHECK_EQUAL(disk.size(), disk_size);
    return disk;
  }

 private:
  Folder folder_;
  OpenFile base_;
  OpenFile log_file_;
  WriteLog log_;
};

void expect_allowed(const Recording& recording, const Bench& bench, std::size_t point, std::uint64_t seed) {
  const std::string disk = bench.disk_after(remains_after(bench.log(), point, seed));
  for (std::size_t piece = 0; piece < pieces_of_disk; ++piece) {
    const std::string found = disk.substr(piece * 512, 512);
    if (allowed(recording, point, piece).count(found) == 0)
      throw fixture::CheckFailed{"point " + std::to_string(point) + ", seed " + std::to_string(seed) +
                                 ", piece " + std::to_string(piece) + ": " +
                                 found.substr(0, found.find('.'))};
  }
}

Recording random_recording(std::mt19937& random) {
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random()) % limit; };
  Recording recording;
  recording.sector_size = below(2) == 0 ? 512 : 4096;
  const std::size_t sectors_of_disk = disk_size / recording.sector_size;
  for (std::size_t i = 0; i < 24; ++i) {
    if (below(5) == 0) {
      recording.events.push_back({0, 0, flush_flag});
      continue;
    }
    const std::size_t sectors = 1 + below(4);
    // Close together, so that many are written over.
    const std::size_t sector = below(std::min<std::size_t>(sectors_of_disk, 12) - sectors + 1);
    const std::uint64_t flags[] = {0, 0, 0, 0, fua_flag, flush_flag, flush_flag | fua_flag};
    recording.events.push_back({sector, sectors, flags[below(std::size(flags))]});
  }
  return recording;
}

void nothing_is_lost_that_was_flushed_and_nothing_comes_from_nowhere() {
  std::mt19937 random(6);
  for (int round = 0; round < 12; ++round) {
    const Recording recording = random_recording(random);
    const Bench bench(recording);
    for (std::size_t point = 0; point <= recording.events.size(); ++point)
      for (std::uint64_t seed = 0; seed < 6; ++seed) expect_allowed(recording, bench, point, seed);
  }
}

// Rules that allow all would find nothing: here the flush is left out of what they know.
void the_rules_find_a_flush_that_is_not_kept() {
  const Recording recording{512, {{0, 1, 0}, {0, 0, flush_flag}, {1, 1, 0}, {2, 1, 0}}};
  Recording without_flush = recording;
  without_flush.events[1] = {9, 1, 0};
  const Bench bench(without_flush);
  bool is_found = false;
  for (std::uint64_t seed = 0; seed < 64 && !is_found; ++seed) {
    try {
      expect_allowed(recording, bench, 3, seed);
    } catch (const fixture::CheckFailed&) {
      is_found = true;
    }
  }
  CHECK(is_found);
}

// Three writes that no flush follows: over the seeds each combination occurs, with all of the last one or
// only a part of it.
void every_part_of_what_is_possible_occurs() {
  const Recording recording{512, {{0, 1, 0}, {0, 0, flush_flag}, {1, 1, 0}, {2, 1, 0}, {3, 4, 0}}};
  const Bench bench(recording);
  std::set<std::string> combinations;
  std::set<std::string> tears;
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    const std::string disk = bench.disk_after(remains_after(bench.log(), 4, seed));
    CHECK_EQUAL(disk.substr(0, 512), marked_bytes(0, 0));
    std::string tear;
    for (std::size_t piece = 3; piece < 7; ++piece)
      tear += disk.substr(piece * 512, 5) == "entry" ? '1' : '0';
    const std::string one = disk.substr(512, 5) == "entry" ? "1" : "0";
    const std::string two = disk.substr(1024, 5) == "entry" ? "1" : "0";
    combinations.insert(one + two + (tear == "0000" ? '0' : '1'));
    tears.insert(tear);
  }
  CHECK_EQUAL(combinations.size(), 8u);
  CHECK_EQUAL(tears.size(), 16u);
}

// An entry but the last one that is there is there as a whole.
void only_the_last_one_is_torn() {
  const Recording recording{512, {{0, 4, 0}, {4, 4, 0}, {8, 4, 0}, {12, 4, 0}}};
  const Bench bench(recording);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::string disk = bench.disk_after(remains_after(bench.log(), 4, seed));
    bool is_last = true;
    for (std::size_t entry = 4; entry > 0; --entry) {
      std::size_t there = 0;
      for (std::size_t piece = (entry - 1) * 4; piece < entry * 4; ++piece)
        if (disk.substr(piece * 512, 5) == "entry") ++there;
      if (there > 0 && there < 4) CHECK(is_last);
      if (there > 0) is_last = false;
    }
  }
}

void a_seed_gives_the_same_disk_again() {
  std::mt19937 random(7);
  const Recording recording = random_recording(random);
  const Bench bench(recording);
  std::set<std::string> disks;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Remains once = remains_after(bench.log(), 20, seed);
    CHECK(bench.disk_after(once) == bench.disk_after(remains_after(bench.log(), 20, seed)));
    disks.insert(bench.disk_after(once));
  }
  CHECK(disks.size() > 1);
}

void without_entries_the_disk_is_the_base() {
  const Bench bench(Recording{});
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    CHECK(bench.disk_after(remains_after(bench.log(), 0, seed)) == base_image());
  CHECK(chosen_points(bench.log(), 10, 1) == std::vector<std::size_t>{0});
}

void points_are_different_and_ascend() {
  WriteLog log;
  log.sector_size = 512;
  log.entries.resize(1000);
  for (const std::size_t count : {std::size_t{2}, std::size_t{300}, std::size_t{1001}}) {
    const std::vector<std::size_t> points = chosen_points(log, count, 5);
    CHECK_EQUAL(points.size(), count);
    CHECK(std::is_sorted(points.begin(), points.end()));
    CHECK(std::adjacent_find(points.begin(), points.end()) == points.end());
    CHECK_EQUAL(points.front(), 0u);
    CHECK_EQUAL(points.back(), 1000u);
  }
  CHECK(chosen_points(log, 300, 5) == chosen_points(log, 300, 5));
  CHECK(chosen_points(log, 300, 5) != chosen_points(log, 300, 6));
  CHECK_EQUAL(chosen_points(log, 5000, 5).size(), 1001u);
  CHECK(chosen_points(log, 0, 5).empty());
  CHECK_EQUAL(chosen_points(log, 1, 5).size(), 1u);
}

}  // namespace
}  // namespace flexrf::power_cut

int main() {
  using namespace flexrf::power_cut;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(nothing_is_lost_that_was_flushed_and_nothing_comes_from_nowhere),
      CONTAINED_TEST(the_rules_find_a_flush_that_is_not_kept),
      CONTAINED_TEST(every_part_of_what_is_possible_occurs),
      CONTAINED_TEST(only_the_last_one_is_torn),
      CONTAINED_TEST(a_seed_gives_the_same_disk_again),
      CONTAINED_TEST(without_entries_the_disk_is_the_base),
      CONTAINED_TEST(points_are_different_and_ascend),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
