// Durations and sizes as people write and read them, a number and its unit; hashes as they are told.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/time.hpp"

namespace flexrf {

/// Three significant digits with the unit that keeps the number below 1000: "850 ns", "12.3 us", "1.00 ms",
/// "45.0 s", "12.5 min", "100 h". Allocates.
std::string duration_text(Duration duration);
/// The same; "": there is none (0).
std::string duration_if_any(Duration duration);
/// "512 B", "1.50 KiB", "8.00 MiB". Allocates.
std::string size_text(std::uint64_t bytes);

/// 16 digits: hashes and digests. A number of 64 bits does not survive every reader of JSON. Allocates.
std::string hexadecimal_text(std::uint64_t number);

/// "7 ms", "300us", "1.5 s", "0 s": a number from 0 on without an exponent, at most one blank, and one of ns,
/// us, ms, s, min, h. Nothing where it is not this, is no whole number of nanoseconds, or above 9e18 of them
/// (285 years). Any thread.
std::optional<Duration> parse_duration(std::string_view text) noexcept;
/// "8 MiB", "1.5 KiB", "512 B" in bytes: likewise, with one of B, KiB, MiB, GiB. Any thread.
std::optional<std::uint64_t> parse_size(std::string_view text) noexcept;

}  // namespace flexrf
