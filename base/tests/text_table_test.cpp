#include "base/text_table.hpp"

#include <cstring>

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

void expect(std::string text, const char* expected) {
  static char copy[1024];
  copy[text.copy(copy, sizeof(copy) - 1)] = '\0';
  text = {};
  text.shrink_to_fit();
  assert_string_equal(copy, expected);
}

void durations_have_three_digits_and_their_unit(void**) {
  expect(duration_text(Duration{0}), "0 ns");
  expect(duration_text(Duration{7}), "7 ns");
  expect(duration_text(Duration{999}), "999 ns");
  expect(duration_text(Duration{1000}), "1.00 us");
  expect(duration_text(Duration{12'345}), "12.3 us");
  expect(duration_text(Duration{123'456}), "123 us");
  expect(duration_text(Duration{999'600}), "1.00 ms");
  expect(duration_text(Duration{-1'500'000}), "-1.50 ms");
  expect(duration_text(std::chrono::seconds{45}), "45.0 s");
  expect(duration_text(std::chrono::seconds{90}), "1.50 min");
  expect(duration_text(std::chrono::hours{100}), "100 h");
}

void sizes_too(void**) {
  expect(size_text(0), "0 B");
  expect(size_text(1023), "1023 B");
  expect(size_text(1536), "1.50 KiB");
  expect(size_text(8U * 1024 * 1024), "8.00 MiB");
  expect(size_text(std::uint64_t{5} << 40), "5120 GiB");
}

void columns_are_as_wide_as_their_widest_cell(void**) {
  const auto text = [] {
    TextTable table({"thread", "cycles", "<why"});
    table.add({"control", "7", "it is late"});
    table.add({"io", "12345", "ok"});
    return table.text("  ");
  };
  expect(text(), "  thread   cycles  why\n  control       7  it is late\n  io        12345  ok\n");
}

void columns_without_text_take_no_room(void**) {
  const auto text = [] {
    TextTable table({"a", "", "b"});
    table.add({"1", "", "2"});
    return table.text("");
  };
  expect(text(), "a  b\n1  2\n");
}

void widths_are_of_characters(void**) {
  assert_int_equal(text_width("\xC2\xB5m"), 2);
  const auto text = [] {
    TextTable table({"<unit", "n"});
    table.add({"\xC2\xB5m", "1"});
    table.add({"abcde", "2"});
    return table.text("");
  };
  expect(text(), "unit   n\n\xC2\xB5m     1\nabcde  2\n");
}

void long_text_is_cut_between_characters(void**) {
  expect(cut_text("short", 5), "short");
  expect(cut_text("a longer one", 8), "a lon...");
  expect(cut_text("\xC2\xB5\xC2\xB5\xC2\xB5\xC2\xB5\xC2\xB5", 4), "\xC2\xB5...");
  expect(cut_text("abcdef", 2), "..");
  expect(cut_text("abcdef", 0), "");
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(durations_have_three_digits_and_their_unit),
      cmocka_unit_test(sizes_too),
      cmocka_unit_test(columns_are_as_wide_as_their_widest_cell),
      cmocka_unit_test(columns_without_text_take_no_room),
      cmocka_unit_test(widths_are_of_characters),
      cmocka_unit_test(long_text_is_cut_between_characters),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
