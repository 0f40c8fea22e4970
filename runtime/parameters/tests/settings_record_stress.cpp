// A settings record that is read while it is published: what is read was published as one.
#include <algorithm>
#include <atomic>
#include <thread>

#include "runtime/parameters/settings_record.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr std::size_t struct_size = 93;  // no whole number of words
constexpr int publications = 200'000;

struct Run {
  SettingsRecord record;
  std::atomic<bool> ends{false};
  std::atomic<int> torn{0};
  std::atomic<int> seen{0};
};

bool is_one(const std::vector<std::byte>& values, const SetMarks& marks) {
  const auto first = std::to_integer<std::uint8_t>(values.front());
  const bool same =
      std::all_of(values.begin(), values.end(), [&](std::byte b) { return b == values.front(); });
  const auto flags = marks.flags();
  return same &&
         std::all_of(flags.begin(), flags.end(), [&](std::uint8_t flag) { return flag == first % 2; });
}

void read(Run& run) {
  std::vector<std::byte> values;
  SetMarks marks;
  while (!run.ends.load()) {
    run.record.read(values, marks);
    if (!is_one(values, marks)) ++run.torn;
    ++run.seen;
  }
}

void what_is_read_was_published_as_one(void**) {
  static Run run;
  run.record.reserve(struct_size);
  std::thread readers[2];
  for (std::thread& reader : readers) reader = std::thread([] { read(run); });
  static std::vector<std::byte> values(struct_size);
  static SetMarks marks(struct_size);
  for (int i = 0; i < publications || run.seen.load() < 100; ++i) {
    std::fill(values.begin(), values.end(), static_cast<std::byte>(i));
    std::fill(marks.flags().begin(), marks.flags().end(), static_cast<std::uint8_t>(i % 2));
    run.record.publish(values.data(), marks);
  }
  run.ends = true;
  for (std::thread& reader : readers) reader.join();
  assert_int_equal(run.torn.load(), 0);
}

}  // namespace
}  // namespace flexrf

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(flexrf::what_is_read_was_published_as_one)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
