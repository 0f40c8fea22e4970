// The choice and GRUB's attempts as environment blocks of GRUB, which are what is on the disk (docs/image.md
// has a picture).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/status.hpp"
#include "image/boot/choice.hpp"

namespace flexrf::boot {

/// An environment block is two sectors. All that is said stands in the first, which a disk writes whole or
/// not at all; the second never changes. So a write that is torn between them is one that happened, or did
/// not.
inline constexpr std::size_t sector_size = 512;
inline constexpr std::size_t block_size = 2 * sector_size;

/// What GRUB writes.
struct Attempts {
  std::uint64_t trial = 0;     ///< the trial that was tried last, by its counter
  unsigned count = 0;          ///< how often, 0 to most_attempts
  Slot last = Slot::b;         ///< taken last when no choice could be read
  std::optional<Slot> failed;  ///< could not be started, so the next start tries the other one

  friend bool operator==(const Attempts&, const Attempts&) = default;
};
inline constexpr unsigned most_attempts = 3;

/// CRC-32 of ISO 3309, as zip's.
std::uint32_t checksum_of(std::string_view text) noexcept;

std::string block_of(const Choice& choice);
/// invalid_argument for whatever block_of() does not make, with what is wrong about it ("its checksum does
/// not match").
Result<Choice> choice_in(std::string_view block);

std::string block_of(const Attempts& attempts);
/// Likewise. GRUB keeps the form, as each value keeps its length.
Result<Attempts> attempts_in(std::string_view block);

}  // namespace flexrf::boot
