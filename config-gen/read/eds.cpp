#include "config-gen/read/eds.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/ascii.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/ini.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::int64_t unsigned_8 = 0x0005;

// Hexadecimal digits and nothing else.
std::optional<std::uint32_t> hexadecimal(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// "31", "0x1F", "-5"; as in C, digits after a leading 0 are octal if they can be.
std::optional<std::int64_t> whole_number(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  int base = 10;
  if (text.starts_with("0x") || text.starts_with("0X")) {
    text.remove_prefix(2);
    base = 16;
  } else if (text.size() > 1 && text.front() == '0' && text.find_first_of("89") == std::string_view::npos) {
    base = 8;
  }
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return static_cast<std::int64_t>(negative ? 0 - value : value);
}

// "$NODEID+0x180" and "0x180+$NODEID".
std::optional<EdsNumber> number(const IniEntry& entry) {
  std::string_view text = entry.value;
  EdsNumber result;
  result.position = entry.position;
  if (const std::size_t comment = text.find(';'); comment != std::string_view::npos)
    text = text.substr(0, comment);
  text = without_blanks(text);
  constexpr std::string_view node = "$nodeid";
  if (const std::size_t at = in_small_letters(text).find(node); at != std::string::npos) {
    result.of_node = true;
    const std::string_view before = without_blanks(text.substr(0, at));
    const std::string_view after = without_blanks(text.substr(at + node.size()));
    if (before.empty() && after.empty()) return result;
    if (before.empty() == after.empty()) return std::nullopt;
    if (before.empty() ? !after.starts_with('+') : !before.ends_with('+')) return std::nullopt;
    text = without_blanks(before.empty() ? after.substr(1) : before.substr(0, before.size() - 1));
  }
  const auto value = whole_number(text);
  if (!value) return std::nullopt;
  result.value = *value;
  return result;
}

class EdsReader {
 public:
  EdsReader(const std::vector<IniSection>& sections, Diagnostics& diagnostics)
      : sections_(sections), diagnostics_(diagnostics) {}

  std::optional<Eds> read() {
    for (const IniSection& section : sections_) {
      if (equal_without_case(section.name, "DeviceInfo")) {
        eds_.vendor = optional_number(section, "VendorNumber");
        eds_.product = optional_number(section, "ProductNumber");
      } else if (equal_without_case(section.name, "DeviceComissioning") ||
                 equal_without_case(section.name, "DeviceCommissioning")) {
        // The standard spells it with one m.
        eds_.node = optional_number(section, "NodeID");
      } else if (equal_without_case(section.name, "MandatoryObjects") ||
                 equal_without_case(section.name, "OptionalObjects") ||
                 equal_without_case(section.name, "ManufacturerObjects")) {
        lists_.push_back(&section);
      } else {
        read_object(section);
      }
    }
    for (const IniSection& section : sections_) read_compact_values(section);
    for (const IniSection* list : lists_) check_list(*list);
    if (!eds_.objects.empty()) return std::move(eds_);
    diagnostics_.error({sections_.front().position.file, 1, 1},
                       "this EDS file has no object: there is no section as [6040]",
                       "is it truncated, or the file of something else?");
    return std::nullopt;
  }

 private:
  // [1018], [1018sub1], [1018SUB0A]; of other sections nothing is asked.
  void read_object(const IniSection& section) {
    const std::string name = in_small_letters(section.name);
    const auto index = hexadecimal(name.substr(0, 4));
    if (name.size() < 4 || !index) return;
    const auto number_of_object = static_cast<std::uint16_t>(*index);
    if (name.size() == 4) {
      eds_.objects.emplace(number_of_object, section.position);
      read_variables(section, number_of_object);
      return;
    }
    if (name.compare(4, 3, "sub") != 0) return;
    const auto subindex = hexadecimal(name.substr(7));
    if (!subindex || *subindex > 0xFF) {
      diagnostics_.warning(section.position, quote(section.name) + " names no subindex from 0 to FF",
                           "the section is left out");
      return;
    }
    eds_.objects.emplace(number_of_object, section.position);
    // A subindex that is written out counts more than the compact form.
    eds_.variables.insert_or_assign({number_of_object, static_cast<std::uint8_t>(*subindex)},
                                    variable(section));
  }

  void read_variables(const IniSection& section, std::uint16_t index) {
    const auto compact = optional_number(section, "CompactSubObj");
    if (compact && compact->value > 0) {
      EdsVariable count;
      count.name = "number of entries";
      count.position = section.position;
      count.data_type = EdsNumber{unsigned_8, false, section.position};
      count.access = "ro";
      count.value = EdsNumber{compact->value, false, compact->position};
      eds_.variables.try_emplace({index, std::uint8_t{0}}, count);
      for (std::int64_t i = 1; i <= std::min<std::int64_t>(compact->value, 0xFE); ++i)
        eds_.variables.try_emplace({index, static_cast<std::uint8_t>(i)}, variable(section));
    } else if (section.find("DataType") != nullptr) {
      eds_.variables.try_emplace({index, std::uint8_t{0}}, variable(section));
    }
  }

  // [1016Value]: what the subindices of a compact object are, where that differs.
  void read_compact_values(const IniSection& section) {
    const std::string name = in_small_letters(section.name);
    constexpr std::string_view ending = "value";
    const auto index = hexadecimal(name.substr(0, 4));
    if (name.size() != 4 + ending.size() || !name.ends_with(ending) || !index) return;
    for (const IniEntry& entry : section.entries) {
      const auto subindex = whole_number(entry.key);
      if (!subindex || *subindex < 1 || *subindex > 0xFE || !has_value(&entry)) continue;  // as NrOfEntries
      const auto found =
          eds_.variables.find({static_cast<std::uint16_t>(*index), static_cast<std::uint8_t>(*subindex)});
      if (found == eds_.variables.end()) {
        diagnostics_.warning(
            entry.key_position,
            "the object " + quote(section.name.substr(0, 4)) + " has no subindex " + quote(entry.key),
            "the value is left out");
      } else {
        found->second.value = value_of(entry, entry.key, found->second);
      }
    }
  }

  EdsVariable variable(const IniSection& section) {
    EdsVariable result;
    result.position = result.access_position = result.mappable_position = section.position;
    if (const IniEntry* entry = section.find("ParameterName")) result.name = entry->value;
    result.data_type = optional_number(section, "DataType");
    if (const IniEntry* entry = section.find("AccessType")) {
      result.access = in_small_letters(without_blanks(entry->value.substr(0, entry->value.find(';'))));
      result.access_position = entry->position;
    }
    if (const auto mappable = optional_number(section, "PDOMapping")) {
      result.mappable = mappable->value != 0;
      result.mappable_position = mappable->position;
    }
    result.configured = has_value(section.find("ParameterValue"));
    result.value = value_of(section, result.configured ? "ParameterValue" : "DefaultValue", result);
    result.low = value_of(section, "LowLimit", result);
    result.high = value_of(section, "HighLimit", result);
    result.flags = optional_number(section, "ObjFlags");
    return result;
  }

  static bool has_value(const IniEntry* entry) {
    return entry != nullptr &&
           !without_blanks(std::string_view(entry->value).substr(0, entry->value.find(';'))).empty();
  }

  // Values and limits may be texts. The check that needs a number refuses a text.
  static std::optional<EdsNumber> value_of(const IniSection& section, std::string_view key,
                                           EdsVariable& variable) {
    const IniEntry* entry = section.find(key);
    return entry == nullptr ? std::nullopt : value_of(*entry, key, variable);
  }
  static std::optional<EdsNumber> value_of(const IniEntry& entry, std::string_view key,
                                           EdsVariable& variable) {
    if (!has_value(&entry)) return std::nullopt;
    const auto value = number(entry);
    if (!value) variable.odd.push_back({std::string(key), entry.value, entry.position});
    return value;
  }

  std::optional<EdsNumber> optional_number(const IniSection& section, std::string_view key) {
    const IniEntry* entry = section.find(key);
    if (entry == nullptr || entry->value.empty()) return std::nullopt;
    const auto value = number(*entry);
    if (!value)
      diagnostics_.warning(entry->position, std::string(key) + " is no number: " + quote(entry->value),
                           "it is left out; numbers are written as 31 or 0x1F");
    return value;
  }

  // A list of objects names what has a section; a truncated file ends before them.
  void check_list(const IniSection& list) {
    std::size_t missing = 0;
    const IniEntry* first = nullptr;
    for (const IniEntry& entry : list.entries) {
      if (entry.key.empty() || entry.key.find_first_not_of("0123456789") != std::string::npos) continue;
      const auto index = number(entry);
      if (!index || index->value < 0 || index->value > 0xFFFF) {
        diagnostics_.warning(entry.position, quote(entry.value) + " is no index of an object",
                             "it is left out; an index is written as 0x6040");
      } else if (!eds_.objects.contains(static_cast<std::uint16_t>(index->value))) {
        ++missing;
        if (first == nullptr) first = &entry;
      }
    }
    if (first == nullptr) return;
    diagnostics_.warning(first->position,
                         "the object " + first->value + " is listed and not described" +
                             (missing == 1 ? "" : " (and " + std::to_string(missing - 1) + " more like it)"),
                         "is the file truncated?");
  }

  const std::vector<IniSection>& sections_;
  Diagnostics& diagnostics_;
  Eds eds_;
  std::vector<const IniSection*> lists_;
};

}  // namespace

const EdsVariable* Eds::find(std::uint16_t index, std::uint8_t subindex) const {
  const auto found = variables.find({index, subindex});
  return found == variables.end() ? nullptr : &found->second;
}

std::string eds_type_name(std::int64_t data_type) {
  static constexpr std::array<const char*, 0x1C> names = {"",
                                                          "bool",
                                                          "i8",
                                                          "i16",
                                                          "i32",
                                                          "u8",
                                                          "u16",
                                                          "u32",
                                                          "f32",
                                                          "a text",
                                                          "an octet string",
                                                          "a unicode text",
                                                          "a time of day",
                                                          "a time difference",
                                                          "",
                                                          "a domain",
                                                          "i24",
                                                          "f64",
                                                          "i40",
                                                          "i48",
                                                          "i56",
                                                          "i64",
                                                          "u24",
                                                          "",
                                                          "u40",
                                                          "u48",
                                                          "u56",
                                                          "u64"};
  if (data_type > 0 && data_type < static_cast<std::int64_t>(names.size()) &&
      *names[static_cast<std::size_t>(data_type)] != '\0')
    return names[static_cast<std::size_t>(data_type)];
  std::array<char, 20> digits{};
  std::to_chars(digits.data(), digits.data() + digits.size(), data_type, 16);
  return "data type 0x" + std::string(digits.data());
}

std::optional<Eds> parse_eds(std::string_view text, const std::filesystem::path& file,
                             Diagnostics& diagnostics) {
  const auto sections = parse_ini(text, file, diagnostics);
  if (!sections) return std::nullopt;
  return EdsReader(*sections, diagnostics).read();
}

std::optional<Eds> read_eds(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const auto sections = read_ini(file, diagnostics);
  if (!sections) return std::nullopt;
  return EdsReader(*sections, diagnostics).read();
}

}  // namespace flexrf::config_gen
