#include "image/screen/qr_code.hpp"

#include <qrcodegen/qrcodegen.hpp>

namespace flexrf::screen {
namespace {

constexpr int margin = 4;  // modules, by the standard

}  // namespace

std::vector<std::string> qr_code(const std::string& text) {
  try {
    const qrcodegen::QrCode code = qrcodegen::QrCode::encodeText(text.c_str(), qrcodegen::QrCode::Ecc::LOW);
    const int end = code.getSize() + margin;
    // What lies outside of the code is light, and the last row may have a half of its own.
    const auto is_lit = [&](int x, int y) { return y < end && !code.getModule(x, y); };
    std::vector<std::string> rows;
    for (int y = -margin; y < end; y += 2) {
      std::string& row = rows.emplace_back();
      for (int x = -margin; x < end; ++x) {
        const bool upper = is_lit(x, y);
        const bool lower = is_lit(x, y + 1);
        row += upper && lower ? "\u2588" : upper ? "\u2580" : lower ? "\u2584" : " ";
      }
    }
    return rows;
  } catch (const qrcodegen::data_too_long&) {
    return {};
  }
}

}  // namespace flexrf::screen
