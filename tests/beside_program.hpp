// Where the files that a test reads lie, and the programs that it starts.
#pragma once

namespace flexrf {

/// The absolute path of `path`, which is relative to the folder of the running program, or absolute already.
/// Never freed: it is meant for the constants of "places.hpp" (flexrf_add_places).
const char* beside_program(const char* path);

}  // namespace flexrf
