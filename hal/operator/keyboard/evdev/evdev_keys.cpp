#include "hal/operator/keyboard/evdev/evdev_keys.hpp"

#include <linux/input-event-codes.h>

#include <cstddef>
#include <string_view>

namespace flexrf {
namespace {

/// Keys that stand side by side have codes one after the other.
struct Row {
  unsigned first;
  std::string_view plain;
  std::string_view shifted;
};

constexpr Row rows[] = {
    {KEY_1, "1234567890-=", "!@#$%^&*()_+"},
    {KEY_Q, "qwertyuiop[]", "QWERTYUIOP{}"},
    {KEY_A, "asdfghjkl;'`", "ASDFGHJKL:\"~"},
    {KEY_BACKSLASH, "\\zxcvbnm,./", "|ZXCVBNM<>?"},
    {KEY_SPACE, " ", " "},
    {KEY_KPASTERISK, "*", "*"},
    {KEY_KP7, "789-456+1230.", "789-456+1230."},
    {KEY_KPSLASH, "/", "/"},
    {KEY_102ND, "<", ">"},
};

struct Named {
  unsigned code;
  Key key;
};

constexpr Named named[] = {
    {KEY_ENTER, Key::enter},         {KEY_KPENTER, Key::enter},  {KEY_TAB, Key::tab},
    {KEY_BACKSPACE, Key::backspace}, {KEY_ESC, Key::escape},     {KEY_UP, Key::up},
    {KEY_DOWN, Key::down},           {KEY_RIGHT, Key::right},    {KEY_LEFT, Key::left},
    {KEY_HOME, Key::home},           {KEY_END, Key::end},        {KEY_INSERT, Key::insert},
    {KEY_DELETE, Key::delete_key},   {KEY_PAGEUP, Key::page_up}, {KEY_PAGEDOWN, Key::page_down},
};

}  // namespace

KeyEvent key_of_code(unsigned code, bool shift) noexcept {
  for (const Row& row : rows) {
    const std::size_t place = code - row.first;  // huge before the row
    if (place >= row.plain.size()) continue;
    const char character = (shift ? row.shifted : row.plain)[place];
    return {Key::character, static_cast<std::uint32_t>(static_cast<unsigned char>(character))};
  }
  for (const Named& one : named)
    if (one.code == code) return {one.key, 0};
  return {};
}

}  // namespace flexrf
