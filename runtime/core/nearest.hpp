// The nearest known word to a mistyped one, for messages.
#pragma once

#include <span>
#include <string_view>

namespace flexrf {

/// The known word with the least edit distance (Levenshtein), if that is at most a third of the word's length
/// and at least one; else empty. Words beyond 63 characters are never near. Any thread; does not allocate.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known) noexcept;

}  // namespace flexrf
