#include "hal/process/interface/word_list.hpp"

namespace flexrf {

Result<std::vector<std::string>> words_of(std::string_view text) {
  std::vector<std::string> words;
  bool inside = false;  // a word, which may be empty
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    } else if (c == '\\' && quote != '\'') {
      if (++i == text.size()) {
        return Status::error(StatusCode::invalid_argument,
                             "ends with a single backslash; write two for the character itself");
      }
      words.back() += text[i];
    } else {
      words.back() += c;
    }
  }
  if (quote != 0) {
    return Status::error(StatusCode::invalid_argument, "the quote %c is not closed: %.*s", quote,
                         static_cast<int>(text.size()), text.data());
  }
  return words;
}

}  // namespace flexrf
