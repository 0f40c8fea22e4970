#include "config-gen/fix/word_place.hpp"

#include <algorithm>

namespace flexrf::config_gen {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // has no column

bool is_word_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

// What needs no escape in a text, and no quotes in a cell.
bool is_plain(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return is_bare(c) || c == '.' || c == '/' || c == '[' || c == ']';
  });
}

// Follows lines and columns as toml++ and the reader of lists do.
class Walk {
 public:
  Walk(std::string_view text, SourceKind kind)
      : text_(text), kind_(kind), at_(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0) {}

  std::size_t at() const { return at_; }
  std::uint32_t line() const { return line_; }
  std::uint32_t column() const { return column_; }
  bool ended() const { return at_ >= text_.size(); }

  void step() {
    if (ends_line()) {
      ++line_;
      column_ = 1;
    } else if (next_begins_character()) {
      ++column_;
    }
    ++at_;
  }

 private:
  bool ends_line() const {
    if (text_[at_] == '\n') return true;
    return kind_ == SourceKind::list && text_[at_] == '\r' && text_.substr(at_ + 1, 1) != "\n";
  }
  bool next_begins_character() const {
    return at_ + 1 >= text_.size() || (static_cast<unsigned char>(text_[at_ + 1]) & 0xC0) != 0x80;
  }

  std::string_view text_;
  SourceKind kind_;
  std::size_t at_;
  std::uint32_t line_ = 1;
  std::uint32_t column_ = 1;
};

// The byte at this place; the text's size where it has no such place.
std::size_t byte_at(std::string_view text, const Position& place, SourceKind kind) {
  Walk walk(text, kind);
  while (!walk.ended() &&
         (walk.line() < place.line || (walk.line() == place.line && walk.column() < place.column)))
    walk.step();
  return walk.line() == place.line && walk.column() == place.column ? walk.at() : text.size();
}

// What stands between quotes, without them; nothing where it has escapes, several lines or no end.
std::optional<std::string_view> between_quotes(std::string_view text, std::size_t token) {
  const char quote = text[token];
  const std::string_view three = text.substr(token, 3);
  if (three.size() == 3 && three[1] == quote && three[2] == quote) return std::nullopt;
  const std::size_t end = text.find(quote, token + 1);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view inside = text.substr(token + 1, end - token - 1);
  const bool escaped = quote == '"' && inside.find('\\') != std::string_view::npos;
  if (escaped || inside.find_first_of("\r\n") != std::string_view::npos) return std::nullopt;
  return inside;
}

struct Token {
  std::string_view content;
  bool bare = false;
};

std::optional<Token> token_of_table(std::string_view text, std::size_t token) {
  if (text[token] == '"' || text[token] == '\'') {
    const auto inside = between_quotes(text, token);
    if (!inside) return std::nullopt;
    return Token{*inside, false};
  }
  std::size_t end = token;
  while (end < text.size() && is_bare(text[end])) ++end;
  return Token{text.substr(token, end - token), true};
}

std::optional<Token> token_of_list(std::string_view text, std::size_t token) {
  if (text[token] == '"') {
    const auto inside = between_quotes(text, token);
    // A quote that is written twice is part of the cell.
    if (!inside || text.substr(token + inside->size() + 2, 1) == "\"") return std::nullopt;
    return Token{*inside, false};
  }
  const std::size_t end = std::min(text.find_first_of(",;\r\n", token), text.size());
  std::string_view content = text.substr(token, end - token);
  while (!content.empty() && (content.back() == ' ' || content.back() == '\t')) content.remove_suffix(1);
  return Token{content, false};
}

// Where the word begins, if it is there once and whole.
std::optional<std::size_t> find_once(std::string_view content, std::string_view word) {
  std::optional<std::size_t> found;
  for (std::size_t at = content.find(word); at != std::string_view::npos; at = content.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at > 0 && is_word_letter(content[at - 1])) || (end < content.size() && is_word_letter(content[end])))
      continue;
    if (found) return std::nullopt;
    found = at;
  }
  return found;
}

}  // namespace

bool is_bare(char c) {
  return c == '-' || (is_word_letter(c) && static_cast<unsigned char>(c) < 0x80);
}

std::optional<WordPlace> find_word(std::string_view text, const Position& place,
                                   const Replacement& replacement, SourceKind kind) {
  const std::string& found = replacement.found;
  if (found.empty() || !is_plain(replacement.wanted)) return std::nullopt;
  const std::size_t token = byte_at(text, place, kind);
  if (token >= text.size()) return std::nullopt;
  const auto there = kind == SourceKind::table ? token_of_table(text, token) : token_of_list(text, token);
  if (!there) return std::nullopt;
  const auto begin = static_cast<std::size_t>(there->content.data() - text.data());
  if (there->content == found) {
    const bool fits =
        !there->bare || std::all_of(replacement.wanted.begin(), replacement.wanted.end(), is_bare);
    if (!fits) return std::nullopt;
    return WordPlace{token, begin};
  }
  if (there->bare) return std::nullopt;
  const auto inside = find_once(there->content, found);
  if (!inside) return std::nullopt;
  return WordPlace{token, begin + *inside};
}

Position place_of(std::string_view text, std::size_t byte, std::string_view file, SourceKind kind) {
  Walk walk(text, kind);
  while (!walk.ended() && walk.at() < byte) walk.step();
  return {file, walk.line(), walk.column()};
}

}  // namespace flexrf::config_gen
