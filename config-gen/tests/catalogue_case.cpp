#include "config-gen/tests/catalogue_case.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <regex>
#include <stdexcept>
#include <utility>

#include "config-gen/model/file_contents.hpp"
#include "config-gen/tests/lines.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string>;

constexpr char messages_header[] = "--- messages";

struct Section {
  std::string verb, file, encoding;
  std::optional<std::pair<int, int>> numbers;  // first and last of its `for`
  Lines lines;
};

void require(bool condition, const std::string& reason) {
  if (!condition) throw std::runtime_error(reason);
}

Section section_of(const std::string& header) {
  static const std::regex form(
      R"(--- (change|write|append|remove) (\S+)(?: in (UTF-16|UTF-16BE))?(?: for n = (\d{1,5})\.\.(\d{1,5}))?)");
  std::smatch parts;
  require(std::regex_match(header, parts, form), "this is no section: " + header);
  Section section{parts[1], parts[2], parts[3], {}, {}};
  require(section.encoding.empty() || section.verb == "write",
          "only a file that is written has an encoding: " + header);
  if (parts[4].matched) section.numbers = {std::stoi(parts[4]), std::stoi(parts[5])};
  require(!section.numbers || section.numbers->first <= section.numbers->second,
          "there is no such number: " + header);
  return section;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

Section numbered(Section section, int number) {
  const auto put = [number](std::string& text) {
    text = replaced(replaced(text, "<n>", std::to_string(number)), "<n+1>", std::to_string(number + 1));
  };
  put(section.file);
  for (std::string& line : section.lines) put(line);
  return section;
}

std::string with_bytes(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "\\x") != 0) {
      bytes += text[i];
      continue;
    }
    const std::string digits = text.substr(i + 2, 2);
    require(digits.size() == 2 && digits.find_first_not_of("0123456789ABCDEF") == std::string::npos,
            "\\x is followed by two digits of a byte: " + text);
    bytes += static_cast<char>(std::stoi(digits, nullptr, 16));
    i += 3;
  }
  return bytes;
}

std::string encoded(const std::string& text, const std::string& encoding) {
  if (encoding.empty()) return text;
  const bool big = encoding == "UTF-16BE";
  std::string wide = big ? "" : "\xFF\xFE";
  for (const char c : text) {
    require(static_cast<unsigned char>(c) < 128, "only ASCII is written in UTF-16");
    wide += big ? std::string{'\0', c} : std::string{c, '\0'};
  }
  return wide;
}

// ---- Changes of tables

// The lines below a table's header, without the empty ones at their end.
struct Span {
  std::size_t begin, end;
};

// What stands before the first table has an empty header.
std::optional<Span> find_table(const Lines& lines, const std::string& header) {
  std::size_t begin = 0;
  if (!header.empty()) {
    const auto found = std::find(lines.begin(), lines.end(), header);
    if (found == lines.end()) return {};
    begin = static_cast<std::size_t>(found - lines.begin()) + 1;
  }
  std::size_t end = begin;
  while (end < lines.size() && !lines[end].starts_with("[")) ++end;
  while (end > begin && lines[end - 1].empty()) --end;
  return Span{begin, end};
}

auto line_at(Lines& lines, std::size_t index) {
  return lines.begin() + static_cast<std::ptrdiff_t>(index);
}

std::string key_of(const std::string& line) {
  const std::size_t equals = line.find('=');
  require(equals != std::string::npos, "this is neither [table] nor key = value: " + line);
  return line.substr(0, line.find_last_not_of(' ', equals - 1) + 1);
}

class Change {
 public:
  explicit Change(Lines lines) : lines_(std::move(lines)) {}

  std::string result(const Lines& edits) {
    for (const std::string& edit : edits) {
      if (edit.empty()) continue;
      if (edit.starts_with("- [")) {
        leave_out_table(edit.substr(2));
      } else if (edit.starts_with("[")) {
        enter(edit);
      } else {
        require(table_.has_value(), "it is not said in which table: " + edit);
        idle_ = false;
        if (edit.starts_with("- "))
          leave_out_key(edit.substr(2));
        else
          set_key(edit);
      }
    }
    require(!idle_, "nothing is changed in " + table_.value_or(""));
    return joined(lines_);
  }

 private:
  void enter(const std::string& header) {
    require(!idle_, "nothing is changed in " + table_.value_or(""));
    table_ = header;
    idle_ = find_table(lines_, header).has_value();
    if (!idle_) lines_.insert(lines_.end(), {"", header});
  }

  void leave_out_table(const std::string& header) {
    const auto span = find_table(lines_, header);
    require(span.has_value(), "there is no table to leave out: " + header);
    std::size_t begin = span->begin - 1;
    if (begin > 0 && lines_[begin - 1].empty()) --begin;
    lines_.erase(line_at(lines_, begin), line_at(lines_, span->end));
    table_.reset();
  }

  // Its line, or the end of the table.
  std::size_t find_key(const std::string& key) {
    const Span span = *find_table(lines_, *table_);
    for (std::size_t i = span.begin; i < span.end; ++i)
      if (lines_[i].find('=') != std::string::npos && key_of(lines_[i]) == key) return i;
    return span.end;
  }

  bool is_end(std::size_t index) { return index == find_table(lines_, *table_)->end; }

  void leave_out_key(const std::string& key) {
    const std::size_t index = find_key(key);
    require(!is_end(index), "there is no key to leave out in " + *table_ + ": " + key);
    lines_.erase(line_at(lines_, index));
  }

  void set_key(const std::string& line) {
    const std::size_t index = find_key(key_of(line));
    if (is_end(index)) {
      lines_.insert(line_at(lines_, index), line);
      return;
    }
    require(lines_[index] != line, "so it is already in " + *table_ + ": " + line);
    lines_[index] = line;
  }

  Lines lines_;
  std::optional<std::string> table_ = "";
  bool idle_ = false;  // in a table of which nothing has been changed yet
};

// ---- Sections

void carry_out(const Section& section, Files& files) {
  const std::string& file = section.file;
  const bool exists = files.contains(file);
  require(exists || section.verb == "write", "the base has no file " + file);
  require(section.lines.empty() == (section.verb == "remove"), "what is to be done with " + file + "?");
  if (section.verb == "remove") {
    files.erase(file);
    return;
  }
  const std::string text = with_bytes(joined(section.lines));
  if (section.verb == "append") {
    files[file] += text;
    return;
  }
  const std::string written = section.verb == "change" ? Change(lines_of(files[file])).result(lines_of(text))
                                                       : encoded(text, section.encoding);
  require(!exists || files[file] != written, "nothing is changed in " + file);
  files[file] = written;
}

std::size_t messages_begin(const std::string& text) {
  const std::string header = std::string(messages_header) + "\n";
  const std::size_t at = text.find("\n" + header);
  require(at != std::string::npos, std::string("there is no ") + messages_header);
  return at + 1 + header.size();
}

Case case_of(const fs::path& file) {
  const std::string text = contents_of(file);
  const std::size_t end = messages_begin(text);
  Case result;
  result.messages = text.substr(end);
  std::vector<Section> sections;
  for (const std::string& line : lines_of(text.substr(0, end))) {
    if (line == messages_header) break;
    if (line.starts_with("--- ")) {
      sections.push_back(section_of(line));
    } else if (!sections.empty()) {
      sections.back().lines.push_back(line);
    } else if (line.starts_with("base: ") && result.files.empty()) {
      const fs::path base = file.parent_path() / "base" / line.substr(6);
      require(fs::is_directory(base), "there is no " + line);
      result.files = files_in(base);
    } else {
      require(line.empty(), "this line is in no section: " + line);
    }
  }
  require(!sections.empty(), "nothing differs from the base");
  for (Section& section : sections) {
    while (!section.lines.empty() && section.lines.back().empty()) section.lines.pop_back();
    const auto [first, last] = section.numbers.value_or(std::pair(0, 0));
    for (int n = first; n <= last; ++n)
      carry_out(section.numbers ? numbered(section, n) : section, result.files);
  }
  return result;
}

}  // namespace

Case read_case(const fs::path& file) try { return case_of(file); } catch (const std::runtime_error& error) {
  throw std::runtime_error(file.generic_string() + ": " + error.what());
}

void rewrite_messages(const fs::path& file, const std::string& messages) {
  const std::string text = contents_of(file);
  std::ofstream(file, std::ios::binary) << text.substr(0, messages_begin(text)) << messages;
}

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).generic_string()] = contents_of(entry.path());
  return files;
}

std::vector<fs::path> case_files(const fs::path& catalogue) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(catalogue))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.stem() < b.stem(); });
  return files;
}

void write_cell(const Files& files, const fs::path& folder) {
  for (const auto& [name, text] : files) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
  }
}

}  // namespace flexrf::config_gen::tests
