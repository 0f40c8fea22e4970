#include "hal/camera/interface/jpeg_check.hpp"

#include <cstring>

namespace flexrf {
namespace {

// The second byte of a marker.
constexpr std::uint8_t stuffed = 0x00;  // no marker: the byte before it is data
constexpr std::uint8_t first_frame = 0xC0;
constexpr std::uint8_t last_frame = 0xCF;
constexpr std::uint8_t huffman_tables = 0xC4;
constexpr std::uint8_t reserved = 0xC8;
constexpr std::uint8_t arithmetic_tables = 0xCC;
constexpr std::uint8_t first_restart = 0xD0;
constexpr std::uint8_t last_restart = 0xD7;
constexpr std::uint8_t begin_of_image = 0xD8;
constexpr std::uint8_t end_of_image = 0xD9;
constexpr std::uint8_t begin_of_scan = 0xDA;
constexpr std::uint8_t restart_interval = 0xDD;
constexpr std::uint8_t first_with_length = 0xC0;

constexpr const char* ends_early = "the JPEG ends before its end";

bool is_frame(std::uint8_t marker) noexcept {
  return marker >= first_frame && marker <= last_frame && marker != huffman_tables && marker != reserved &&
         marker != arithmetic_tables;
}

bool is_restart(std::uint8_t marker) noexcept {
  return marker >= first_restart && marker <= last_restart;
}

class JpegWalk {
 public:
  JpegWalk(std::span<const std::uint8_t> bytes, std::uint32_t width, std::uint32_t height) noexcept
      : bytes_(bytes), width_(width), height_(height) {}

  /// Null, or what is wrong.
  const char* walk() noexcept {
    if (bytes_.size() < 2 || bytes_[0] != 0xFF || bytes_[1] != begin_of_image) return "it is no JPEG";
    at_ = 2;
    std::uint8_t marker = 0;
    if (const char* const damage = take_marker(marker)) return damage;
    while (marker != end_of_image) {
      if (const char* const damage = take_segment(marker)) return damage;
      const char* const damage = marker == begin_of_scan ? skip_scan(marker) : take_marker(marker);
      if (damage != nullptr) return damage;
    }
    return has_scan_ ? nullptr : "the JPEG holds no picture";
  }
  std::size_t position() const noexcept { return at_; }

 private:
  std::size_t left() const noexcept { return bytes_.size() - at_; }
  std::uint32_t word(std::size_t at) const noexcept { return bytes_[at] * 256U + bytes_[at + 1]; }

  /// Any number of bytes 0xFF may come before one.
  const char* take_marker(std::uint8_t& marker) noexcept {
    if (left() < 2) return ends_early;
    if (bytes_[at_] != 0xFF) return "the JPEG is garbled between two markers";
    while (left() > 1 && bytes_[at_] == 0xFF) ++at_;
    marker = bytes_[at_++];
    return marker == 0xFF ? ends_early : nullptr;
  }

  const char* take_segment(std::uint8_t marker) noexcept {
    if (marker < first_with_length || is_restart(marker) || marker == begin_of_image)
      return "the JPEG has a marker where none may be";
    if (left() < 2) return ends_early;
    const std::uint32_t length = word(at_);
    if (length < 2) return "the JPEG is garbled within a marker";
    if (length > left()) return ends_early;
    if (is_frame(marker)) {
      if (length < 8) return "the JPEG is garbled within a marker";
      if (word(at_ + 5) != width_ || word(at_ + 3) != height_) return "the JPEG is of another size";
      has_frame_ = true;
    } else if (marker == restart_interval) {
      restarts_ = length >= 4 && word(at_ + 2) != 0;
    } else if (marker == begin_of_scan) {
      if (!has_frame_) return "the JPEG does not say its size";
      has_scan_ = true;
    }
    at_ += length;
    return nullptr;
  }

  /// To behind the marker that ends it.
  const char* skip_scan(std::uint8_t& marker) noexcept {
    std::uint8_t next_restart = first_restart;
    while (true) {
      const void* const found = left() == 0 ? nullptr : std::memchr(&bytes_[at_], 0xFF, left());
      if (found == nullptr) return ends_early;
      at_ = static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - bytes_.data());
      if (const char* const damage = take_marker(marker)) return damage;
      if (marker == stuffed) continue;
      if (!is_restart(marker)) return nullptr;
      if (!restarts_ || marker != next_restart) return "a part of the JPEG is missing";
      next_restart = marker == last_restart ? first_restart : static_cast<std::uint8_t>(marker + 1);
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::uint32_t width_;
  std::uint32_t height_;
  std::size_t at_ = 0;
  bool has_frame_ = false;
  bool has_scan_ = false;
  bool restarts_ = false;
};

}  // namespace

CheckedJpeg check_jpeg(std::span<const std::uint8_t> bytes, std::uint32_t width,
                       std::uint32_t height) noexcept {
  JpegWalk walk(bytes, width, height);
  const char* const damage = walk.walk();
  return {damage, damage == nullptr ? walk.position() : 0};
}

}  // namespace flexrf
