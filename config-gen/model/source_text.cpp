#include "config-gen/model/source_text.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

TriedTexts* tried_texts = nullptr;

// The place of a byte; characters of several bytes count once.
Position place_of(std::string_view text, std::size_t byte, std::string_view file) {
  Position place{file, 1, 1};
  for (const char c : text.substr(0, byte)) {
    if (c == '\n') {
      ++place.line;
      place.column = 1;
    } else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) {
      ++place.column;
    }
  }
  return place;
}

// Bytes of the character at the front; 0 when it is none of UTF-8 (RFC 3629: no surrogates, nothing longer
// than needed).
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F) ||
      (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F))
    return 0;
  return length;
}

bool is_utf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
  // Without its mark: every other byte of Latin letters is zero.
  return text.size() >= 4 && ((text[0] == '\0') != (text[1] == '\0')) &&
         (text[0] == '\0') == (text[2] == '\0') && (text[1] == '\0') == (text[3] == '\0');
}

std::string advice_for(std::string_view file) {
  return "save it as UTF-8 in the editor, or: iconv -f WINDOWS-1252 -t UTF-8 " + std::string(file) + " > NEW";
}

// A byte above 0x7F as Latin-1 means it, in UTF-8.
std::string latin(unsigned char byte) {
  return {static_cast<char>(0xC0 | (byte >> 6)), static_cast<char>(0x80 | (byte & 0x3F))};
}

// Follows TOML's texts, comments and brackets, and nothing else of it: what is wrong in there is the parser's
// to tell.
class NestingCheck {
 public:
  NestingCheck(std::string_view toml, std::string_view file) : toml_(toml), file_(file) {}

  // The place where it becomes too deep.
  std::optional<Position> run() {
    while (at_ < toml_.size()) {
      const char c = toml_[at_];
      if (c == '"' || c == '\'') {
        skip_text(c);
        continue;
      }
      if (c == '#') {
        at_ = std::min(toml_.find('\n', at_), toml_.size());
        continue;
      }
      if (c == '[' || c == '{') {
        ++open_;
        dots_ = 0;
      } else if (c == ']' || c == '}') {
        if (open_ > 0) --open_;
        dots_ = 0;
      } else if (c == '.') {
        ++dots_;
      } else if (c == '\n' || c == ',' || c == '=') {
        dots_ = 0;
      }
      if (open_ > max_nesting || dots_ >= max_nesting) return place_of(toml_, at_, file_);
      ++at_;
    }
    return std::nullopt;
  }

 private:
  void skip_text(char quote) {
    const std::string three(3, quote);
    const bool several_lines = toml_.substr(at_).starts_with(three);
    at_ += several_lines ? 3 : 1;
    while (at_ < toml_.size()) {
      if (quote == '"' && toml_[at_] == '\\') {
        at_ += 2;
      } else if (several_lines ? toml_.substr(at_).starts_with(three) : toml_[at_] == quote) {
        at_ += several_lines ? 3 : 1;
        return;
      } else if (!several_lines && toml_[at_] == '\n') {
        return;  // never closed
      } else {
        ++at_;
      }
    }
  }

  std::string_view toml_;
  std::string_view file_;
  std::size_t at_ = 0;
  std::size_t open_ = 0;
  std::size_t dots_ = 0;
};

// The kind of a path that is no regular file, as "a pipe"; empty for a regular file.
std::string other_kind_of(const struct stat& status) {
  if (S_ISREG(status.st_mode)) return "";
  if (S_ISFIFO(status.st_mode)) return "a pipe";
  if (S_ISDIR(status.st_mode)) return "a folder";
  return S_ISSOCK(status.st_mode) ? "a socket" : "a device";
}

std::string advice_for_kind(std::string_view kind) {
  return kind == "a folder" ? "name a file in it" : "write what comes from it into a file, and name that";
}

struct ReadFailure {
  std::string kind;  // what it is instead of a file; empty: it is one, or nobody knows
  int error = 0;     // as errno has it
};

// At most one byte more than a file may have.
ReadFailure read_whole(const std::filesystem::path& file, std::string& text) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return {"", errno};
  if (std::string kind = other_kind_of(status); !kind.empty()) return {std::move(kind), 0};
  // Another kind of file may have taken its place: opening a pipe would block until another process writes.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return {"", errno};
  ReadFailure failure;
  if (::fstat(descriptor, &status) != 0)
    failure.error = errno;
  else
    failure.kind = other_kind_of(status);
  if (failure.error == 0 && failure.kind.empty()) {
    text.resize(max_file_size + 1);
    std::size_t size = 0;
    while (size < text.size()) {
      const ssize_t count = ::read(descriptor, text.data() + size, text.size() - size);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) failure.error = errno;
      if (count <= 0) break;
      size += static_cast<std::size_t>(count);
    }
    text.resize(size);
  }
  ::close(descriptor);
  return failure;
}

}  // namespace

TriedTexts::TriedTexts() {
  tried_texts = this;
}

TriedTexts::~TriedTexts() {
  tried_texts = nullptr;
}

void TriedTexts::set(const std::filesystem::path& file, std::string text) {
  texts_.insert_or_assign(std::filesystem::weakly_canonical(file), std::move(text));
}

std::optional<std::string> read_source(const std::filesystem::path& file, Diagnostics& diagnostics) {
  if (tried_texts != nullptr && !tried_texts->texts_.empty()) {
    const auto found = tried_texts->texts_.find(std::filesystem::weakly_canonical(file));
    if (found != tried_texts->texts_.end()) return found->second;
  }
  const Position place{intern(file.generic_string()), 1, 1};
  std::string text;
  const ReadFailure failure = read_whole(file, text);
  if (!failure.kind.empty()) {
    diagnostics.error(place, "this is " + failure.kind + ", and no file that could be read as a whole",
                      advice_for_kind(failure.kind));
    return std::nullopt;
  }
  if (failure.error != 0) {
    diagnostics.error(place, std::string("cannot read this file: ") + std::strerror(failure.error),
                      "check that it exists, is a file and may be read");
    return std::nullopt;
  }
  if (text.size() > max_file_size) {
    diagnostics.error(place, "this file is larger than " + size_text(max_file_size),
                      "name the table, list or data sheet that is meant");
    return std::nullopt;
  }
  return text;
}

bool check_named_file(const std::filesystem::path& file, std::string_view name, const Position& position,
                      Diagnostics& diagnostics) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT || errno == ENOTDIR)
      diagnostics.error(position, "there is no file " + quote(name),
                        "it is looked for at " + file.generic_string());
    else
      diagnostics.error(position, quote(name) + " cannot be read: " + std::strerror(errno),
                        "it is looked for at " + file.generic_string());
    return false;
  }
  const std::string kind = other_kind_of(status);
  if (kind.empty()) return true;
  diagnostics.error(position, quote(name) + " is " + kind + ", and no file that could be read as a whole",
                    advice_for_kind(kind));
  return false;
}

bool check_utf8(std::string_view text, std::string_view file, Diagnostics& diagnostics) {
  if (is_utf16(text)) {
    diagnostics.error(
        {file, 1, 1}, "this file is in UTF-16, as some editors and spreadsheets write it",
        "save it as UTF-8 in the editor, or: iconv -f UTF-16 -t UTF-8 " + std::string(file) + " > NEW");
    return false;
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character(text.substr(at));
    if (length > 0) {
      at += length;
      continue;
    }
    const auto byte = static_cast<unsigned char>(text[at]);
    std::array<char, 8> number{};
    std::snprintf(number.data(), number.size(), "0x%02X", byte);
    diagnostics.error(place_of(text, at, file),
                      std::string("this file is not in UTF-8: the byte ") + number.data() +
                          " begins no character" +
                          (byte >= 0xA0 ? "; in Latin-1 it is " + quote(latin(byte)) : ""),
                      advice_for(file));
    return false;
  }
  return true;
}

std::string with_plain_line_ends(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      plain += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      plain += '\n';
  }
  return plain;
}

bool check_nesting(std::string_view toml, std::string_view file, Diagnostics& diagnostics) {
  const auto place = NestingCheck(toml, file).run();
  if (!place) return true;
  diagnostics.error(
      *place, "tables, lists and dotted names are nested deeper than " + std::to_string(max_nesting),
      "no table needs that: look for brackets that are never closed, or for a name that was repeated");
  return false;
}

}  // namespace flexrf::config_gen
