// What to do about a message: a sentence for people, and where that is "did you mean 'wanted'?", the two
// words.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace flexrf::config_gen {

// One word of the key, text or cell at a message's place, and the known one that was most likely meant.
struct Replacement {
  std::string found;
  std::string wanted;
  std::string doubt;  // why only a person should replace it; empty: `--fix` does

  bool operator==(const Replacement&) const = default;
};

// Made of a sentence alone, it replaces nothing. suggest() of words.hpp makes those that do.
struct Hint {
  Hint(std::string sentence) : text(std::move(sentence)) {}
  Hint(const char* sentence) : text(sentence) {}

  // The same sentence, and why the word may be right and something else wrong.
  Hint doubted(std::string why) && {
    if (replacement) replacement->doubt = std::move(why);
    return std::move(*this);
  }

  std::string text;
  std::optional<Replacement> replacement;
};

}  // namespace flexrf::config_gen
