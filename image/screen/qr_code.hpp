// A QR code (ISO/IEC 18004) for a console of text, which a telephone reads.
#pragma once

#include <string>
#include <vector>

namespace flexrf::screen {

/// The rows of the code with its margin, two modules in each character (U+2580, U+2584, U+2588): light
/// modules are lit, as the console is dark. All have as many columns as the code has modules. Empty if the
/// text is too long for a code.
std::vector<std::string> qr_code(const std::string& text);

}  // namespace flexrf::screen
