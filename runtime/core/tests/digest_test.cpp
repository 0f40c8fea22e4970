#include "runtime/core/digest.hpp"

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

void order_and_every_word_matter(void**) {
  Digest one;
  one.add(1);
  one.add(2);
  Digest other;
  other.add(2);
  other.add(1);
  assert_int_not_equal(one.value(), other.value());
  Digest shorter;
  shorter.add(1);
  assert_int_not_equal(one.value(), shorter.value());
  assert_int_not_equal(Digest{}.value(), shorter.value());
  Digest continued{shorter.value()};
  continued.add(2);
  assert_int_equal(continued.value(), one.value());
}

/// The first values of SplitMix64 with seed 0 are published with the algorithm.
void mixing_is_splitmix64(void**) {
  Digest digest;
  digest.add(0);
  assert_int_equal(digest.value(), 0xE220A8397B1DCDAF);
}

void text_counts_with_its_length(void**) {
  Digest split;
  split.add_text("ab");
  split.add_text("c");
  Digest joined;
  joined.add_text("a");
  joined.add_text("bc");
  assert_int_not_equal(split.value(), joined.value());
  for (std::size_t size = 1; size < 20; ++size) {
    char text[20] = "abcdefghijklmnopqrs";
    Digest before;
    before.add_text({text, size});
    text[size - 1] = static_cast<char>(text[size - 1] ^ 1);
    Digest after;
    after.add_text({text, size});
    assert_int_not_equal(before.value(), after.value());
  }
}

void padding_does_not_count(void**) {
  static constexpr ByteRange significant[] = {{0, 3}, {8, 8}};
  const TypeDescriptor type{"T", "", 16, 8, 0, {}, significant, {}, false};
  unsigned char value[16] = {};
  const auto digest = [&type, &value] {
    Digest result;
    result.add_fields(type, value);
    return result.value();
  };
  const std::uint64_t zero = digest();
  for (int byte = 0; byte < 16; ++byte) {
    value[byte] = 1;
    if (byte >= 3 && byte < 8) {
      assert_int_equal(digest(), zero);
    } else {
      assert_int_not_equal(digest(), zero);
    }
    value[byte] = 0;
  }
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(order_and_every_word_matter),
      cmocka_unit_test(mixing_is_splitmix64),
      cmocka_unit_test(text_counts_with_its_length),
      cmocka_unit_test(padding_does_not_count),
  };
  return cmocka_run_group_tests_name("digest", tests, nullptr, nullptr);
}
