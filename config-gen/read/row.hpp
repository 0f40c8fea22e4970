// One table while it is read: typed access by key, and an error for every key that nobody asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/limits.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

// From the least to the most that can be meant, in nanoseconds.
struct DurationBounds {
  std::int64_t least = 1;
  std::int64_t most = max_duration;
};
// Periods and other triggers of threads, and budgets of steps.
inline constexpr DurationBounds release_bounds{1'000};
// Sleeps of a back-off: an item that arrives during one waits for its end.
inline constexpr DurationBounds sleep_bounds{1'000, 3'600'000'000'000};
// Lengths and time-outs of a log-in.
inline constexpr DurationBounds session_bounds{1'000'000'000};
// Time-outs after which something counts as hung or failed.
inline constexpr DurationBounds supervision_bounds{1'000'000, 3'600'000'000'000};

class Row {
 public:
  // `name` is how messages call it: "[unit.jog]", "this file".
  Row(const Node& table, std::string_view name, Diagnostics& diagnostics);

  // Each gives nothing when the key is missing, or is of another kind, which is reported.
  std::optional<std::string> text(std::string_view key);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::int64_t> integer(std::string_view key, std::int64_t least, std::int64_t most);
  std::optional<std::int64_t> duration(std::string_view key);  // nanoseconds, 0 allowed
  // 0 and what lies outside of the bounds are errors.
  std::optional<std::int64_t> positive_duration(std::string_view key, const DurationBounds& bounds = {});
  std::optional<std::size_t> size(std::string_view key);
  const Node* list_of_texts(std::string_view key);  // an array whose elements are all texts
  const Node* table(std::string_view key);
  const Node* any(std::string_view key);
  // The text's place in `words`; an unknown one is reported with the nearest.
  std::optional<std::size_t> word(std::string_view key, const std::vector<std::string>& words);

  // The same, and an error when the key is missing, with this hint.
  std::optional<std::string> required_text(std::string_view key, std::string_view hint);
  // A text on one line: line breaks and other control characters are blanks.
  std::optional<std::string> sentence(std::string_view key);
  std::string summary();  // a sentence, required everywhere

  // Allowed here and read elsewhere.
  void also(std::string_view key);
  bool has(std::string_view key) const { return table_.find(key) != nullptr; }
  // Where the key's value stands, or the row when it is missing.
  Position position(std::string_view key) const;
  Position position() const { return table_.key_position; }
  const std::string& name() const { return name_; }
  const Node& node() const { return table_; }

  // Reports every key that was not asked for.
  void finish();

  // Where a key stands here that can only be a slip for the missing one, that is told instead.
  void missing(std::string_view key, std::string_view hint);
  void wrong_kind(const Node& value, std::string_view key, std::string_view expected, std::string_view hint);

 private:
  const Node* find(std::string_view key);
  // Told here, and not once more by finish().
  bool is_misspelt(std::string_view key);

  const Node& table_;
  std::string name_;
  Diagnostics& diagnostics_;
  std::vector<std::string> asked_;
};

// One sentence for every kind of bad name; false when reported. `what` is as "a unit".
// Words of C++ are refused, unless the name stays a text in what is generated.
bool check_name(const Node& row, std::string_view what, bool only_text, Diagnostics& diagnostics);

// Of a type, a unit, an interface or a driver; `example` is a name as it could be.
void check_class_name(const std::string& name, const Position& position, const std::string& example,
                      Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
