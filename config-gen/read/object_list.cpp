#include "config-gen/read/object_list.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "config-gen/model/words.hpp"
#include "config-gen/read/csv_rows.hpp"

namespace flexrf::config_gen {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

class ListReader : CsvRowReader {
  enum Column {
    index,
    subindex,
    name,
    type,
    access,
    pdo,
    presence,
    when,
    value,
    mask,
    without,
    helps,
    columns
  };
  static constexpr std::array<const char*, columns> column_names = {
      "index",    "subindex", "name",  "type", "access",  "pdo",
      "presence", "when",     "value", "mask", "without", "helps"};

 public:
  ListReader(const CsvTable& table, const std::vector<ListParameter>& parameters, Diagnostics& diagnostics)
      : CsvRowReader(table, column_names, "a list of objects", " of an object", diagnostics),
        parameters_(parameters) {}

  std::vector<NeededObject> read() {
    if (!find_columns({index, name, type, access})) return {};
    for (const CsvRow& row : table_.rows) {
      row_ = &row;
      failed_ = false;
      entry_ = {};
      read_row();
      if (!failed_) objects_.push_back(entry_);
    }
    return std::move(objects_);
  }

 private:
  std::optional<std::size_t> required_word(Column column, const std::vector<std::string>& words) {
    if (cell(column) == nullptr)
      error(place(column), std::string("this object has no ") + column_names[column],
            "write one of " + listed(words));
    return word(column, words);
  }

  std::int64_t integer(Column column, std::int64_t least, std::int64_t most, std::int64_t otherwise) {
    const CsvCell* found = cell(column);
    if (found == nullptr) return otherwise;
    const auto number = CsvTable::integer(*found, diagnostics_);
    if (!number) {
      failed_ = true;
    } else if (*number < least || *number > most) {
      error(*found, quote(found->text) + " is no " + column_names[column] + " of an object",
            "it is from " + std::to_string(least) + " to " + std::to_string(most));
    }
    return number.value_or(otherwise);
  }

  void read_row() {
    entry_.position = row_->cells.front().position;
    if (cell(index) == nullptr) error(row_->cells.front(), "this object has no index", "write it as 0x6040");
    entry_.index = static_cast<std::uint16_t>(integer(index, 1, 0xFFFF, 0));
    entry_.subindex = static_cast<std::uint8_t>(integer(subindex, 0, 0xFF, 0));
    if (const CsvCell* found = cell(name)) entry_.name = found->text;
    if (const CsvCell* found = cell(without)) entry_.without = found->text;
    if (const CsvCell* found = cell(helps)) entry_.helps = found->text;
    entry_.type = required_word(type, object_types).value_or(0);
    entry_.access = static_cast<NeededObject::Access>(required_word(access, object_accesses).value_or(0));
    if (const auto direction = word(pdo, object_pdos))
      entry_.pdo = *direction == 0 ? NeededObject::Pdo::received : NeededObject::Pdo::sent;
    entry_.optional = word(presence, object_presences).value_or(0) == 1;
    entry_.mask = static_cast<std::uint32_t>(integer(mask, 1, 0xFFFFFFFF, 0xFFFFFFFF));
    read_when();
    read_value();
  }

  // "homing_method", "not takes_velocities", "mode = cyclic_position | profile_position and maps_mode",
  // "output_bytes = 2 | 3".
  void read_when() {
    const CsvCell* found = cell(when);
    if (found == nullptr) return;
    constexpr std::string_view conjunction = " and ";
    for (std::string_view text = found->text; !text.empty();) {
      const std::size_t end = std::min(text.find(conjunction), text.size());
      read_condition(*found, text.substr(0, end));
      text.remove_prefix(std::min(end + conjunction.size(), text.size()));
    }
  }

  void read_condition(const CsvCell& found, std::string_view text) {
    NeededObject::Condition condition;
    constexpr std::string_view negation = "not ";
    condition.unless = text.starts_with(negation);
    if (condition.unless) text.remove_prefix(negation.size());
    const std::size_t equals = text.find('=');
    condition.parameter = trimmed(text.substr(0, equals));
    const ListParameter* parameter = find_parameter(found, condition.parameter);
    if (parameter == nullptr) return;
    for (std::size_t at = equals; at < text.size();) {
      const std::size_t end = std::min(text.find('|', at + 1), text.size());
      read_choice(found, *parameter, std::string(trimmed(text.substr(at + 1, end - at - 1))), condition);
      at = end;
    }
    entry_.when.push_back(std::move(condition));
  }

  void read_choice(const CsvCell& found, const ListParameter& parameter, const std::string& wanted,
                   NeededObject::Condition& condition) {
    if (parameter.values.empty()) {
      CsvCell number = found;
      number.text = wanted;
      const auto whole = CsvTable::integer(number, diagnostics_);
      failed_ = failed_ || !whole;
      condition.values.push_back(whole.value_or(0));
      return;
    }
    const auto place = std::find(parameter.values.begin(), parameter.values.end(), wanted);
    if (place != parameter.values.end())
      condition.values.push_back(place - parameter.values.begin());
    else
      error(found, quote(parameter.name) + " cannot be " + quote(wanted),
            suggest(wanted, parameter.values, "values", "name it alone"));
  }

  void read_value() {
    const CsvCell* found = cell(value);
    if (found == nullptr) return;
    if (is_snake_case(found->text)) {
      entry_.value = found->text;
      find_parameter(*found, found->text);
    } else if (const auto number = read_number(*found)) {
      entry_.value = *number;
    } else {
      failed_ = true;
    }
  }

  // "0x80", or as EDS files write what is of the node: "$NODEID+0x200".
  std::optional<std::int64_t> read_number(const CsvCell& found) {
    constexpr std::string_view of_node = "$NODEID+";
    entry_.of_node = found.text.starts_with(of_node);
    CsvCell number = found;
    if (entry_.of_node) number.text.erase(0, of_node.size());
    return CsvTable::integer(number, diagnostics_);
  }

  const ListParameter* find_parameter(const CsvCell& found, const std::string& wanted) {
    std::vector<std::string> names;
    for (const ListParameter& parameter : parameters_) {
      if (parameter.name == wanted) return &parameter;
      names.push_back(parameter.name);
    }
    error(found, "the driver has no configuration parameter " + quote(wanted),
          suggest(wanted, names, "parameters", "leave the cell empty"));
    return nullptr;
  }

  const std::vector<ListParameter>& parameters_;
  NeededObject entry_;
  std::vector<NeededObject> objects_;
};

}  // namespace

std::string object_text(std::uint16_t index, std::uint8_t subindex) {
  std::array<char, 16> text{};
  if (subindex == 0) {
    std::snprintf(text.data(), text.size(), "0x%04X", unsigned{index});
  } else {
    std::snprintf(text.data(), text.size(), "0x%04X:%02X", unsigned{index}, unsigned{subindex});
  }
  return text.data();
}

std::vector<NeededObject> read_object_list(const std::filesystem::path& file,
                                           const std::vector<ListParameter>& parameters,
                                           Diagnostics& diagnostics) {
  const std::optional<CsvTable> table = read_csv(file, diagnostics);
  if (!table) return {};
  return ListReader(*table, parameters, diagnostics).read();
}

}  // namespace flexrf::config_gen
