// Files as text, before anything is made of them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "config-gen/model/diagnostics.hpp"

namespace flexrf::config_gen {

// The file's bytes; nothing when it cannot be read or is too large, which is then in `diagnostics`. Never
// waits: a pipe, a socket, a device and a folder are refused.
std::optional<std::string> read_source(const std::filesystem::path& file, Diagnostics& diagnostics);

// Whether there is a file that can be read as a whole where a row names one; else it is reported at
// `position`, where the row calls it `name`.
bool check_named_file(const std::filesystem::path& file, std::string_view name, const Position& position,
                      Diagnostics& diagnostics);

// Texts that read_source() finds in place of the files' own, until it goes: so changes are tried before they
// are written. At most one at a time, in the thread that reads.
class TriedTexts {
 public:
  TriedTexts();
  ~TriedTexts();
  TriedTexts(const TriedTexts&) = delete;
  TriedTexts& operator=(const TriedTexts&) = delete;

  // However the file is named when it is read.
  void set(const std::filesystem::path& file, std::string text);

 private:
  friend std::optional<std::string> read_source(const std::filesystem::path& file, Diagnostics& diagnostics);

  std::map<std::filesystem::path, std::string> texts_;
};

// Whether these are characters in UTF-8. What else they are is reported, with the place of the first byte
// that is wrong. A byte order mark of UTF-8 is allowed.
bool check_utf8(std::string_view text, std::string_view file, Diagnostics& diagnostics);

// Every end of line as "\n": files come with "\r\n", and out of some spreadsheets with "\r" alone.
std::string with_plain_line_ends(std::string_view text);

// Whether tables, lists and dotted names in this TOML are nested no deeper than a parser can follow; else it
// is reported.
bool check_nesting(std::string_view toml, std::string_view file, Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
