// A text compared by CMocka, which leaves the test by a jump: the string owns nothing by then.
#pragma once

#include <string>

#include "tests/cmocka.hpp"

namespace flexrf {

inline void expect(std::string text, const char* expected) {
  static char copy[1024];
  copy[text.copy(copy, sizeof(copy) - 1)] = '\0';
  text = {};
  text.shrink_to_fit();
  assert_string_equal(copy, expected);
}

}  // namespace flexrf
