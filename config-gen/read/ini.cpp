#include "config-gen/read/ini.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "base/ascii.hpp"
#include "config-gen/model/source_text.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

// What a file is that is no text of sections; empty when it may be one.
std::string other_kind_of_file(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return "a text in UTF-16";
  if (text.find('\0') != std::string_view::npos) return "no text";
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return "empty";
  return text[first] == '<' ? "a text in XML" : "";
}

class Lines {
 public:
  Lines(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  bool next() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    return true;
  }
  std::string_view line() const { return line_; }
  // Of what begins at this byte of the line; characters of several bytes count once.
  Position position(std::size_t byte) const {
    const auto columns = std::count_if(line_.begin(), line_.begin() + static_cast<std::ptrdiff_t>(byte),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    return {file_, number_, static_cast<std::uint32_t>(columns + 1)};
  }
  // From `begin` to `end` without the blanks around, and where it begins.
  std::pair<std::string_view, Position> part(std::size_t begin, std::size_t end) const {
    while (begin < end && is_blank(line_[begin])) ++begin;
    while (end > begin && is_blank(line_[end - 1])) --end;
    return {line_.substr(begin, end - begin), position(begin)};
  }

 private:
  std::string_view text_;
  std::string_view file_;
  std::string_view line_;
  std::size_t at_ = 0;
  std::uint32_t number_ = 0;
};

class IniReader {
 public:
  explicit IniReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  std::vector<IniSection> read(Lines& lines) {
    while (lines.next()) read_line(lines);
    if (stray_ > 0)
      diagnostics_.warning(
          first_stray_,
          "this line is neither [section] nor key=value" +
              (stray_ == 1 ? std::string() : " (and " + std::to_string(stray_ - 1) + " more such lines)"),
          "it is left out: a comment begins with ';'");
    return std::move(sections_);
  }

 private:
  void read_line(const Lines& lines) {
    const std::string_view line = lines.line();
    const auto [whole, start] = lines.part(0, line.size());
    if (whole.empty() || whole.front() == ';' || whole.front() == '#') return;
    if (whole.front() == '[') {
      read_section(whole, start);
      return;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || sections_.empty()) {
      if (++stray_ == 1) first_stray_ = start;
      return;
    }
    const auto [key, key_position] = lines.part(0, equals);
    const auto [value, position] = lines.part(equals + 1, line.size());
    if (leave_out_) return;
    if (!keys_.insert(in_small_letters(key)).second) {
      diagnostics_.warning(key_position, "the key " + quote(key) + " is there twice in its section",
                           "the first counts");
      return;
    }
    sections_.back().entries.push_back({std::string(key), std::string(value), key_position, position});
  }

  void read_section(std::string_view whole, const Position& start) {
    const std::size_t end = whole.find(']');
    if (end == std::string_view::npos)
      diagnostics_.warning(start, "the ']' of this section is missing", "is the file truncated?");
    std::string_view name = whole.substr(1, end == std::string_view::npos ? end : end - 1);
    while (!name.empty() && is_blank(name.front())) name.remove_prefix(1);
    while (!name.empty() && is_blank(name.back())) name.remove_suffix(1);
    const auto [known, is_new] = known_.try_emplace(in_small_letters(name), start);
    keys_.clear();
    leave_out_ = !is_new;
    if (leave_out_)
      diagnostics_.warning(start, "the section " + quote(name) + " is there twice",
                           "the first counts, at " + to_string(known->second));
    else
      sections_.push_back({std::string(name), start, {}});
  }

  Diagnostics& diagnostics_;
  std::vector<IniSection> sections_;
  std::map<std::string, Position> known_;  // by its name in small letters
  std::set<std::string> keys_;             // of the section that is read, likewise
  bool leave_out_ = false;
  std::size_t stray_ = 0;
  Position first_stray_;
};

}  // namespace

std::string in_small_letters(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower_case);
  return result;
}

const IniEntry* IniSection::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const IniEntry& entry) { return equal_without_case(entry.key, key); });
  return found == entries.end() ? nullptr : &*found;
}

std::optional<std::vector<IniSection>> parse_ini(std::string_view text, const std::filesystem::path& file,
                                                 Diagnostics& diagnostics) {
  const std::string_view name = intern(file.generic_string());
  const std::string other = other_kind_of_file(text);
  if (!other.empty()) {
    diagnostics.error({name, 1, 1}, "this is no EDS file: it is " + other,
                      "name the vendor's file as it is downloaded, NAME.eds");
    return std::nullopt;
  }
  if (text.starts_with(utf8_mark)) text.remove_prefix(utf8_mark.size());
  Lines lines(text, name);
  std::vector<IniSection> sections = IniReader(diagnostics).read(lines);
  if (sections.empty()) {
    diagnostics.error({name, 1, 1}, "this is no EDS file: it has no [section]",
                      "name the vendor's file as it is downloaded, NAME.eds");
    return std::nullopt;
  }
  return sections;
}

std::optional<std::vector<IniSection>> read_ini(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const auto text = read_source(file, diagnostics);
  return text ? parse_ini(with_plain_line_ends(*text), file, diagnostics) : std::nullopt;
}

}  // namespace flexrf::config_gen
