#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"

namespace flexrf {

/// The words of a text, as a shell parts them and nothing more: blanks part words, quotes of either kind keep
/// blanks, a backslash takes the next character as it is (but within single quotes). Nothing is
/// expanded [word-list-1]. invalid_argument: a quote is not closed, or the text ends with a
/// backslash [word-list-2]. Lifecycle thread.
Result<std::vector<std::string>> words_of(std::string_view text);

}  // namespace flexrf
