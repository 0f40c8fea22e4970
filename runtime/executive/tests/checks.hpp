// Assertions for test bodies that own things: a failing check unwinds the body, and only then does CMocka
// hear of it.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

#include "tests/cmocka.hpp"

namespace flexrf::fixture {

struct CheckFailed {
  std::string message;
};

template <class Value>
std::string shown(const Value& value) {
  std::ostringstream text;
  if constexpr (std::is_enum_v<Value>) {
    text << static_cast<long long>(value);
  } else {
    text << value;
  }
  return text.str();
}

template <class Left, class Right>
void check_equal(const Left& left, const Right& right, const char* what, const char* file, int line) {
  if (left == right) return;
  throw CheckFailed{std::string{file} + ":" + std::to_string(line) + ": " + what + ": " + shown(left) +
                    " is not " + shown(right)};
}

inline void check_contains(std::string_view text, std::string_view part, const char* file, int line) {
  if (text.find(part) != std::string_view::npos) return;
  throw CheckFailed{std::string{file} + ":" + std::to_string(line) + ": `" + std::string{part} +
                    "` is not in:\n" + std::string{text}};
}

/// Runs the body; fails the CMocka test when a check in it failed.
template <void (*body)()>
void contained(void**) {
  static char message[8192];
  message[0] = '\0';
  try {
    body();
  } catch (const CheckFailed& failed) {
    std::snprintf(message, sizeof(message), "%s", failed.message.c_str());
  }
  if (message[0] != '\0') fail_msg("%s", message);
}

}  // namespace flexrf::fixture

#define CHECK(condition)                                                                                 \
  do {                                                                                                   \
    if (!(condition)) {                                                                                  \
      throw flexrf::fixture::CheckFailed{std::string{__FILE__} + ":" + std::to_string(__LINE__) + ": " + \
                                         #condition};                                                    \
    }                                                                                                    \
  } while (false)
#define CHECK_EQUAL(left, right) flexrf::fixture::check_equal(left, right, #left, __FILE__, __LINE__)
#define CHECK_CONTAINS(text, part) flexrf::fixture::check_contains(text, part, __FILE__, __LINE__)
#define CONTAINED_TEST(body) \
  { #body, flexrf::fixture::contained < body>, nullptr, nullptr, nullptr }
