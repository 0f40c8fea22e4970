// The words of values, in each order of bytes, and what does not fit.
#include "hal/modbus/link/interface/register_map.hpp"

#include <cmath>
#include <iterator>
#include <limits>

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

ModbusRegister of(ModbusType type, ModbusWordOrder order = ModbusWordOrder::abcd, double scale = 1) {
  return {"value",
          0,
          ModbusArea::holding_register,
          type,
          order,
          ModbusAccess::read_write,
          ModbusPollGroup::fast,
          scale,
          "",
          3};
}

// [register-map-1]
void words_are_in_each_order(void**) {
  struct Case {
    ModbusWordOrder order;
    std::uint16_t words[2];
  };
  // 0x12345678 has A = 12, B = 34, C = 56, D = 78.
  const Case cases[] = {{ModbusWordOrder::abcd, {0x1234, 0x5678}},
                        {ModbusWordOrder::cdab, {0x5678, 0x1234}},
                        {ModbusWordOrder::badc, {0x3412, 0x7856}},
                        {ModbusWordOrder::dcba, {0x7856, 0x3412}}};
  for (const Case& one : cases) {
    const ModbusRegister meaning = of(ModbusType::u32, one.order);
    std::uint16_t words[2] = {};
    encode_register(meaning, 0x12345678, words);
    assert_int_equal(words[0], one.words[0]);
    assert_int_equal(words[1], one.words[1]);
    assert_true(decode_register(meaning, one.words) == 0x12345678);
  }
}

void floats_are_those_of_ieee_754(void**) {
  const std::uint16_t one_and_a_half[] = {0x3FC0, 0x0000};
  assert_true(decode_register(of(ModbusType::f32), one_and_a_half) == 1.5);
  const std::uint16_t as_double[] = {0x3FF8, 0x0000, 0x0000, 0x0000};
  assert_true(decode_register(of(ModbusType::f64), as_double) == 1.5);
}

// [register-map-2]
void the_four_words_of_a_long_value_too(void**) {
  struct Case {
    ModbusWordOrder order;
    std::uint16_t words[4];
  };
  const Case cases[] = {{ModbusWordOrder::abcd, {0x0012, 0x3456, 0x789A, 0xBC00}},
                        {ModbusWordOrder::cdab, {0xBC00, 0x789A, 0x3456, 0x0012}},
                        {ModbusWordOrder::badc, {0x1200, 0x5634, 0x9A78, 0x00BC}},
                        {ModbusWordOrder::dcba, {0x00BC, 0x9A78, 0x5634, 0x1200}}};
  for (const Case& one : cases) {
    const ModbusRegister meaning = of(ModbusType::u64, one.order);
    std::uint16_t words[4] = {};
    encode_register(meaning, 0x0012'3456'789A'BC00, words);
    assert_memory_equal(words, one.words, sizeof(words));
    assert_true(decode_register(meaning, one.words) == 0x0012'3456'789A'BC00);
  }
}

// [register-map-5]
void a_bit_leaves_the_others_of_its_register(void**) {
  ModbusRegister meaning = of(ModbusType::boolean);
  meaning.bit = 15;
  std::uint16_t word = 0x0101;
  assert_true(decode_register(meaning, &word) == 0);
  encode_register(meaning, 1, &word);
  assert_int_equal(word, 0x8101);
  assert_true(decode_register(meaning, &word) == 1);
  meaning.bit = 0;
  encode_register(meaning, 0, &word);
  assert_int_equal(word, 0x8100);
  assert_true(decode_register(meaning, &word) == 0);
}

void signs_and_scales_are_kept(void**) {
  for (const ModbusType type : {ModbusType::i16, ModbusType::i32, ModbusType::i64, ModbusType::f64}) {
    const ModbusRegister meaning = of(type, ModbusWordOrder::abcd, 0.1);
    std::uint16_t words[4] = {};
    encode_register(meaning, -12.3, words);
    assert_true(std::abs(decode_register(meaning, words) + 12.3) < 1e-9);
  }
}

// [modbus-station-4]
void what_does_not_fit_becomes_the_nearest(void**) {
  std::uint16_t words[4] = {};
  encode_register(of(ModbusType::u16), 70000, words);
  assert_int_equal(words[0], 65535);
  encode_register(of(ModbusType::u16), -5, words);
  assert_int_equal(words[0], 0);
  encode_register(of(ModbusType::i16), -40000, words);
  assert_true(decode_register(of(ModbusType::i16), words) == -32768);
  encode_register(of(ModbusType::u32), std::numeric_limits<double>::infinity(), words);
  assert_true(decode_register(of(ModbusType::u32), words) == 4294967295.0);
  encode_register(of(ModbusType::u64), 1e20, words);
  const std::uint16_t all_ones[] = {0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF};
  assert_memory_equal(words, all_ones, sizeof(words));
  encode_register(of(ModbusType::i64), -1e20, words);
  const std::uint16_t least[] = {0x8000, 0, 0, 0};
  assert_memory_equal(words, least, sizeof(words));
  encode_register(of(ModbusType::f64), std::numeric_limits<double>::infinity(), words);
  assert_true(decode_register(of(ModbusType::f64), words) == std::numeric_limits<double>::max());
}

// [register-map-3]
void what_lies_between_two_counts_becomes_the_nearer(void**) {
  for (const double sign : {1.0, -1.0}) {
    const ModbusRegister meaning = of(ModbusType::i16, ModbusWordOrder::abcd, 0.1);
    std::uint16_t word = 0;
    encode_register(meaning, sign * 1.24, &word);
    assert_int_equal(static_cast<std::int16_t>(word), static_cast<int>(sign) * 12);
    encode_register(meaning, sign * 1.26, &word);
    assert_int_equal(static_cast<std::int16_t>(word), static_cast<int>(sign) * 13);
  }
}

// [register-map-4]
void no_number_becomes_the_bits_that_say_so_or_the_safe_value(void**) {
  std::uint16_t words[2] = {};
  encode_register(of(ModbusType::u16), std::nan(""), words);
  assert_int_equal(words[0], 3);
  ModbusRegister meaning = of(ModbusType::i32, ModbusWordOrder::cdab);
  meaning.missing = 0x80000000;
  encode_register(meaning, std::nan(""), words);
  assert_int_equal(words[0], 0);
  assert_int_equal(words[1], 0x8000);
}

// [register-map-7]
void an_offset_is_added_to_the_scaled_counts(void**) {
  ModbusRegister meaning = of(ModbusType::u16, ModbusWordOrder::abcd, 0.1);
  meaning.offset = -40;
  std::uint16_t word = 277;
  assert_true(std::abs(decode_register(meaning, &word) + 12.3) < 1e-9);
  assert_true(std::abs(decode_register(meaning, &word, 100) - 2730) < 1e-9);
  encode_register(meaning, 5.0, &word);
  assert_int_equal(word, 450);
  encode_register(meaning, 60, &word, 100);
  assert_int_equal(word, 10);
  encode_register(meaning, -50, &word);  // below what a count of 0 is
  assert_int_equal(word, 0);
}

// [register-map-8]
void bits_that_say_that_there_is_no_value_are_no_number(void**) {
  ModbusRegister meaning = of(ModbusType::i16);
  meaning.missing = 0x8000;
  std::uint16_t word = 0x8000;
  assert_true(std::isnan(decode_register(meaning, &word)));
  word = 0x8001;
  assert_true(decode_register(meaning, &word) == -32767);
  ModbusRegister wide = of(ModbusType::u32, ModbusWordOrder::dcba);
  wide.missing = 0xFFFFFFFE;
  std::uint16_t words[4] = {0xFEFF, 0xFFFF};
  assert_true(std::isnan(decode_register(wide, words)));
  words[0] = 0xFFFF;
  assert_true(decode_register(wide, words) == 4294967295.0);
  const std::uint16_t no_float[] = {0x7FC1, 0x0000};  // without a column for it
  assert_true(std::isnan(decode_register(of(ModbusType::f32), no_float)));
}

// [register-map-10]
void a_text_ends_at_a_zero_and_without_blanks(void**) {
  ModbusRegister meaning = of(ModbusType::text);
  meaning.length = 3;
  assert_int_equal(meaning.words(), 3);
  std::array<char, 2 * ModbusRegister::most_words> text{};
  const std::uint16_t padded[] = {0x5061, 0x2020, 0x2020};
  assert_true(decode_text(meaning, padded, text) == "Pa");
  const std::uint16_t full[] = {0x5061, 0x6220, 0x6364};
  assert_true(decode_text(meaning, full, text) == "Pab cd");
  const std::uint16_t ended[] = {0x5000, 0x6262, 0x6363};
  assert_true(decode_text(meaning, ended, text) == "P");
  meaning.word_order = ModbusWordOrder::badc;
  const std::uint16_t swapped[] = {0x6150, 0x0062, 0};
  assert_true(decode_text(meaning, swapped, text) == "Pab");
  std::uint16_t words[3] = {1, 1, 1};
  encode_text(meaning, "Pab", words);
  assert_memory_equal(words, swapped, sizeof(words));
  encode_text(meaning, "longer than that", words);
  assert_true(decode_text(meaning, words, text) == "longer");
  assert_true(std::isnan(decode_register(meaning, words)));
}

// [register-map-9]
void an_exponent_is_a_power_of_ten_within_reason(void**) {
  assert_true(factor_of_exponent(0) == 1);
  assert_true(std::abs(factor_of_exponent(-3) - 0.001) < 1e-12);
  assert_true(factor_of_exponent(10) == 1e10);
  for (const double exponent : {11.0, -11.0, 32767.0, std::nan("")})
    assert_true(std::isnan(factor_of_exponent(exponent)));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {cmocka_unit_test(words_are_in_each_order),
                              cmocka_unit_test(the_four_words_of_a_long_value_too),
                              cmocka_unit_test(a_bit_leaves_the_others_of_its_register),
                              cmocka_unit_test(floats_are_those_of_ieee_754),
                              cmocka_unit_test(signs_and_scales_are_kept),
                              cmocka_unit_test(what_does_not_fit_becomes_the_nearest),
                              cmocka_unit_test(what_lies_between_two_counts_becomes_the_nearer),
                              cmocka_unit_test(no_number_becomes_the_bits_that_say_so_or_the_safe_value),
                              cmocka_unit_test(an_offset_is_added_to_the_scaled_counts),
                              cmocka_unit_test(bits_that_say_that_there_is_no_value_are_no_number),
                              cmocka_unit_test(a_text_ends_at_a_zero_and_without_blanks),
                              cmocka_unit_test(an_exponent_is_a_power_of_ten_within_reason)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
