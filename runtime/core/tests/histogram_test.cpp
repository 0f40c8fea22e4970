#include "runtime/core/histogram.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::histogram_test {
namespace {

void empty_histogram_is_all_zero(void**) {
  Histogram histogram;
  assert_int_equal(histogram.count(), 0);
  assert_int_equal(histogram.quantile(0.5).count(), 0);
  assert_int_equal(histogram.maximum().count(), 0);
}

void quantiles_are_at_most_one_sixteenth_too_high(void**) {
  Histogram histogram;
  for (std::int64_t value = 1; value <= 100'000; ++value) histogram.add(Duration{value});
  for (const double share : {0.001, 0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const double exact = share * 100'000;
    const auto measured = static_cast<double>(histogram.quantile(share).count());
    assert_true(measured >= exact);
    assert_true(measured <= exact * 1.0625);
  }
  assert_int_equal(histogram.quantile(1).count(), 100'000);
  assert_int_equal(histogram.maximum().count(), 100'000);
}

void every_value_lies_in_its_bucket(void**) {
  for (std::int64_t value = 0; value < (std::int64_t{1} << 40); value += 1 + value / 7) {
    Histogram histogram;
    histogram.add(Duration{value});
    std::uint32_t bucket = 0;
    while (histogram.in_bucket(bucket) == 0) ++bucket;
    assert_true(Histogram::upper_bound(bucket).count() >= value);
    if (bucket > 0) assert_true(Histogram::upper_bound(bucket - 1).count() < value);
  }
}

void what_lies_outside_counts_at_the_ends(void**) {
  Histogram histogram;
  histogram.add(Duration{-5});
  histogram.add(Duration::max());
  assert_int_equal(histogram.in_bucket(0), 1);
  assert_int_equal(histogram.in_bucket(Histogram::buckets - 1), 1);
  assert_int_equal(histogram.count(), 2);
  assert_int_equal(histogram.maximum().count(), Duration::max().count());
}

}  // namespace
}  // namespace flexrf::histogram_test

int main() {
  using namespace flexrf::histogram_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(empty_histogram_is_all_zero),
      cmocka_unit_test(quantiles_are_at_most_one_sixteenth_too_high),
      cmocka_unit_test(every_value_lies_in_its_bucket),
      cmocka_unit_test(what_lies_outside_counts_at_the_ends),
  };
  return cmocka_run_group_tests_name("histogram", tests, nullptr, nullptr);
}
