#include "config-gen/read/device_list.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "config-gen/model/limits.hpp"
#include "config-gen/model/source_text.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/csv.hpp"
#include "config-gen/read/row.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

// Of a [device.N] row, but for the names of its drivers; a column of another name is a parameter of the
// configuration.
const std::vector<std::string>& keys_of_device() {
  static const std::vector<std::string> keys = {
      "name",    "interface", "drivers", "instead",      "on",      "io_thread", "initialise_timeout",
      "units",   "out",       "urdf",    "register_map", "runtime", "parameter", "configuration",
      "required"};
  return keys;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t") - begin + 1));
}

// ---- Cells as values

bool read_integer(std::string_view text, std::int64_t& value) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
  if (hexadecimal) text.remove_prefix(2);
  if (text.empty() || text.front() == '-') return false;
  const auto [end, failed] =
      std::from_chars(text.data(), text.data() + text.size(), value, hexadecimal ? 16 : 10);
  if (failed != std::errc{} || end != text.data() + text.size()) return false;
  if (negative) value = -value;
  return true;
}

bool read_real(std::string_view text, double& value) {
  // "nan" and "inf" are words.
  if (text.find_first_of("0123456789") == std::string_view::npos) return false;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  return failed == std::errc{} && end == text.data() + text.size();
}

// What a cell looks like; `text` keeps what it is where a text is asked for.
Node one_value(const CsvCell& cell, const std::string& text) {
  Node value;
  value.position = cell.position;
  value.cell = true;
  value.text = text;
  value.kind = Node::Kind::text;
  if (text == "true" || text == "TRUE" || text == "false" || text == "FALSE") {
    value.kind = Node::Kind::boolean;
    value.boolean = text == "true" || text == "TRUE";
  } else if (read_integer(text, value.integer)) {
    value.kind = Node::Kind::integer;
  } else if (read_real(text, value.real)) {
    value.kind = Node::Kind::real;
  }
  return value;
}

// "a | b" is a list, and so is what always is one.
Node value_of(const CsvCell& cell, bool always_list) {
  if (!always_list && cell.text.find('|') == std::string::npos) return one_value(cell, cell.text);
  Node list;
  list.position = cell.position;
  list.cell = true;
  list.text = cell.text;
  list.kind = Node::Kind::array;
  for (const std::string& part : split(cell.text, '|'))
    list.children.push_back(one_value(cell, without_blanks(part)));
  return list;
}

// ---- The tree

Node* find(Node& table, std::string_view key) {
  const auto found = std::find_if(table.children.begin(), table.children.end(),
                                  [key](const Node& child) { return child.key == key; });
  return found != table.children.end() ? &*found : nullptr;
}

Node& add(Node& table, Node child, const std::string& key, const Position& key_position) {
  child.key = key;
  child.key_position = key_position;
  table.children.push_back(std::move(child));
  return table.children.back();
}

Node table_at(const Position& position) {
  Node table;
  table.kind = Node::Kind::table;
  table.position = position;
  return table;
}

struct Column {
  std::size_t place = 0;
  std::vector<std::string> path;  // of keys, from the row
};

class ListReader {
 public:
  // `taken` are the devices that there are already, with their places.
  ListReader(const Node& node, const CsvTable& list, std::map<std::string, Position>& taken,
             Diagnostics& diagnostics)
      : node_(node), list_(list), taken_(taken), diagnostics_(diagnostics) {}

  // Nothing where what is wrong with the list is wrong with every row of it.
  std::optional<std::vector<Node>> read() {
    read_columns();
    read_common();
    if (list_.rows.empty())
      error(list_.header.front().position, "this list has no devices", "add a row for each device");
    if (list_.rows.size() > max_rows)
      error(list_.header.front().position,
            "this list has " + std::to_string(list_.rows.size()) + " rows, more than " +
                std::to_string(max_rows),
            "an application has no more rows than that");
    if (failed_) return std::nullopt;
    for (const CsvRow& row : list_.rows) read_row(row);
    return std::move(rows_);
  }

  bool failed() const { return failed_; }

 private:
  void error(const Position& position, std::string text, Hint hint) {
    failed_ = true;
    diagnostics_.error(position, std::move(text), std::move(hint));
  }

  // ---- What is the same in all rows

  void read_columns() {
    for (std::size_t place = 0; place < list_.header.size(); ++place) read_column(place);
    // A column that is missing is one that is misspelt, more often than not.
    if (failed_) return;
    const auto name = list_.required_column("name", diagnostics_);
    failed_ = !name;
    name_ = name.value_or(0);
    for (const char* const key : {"interface", "drivers"}) {
      if (node_.find(key) != nullptr || list_.column(key)) continue;
      error(node_.key_position,
            "[device_list." + node_.key + "] has no " + quote(key) + ", and its list no such column",
            std::string("add ") +
                (key == std::string_view("drivers") ? "drivers = [\"simulated\"]"
                                                    : "interface = \"DigitalIo\"") +
                ", or a column " + quote(key));
    }
  }

  void read_column(std::size_t place) {
    const CsvCell& header = list_.header[place];
    // For people only.
    if (header.text.empty() || header.text.starts_with('#') || header.text == "name") return;
    std::vector<std::string> path = split(header.text, '.');
    if (path.size() > max_nesting || std::find(path.begin(), path.end(), "") != path.end()) {
      error(header.position, quote(header.text) + " is no key of a device",
            "write it as configuration.line; of a column for people only, write a # before its name");
      return;
    }
    const std::vector<std::string>& keys = keys_of_device();
    if (path.size() == 1 && std::find(keys.begin(), keys.end(), header.text) == keys.end()) {
      // What is nearly a key was meant as one.
      Hint hint = suggest(header.text, keys, "columns", "");
      if (hint.replacement && hint.replacement->doubt.empty()) {
        error(header.position, "a list of devices has no column " + quote(header.text), std::move(hint));
        return;
      }
      path.insert(path.begin(), "configuration");
    }
    for (const Column& other : columns_) {
      if (other.path != path) continue;
      if (list_.header[other.place].text == header.text) return;  // which was reported
      error(header.position,
            quote(header.text) + " and " + quote(list_.header[other.place].text) + " are the same key",
            "remove one; the other is at " + to_string(list_.header[other.place].position));
      return;
    }
    columns_.push_back({place, std::move(path)});
  }

  void read_common() {
    common_ = node_;
    std::erase_if(common_.children, [](const Node& child) { return child.key == "file"; });
  }

  // ---- A row

  void read_row(const CsvRow& row) {
    const CsvCell& name = row[name_];
    if (name.text.empty()) {
      error(name.position, "this device has no name", "write it in lower_snake_case, as door_closed");
      return;
    }
    const auto [other, is_new] = taken_.emplace(name.text, name.position);
    if (!is_new) {
      error(name.position, "the device " + quote(name.text) + " is there twice",
            "rename one; the other is at " + to_string(other->second));
      return;
    }
    Node device = common_;
    device.key = name.text;
    device.position = device.key_position = name.position;
    device.listed = node_.key_position;
    for (const Column& column : columns_)
      if (!row[column.place].text.empty()) set(device, column, row[column.place]);
    rows_.push_back(std::move(device));
  }

  void set(Node& device, const Column& column, const CsvCell& cell) {
    const CsvCell& header = list_.header[column.place];
    Node* table = &device;
    for (std::size_t i = 0; i + 1 < column.path.size(); ++i) {
      Node* inner = find(*table, column.path[i]);
      if (inner == nullptr) inner = &add(*table, table_at(header.position), column.path[i], header.position);
      if (inner->kind != Node::Kind::table) {
        refuse(cell, column, *inner);
        return;
      }
      table = inner;
    }
    const std::string& key = column.path.back();
    Node value = value_of(cell, column.path.size() == 1 && key == "drivers");
    Node* const known = find(*table, key);
    if (known == nullptr) {
      add(*table, std::move(value), key, header.position);
    } else if (known->kind == Node::Kind::table) {
      refuse(cell, column, *known);
    } else {
      value.key = key;
      value.key_position = header.position;
      *known = std::move(value);
    }
  }

  // io_thread = true and io_thread.period: one is a part of the other.
  void refuse(const CsvCell& cell, const Column& column, const Node& other) {
    error(cell.position,
          quote(join(column.path, ".")) + " and " + quote(other.key) + " cannot both have a value",
          "leave the cell empty, or remove the other, at " + to_string(other.position));
  }

  const Node& node_;
  const CsvTable& list_;
  std::map<std::string, Position>& taken_;
  Diagnostics& diagnostics_;
  std::size_t name_ = 0;
  std::vector<Column> columns_;
  Node common_;  // of each row, where its cell is empty
  std::vector<Node> rows_;
  bool failed_ = false;
};

class Lists {
 public:
  Lists(const fs::path& folder, Diagnostics& diagnostics, std::vector<fs::path>& files)
      : folder_(folder), diagnostics_(diagnostics), files_(files) {}

  bool add_to(Node& table) {
    Node* const section = find(table, "device_list");
    if (section == nullptr) return true;
    const Node lists = std::move(*section);
    table.children.erase(table.children.begin() + (section - table.children.data()));
    if (lists.kind != Node::Kind::table) {
      diagnostics_.error(lists.position, "'device_list' must be a table, not " + kind_text(lists.kind),
                         "write rows as [device_list.NAME]");
      return false;
    }
    Node* devices = find(table, "device");
    if (devices == nullptr) devices = &add(table, table_at(lists.position), "device", lists.key_position);
    for (const Node& device : devices->children) taken_.emplace(device.key, device.key_position);
    for (const Node& list : lists.children) read(list, *devices);
    return good_;
  }

 private:
  void read(const Node& node, Node& devices) {
    if (node.kind != Node::Kind::table) {
      diagnostics_.error(node.key_position,
                         quote(node.key) + " in [device_list] must be a table, not " + kind_text(node.kind),
                         "write rows as [device_list.NAME]");
      good_ = false;
      return;
    }
    good_ = check_name(node, "a list of devices", true, diagnostics_) && good_;
    Row row(node, "[device_list." + node.key + "]", diagnostics_);
    const auto name =
        row.required_text("file", "add file = \"io_list.csv\", relative to the application's folder");
    const auto list = name ? read_file(*name, row.position("file")) : std::nullopt;
    if (!list) {
      good_ = false;
      return;
    }
    ListReader reader(node, *list, taken_, diagnostics_);
    auto rows = reader.read();
    good_ = good_ && !reader.failed();
    if (rows) std::move(rows->begin(), rows->end(), std::back_inserter(devices.children));
  }

  std::optional<CsvTable> read_file(const std::string& name, const Position& position) {
    const fs::path file = (folder_ / name).lexically_normal();
    if (name.find("${") != std::string::npos) {
      diagnostics_.error(position, "the list " + quote(name) + " would be another one for each instance",
                         "name one file; its cells may contain arguments, as TANK_${index}_FULL");
      return std::nullopt;
    }
    if (!check_named_file(file, name, position, diagnostics_)) return std::nullopt;
    files_.push_back(file);
    const std::size_t before = diagnostics_.errors();
    auto list = read_csv(file, diagnostics_);
    // Rows that do not fit are left out.
    if (diagnostics_.errors() != before) good_ = false;
    return list;
  }

  const fs::path& folder_;
  Diagnostics& diagnostics_;
  std::vector<fs::path>& files_;
  std::map<std::string, Position> taken_;
  bool good_ = true;
};

}  // namespace

bool add_listed_devices(Node& table, const fs::path& folder, Diagnostics& diagnostics,
                        std::vector<fs::path>& files) {
  return Lists(folder, diagnostics, files).add_to(table);
}

}  // namespace flexrf::config_gen
