#include "hal/operator/keyboard/script/key_script.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <utility>

namespace flexrf {
namespace {

constexpr double longest_script = 1e6;  // s
constexpr std::array<std::pair<std::string_view, KeyEvent>, 16> named_keys = {{
    {"space", {Key::character, ' '}},
    {"hash", {Key::character, '#'}},
    {"enter", {Key::enter, 0}},
    {"tab", {Key::tab, 0}},
    {"backspace", {Key::backspace, 0}},
    {"escape", {Key::escape, 0}},
    {"up", {Key::up, 0}},
    {"down", {Key::down, 0}},
    {"right", {Key::right, 0}},
    {"left", {Key::left, 0}},
    {"home", {Key::home, 0}},
    {"end", {Key::end, 0}},
    {"insert", {Key::insert, 0}},
    {"delete", {Key::delete_key, 0}},
    {"page_up", {Key::page_up, 0}},
    {"page_down", {Key::page_down, 0}},
}};

// Cuts the next word off the line.
std::string_view next_word(std::string_view& line) {
  constexpr std::string_view blanks = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

bool parse_key(std::string_view word, KeyEvent& event) {
  if (word.size() == 1) {
    event = {Key::character, static_cast<unsigned char>(word[0])};
    return true;
  }
  for (const auto& [name, key] : named_keys) {
    if (name != word) continue;
    event = key;
    return true;
  }
  return false;
}

bool parse_seconds(std::string_view word, Duration& after) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return false;
  if (!(value >= 0) || value > longest_script) return false;
  after = duration_of(value);
  return true;
}

}  // namespace

Result<std::vector<ScriptedKey>> parse_key_script(std::string_view text, const std::string& file_name) {
  std::vector<ScriptedKey> keys;
  int number = 0;
  const auto error = [&](const char* what, std::string_view word) {
    return Status::error(StatusCode::invalid_argument,
                         "%s:%d: %s '%.*s'; a line is seconds and a key, as '0.5 w'", file_name.c_str(),
                         number, what, static_cast<int>(std::min<std::size_t>(word.size(), 40)), word.data());
  };
  while (!text.empty()) {
    ++number;
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line = line.substr(0, line.find('#'));
    const std::string_view time = next_word(line);
    if (time.empty()) continue;
    const std::string_view key = next_word(line);
    ScriptedKey scripted;
    if (!parse_seconds(time, scripted.after)) return error("not a time in seconds:", time);
    if (!parse_key(key, scripted.event)) return error("not a key:", key);
    if (const std::string_view more = next_word(line); !more.empty()) return error("more than a key:", more);
    if (!keys.empty() && scripted.after < keys.back().after)
      return error("earlier than the line before:", time);
    keys.push_back(scripted);
  }
  return keys;
}

Result<std::vector<ScriptedKey>> read_key_script(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return Status::error(StatusCode::not_found, "%s: the key script cannot be read", file.c_str());
  }
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  return parse_key_script(text, file);
}

}  // namespace flexrf
