// A fuzz target as a test of every run: its seeds, each cut short everywhere, and each changed at random, the
// same in every run. It finds less than libFuzzer does, and that a target no longer builds or holds soon
// after.
#include <sanitizer/common_interface_defs.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <random>

#include "tests/cmocka.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace flexrf::fuzz {
namespace {

constexpr int changed_per_seed = 10000;
constexpr int most_changes = 4;

std::span<const std::uint8_t> taken;

/// What brought it down can be a seed of the target.
void tell() {
  std::fputs("it was given:", stderr);
  for (const std::uint8_t byte : taken) std::fprintf(stderr, " %02x", byte);
  std::fputs("\n", stderr);
}

void give(const Bytes& bytes) {
  taken = bytes;
  take(bytes);
}

Bytes changed(Bytes bytes, std::mt19937& random) {
  const auto below = [&](std::size_t end) { return static_cast<std::ptrdiff_t>(random() % end); };
  for (std::ptrdiff_t left = 1 + below(most_changes); left > 0 && !bytes.empty(); --left) {
    const auto at = bytes.begin() + below(bytes.size());
    const auto byte = static_cast<std::uint8_t>(random());
    switch (below(4)) {
      case 0:
        *at = byte;
        break;
      case 1:
        *at = static_cast<std::uint8_t>(*at ^ 1U << (byte & 7U));
        break;
      case 2:
        bytes.insert(at, byte);
        break;
      default:
        bytes.erase(at,
                    at + 1 + below(static_cast<std::size_t>(std::min<std::ptrdiff_t>(bytes.end() - at, 8))));
    }
  }
  return bytes;
}

void changed_seeds(void**) {
  __sanitizer_set_death_callback(tell);
  std::signal(SIGABRT, [](int) { tell(); });
  std::mt19937 random(1);
  const std::vector<Bytes> given = seeds();
  assert_false(given.empty());
  for (const Bytes& seed : given) {
    for (std::size_t size = 0; size <= seed.size(); ++size)
      give(Bytes(seed.begin(), seed.begin() + static_cast<std::ptrdiff_t>(size)));
    for (int i = 0; i < changed_per_seed; ++i) give(changed(seed, random));
  }
}

}  // namespace
}  // namespace flexrf::fuzz

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(flexrf::fuzz::changed_seeds)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
