#include "image/power_cut/write_log.hpp"

#include <unistd.h>

#include <array>
#include <cstdint>
#include <string>

#include "image/power_cut/disk_image.hpp"
#include "image/power_cut/tests/hand_made_log.hpp"

namespace flexrf::power_cut {
namespace {

constexpr std::uint64_t disk_size = 64 * 1024;

Result<WriteLog> read(const std::string& bytes) {
  const Folder folder;
  const OpenFile file(write_file(folder / "log", bytes));
  CHECK(file.status());
  return read_log(file.descriptor(), disk_size);
}

void expect_error(const std::string& bytes, const char* part) {
  const Result<WriteLog> log = read(bytes);
  CHECK(!log);
  CHECK_EQUAL(name_of(log.status().code()), name_of(StatusCode::invalid_argument));
  CHECK_CONTAINS(log.status().cause(), part);
}

HandMadeLog some_log(std::uint64_t sector_size) {
  HandMadeLog log;
  log.sector_size = sector_size;
  log.add(3, 2, 0);
  log.add(0, 0, flush_flag);
  log.add(5, 1, fua_flag);
  log.add(0, 0, mark_flag, "saved");
  log.add(1, 1, flush_flag | fua_flag);
  return log;
}

void entries_are_read_in_sectors_of_any_size() {
  for (const std::uint64_t size : {std::uint64_t{512}, std::uint64_t{4096}}) {
    const Result<WriteLog> log = read(some_log(size).bytes());
    CHECK(log);
    CHECK_EQUAL(log->sector_size, size);
    CHECK_EQUAL(log->entries.size(), 5u);
    const LogEntry expected[] = {{3 * size, 2 * size, 2 * size, false, false},
                                 {0, 0, 5 * size, true, false},
                                 {5 * size, size, 6 * size, false, true},
                                 {0, 0, 0, false, false},
                                 {size, size, 9 * size, true, true}};
    for (std::size_t i = 0; i < std::size(expected); ++i) {
      const LogEntry& entry = log->entries[i];
      CHECK_EQUAL(entry.disk_offset, expected[i].disk_offset);
      CHECK_EQUAL(entry.size, expected[i].size);
      if (entry.size > 0) CHECK_EQUAL(entry.log_offset, expected[i].log_offset);
      CHECK_EQUAL(entry.is_flush, expected[i].is_flush);
      CHECK_EQUAL(entry.is_fua, expected[i].is_fua);
    }
  }
}

void a_log_without_entries_is_one() {
  const Result<WriteLog> log = read(HandMadeLog{}.bytes());
  CHECK(log);
  CHECK(log->entries.empty());
}

// QEMU counts an entry after it has written it: what stands behind the last one that is counted is left out.
void what_is_not_counted_is_left_out() {
  HandMadeLog hand_made = some_log(512);
  hand_made.count = 2;
  const Result<WriteLog> log = read(hand_made.bytes());
  CHECK(log);
  CHECK_EQUAL(log->entries.size(), 2u);
}

void what_is_no_log_is_refused() {
  expect_error("", "ends early");
  expect_error(std::string(4096, '\0'), "does not begin as one");
  HandMadeLog log = some_log(512);
  log.magic ^= 1;
  expect_error(log.bytes(), "does not begin as one");
  log = some_log(512);
  log.version = 2;
  expect_error(log.bytes(), "version 2, and only 1 is known");
  for (const std::uint64_t size : {0, 1, 256, 511, 513, 1 << 24}) {
    std::string bytes = some_log(512).bytes();
    bytes.replace(24, 4, little_endian(size, 4));
    expect_error(bytes, "a power of two from 512");
  }
}

void a_log_that_is_cut_short_is_refused_wherever_it_is_cut() {
  const std::string bytes = some_log(512).bytes();
  for (std::size_t size = 0; size < bytes.size(); size += 64) {
    const Result<WriteLog> log = read(bytes.substr(0, size));
    CHECK(!log);
    CHECK_CONTAINS(log.status().cause(), "ends");
  }
  expect_error(bytes.substr(0, bytes.size() - 1), "ends within entry 4 of 5");
  std::string counted = bytes;
  counted.replace(16, 8, little_endian(~std::uint64_t{0}, 8));
  expect_error(counted, "ends within entry 5 of 18446744073709551615");
}

void an_entry_that_cannot_be_is_refused() {
  struct Case {
    std::uint64_t sector;
    std::uint64_t sectors;
    std::uint64_t flags;
    const char* part;
  };
  const Case cases[] = {{128, 1, 0, "entry 1 of the log writes beyond the end"},
                        {127, 2, 0, "writes beyond the end"},
                        {~std::uint64_t{0}, 1, 0, "writes beyond the end"},
                        {8, 8, discard_flag, "entry 1 of the log is a discard"},
                        {0, 0, 32, "flags that are not known"},
                        {0, 1, mark_flag, "a mark that writes"},
                        {0, 0, 0, "neither writes nor flushes"}};
  for (const Case& each : cases) {
    HandMadeLog log;
    log.add(0, 1, 0);
    log.add(each.sector, each.sectors, each.flags);
    expect_error(log.bytes(), each.part);
  }
  HandMadeLog log;
  log.add(127, 1, 0);
  CHECK(read(log.bytes()));
  // A number of sectors that overflows when it is multiplied.
  std::string bytes = log.bytes();
  bytes.replace(512 + 8, 8, little_endian(std::uint64_t{1} << 55, 8));
  expect_error(bytes, "ends within entry 0");
  log = {};
  log.add(0, 1, 0, "longer than nothing");
  expect_error(log.bytes(), "data of another length");
}

void what_is_no_file_is_refused() {
  const Folder folder;
  CHECK(!OpenFile(folder / "none").status());
  CHECK_CONTAINS(OpenFile(folder / "").status().cause(), "is no file");
  std::array<int, 2> ends{};
  CHECK(pipe(ends.data()) == 0);
  const Result<WriteLog> log = read_log(ends[0], disk_size);
  close(ends[0]);
  close(ends[1]);
  CHECK(!log);
}

}  // namespace
}  // namespace flexrf::power_cut

int main() {
  using namespace flexrf::power_cut;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(entries_are_read_in_sectors_of_any_size),
      CONTAINED_TEST(a_log_without_entries_is_one),
      CONTAINED_TEST(what_is_not_counted_is_left_out),
      CONTAINED_TEST(what_is_no_log_is_refused),
      CONTAINED_TEST(a_log_that_is_cut_short_is_refused_wherever_it_is_cut),
      CONTAINED_TEST(an_entry_that_cannot_be_is_refused),
      CONTAINED_TEST(what_is_no_file_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
