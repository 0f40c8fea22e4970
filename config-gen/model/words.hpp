// Words in tables and messages: names, their spelling, the nearest known one.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config-gen/model/hint.hpp"

namespace flexrf::config_gen {

bool is_snake_case(
    std::string_view name);  // lower_snake_case, starts with a letter, no "__", no "_" at the end
bool is_camel_case(std::string_view name);
bool is_keyword(std::string_view name);  // of C++20
bool is_macro(std::string_view name);    // or written as one: a class called EOF would be something else

std::span<const std::string_view> known_macros();  // but those of capitals, which are too many

std::string camel_case(std::string_view snake);  // key_event -> KeyEvent
std::string snake_case(std::string_view camel);  // KeyEvent -> key_event

// The known word that is the fewest edits away, or empty when none is near enough to be meant.
std::string nearest(std::string_view word, std::span<const std::string> known);

// "did you mean 'nearest'?", with the replacement; else "known KINDS: 'a', 'b'" (sorted, at most a dozen);
// else `otherwise`. The replacement is in doubt where another word is as near, or where the words differ by
// more than a slip of the hand, as 'can0' and 'can1' do.
Hint suggest(std::string_view word, const std::vector<std::string>& known, std::string_view kinds,
             std::string_view otherwise);

std::string string_literal(std::string_view text);  // "…" in C++, whatever the text holds
// On one line, whatever it holds: control characters as escapes.
std::string on_one_line(std::string_view text);
// The same, and not too long to read: what comes after 120 letters as "...".
std::string printable(std::string_view text);
std::string quote(std::string_view word);                   // 'word', printable
std::string listed(const std::vector<std::string>& words);  // 'a', 'b' and 'c'
std::string join(const std::vector<std::string>& words, std::string_view separator);

// For people: "7 ms", "1.5 s"; "64 KiB", "1.5 MiB".
std::string duration_text(long long nanoseconds);
std::string size_text(std::size_t bytes);

}  // namespace flexrf::config_gen
