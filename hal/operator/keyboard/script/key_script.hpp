#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"
#include "base/time.hpp"
#include "types/key_event.hpp"

namespace flexrf {

struct ScriptedKey {
  Duration after{};  ///< the start
  KeyEvent event{};
};

/// A line per key press: seconds after the start and the key, as "0.5 w". A key is a character or a name:
/// space, enter, tab, backspace, escape, up, down, left, right, home, end, insert, delete, page_up,
/// page_down. Times may repeat but not go back. '#' begins a comment (the key # has the name hash). An error
/// cites file:line. Allocates; not in a cyclic thread.
Result<std::vector<ScriptedKey>> read_key_script(const std::string& file);
Result<std::vector<ScriptedKey>> parse_key_script(std::string_view text, const std::string& file_name);

}  // namespace flexrf
