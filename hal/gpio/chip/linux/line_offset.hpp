// Which line of a chip is meant, whichever version of libgpiod tells their names.
#pragma once

#include <functional>
#include <string>

#include "base/status.hpp"

namespace flexrf {

/// The offset of a line, below `count`. `line` is its name; where no line has that name it is the offset
/// itself, as "3" or "#3": lines of Super-IO chips, many PC boards and expanders have no names. `name_of`:
/// the name of the line at an offset; empty: it has none. Errors: not_found; invalid_argument where two lines
/// have the name. Blocks, allocates. Lifecycle thread, and the chip's keeper.
Result<unsigned> offset_of_line(const char* chip, const char* line, unsigned count,
                                const std::function<std::string(unsigned offset)>& name_of);

}  // namespace flexrf
