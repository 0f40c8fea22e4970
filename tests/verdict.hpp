// What a case of a conformance suite comes to.
#pragma once

namespace flexrf {

enum class Verdict { passed, failed, skipped };

constexpr Verdict verdict(bool good) {
  return good ? Verdict::passed : Verdict::failed;
}

}  // namespace flexrf
