#include "base/text_table.hpp"

#include <cstring>

#include "base/tests/expect_text.hpp"

namespace flexrf::text_table_test {
namespace {

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
}  // namespace flexrf::text_table_test

int main() {
  using namespace flexrf::text_table_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(columns_are_as_wide_as_their_widest_cell),
      cmocka_unit_test(columns_without_text_take_no_room),
      cmocka_unit_test(widths_are_of_characters),
      cmocka_unit_test(long_text_is_cut_between_characters),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
