// Files of lines NAME=VALUE, by which the programs of a PC tell each other.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "base/status.hpp"

namespace flexrf::helper {

/// The lines of one file.
class NamedLines {
 public:
  static constexpr std::size_t longest_value = 200;

  /// Of a name that comes twice the last counts; other lines are left out.
  static NamedLines of(std::string_view text);
  /// not_found: there is no such file. Blocks.
  static Result<NamedLines> read(const std::string& file);

  /// Cut to `longest_value` bytes, as what others wrote goes to people. Empty: there is none.
  std::string text(std::string_view name) const;
  /// All of it. Empty: there is none.
  std::string whole(std::string_view name) const;
  /// 0: there is none.
  std::uint64_t number(std::string_view name) const;

 private:
  std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace flexrf::helper
