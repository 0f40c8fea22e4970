#include "config-gen/model/words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <iterator>

#include "base/nearest_name.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::string_view keywords[] = {
    "alignas",     "alignof",  "and",        "and_eq",    "asm",       "auto",         "bitand",
    "bitor",       "bool",     "break",      "case",      "catch",     "char",         "char16_t",
    "char32_t",    "char8_t",  "class",      "co_await",  "co_return", "co_yield",     "compl",
    "concept",     "const",    "const_cast", "consteval", "constexpr", "constinit",    "continue",
    "decltype",    "default",  "delete",     "do",        "double",    "dynamic_cast", "else",
    "enum",        "explicit", "export",     "extern",    "false",     "float",        "for",
    "friend",      "goto",     "if",         "inline",    "int",       "long",         "mutable",
    "namespace",   "new",      "noexcept",   "not",       "not_eq",    "nullptr",      "operator",
    "or",          "or_eq",    "private",    "protected", "public",    "register",     "reinterpret_cast",
    "requires",    "return",   "short",      "signed",    "sizeof",    "static",       "static_assert",
    "static_cast", "struct",   "switch",     "template",  "this",      "thread_local", "throw",
    "true",        "try",      "typedef",    "typeid",    "typename",  "union",        "unsigned",
    "using",       "virtual",  "void",       "volatile",  "wchar_t",   "while",        "xor",
    "xor_eq"};

// Macros of the headers that units and drivers include before what is generated. A test compares.
constexpr std::string_view macros[] = {
    "errno",
    "h_addr",
    "h_errno",
    "ifa_broadaddr",
    "ifa_dstaddr",
    "ifc_buf",
    "ifc_req",
    "ifr_addr",
    "ifr_bandwidth",
    "ifr_broadaddr",
    "ifr_data",
    "ifr_dstaddr",
    "ifr_flags",
    "ifr_hwaddr",
    "ifr_ifindex",
    "ifr_map",
    "ifr_metric",
    "ifr_mtu",
    "ifr_name",
    "ifr_netmask",
    "ifr_newname",
    "ifr_qlen",
    "ifr_slave",
    "input_event_sec",
    "input_event_usec",
    "math_errhandling",
    "s6_addr",
    "s6_addr16",
    "s6_addr32",
    "sa_handler",
    "sa_sigaction",
    "si_addr",
    "si_addr_lsb",
    "si_arch",
    "si_band",
    "si_call_addr",
    "si_fd",
    "si_int",
    "si_lower",
    "si_overrun",
    "si_pid",
    "si_pkey",
    "si_ptr",
    "si_status",
    "si_stime",
    "si_syscall",
    "si_timerid",
    "si_uid",
    "si_upper",
    "si_utime",
    "si_value",
    "sigev_notify_attributes",
    "sigev_notify_function",
    "simdjson_fallthrough",
    "simdjson_inline",
    "simdjson_never_inline",
    "simdjson_really_inline",
    "simdjson_strcasecmp",
    "simdjson_strncasecmp",
    "simdjson_unused",
    "simdjson_warn_unused",
    "st_atime",
    "st_ctime",
    "st_mtime",
};

bool lower(char c) {
  return c >= 'a' && c <= 'z';
}
bool upper(char c) {
  return c >= 'A' && c <= 'Z';
}
bool digit(char c) {
  return c >= '0' && c <= '9';
}

std::string number_with_unit(double value, const char* unit) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.6g %s", value, unit);
  return text.data();
}

// ---- The nearest word, and whether it can only be a slip

struct Nearest {
  std::string name;   // empty: none is near
  std::string other;  // as near; empty: none is
};

Nearest find_nearest(std::string_view word, std::span<const std::string> known) {
  constexpr std::size_t most_looked_at = 1000;  // an application of more names shall not take longer
  constexpr std::size_t longest = 64;           // no name is longer that somebody mistypes
  if (word.size() > longest) return {};
  known = known.first(std::min(known.size(), most_looked_at));
  const std::size_t limit = std::max<std::size_t>(1, std::min<std::size_t>(3, word.size() / 2));
  std::size_t best = limit + 1;
  Nearest found;
  for (const std::string& candidate : known) {
    const std::size_t length_apart =
        candidate.size() > word.size() ? candidate.size() - word.size() : word.size() - candidate.size();
    if (length_apart > best) continue;
    const std::size_t d = edit_distance(word, candidate);
    if (d > best || (d == best && found.name.empty()) || candidate == found.name) continue;
    if (d < best) {
      found = {candidate, ""};
    } else {
      found = {std::min(candidate, found.name), std::max(candidate, found.name)};
    }
    best = d;
  }
  return found;
}

std::string small_letters(std::string_view text) {
  std::string small;
  for (const char c : text) small += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

bool separates(char c) {
  return c == '_' || c == '-';
}

std::string without(bool (*left_out)(char), std::string_view text) {
  std::string rest;
  std::copy_if(text.begin(), text.end(), std::back_inserter(rest), [&](char c) { return !left_out(c); });
  return rest;
}

std::string digits_of(std::string_view text) {
  return without([](char c) { return !digit(c); }, text);
}

// "tool_pose" has two, "axis[2].drive" three.
std::vector<std::string> parts_of(std::string_view name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    if (separates(c) || c == '.' || c == '[' || c == ']' || c == '/')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// Two neighbours exchanged, a letter too many or too few; in a long word also another letter. The first
// letter is seldom mistyped: 'lamp' and 'clamp', 'left' and 'lift' are words of their own.
bool is_slip_of_part(const std::string& found, const std::string& wanted) {
  if (found == wanted) return true;
  const auto [shorter, longer] = std::minmax({found.size(), wanted.size()});
  if (shorter < 3 || edit_distance(found, wanted) != 1) return false;
  if (shorter == longer && std::is_permutation(found.begin(), found.end(), wanted.begin())) return true;
  return found.front() == wanted.front() && (shorter != longer || shorter >= 6);
}

bool is_slip(std::string_view found, std::string_view wanted) {
  const std::string one = small_letters(found);
  const std::string other = small_letters(wanted);
  if (without(separates, one) == without(separates, other)) return true;
  const std::vector<std::string> parts = parts_of(one);
  const std::vector<std::string> wanted_parts = parts_of(other);
  return parts.size() == wanted_parts.size() &&
         std::equal(parts.begin(), parts.end(), wanted_parts.begin(), is_slip_of_part);
}

std::string doubt_about(std::string_view word, const Nearest& near) {
  if (!near.other.empty()) return quote(near.other) + " is as near";
  if (digits_of(word) != digits_of(near.name)) return "names with other numbers are other things";
  return is_slip(word, near.name) ? "" : "they differ by more than a slip of the hand";
}

}  // namespace

bool is_snake_case(std::string_view name) {
  if (name.empty() || !lower(name.front()) || name.back() == '_') return false;
  if (name.find("__") != std::string_view::npos) return false;
  return std::all_of(name.begin(), name.end(), [](char c) { return lower(c) || digit(c) || c == '_'; });
}

bool is_camel_case(std::string_view name) {
  if (name.empty() || !upper(name.front())) return false;
  return std::all_of(name.begin(), name.end(), [](char c) { return lower(c) || upper(c) || digit(c); });
}

bool is_keyword(std::string_view name) {
  return std::find(std::begin(keywords), std::end(keywords), name) != std::end(keywords);
}

bool is_macro(std::string_view name) {
  if (std::find(std::begin(macros), std::end(macros), name) != std::end(macros)) return true;
  // EOF, NULL, NAN, B9600: too many to be listed; and of <cinttypes> those that are not all capitals.
  const bool capitals = std::none_of(name.begin(), name.end(), lower);
  return (capitals && name.size() > 1) || name.starts_with("PRI") || name.starts_with("SCN");
}

std::span<const std::string_view> known_macros() {
  return macros;
}

std::string camel_case(std::string_view snake) {
  std::string camel;
  bool start = true;
  for (const char c : snake) {
    if (c == '_' || c == '-') {
      start = true;
    } else {
      camel += start ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
      start = false;
    }
  }
  return camel;
}

std::string snake_case(std::string_view camel) {
  std::string snake;
  for (const char c : camel) {
    if (upper(c) && !snake.empty() && snake.back() != '_') snake += '_';
    snake += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return snake;
}

std::string nearest(std::string_view word, std::span<const std::string> known) {
  return find_nearest(word, known).name;
}

Hint suggest(std::string_view word, const std::vector<std::string>& known, std::string_view kinds,
             std::string_view otherwise) {
  const Nearest near = find_nearest(word, known);
  if (!near.name.empty()) {
    Hint hint = "did you mean " + quote(near.name) + "?";
    hint.replacement = Replacement{std::string(word), near.name, doubt_about(word, near)};
    return hint;
  }
  if (known.empty()) return std::string(otherwise);
  std::vector<std::string> shown = known;
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  constexpr std::size_t most = 12;
  const bool cut = shown.size() > most;
  if (cut) shown.resize(most);
  std::string text = "known " + std::string(kinds) + ": ";
  for (std::size_t i = 0; i < shown.size(); ++i) text += (i == 0 ? "" : ", ") + quote(shown[i]);
  return cut ? text + ", ..." : text;
}

std::string string_literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    // Compilers warn of what C++ once took for trigraphs: no two question marks follow each other.
    if (c == '"' || c == '\\' || (c == '?' && result.back() == '?')) {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (byte < 0x20 || byte == 0x7F) {
      // Three octal digits, so that a digit that follows is not taken in.
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\%03o", byte);
      result += escape.data();
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string on_one_line(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n') {
      result += "\\n";
    } else if (byte < 0x20 || byte == 0x7F) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\x%02X", byte);
      result += escape.data();
    } else {
      result += c;
    }
  }
  return result;
}

std::string printable(std::string_view text) {
  constexpr std::size_t most_letters = 120;
  std::string result = on_one_line(text);
  if (result.size() <= most_letters) return result;
  std::size_t end = most_letters;
  // Letters are whole.
  while (end < result.size() && (static_cast<unsigned char>(result[end]) & 0xC0) == 0x80) ++end;
  if (end == result.size()) return result;
  result.resize(end);
  return result + "...";
}

std::string quote(std::string_view word) {
  return "'" + printable(word) + "'";
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += quote(words[i]);
  }
  return text;
}

std::string join(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += separator;
    text += words[i];
  }
  return text;
}

std::string duration_text(long long nanoseconds) {
  const auto value = static_cast<double>(nanoseconds);
  const long long magnitude = nanoseconds < 0 ? -nanoseconds : nanoseconds;
  if (magnitude >= 1'000'000'000) return number_with_unit(value / 1e9, "s");
  if (magnitude >= 1'000'000) return number_with_unit(value / 1e6, "ms");
  if (magnitude >= 1'000) return number_with_unit(value / 1e3, "us");
  return number_with_unit(value, "ns");
}

std::string size_text(std::size_t bytes) {
  const auto value = static_cast<double>(bytes);
  std::array<char, 48> text{};
  if (bytes < 1024) return std::to_string(bytes) + " B";
  const bool mebi = bytes >= 1024 * 1024;
  const double scaled = mebi ? value / (1024.0 * 1024.0) : value / 1024.0;
  std::snprintf(text.data(), text.size(), scaled < 100 ? "%.2f" : "%.1f", scaled);
  std::string number = text.data();
  while (number.back() == '0') number.pop_back();
  if (number.back() == '.') number.pop_back();
  return number + (mebi ? " MiB" : " KiB");
}

}  // namespace flexrf::config_gen
