// Where in a file's bytes the word stands that a message is about.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "config-gen/model/hint.hpp"
#include "config-gen/model/position.hpp"

namespace flexrf::config_gen {

enum class SourceKind { table, list };  // TOML, CSV

struct WordPlace {
  std::size_t token = 0;  // the byte at which the message points: of a key, of the quote of a text, of a cell
  std::size_t begin = 0;  // of the word
};

// The word of a replacement in the key, text or cell at this place. It has to be all of it, or one whole word
// in a text or cell, as 'raedy' in "state = raedy". Nothing where it is not there as it is written (an
// argument of a group, an escape in a text), stands there more than once, or where what is wanted could not
// stand there without quotes.
std::optional<WordPlace> find_word(std::string_view text, const Position& place,
                                   const Replacement& replacement, SourceKind kind);

/// Whether a character can stand in a bare key of TOML.
bool is_bare(char c);

// The place of a byte, as messages count.
Position place_of(std::string_view text, std::size_t byte, std::string_view file, SourceKind kind);

}  // namespace flexrf::config_gen
