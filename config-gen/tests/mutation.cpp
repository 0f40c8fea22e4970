#include "config-gen/tests/mutation.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "config-gen/model/file_contents.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/tests/catalogue_case.hpp"
#include "config-gen/tests/lines.hpp"

namespace flexrf::config_gen::tests {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view copied_endings[] = {".toml", ".csv", ".eds", ".urdf", ".js"};
constexpr std::string_view copied_folders[] = {"runtime", "hal", "units", "config-gen", "tests", "apps"};

// Names that mean something to C++, to the standard library, to the runtime or to config-gen.
constexpr std::string_view known_names[] = {"status",
                                            "slot",
                                            "unit",
                                            "device",
                                            "tick",
                                            "input",
                                            "output",
                                            "clock",
                                            "scalar",
                                            "role",
                                            "duration",
                                            "result",
                                            "text",
                                            "application",
                                            "thread",
                                            "class",
                                            "operator",
                                            "errno",
                                            "n_u_l_l",
                                            "e_o_f",
                                            "std",
                                            "flexrf",
                                            "main",
                                            "user",
                                            "int",
                                            "nan",
                                            "stdin",
                                            "linux",
                                            "assert",
                                            "sa_handler",
                                            "runtime",
                                            "feedback",
                                            "step",
                                            "name",
                                            "fault",
                                            "configuration",
                                            "type_descriptor",
                                            "byte_range",
                                            "index",
                                            "signal",
                                            "observer",
                                            "x_x2",
                                            "values",
                                            "name_of",
                                            "descriptor"};

constexpr std::string_view values[] = {"0",
                                       "-1",
                                       "1",
                                       "2.5",
                                       "4096",
                                       "4097",
                                       "65536",
                                       "2147483647",
                                       "2147483648",
                                       "4294967295",
                                       "9223372036854775807",
                                       "-9223372036854775808",
                                       "9007199254740993",
                                       "1e308",
                                       "-1e308",
                                       "inf",
                                       "nan",
                                       "1e-320",
                                       "true",
                                       "false",
                                       "\"\"",
                                       "\"0 ms\"",
                                       "\"1 ns\"",
                                       "\"9223372036 s\"",
                                       "\"2500000 h\"",
                                       "\"8 GiB\"",
                                       "\"8000000 GiB\"",
                                       "\"1 B\"",
                                       "[]",
                                       "[1]",
                                       "[0, 0]",
                                       "[4096, 4096]",
                                       "{}",
                                       "{ a = 1 }",
                                       "1979-05-27",
                                       "\"${index}\"",
                                       "\"${\"",
                                       "[[1, 2], [3, 4]]",
                                       "[\"a\", \"a\"]",
                                       "0x7fff"};

constexpr std::string_view texts[] = {"ends in a backslash \\\\",
                                      "two\\nlines",
                                      "three\\n\\nlines\\\\\\n",
                                      "*/ int x; /*",
                                      "?\?/",
                                      "a \\\" quote",
                                      "\\u0000",
                                      "\\t",
                                      "\\U0001F916",
                                      "R\\\"(",
                                      "%s%n",
                                      "</script>",
                                      "\\u2028",
                                      "${index}"};

constexpr std::string_view keys[] = {"capacity", "count",        "shape", "loans",   "history", "stack",
                                     "budget",   "min_interval", "on",    "default", "range",   "type"};

std::string repeated(std::string_view part, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += part;
  return text;
}

std::string sixteen_bits(const std::string& text, bool big) {
  std::string wide = big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) {
    if (big) wide += '\0';
    wide += c;
    if (!big) wide += '\0';
  }
  return wide;
}

// Where the quoted words of a line begin and end, quotes left out.
std::vector<std::pair<std::size_t, std::size_t>> quoted_in(const std::string& line) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  std::size_t open = std::string::npos;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '"') continue;
    if (open == std::string::npos) {
      open = i + 1;
    } else {
      places.emplace_back(open, i);
      open = std::string::npos;
    }
  }
  return places;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string with_word(const std::string& text, const std::string& from, const std::string& to) {
  std::string result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t found = text.find(from, at);
    if (found == std::string::npos) break;
    const std::size_t end = found + from.size();
    const bool whole =
        (found == 0 || !is_letter(text[found - 1])) && (end == text.size() || !is_letter(text[end]));
    result += text.substr(at, found - at) + (whole ? to : from);
    at = end;
  }
  return result + text.substr(std::min(at, text.size()));
}

// ---- Changes of one file

class Change {
 public:
  Change(const TableTree& tree, const Cell& cell, Dice& dice, std::string text)
      : tree_(tree), cell_(cell), dice_(dice), text_(std::move(text)), lines_(lines_of(text_)) {}

  std::string result() {
    // Most files stay tables, so that what comes after the parser is reached.
    if (dice_.one_in(24)) return of_bytes();
    if (dice_.one_in(40)) return of_depth();
    if (lines_.empty()) return of_bytes();
    const std::size_t times = 1 + dice_.below(3);
    for (std::size_t i = 0; i < times && !lines_.empty(); ++i) of_lines();
    return joined(lines_);
  }

 private:
  std::string& any_line() { return lines_[dice_.below(lines_.size())]; }
  void insert(std::string line) {
    lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(dice_.below(lines_.size() + 1)),
                  std::move(line));
  }

  std::string of_bytes() {
    switch (dice_.below(9)) {
      case 0:
        return text_.substr(0, dice_.below(text_.size() + 1));
      case 1:
        return sixteen_bits(text_, dice_.one_in(2));
      case 2:
        return "\xEF\xBB\xBF" + text_;
      case 3:
        std::replace(text_.begin(), text_.end(), '\n', '\r');
        return text_;
      case 4: {
        std::string both;
        for (const char c : text_) both += c == '\n' ? "\r\n" : std::string(1, c);
        return both;
      }
      case 5: {
        const std::size_t from = dice_.below(text_.size() + 1);
        return text_.erase(from, dice_.below(40));
      }
      case 6:
        return text_ + text_;
      case 7:
        for (std::size_t i = 0; i < 3 && !text_.empty(); ++i)
          text_[dice_.below(text_.size())] = static_cast<char>(dice_.below(256));
        return text_;
      default:
        return text_.insert(dice_.below(text_.size() + 1),
                            std::string(1, static_cast<char>(dice_.below(256))));
    }
  }

  // As deep, or as many, as no person writes.
  std::string of_depth() {
    constexpr std::size_t depths[] = {10, 100, 1000, 5000, 50000};
    const std::size_t depth = dice_.of(depths);
    switch (dice_.below(6)) {
      case 0:
        return repeated("a.", depth) + "a = 1\n" + text_;
      case 1:
        return "a = " + repeated("[", depth) + repeated("]", depth) + "\n" + text_;
      case 2:
        return "a = " + repeated("{ a = ", depth) + "1" + repeated(" }", depth) + "\n" + text_;
      case 3:
        return text_ + "\n[" + repeated("a.", depth) + "a]\n";
      case 4:
        return text_ + "\n[slot." + repeated("a", depth) + "]\n";
      default: {
        std::string many = text_ + "\n";
        for (std::size_t i = 0; i < std::min<std::size_t>(depth, 5000); ++i)
          many += "[slot.s" + std::to_string(i) + "]\n";
        return many;
      }
    }
  }

  void of_lines() {
    switch (dice_.below(15)) {
      case 0:
        lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(dice_.below(lines_.size())));
        break;
      case 1:
        insert(any_line());
        break;
      case 2:
        std::swap(any_line(), any_line());
        break;
      case 3: {
        const auto other = lines_of(contents_of(dice_.of(cell_.files)));
        if (!other.empty()) insert(dice_.of(other));
        break;
      }
      case 4:
      case 5:
        other_value(std::string(dice_.of(values)));
        break;
      case 6:
        other_value("\"" + std::string(dice_.of(texts)) + "\"");
        break;
      case 7:
      case 8:
      case 9:
        other_word();
        break;
      case 10:
      case 11:
        other_number();
        break;
      case 12:
        other_name();
        break;
      case 13:
        insert(std::string(dice_.of(keys)) + " = " + std::string(dice_.of(values)));
        break;
      default:
        twice();
        break;
    }
  }

  void other_value(const std::string& value) {
    std::string& line = any_line();
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos) line = line.substr(0, equals + 1) + " " + value;
  }

  void other_word() {
    std::string& line = any_line();
    const auto places = quoted_in(line);
    if (places.empty()) return;
    const auto [from, to] = dice_.of(places);
    const std::string word = dice_.one_in(3) ? std::string(dice_.of(known_names)) : dice_.of(tree_.words());
    line.replace(from, to - from, dice_.one_in(6) ? camel_case(word) : word);
  }

  void other_number() {
    constexpr std::string_view numbers[] = {
        "0", "1", "2", "7", "63", "64", "256", "4095", "4096", "1000000", "268435456", "9223372036854775807"};
    std::string& line = any_line();
    const std::size_t from = line.find_first_of("0123456789");
    if (from == std::string::npos) return;
    const std::size_t to = std::min(line.find_first_not_of("0123456789", from), line.size());
    line.replace(from, to - from, dice_.of(numbers));
  }

  // Of a table or a key.
  void other_name() {
    std::string& line = any_line();
    const std::string name = dice_.one_in(2) ? std::string(dice_.of(known_names)) : dice_.of(tree_.words());
    if (line.starts_with("[") && line.find('.') != std::string::npos) {
      line = line.substr(0, line.find('.') + 1) + name + "]";
    } else if (const std::size_t equals = line.find('='); equals != std::string::npos) {
      line = name + " " + line.substr(equals);
    }
  }

  // A whole table once more, under another name.
  void twice() {
    std::vector<std::size_t> heads;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].starts_with("[") && lines_[i].find('.') != std::string::npos) heads.push_back(i);
    if (heads.empty()) return;
    const std::size_t head = dice_.of(heads);
    std::vector<std::string> copy{lines_[head].substr(0, lines_[head].find('.') + 1) +
                                  (dice_.one_in(3) ? std::string(dice_.of(known_names)) : "again") + "]"};
    for (std::size_t i = head + 1; i < lines_.size() && !lines_[i].starts_with("["); ++i)
      copy.push_back(lines_[i]);
    lines_.insert(lines_.end(), copy.begin(), copy.end());
  }

  const TableTree& tree_;
  const Cell& cell_;
  Dice& dice_;
  std::string text_;
  std::vector<std::string> lines_;
};

}  // namespace

void write_file(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

std::uint64_t Dice::next() {
  state_ += 0x9E3779B97F4A7C15U;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

TableTree::TableTree(const fs::path& repository) {
  std::set<std::string> words;
  for (const std::string_view folder : copied_folders)
    for (const auto& entry : fs::recursive_directory_iterator(repository / folder)) {
      const fs::path place = root() / fs::relative(entry.path(), repository);
      const auto is_copied = [&](std::string_view ending) { return entry.path().extension() == ending; };
      if (!entry.is_regular_file() || place.string().find("/catalogue/") != std::string::npos ||
          std::none_of(std::begin(copied_endings), std::end(copied_endings), is_copied))
        continue;
      fs::create_directories(place.parent_path());
      fs::copy_file(entry.path(), place);
      if (place.extension() != ".toml") continue;
      for (const std::string& line : lines_of(contents_of(place)))
        for (const auto& [from, to] : quoted_in(line)) words.insert(line.substr(from, to - from));
    }
  words_.assign(words.begin(), words.end());

  const fs::path tests = root() / "config-gen/tests";
  for (const fs::path& file : case_files(repository / "config-gen/tests/catalogue"))
    write_cell(read_case(file).files, tests / "catalogue" / file.stem());
  SearchPaths small;
  small.types = {tests / "base/types"};
  small.units = {tests / "base/units"};
  small.interfaces = {tests / "base/hal/interfaces"};
  small.drivers = {tests / "base/hal/linux", tests / "base/hal/simulated"};
  SearchPaths large;
  large.library = {root() / "runtime", root() / "hal"};
  large.types = {root() / "runtime/types"};
  large.units = {root() / "units"};
  large.interfaces = {root() / "hal"};
  large.drivers = {root() / "hal"};
  for (const char* part : {"generator", "panel", "applications"}) {
    large.interfaces.push_back(root() / "tests" / part / "interfaces");
    large.drivers.push_back(root() / "tests" / part / "drivers");
  }
  large.drivers.push_back(root() / "apps/pick-station/drivers");
  for (const char* table : {"apps/keyboard/keyboard", "apps/keyboard-single/keyboard_single",
                            "apps/pick-station/pick_station", "tests/generator/cell/generated_cell",
                            "tests/panel/cell/panel_cell", "tests/applications/crowd/crowd"})
    add(root() / (std::string(table) + ".toml"), large);
  for (const char* part : {"cells", "catalogue"}) {
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(tests / part)) folders.push_back(entry.path());
    std::sort(folders.begin(), folders.end());
    for (const fs::path& folder : folders) {
      SearchPaths paths = small;
      paths.interfaces.push_back(folder / "hal/interfaces");
      paths.drivers.push_back(folder / "hal/drivers");
      if (fs::exists(folder / "cell.toml")) add(folder / "cell.toml", paths);
    }
  }
}

void TableTree::add(const fs::path& table, const SearchPaths& paths) {
  Diagnostics diagnostics;
  const Model model = read({Target::Kind::application, table}, paths, diagnostics);
  cells_.push_back({table, paths, model.files});
}

Mutation::Mutation(const TableTree& tree, const Cell& cell, std::uint64_t number,
                   const std::function<bool(const fs::path&)>& may_change) {
  Dice dice(number);
  std::vector<fs::path> files;
  std::copy_if(cell.files.begin(), cell.files.end(), std::back_inserter(files), may_change);
  if (dice.one_in(4)) rename_word(cell, dice, may_change);
  const std::size_t changes = renamed_.empty() ? 1 + dice.below(2) : 0;
  for (std::size_t i = 0; i < changes && !files.empty(); ++i) {
    const fs::path& file = dice.one_in(2) && may_change(cell.table) ? cell.table : dice.of(files);
    store(file, Change(tree, cell, dice, contents_of(file)).result());
  }
}

// A type or a unit gets another name, in all tables and in those of its file and folder.
void Mutation::rename_word(const Cell& cell, Dice& dice,
                           const std::function<bool(const fs::path&)>& may_change) {
  std::vector<fs::path> tables;
  for (const fs::path& file : cell.files)
    if (file != cell.table && file.extension() == ".toml" && may_change(file)) tables.push_back(file);
  if (tables.empty()) return;
  const fs::path table = dice.of(tables);
  const std::string from = table.stem().string(), to(dice.of(known_names));
  const bool has_folder = table.parent_path().filename() == from;
  const fs::path place =
      (has_folder ? table.parent_path().parent_path() / to : table.parent_path()) / (to + ".toml");
  if (fs::exists(place)) return;
  for (const fs::path& file : cell.files)
    if (file.extension() == ".toml" && may_change(file))
      store(file, with_word(with_word(contents_of(file), from, to), camel_case(from), camel_case(to)));
  if (has_folder) {
    renamed_.emplace_back(table.parent_path() / (from + ".toml"), table.parent_path() / (to + ".toml"));
    fs::rename(renamed_.back().first, renamed_.back().second);
    renamed_.emplace_back(table.parent_path(), place.parent_path());
  } else {
    renamed_.emplace_back(table, place);
  }
  fs::rename(renamed_.back().first, renamed_.back().second);
}

Mutation::~Mutation() {
  for (auto one = renamed_.rbegin(); one != renamed_.rend(); ++one) fs::rename(one->second, one->first);
  for (const auto& [file, text] : before_) write_file(file, text);
}

void Mutation::store(const fs::path& file, const std::string& text) {
  before_.try_emplace(file, contents_of(file));
  write_file(file, text);
}

std::string Mutation::description() const {
  constexpr std::size_t most_lines = 12, most_letters = 160;
  std::string text;
  for (const auto& [from, to] : renamed_) text += from.string() + " is now " + to.string() + "\n";
  if (!renamed_.empty()) return text;
  for (const auto& [file, old] : before_) {
    text += file.string() + ":\n";
    const auto was = lines_of(old), is = lines_of(contents_of(file));
    std::size_t shown = 0;
    const auto show = [&](char mark, const auto& lines, const auto& others) {
      for (const std::string& line : lines)
        if (std::find(others.begin(), others.end(), line) == others.end() && shown++ < most_lines)
          text += std::string("  ") + mark + " " + line.substr(0, most_letters) + "\n";
    };
    show('-', was, is);
    show('+', is, was);
  }
  return text;
}

}  // namespace flexrf::config_gen::tests
