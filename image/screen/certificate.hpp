// The fingerprint by which a person knows the panel's certificate again.
#pragma once

#include <string>

namespace flexrf::screen {

/// SHA-256 of the first certificate in a file (PEM), as 64 hexadecimal digits in capitals, as browsers show
/// it; empty: there is none. Blocks.
std::string fingerprint_of(const std::string& certificate_file);

}  // namespace flexrf::screen
