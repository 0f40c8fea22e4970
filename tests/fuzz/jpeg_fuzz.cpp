// Bytes of a camera's compressed picture, as the check without decoding takes them.
#include <algorithm>

#include "hal/camera/interface/jpeg_check.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace flexrf::fuzz {
namespace {

constexpr std::uint32_t width = 8;
constexpr std::uint32_t height = 8;

Bytes jpeg(std::initializer_list<std::uint8_t> scan) {
  Bytes bytes{0xFF,  0xD8, 0xFF, 0xDD, 0, 4,    0,    1, 0xFF, 0xC0, 0, 11, 8, 0,  height, 0,
              width, 1,    1,    0x11, 0, 0xFF, 0xDA, 0, 8,    1,    1, 0,  0, 63, 0};
  bytes.insert(bytes.end(), scan);
  return bytes;
}

}  // namespace

std::vector<Bytes> seeds() {
  return {jpeg({0x12, 0x34, 0xFF, 0xD9}), jpeg({0x12, 0xFF, 0x00, 0xFF, 0xD0, 0x34, 0xFF, 0xFF, 0xD9, 0x00}),
          jpeg({0x12, 0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0, 0xFF, 0xD9}), jpeg({0x12})};
}

void take(std::span<const std::uint8_t> bytes) {
  const CheckedJpeg checked = check_jpeg(bytes, width, height);
  if (checked.damage != nullptr) return expect(checked.size == 0 && checked.damage[0] != '\0');
  // Whatever passes begins and ends as it must, and passes alone, too, but no byte less of it.
  expect(checked.size >= 4 && checked.size <= bytes.size());
  const auto whole = bytes.first(checked.size);
  expect(whole[0] == 0xFF && whole[1] == 0xD8 && whole[checked.size - 2] == 0xFF &&
         whole[checked.size - 1] == 0xD9);
  const Bytes alone(whole.begin(), whole.end());  // of its own, so that a byte beyond would be found
  expect(check_jpeg(alone, width, height).size == checked.size);
  const Bytes shorter(whole.begin(), whole.end() - 1);
  expect(check_jpeg(shorter, width, height).damage != nullptr);
  expect(check_jpeg(alone, width + 1, height).damage != nullptr);
}

}  // namespace flexrf::fuzz
