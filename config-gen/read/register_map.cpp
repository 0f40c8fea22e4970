// Register maps of Modbus stations: every row is checked by itself, then all rows against each other.
#include "config-gen/read/register_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "config-gen/model/words.hpp"
#include "config-gen/read/csv_rows.hpp"
#include "config-gen/read/quantities.hpp"

namespace flexrf::config_gen {
namespace {

enum Area : std::size_t { coil, discrete_input, holding_register, input_register };
constexpr std::size_t boolean = 0;       // in register_types
constexpr std::size_t read_only = 0;     // in register_accesses
constexpr std::size_t write_only = 1;    // likewise
constexpr std::size_t first_double = 3;  // types from here on have two registers
constexpr std::size_t first_long = 6;    // and from here on four
constexpr std::size_t text_type = 9;     // and this one as many as its row says
constexpr std::size_t swaps_bytes = 2;   // in register_word_orders
constexpr std::uint16_t whole = 0xFFFF;  // all bits of a register
const std::vector<std::string> yes_and_no = {"yes", "no"};

struct Range {
  double least;
  double most;
};
// Of the raw value, in the order of register_types.
constexpr std::array<Range, 10> raw_ranges = {{{0, 1},
                                               {-32768, 32767},
                                               {0, 65535},
                                               {-2147483648.0, 2147483647.0},
                                               {0, 4294967295.0},
                                               {-3.4e38, 3.4e38},
                                               {-9223372036854775808.0, 9223372036854775807.0},
                                               {0, 18446744073709551615.0},
                                               {-1.7e308, 1.7e308},
                                               {0, 0}}};

bool is_fraction(std::size_t type) {
  return register_types[type][0] == 'f';
}

std::size_t words_of(const ModbusRegister& entry) {
  if (entry.type == text_type) return entry.length;
  return entry.type >= first_long ? 4 : entry.type >= first_double ? 2 : 1;
}

/// Bits of a register, and who has them.
struct Taken {
  std::string name;
  std::uint16_t bits;
  bool refreshed;
};

class MapReader : CsvRowReader {
  enum Column {
    name,
    address,
    bit,
    type,
    area,
    word_order,
    scale,
    unit,
    access,
    poll_group,
    safe_value,
    refresh,
    offset,
    missing,
    scale_register,
    length,
    columns
  };
  static constexpr std::array<const char*, columns> column_names = {
      "name",   "address",    "bit",        "type",    "area",   "word_order", "scale",          "unit",
      "access", "poll_group", "safe_value", "refresh", "offset", "missing",    "scale_register", "length"};

 public:
  MapReader(const CsvTable& table, Diagnostics& diagnostics)
      : CsvRowReader(table, column_names, "a register map", "", diagnostics) {}

  std::optional<RegisterMap> read() {
    if (!find_columns({name, address, type, access})) return std::nullopt;
    for (const CsvRow& row : table_.rows) {
      row_ = &row;
      read_row();
    }
    if (table_.rows.empty())
      error(table_.header.front(), "this register map has no registers", "add a row for each value");
    find_scale_registers();
    check_sizes();
    if (failed_) return std::nullopt;
    return std::move(map_);
  }

 private:
  std::optional<std::size_t> required_word(Column column, const std::vector<std::string>& words) {
    if (cell(column) == nullptr) {
      error(place(column), "the register " + quote(entry_.name) + " has no " + column_names[column],
            "write one of " + listed(words));
      return std::nullopt;
    }
    return word(column, words);
  }

  void read_row() {
    const bool failed_before = failed_;
    failed_ = false;
    entry_ = {};
    read_name();
    const auto type_word = required_word(type, register_types);
    const auto access_word = required_word(access, register_accesses);
    entry_.type = type_word.value_or(boolean);
    entry_.access = access_word.value_or(read_only);
    entry_.poll_group = word(poll_group, register_poll_groups).value_or(0);
    read_unit();
    if (type_word && access_word) {
      read_length();
      read_bit();
      read_area();
      read_word_order();
      if (entry_.type != text_type) read_scaling();
      read_safe_value();
      read_refresh();
    }
    read_address();
    if (!failed_) {
      check_against_others();
      if (const CsvCell* found = cell(scale_register)) scaled_.emplace_back(map_.registers.size(), found);
      map_.registers.push_back(entry_);
    }
    failed_ = failed_ || failed_before;
  }

  void read_name() {
    entry_.name = place(name).text;
    if (!is_snake_case(entry_.name))
      error(place(name), quote(entry_.name) + " is not a name for a register",
            "write it in lower_snake_case, as tank_pressure");
    const auto [known, fresh] = names_.emplace(entry_.name, place(name).position);
    if (!fresh)
      error(place(name), "the register " + quote(entry_.name) + " is there twice",
            "rename one; the other is at " + to_string(known->second));
  }

  void read_area() {
    const bool writes = entry_.access != read_only;
    const bool is_bit = entry_.type == boolean && cell(bit) == nullptr;
    const std::size_t usual = !is_bit ? holding_register : writes ? coil : discrete_input;
    entry_.area = word(area, register_areas).value_or(usual);
    const std::string& called = register_areas[entry_.area];
    const bool has_bits = entry_.area == coil || entry_.area == discrete_input;
    if (has_bits && entry_.type == boolean && cell(bit) != nullptr)
      error(place(bit), "a " + called + " is one bit, and has none to choose",
            "leave the cell empty, or make the area holding_register or input_register");
    else if (is_bit != has_bits)
      error(place(area), quote(called) + " cannot be a " + register_types[entry_.type],
            is_bit ? "a bool is a coil or a discrete_input; for one of a register name its bit"
                   : "a coil and a discrete_input are a bool");
    else if (writes && (entry_.area == discrete_input || entry_.area == input_register))
      error(place(access), quote(called) + " cannot be written",
            std::string("make its access read, or it a ") + (is_bit ? "coil" : "holding_register"));
  }

  void read_unit() {
    const CsvCell* found = cell(unit);
    if (found == nullptr) return;
    entry_.unit = found->text;
    if (std::string advice = judge_unit(found->text, UnitUse::device); !advice.empty()) {
      error(*found, quote(found->text) + " is no unit of measure", std::move(advice));
      return;
    }
    // A valve's position may be read as a part of its way.
    const bool is_share = found->text == "1" || found->text == "%" || found->text == "ppm";
    const std::string instead = is_share ? "" : units_instead(entry_.name, found->text);
    if (!instead.empty())
      error(*found, quote(found->text) + " does not measure what " + quote(entry_.name) + " is by its name",
            "write a unit that measures it, as " + instead + ", or name the register by what it is");
  }

  void read_word_order() {
    const auto order = word(word_order, register_word_orders, "only the device's manual tells its order");
    entry_.word_order = order.value_or(0);
    if (order && entry_.type == text_type && *order != 0 && *order != swaps_bytes)
      error(place(word_order), "the registers of a text come in their order",
            "leave the cell empty, or write badc where the first character is in the low byte");
    else if (order && words_of(entry_) == 1 && entry_.type != text_type)
      error(place(word_order), quote(register_types[entry_.type]) + " has no word_order",
            "leave the cell empty: only what has several registers has one");
  }

  void read_scale() {
    const CsvCell* found = cell(scale);
    if (found == nullptr) return;
    const auto value = CsvTable::number(*found, diagnostics_);
    if (!value) {
      failed_ = true;
      return;
    }
    if (!std::isfinite(*value) || *value == 0)
      error(*found, "the scale " + quote(found->text) + " would lose the value",
            "write how much one count of the register is, as 0.1");
    else if (entry_.type == boolean && *value != 1)
      error(*found, "a bool has no scale", "leave the cell empty");
    entry_.scale = *value;
  }

  // A text has its registers, and nothing that is of numbers.
  void read_length() {
    const CsvCell* found = cell(length);
    if (entry_.type != text_type) {
      if (found != nullptr)
        error(*found, "only a text has a length", "leave the cell empty, or make it a text");
      return;
    }
    if (found == nullptr) {
      error(place(length), "the text " + quote(entry_.name) + " has no length",
            "write how many registers it takes, two characters each");
      return;
    }
    const auto value = CsvTable::integer(*found, diagnostics_);
    if (!value)
      failed_ = true;
    else if (*value < 1 || *value > static_cast<std::int64_t>(max_registers_of_text))
      error(*found, "a text cannot have " + found->text + " registers",
            "a text has from 1 to " + std::to_string(max_registers_of_text) + ", two characters each");
    else
      entry_.length = static_cast<std::size_t>(*value);
    if (entry_.access != read_only) error(place(access), "a text is only read", "make its access read");
    for (const Column column : {scale, offset, missing, scale_register, unit})
      if (const CsvCell* number = cell(column))
        error(*number, "a text has no " + std::string(column_names[column]), "leave the cell empty");
  }

  bool is_plain() const { return entry_.scale == 1 && entry_.offset == 0; }

  void read_scaling() {
    read_scale();
    read_offset();
    read_missing();
    read_scale_register();
  }

  void read_offset() {
    const CsvCell* found = cell(offset);
    if (found == nullptr) return;
    const auto value = CsvTable::number(*found, diagnostics_);
    if (!value) {
      failed_ = true;
      return;
    }
    if (!std::isfinite(*value))
      error(*found, "the offset " + quote(found->text) + " would lose the value",
            "write what a count of 0 is in the unit, as -40");
    else if (entry_.type == boolean && *value != 0)
      error(*found, "a bool has no offset", "leave the cell empty");
    entry_.offset = *value;
  }

  // A register that is written, too, has no missing value: the count for it could be written by mistake.
  bool is_only_read(Column column) {
    if (entry_.access == read_only) return true;
    error(place(column), "what is written has no " + std::string(column_names[column]),
          "make its access read, and write it by a row of another name at the same address");
    return false;
  }

  void read_missing() {
    const CsvCell* found = cell(missing);
    if (found == nullptr || !is_only_read(missing)) return;
    const std::string& called = register_types[entry_.type];
    if (entry_.type == boolean)
      error(*found, "a bool is 0 or 1: none of its values says that there is none", "leave the cell empty");
    else if (const auto bits =
                 is_fraction(entry_.type) ? bits_of_fraction(found->text) : bits_of_integer(found->text))
      entry_.missing = *bits;
    else
      error(*found, quote(found->text) + " is no value of the type " + called,
            is_fraction(entry_.type)
                ? "write what the register tells then, as -9999; \"nan\" says it without this column"
                : "write the counts that the register tells then, as -32768 or 0x8000");
  }

  unsigned type_bits() const { return static_cast<unsigned>(16 * words_of(entry_)); }

  // Counts with their sign, or as the bits that they are.
  std::optional<std::uint64_t> bits_of_integer(std::string_view text) const {
    const bool is_negative = text.starts_with('-');
    if (is_negative) text.remove_prefix(1);
    const bool is_hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    if (is_hexadecimal) text.remove_prefix(2);
    std::uint64_t value = 0;
    const auto [end, failed] =
        std::from_chars(text.data(), text.data() + text.size(), value, is_hexadecimal ? 16 : 10);
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - type_bits());
    if (failed != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    if (!is_negative) return value <= all ? std::optional(value) : std::nullopt;
    const bool is_signed = register_types[entry_.type][0] == 'i';
    if (!is_signed || value > all / 2 + 1) return std::nullopt;
    return (0 - value) & all;
  }

  std::optional<std::uint64_t> bits_of_fraction(std::string_view text) const {
    double value = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc{} || end != text.data() + text.size() || std::isnan(value)) return std::nullopt;
    if (type_bits() == 64) return std::bit_cast<std::uint64_t>(value);
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  }

  void read_scale_register() {
    const CsvCell* found = cell(scale_register);
    if (found == nullptr || !is_only_read(scale_register)) return;
    if (entry_.type == boolean) error(*found, "a bool has no scale", "leave the cell empty");
  }

  // Named rows may come later.
  void find_scale_registers() {
    std::vector<std::string> known;
    for (const ModbusRegister& one : map_.registers) known.push_back(one.name);
    for (const auto& [index, found] : scaled_) {
      const auto other = std::find(known.begin(), known.end(), found->text);
      if (other == known.end()) {
        // A row that is wrong itself has been told.
        if (!names_.contains(found->text))
          error(*found, "the register map has no register " + quote(found->text),
                suggest(found->text, known, "registers", "name the row that tells the power of ten"));
        continue;
      }
      const auto place = static_cast<std::size_t>(other - known.begin());
      const ModbusRegister& factor = map_.registers[place];
      const std::string what = quote(factor.name) + " tells no power of ten: ";
      if (factor.access == write_only)
        error(*found, what + "it is only written", "name a row whose access is read");
      else if (register_types[factor.type] != "i16" && register_types[factor.type] != "u16")
        error(*found, what + "it is a " + register_types[factor.type], "name a row of the type i16 or u16");
      else if (factor.scale != 1 || factor.offset != 0 || cell_of_scaled(place))
        error(*found, what + "it has a scale or an offset itself",
              "leave them out of the row " + quote(factor.name) + ": its counts are the exponent");
      else
        map_.registers[index].scale_register = place;
    }
  }

  bool cell_of_scaled(std::size_t place) const {
    return std::any_of(scaled_.begin(), scaled_.end(),
                       [place](const auto& one) { return one.first == place; });
  }

  void read_safe_value() {
    const CsvCell* found = cell(safe_value);
    if (entry_.access == read_only) {
      if (found != nullptr)
        error(*found, "what is only read has no safe_value",
              "leave the cell empty, or make the register's access read_write");
      return;
    }
    if (found == nullptr) {
      error(place(safe_value), "the register " + quote(entry_.name) + " is written and has no safe_value",
            "write what it shall be while nothing may move, in its unit");
      return;
    }
    const auto value = CsvTable::number(*found, diagnostics_);
    if (!value) {
      failed_ = true;
      return;
    }
    entry_.safe_value = *value;
    const double raw = (*value - entry_.offset) / entry_.scale;
    const Range range = raw_ranges[entry_.type];
    // Dividing by a scale such as 0.1 rounds: a whole count may come out a few units of the last digit beside
    // it.
    const bool is_count =
        is_fraction(entry_.type) || std::abs(raw - std::round(raw)) <= 1e-6 * std::max(1.0, std::abs(raw));
    if (raw >= range.least && raw <= range.most && !is_count)
      error(*found,
            "the safe_value " + found->text + " is no whole count of its type, " +
                register_types[entry_.type] +
                (is_plain() ? "" : ", with the scale and offset of " + quote(entry_.name)),
            "write the value that the register shall have, to its last count");
    else if (!(raw >= range.least && raw <= range.most))
      error(*found,
            "the safe_value " + found->text + " does not fit a " + register_types[entry_.type] +
                (is_plain() ? "" : " with the scale and offset of " + quote(entry_.name)),
            "change the value, the type, the scale or the offset");
  }

  void read_refresh() {
    const auto chosen = word(refresh, yes_and_no);
    if (!chosen) return;
    if (entry_.access == read_only)
      error(place(refresh), "what is only read is not written again",
            "leave the cell empty, or make the register's access read_write");
    entry_.refreshed = *chosen == 0;
  }

  void read_address() {
    const CsvCell& found = place(address);
    const auto value = CsvTable::integer(found, diagnostics_);
    if (!value) {
      failed_ = true;
      return;
    }
    const auto last = *value + static_cast<std::int64_t>(words_of(entry_)) - 1;
    if (*value < 0 || *value > 65535)
      error(found, "the address " + found.text + " is not from 0 to 65535",
            "addresses are as in the request: what a manual calls 40001 is the holding_register 0");
    else if (last > 65535)
      error(found,
            quote(entry_.name) + " has " + std::to_string(words_of(entry_)) +
                " registers, and there is none after 65535",
            "give it a lower address, or a type that takes one register");
    else
      entry_.address = static_cast<std::uint16_t>(*value);
  }

  void read_bit() {
    const CsvCell* found = cell(bit);
    if (found == nullptr) return;
    const auto value = CsvTable::integer(*found, diagnostics_);
    if (!value) {
      failed_ = true;
    } else if (entry_.type != boolean) {
      error(*found,
            "a bit of a register is a bool, and " + quote(entry_.name) + " a " + register_types[entry_.type],
            "make it a bool, or leave the cell empty");
    } else if (*value < 0 || *value > 15) {
      error(*found, "a register has no bit " + found->text, "bits are from 0, the least significant, to 15");
    } else {
      entry_.bit = static_cast<std::uint8_t>(*value);
    }
  }

  // Each word is read once and written once; each bit, where its register is bits.
  void check_against_others() {
    const auto bits = static_cast<std::uint16_t>(entry_.bit ? 1U << *entry_.bit : whole);
    for (std::uint32_t i = 0; i < words_of(entry_); ++i) {
      for (const bool writing : {false, true}) {
        if (writing ? entry_.access == read_only : entry_.access == write_only) continue;
        const auto key = std::array<std::uint32_t, 3>{static_cast<std::uint32_t>(entry_.area),
                                                      entry_.address + i, writing ? 1U : 0U};
        std::vector<Taken>& here = taken_[key];
        const auto other =
            std::find_if(here.begin(), here.end(), [&](const Taken& one) { return (one.bits & bits) != 0; });
        if (other == here.end()) {
          if (here.empty()) ++(writing ? written_ : read_);
          if (writing && !here.empty() && here.front().refreshed != entry_.refreshed) {
            error(place(refresh),
                  quote(entry_.name) + " is in one register with " + quote(here.front().name) +
                      ", and the two are not refreshed alike",
                  "bits of one register are written together: give both the same refresh");
            return;
          }
          here.push_back({entry_.name, bits, entry_.refreshed});
          continue;
        }
        error(place(entry_.bit ? bit : address),
              (entry_.bit ? "bit " + std::to_string(*entry_.bit) + " of " : std::string()) + "the " +
                  register_areas[entry_.area] + " " + std::to_string(entry_.address + i) + " of " +
                  quote(entry_.name) + " is " + (writing ? "written" : "read") + " as " + quote(other->name) +
                  " too",
              entry_.bit
                  ? "give each its own bit, and the register no other row"
                  : "give each its own address; a type with 32 in its name takes two, one with 64 four");
        return;
      }
    }
  }

  void check_sizes() {
    const CsvCell& start = table_.header.front();
    const auto limit = [&](std::size_t count, std::size_t most, const char* what) {
      if (count > most)
        error(start,
              "this register map has " + std::to_string(count) + " " + what + ", at most " +
                  std::to_string(most) + " are possible",
              "leave out what the cell does not need, or make two stations of it");
    };
    limit(map_.registers.size(), max_registers_of_station, "rows");
    limit(read_, max_input_words_of_station, "words to read");
    limit(written_, max_output_words_of_station, "words to write");
  }

  ModbusRegister entry_;
  RegisterMap map_;
  std::map<std::string, Position> names_;
  std::vector<std::pair<std::size_t, const CsvCell*>> scaled_;  // rows with a scale register, and its name
  std::map<std::array<std::uint32_t, 3>, std::vector<Taken>> taken_;
  std::size_t read_ = 0;
  std::size_t written_ = 0;
};

}  // namespace

std::optional<RegisterMap> read_register_map(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const std::optional<CsvTable> table = read_csv(file, diagnostics);
  if (!table) return std::nullopt;
  return MapReader(*table, diagnostics).read();
}

}  // namespace flexrf::config_gen
