// Writes an application with many units of few types, to measure the generator and the compiler with.
#pragma once

#include <string>

namespace flexrf::bench {

/// The folder becomes an application outside of this repository: scale.toml, types/, units/ and a
/// CMakeLists.txt that finds FlexRF as a package. Each of the units, of five types, reads one slot and writes
/// `outputs` slots, and has configuration, a runtime parameter and feedback. False when a file cannot be
/// written.
bool write_scale_tables(const std::string& folder, int units, int outputs);

}  // namespace flexrf::bench
