// CommandLine: the options of a simulator's command line.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace flexrf {

/// The whole of `text` is a number from `least` to `most`, which goes to `value`. Else `value` means nothing.
bool is_number(const char* text, double least, double most, double& value);

/// Each option that is asked for is taken out; of one that stands there several times, the last counts. What
/// is left in the end was not known. The words outlive this.
class CommandLine {
 public:
  CommandLine(int count, char** words) : words_(words + 1, words + count) {}

  bool has(std::string_view option) { return !take(option, 0).empty(); }
  /// The word behind it; null: it is not there.
  const char* word(std::string_view option);
  /// `value` stays where it is not there.
  void number(std::string_view option, double least, double most, double& value);
  /// As word(), of an option with a number behind that.
  const char* word_and_number(std::string_view option, double least, double most, double& value);

  /// All of it was asked for, and was as it was to be.
  bool is_understood() const noexcept { return is_well_ && words_.empty(); }

 private:
  /// The option and so many words behind it; empty: it is not there.
  std::vector<const char*> take(std::string_view option, std::ptrdiff_t behind);

  std::vector<const char*> words_;
  bool is_well_ = true;
};

}  // namespace flexrf
