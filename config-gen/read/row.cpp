#include "config-gen/read/row.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/quantity_text.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

std::string shown(const Node& node) {
  return node.kind == Node::Kind::text ? "\"" + printable(node.text) + "\"" : kind_text(node.kind);
}

struct QuantityWords {
  const char* name;      // as "a duration"
  const char* smallest;  // what it is a whole number of
  std::span<const std::string_view> units;
  const char* hint;
};

constexpr std::array<std::string_view, 6> duration_units = {"ns", "us", "ms", "s", "min", "h"};
constexpr QuantityWords duration_words{
    "a duration", "nanoseconds", duration_units,
    "write a number and its unit in double quotes, as \"7 ms\", \"300 us\", \"1.5 s\" or \"250 ns\""};
constexpr std::array<std::string_view, 4> size_units = {"B", "KiB", "MiB", "GiB"};
constexpr QuantityWords size_words{
    "a size", "bytes", size_units,
    "write a number and its unit in double quotes, as \"8 MiB\", \"64 KiB\" or \"512 B\""};

// Why a text that parse_duration() or parse_size() refuses is none.
std::string flaw_of(std::string_view text, const QuantityWords& words) {
  const std::string name = words.name;
  const bool is_negative = text.starts_with('-');
  if (is_negative) text.remove_prefix(1);
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::string_view number = text.substr(0, end);
  const std::size_t point = number.find('.');
  const bool is_number =
      number.find_first_of("0123456789") != std::string_view::npos && point == number.rfind('.');
  if (!is_number) return name + " begins with a number";
  if (is_negative) return name + " is never negative";
  text.remove_prefix(end);
  if (text.starts_with(',')) return "a fraction is written after a point";
  if (text.size() > 1 && (text[0] == 'e' || text[0] == 'E') &&
      std::string_view("+-0123456789").find(text[1]) != std::string_view::npos)
    return "its number is written without an exponent";
  if (text.starts_with(' ')) text.remove_prefix(1);
  if (text.empty()) return "its unit is missing";
  if (std::find(words.units.begin(), words.units.end(), text) == words.units.end())
    return quote(text) + " is no unit of " + name;
  const bool is_whole = point == std::string_view::npos ||
                        number.substr(point + 1).find_first_not_of('0') == std::string_view::npos;
  return is_whole ? "it is larger than any that can be kept"
                  : std::string("it is no whole number of ") + words.smallest;
}

void refuse_quantity(const Node& value, const std::string& what, const QuantityWords& words,
                     Diagnostics& diagnostics) {
  const bool is_text = value.kind == Node::Kind::text;
  diagnostics.error(value.position,
                    what + (is_text ? " is " : " must be " + std::string(words.name) + ", not ") +
                        shown(value) + (is_text ? ": " + flaw_of(value.text, words) : ""),
                    words.hint);
}

}  // namespace

Row::Row(const Node& table, std::string_view name, Diagnostics& diagnostics)
    : table_(table), name_(printable(name)), diagnostics_(diagnostics) {}

const Node* Row::find(std::string_view key) {
  also(key);
  const Node* value = table_.find(key);
  return value != nullptr && value->broken ? nullptr : value;
}

void Row::also(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
}

const Node* Row::any(std::string_view key) {
  return find(key);
}

std::optional<std::string> Row::text(std::string_view key) {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind == Node::Kind::text || value->cell) return value->text;
  wrong_kind(*value, key, "a text", "write it in double quotes");
  return std::nullopt;
}

std::optional<bool> Row::boolean(std::string_view key) {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind == Node::Kind::boolean) return value->boolean;
  wrong_kind(*value, key, "true or false", "write true or false, without quotes");
  return std::nullopt;
}

std::optional<std::int64_t> Row::integer(std::string_view key, std::int64_t least, std::int64_t most) {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != Node::Kind::integer) {
    wrong_kind(*value, key, "a whole number", "write a number without quotes and without a fraction");
    return std::nullopt;
  }
  if (value->integer < least || value->integer > most) {
    diagnostics_.error(value->position, quote(key) + " of " + name_ + " is " + std::to_string(value->integer),
                       "it must be from " + std::to_string(least) + " to " + std::to_string(most));
    return std::nullopt;
  }
  return value->integer;
}

std::optional<std::int64_t> Row::duration(std::string_view key) {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind == Node::Kind::text)
    if (const auto duration = parse_duration(value->text)) {
      if (duration->count() <= max_duration) return duration->count();
      diagnostics_.error(value->position,
                         quote(key) + " of " + name_ + " is " + shown(*value) + ", longer than a year",
                         "a duration is at most \"8760 h\"");
      return std::nullopt;
    }
  refuse_quantity(*value, quote(key) + " of " + name_, duration_words, diagnostics_);
  return std::nullopt;
}

std::optional<std::int64_t> Row::positive_duration(std::string_view key, const DurationBounds& bounds) {
  const auto value = duration(key);
  if (!value || (*value >= bounds.least && *value <= bounds.most)) return value;
  if (*value == 0) {
    diagnostics_.error(position(key), quote(key) + " of " + name_ + " is zero",
                       "give a duration longer than zero");
    return std::nullopt;
  }
  const bool is_short = *value < bounds.least;
  diagnostics_.error(position(key),
                     quote(key) + " of " + name_ + " is " + duration_text(*value) + ", which is too " +
                         (is_short ? "short" : "long"),
                     std::string("write at ") + (is_short ? "least" : "most") + " \"" +
                         duration_text(is_short ? bounds.least : bounds.most) + "\"");
  return std::nullopt;
}

std::optional<std::size_t> Row::size(std::string_view key) {
  const Node* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto size = value->kind == Node::Kind::text ? parse_size(value->text) : std::nullopt;
  if (size && *size > 0 && *size <= max_size) return size;
  if (!size)
    refuse_quantity(*value, quote(key) + " of " + name_, size_words, diagnostics_);
  else if (*size == 0)
    diagnostics_.error(value->position, quote(key) + " of " + name_ + " is zero",
                       "give a size of at least \"1 B\"");
  else
    diagnostics_.error(value->position, quote(key) + " of " + name_ + " is " + shown(*value),
                       "a size is at most \"1024 GiB\"");
  return std::nullopt;
}

const Node* Row::list_of_texts(std::string_view key) {
  const Node* value = find(key);
  if (value == nullptr) return nullptr;
  const auto is_text = [](const Node& element) { return element.kind == Node::Kind::text || element.cell; };
  if (value->kind == Node::Kind::array &&
      std::all_of(value->children.begin(), value->children.end(), is_text))
    return value;
  wrong_kind(*value, key, "a list of texts", "write it as [\"first\", \"second\"]");
  return nullptr;
}

const Node* Row::table(std::string_view key) {
  const Node* value = find(key);
  if (value == nullptr || value->kind == Node::Kind::table) return value;
  wrong_kind(*value, key, "a table", "write it as { key = value } or " + std::string(key) + ".KEY = value");
  return nullptr;
}

std::optional<std::size_t> Row::word(std::string_view key, const std::vector<std::string>& words) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), *value);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  diagnostics_.error(position(key), "unknown " + std::string(key) + " " + quote(*value) + " in " + name_,
                     suggest(*value, words, "words", ""));
  return std::nullopt;
}

std::optional<std::string> Row::required_text(std::string_view key, std::string_view hint) {
  if (!has(key)) missing(key, hint);
  return text(key);
}

std::optional<std::string> Row::sentence(std::string_view key) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  std::string line;
  for (const char c : *value) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > 0x20 && byte != 0x7F)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::string Row::summary() {
  if (!has("summary"))
    missing("summary", "add summary = \"One sentence.\": the panel and the reference show it");
  const auto value = sentence("summary");
  if (value && value->empty())
    diagnostics_.error(position("summary"), "the summary of " + name_ + " is empty",
                       "write one sentence: the panel and the reference show it");
  return value.value_or("");
}

Position Row::position(std::string_view key) const {
  const Node* value = table_.find(key);
  return value != nullptr ? value->position : table_.key_position;
}

void Row::finish() {
  for (const Node& child : table_.children)
    if (std::find(asked_.begin(), asked_.end(), child.key) == asked_.end())
      diagnostics_.error(child.key_position, "unknown key " + quote(child.key) + " in " + name_,
                         suggest(child.key, asked_, "keys", "remove it"));
}

void Row::missing(std::string_view key, std::string_view hint) {
  if (is_misspelt(key)) return;
  diagnostics_.error(position(), name_ + " has no " + quote(key), std::string(hint));
}

bool Row::is_misspelt(std::string_view key) {
  for (const Node& child : table_.children) {
    if (std::find(asked_.begin(), asked_.end(), child.key) != asked_.end()) continue;
    Hint near = suggest(child.key, {std::string(key)}, "keys", "");
    if (!near.replacement || !near.replacement->doubt.empty()) continue;
    diagnostics_.error(child.key_position, "unknown key " + quote(child.key) + " in " + name_,
                       std::move(near));
    also(child.key);
    return true;
  }
  return false;
}

void Row::wrong_kind(const Node& value, std::string_view key, std::string_view expected,
                     std::string_view hint) {
  std::string is = kind_text(value.kind);
  if (value.kind == Node::Kind::array && expected.substr(0, 6) == "a list") is = "a list of something else";
  diagnostics_.error(value.position,
                     quote(key) + " of " + name_ + " must be " + std::string(expected) + ", not " + is,
                     std::string(hint));
}

bool check_name(const Node& row, std::string_view what, bool only_text, Diagnostics& diagnostics) {
  if (!only_text && is_keyword(row.key)) {
    diagnostics.error(row.key_position,
                      std::string(what) + " cannot be named " + quote(row.key) + ": it is a word of C++",
                      "choose another name, as " + quote(row.key + "_value"));
    return false;
  }
  if (!is_snake_case(row.key)) {
    diagnostics.error(
        row.key_position, quote(row.key) + " is not a name for " + std::string(what),
        "names are lower_snake_case: small letters, digits and single underscores, a letter first");
    return false;
  }
  if (!only_text && is_macro(row.key)) {
    diagnostics.error(
        row.key_position,
        std::string(what) + " cannot be named " + quote(row.key) + ": it is a macro of the system's headers",
        "choose another name, as " + quote(row.key + "_value"));
    return false;
  }
  return true;
}

void check_class_name(const std::string& name, const Position& position, const std::string& example,
                      Diagnostics& diagnostics) {
  if (!is_camel_case(name))
    diagnostics.error(position, quote(name) + " is not a name for a class",
                      "write it in CamelCase, as " + (example.empty() ? "\"Jog\"" : "\"" + example + "\""));
  else if (is_macro(name))
    diagnostics.error(
        position, quote(name) + " is not a name for a class: the system's headers have macros of such names",
        "use small letters too, as in \"Jog\"");
}

}  // namespace flexrf::config_gen
