// The text of values: what files hold and people type.
#include <array>
#include <charconv>
#include <vector>

#include "base/nearest_name.hpp"
#include "runtime/core/scalar_types.hpp"
#include "runtime/parameters/number_text.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

constexpr std::string_view blanks = " \t\r\n";

// Memory that texts are read into before any of it counts: on the stack unless there is much.
class Staging {
 public:
  explicit Staging(std::size_t size) : large_(size > small_.size() ? size : 0) {}
  std::byte* data() noexcept { return large_.empty() ? small_.data() : large_.data(); }

 private:
  std::array<std::byte, 512> small_{};
  std::vector<std::byte> large_;
};

// Where the element with this number in reading order (row by row) lies in memory (column by column).
std::uint32_t element_read_as(const FieldDescriptor& field, std::uint32_t number) noexcept {
  const std::uint32_t rows = field.shape[0];
  const std::uint32_t columns = field.shape[1];
  return (number / columns) + (number % columns) * rows;
}

void append_element(const FieldDescriptor& field, const std::byte* at, std::string& text) {
  switch (field.scalar) {
    case Scalar::boolean:
    case Scalar::hold:
      text += load<std::uint8_t>(at) != 0 ? "true" : "false";
      return;
    case Scalar::enumeration: {
      const auto number = load<std::uint8_t>(at);
      if (number < field.type->values.size())
        text += field.type->values[number].name;
      else
        text += NumberText(number).c_str();
      return;
    }
    case Scalar::button:
      text += NumberText(load<std::uint32_t>(at)).c_str();
      return;
    default:
      visit_number(field.scalar, 0, [&](auto tag) {
        text += NumberText(load<decltype(tag)>(at)).c_str();
        return 0;
      });
  }
}

template <class T>
Status parse_number(const FieldDescriptor& field, std::byte* at, std::string_view word,
                    const ValueRange* range) noexcept {
  T number{};
  const char* first = word.data();
  const char* const end = word.data() + word.size();
  if (word.size() > 1 && *first == '+' && first[1] != '-') ++first;
  // A negative number in an unsigned field is an integer, but not one it can hold.
  const bool is_below = std::is_unsigned_v<T> && word.size() > 1 && *first == '-';
  auto [rest, error] = std::from_chars(is_below ? first + 1 : first, end, number);
  if (is_below && error == std::errc{} && rest == end) error = std::errc::result_out_of_range;
  const auto length = static_cast<int>(word.size());
  if (error == std::errc::result_out_of_range) {
    if (range != nullptr)
      return Status::error(StatusCode::out_of_range, "%.*s lies outside %s to %s", length, word.data(),
                           NumberText(range->minimum).c_str(), NumberText(range->maximum).c_str());
    return Status::error(StatusCode::out_of_range, "%.*s does not fit its type", length, word.data());
  }
  if (error != std::errc{} || rest != end)
    return Status::error(StatusCode::invalid_argument, "'%.*s' is not %s", length, word.data(),
                         std::is_integral_v<T> ? "an integer" : "a number");
  const Status status = check_number(field, number, range);
  if (status.is_ok()) store(at, number);
  return status;
}

Status parse_enumeration(const FieldDescriptor& field, std::byte* at, std::string_view word) noexcept {
  NearestName nearest(word);
  std::uint8_t number = 0;
  for (const EnumerationValue& value : field.type->values) {
    if (word == value.name) {
      store(at, number);
      return {};
    }
    nearest.offer(value.name);
    ++number;
  }
  const auto length = static_cast<int>(word.size());
  const std::string_view best = nearest.best();
  if (!best.empty())
    return Status::error(StatusCode::invalid_argument, "'%.*s' is no %s; did you mean '%.*s'?", length,
                         word.data(), field.type->name, static_cast<int>(best.size()), best.data());
  char known[128] = {};
  std::size_t used = 0;
  for (const EnumerationValue& value : field.type->values)
    if (used < sizeof(known))
      used += static_cast<std::size_t>(
          std::snprintf(known + used, sizeof(known) - used, "%s%s", used == 0 ? "" : ", ", value.name));
  return Status::error(StatusCode::invalid_argument, "'%.*s' is no %s: %s", length, word.data(),
                       field.type->name, known);
}

Status parse_element(const FieldDescriptor& field, std::byte* at, std::string_view word,
                     const ValueRange* range) noexcept {
  switch (field.scalar) {
    case Scalar::boolean:
      if (word != "true" && word != "false")
        return Status::error(StatusCode::invalid_argument, "'%.*s' is neither true nor false",
                             static_cast<int>(word.size()), word.data());
      store(at, static_cast<std::uint8_t>(word == "true" ? 1 : 0));
      return {};
    case Scalar::enumeration:
      return parse_enumeration(field, at, word);
    default:
      return visit_number(field.scalar, Status::error(StatusCode::invalid_argument, "takes no text"),
                          [&](auto tag) { return parse_number<decltype(tag)>(field, at, word, range); });
  }
}

Status parse_text(const FieldDescriptor& field, std::uint32_t capacity, std::byte* at,
                  std::string_view text) noexcept {
  if (text.size() > capacity)
    return Status::error(StatusCode::out_of_range, "%s: %zu bytes of text, but there is room for %u",
                         field.name, text.size(), capacity);
  Status status = check_text(text);
  if (text.find('\0') != std::string_view::npos)
    status = Status::error(StatusCode::invalid_argument, "a zero within the text");
  if (!status) return Status::error(status.code(), "%s: %s", field.name, status.cause());
  std::memset(at, 0, capacity);
  std::memcpy(at, text.data(), text.size());
  return {};
}

// The next element, or ";" by itself; empty at the end.
std::string_view take_word(std::string_view& text) noexcept {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text.remove_prefix(first);
  const std::size_t size = text.front() == ';' ? 1 : text.find_first_of(" \t\r\n;");
  const std::string_view word = text.substr(0, size);
  text.remove_prefix(word.size());
  return word;
}

Status wrong_count(const FieldPlace& place, std::uint32_t found) noexcept {
  const FieldDescriptor& field = *place.field;
  if (field.dimensions == 2 && !place.is_element)
    return Status::error(StatusCode::invalid_argument,
                         "%s: wants %u rows of %u values, the rows separated by ';'", field.name,
                         static_cast<unsigned>(field.shape[0]), static_cast<unsigned>(field.shape[1]));
  return Status::error(StatusCode::invalid_argument, "%s: wants %u value%s, but there %s %u", field.name,
                       place.count, place.count == 1 ? "" : "s", found == 1 ? "is" : "are", found);
}

}  // namespace

std::string text_of(const FieldPlace& place, const void* structure) {
  const FieldDescriptor& field = *place.field;
  const std::byte* at = bytes_at(structure, place.offset);
  std::string text;
  if (field.scalar == Scalar::structure) return text;
  if (field.scalar == Scalar::text) {
    const auto* characters = reinterpret_cast<const char*>(at);
    return text.assign(characters, strnlen(characters, place.count));
  }
  const bool is_matrix = field.dimensions == 2 && !place.is_element;
  const std::size_t one = element_size(field);
  for (std::uint32_t i = 0; i < place.count; ++i) {
    if (i > 0) text += is_matrix && i % field.shape[1] == 0 ? "; " : " ";
    append_element(field, at + one * (is_matrix ? element_read_as(field, i) : i), text);
  }
  return text;
}

Status write_text(const FieldPlace& place, void* structure, std::string_view text, const ValueRange* range) {
  const FieldDescriptor& field = *place.field;
  std::byte* const at = bytes_at(structure, place.offset);
  if (field.scalar == Scalar::text) return parse_text(field, place.count, at, text);
  if (field.scalar == Scalar::structure)
    return Status::error(StatusCode::invalid_argument, "%s: is a structure: name its members", field.name);

  const std::size_t one = element_size(field);
  const bool is_matrix = field.dimensions == 2 && !place.is_element;
  Staging staging(place.count * one);
  std::uint32_t found = 0;
  for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
    if (word == ";") {
      const bool is_row = is_matrix && found > 0 && found < place.count && found % field.shape[1] == 0;
      if (!is_row) return wrong_count(place, found);
      word = take_word(text);
      if (word.empty() || word == ";") return wrong_count(place, found);
    } else if (is_matrix && found > 0 && found < place.count && found % field.shape[1] == 0) {
      return wrong_count(place, found);
    }
    if (found < place.count) {
      const std::uint32_t element = is_matrix ? element_read_as(field, found) : found;
      const Status status = parse_element(field, staging.data() + one * element, word, range);
      if (!status) {
        if (place.count == 1) return Status::error(status.code(), "%s: %s", field.name, status.cause());
        return Status::error(status.code(), "%s, value %u: %s", field.name, found + 1, status.cause());
      }
    }
    ++found;
  }
  if (found != place.count) return wrong_count(place, found);
  std::memcpy(at, staging.data(), place.count * one);
  return {};
}

}  // namespace flexrf
