#include "runtime/parameters/value_access.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/nearest_name.hpp"
#include "runtime/core/scalar_types.hpp"
#include "runtime/parameters/number_text.hpp"

namespace flexrf {
namespace {

std::string_view text_in(const void* value, std::size_t capacity) noexcept {
  const auto* characters = static_cast<const char*>(value);
  return {characters, strnlen(characters, capacity)};
}

// "gain", "gains[2]", "rotation[0][1]": the element with this place in memory.
class ElementName {
 public:
  ElementName(const FieldDescriptor& field, std::uint32_t element, std::uint32_t count) noexcept {
    const bool is_array = field.dimensions > 0 && count > 1;
    if (is_array && field.dimensions == 2) {
      const std::uint32_t rows = field.shape[0];
      std::snprintf(text_, sizeof(text_), "%s[%u][%u]", field.name, element % rows, element / rows);
    } else if (is_array) {
      std::snprintf(text_, sizeof(text_), "%s[%u]", field.name, element);
    } else {
      std::snprintf(text_, sizeof(text_), "%s", field.name);
    }
  }
  const char* c_str() const noexcept { return text_; }

 private:
  char text_[96];
};

Status check_members(const TypeDescriptor& type, const void* structure) noexcept {
  for (const FieldDescriptor& member : type.fields) {
    const Status status = check_value(member, member.count, bytes_at(structure, member.offset), nullptr);
    if (!status) return status;
  }
  return {};
}

Status check_element(const FieldDescriptor& field, const void* value, const ValueRange* range) noexcept {
  switch (field.scalar) {
    case Scalar::boolean:
    case Scalar::hold:
      if (load<std::uint8_t>(value) <= 1) return {};
      return Status::error(StatusCode::invalid_argument, "neither false nor true");
    case Scalar::enumeration: {
      const auto number = load<std::uint8_t>(value);
      if (number < field.type->values.size()) return {};
      return Status::error(StatusCode::out_of_range, "%u is no value of %s, which has %zu",
                           static_cast<unsigned>(number), field.type->name, field.type->values.size());
    }
    case Scalar::structure:
      return check_members(*field.type, value);
    default:
      return visit_number(field.scalar, Status{},
                          [&](auto tag) { return check_number(field, load<decltype(tag)>(value), range); });
  }
}

// One index "[3]" from the front of `path`.
Status take_index(std::string_view& path, std::uint32_t extent, const FieldDescriptor& field,
                  std::uint32_t& index) noexcept {
  const char* const end = path.data() + path.size();
  const auto [rest, error] = std::from_chars(path.data() + 1, end, index);
  if (error != std::errc{} || rest == end || *rest != ']')
    return Status::error(StatusCode::invalid_argument, "'%s' wants an index as in '%s[0]'", field.name,
                         field.name);
  if (index >= extent)
    return Status::error(StatusCode::out_of_range, "index %u of '%s' lies outside 0 to %u", index, field.name,
                         extent - 1);
  path.remove_prefix(static_cast<std::size_t>(rest + 1 - path.data()));
  return {};
}

Status take_indices(std::string_view& path, FieldPlace& place) noexcept {
  const FieldDescriptor& field = *place.field;
  if (field.dimensions == 0)
    return Status::error(StatusCode::invalid_argument, "'%s' is a single value and has no index", field.name);
  std::uint32_t first = 0;
  if (const Status status = take_index(path, field.shape[0], field, first); !status) return status;
  std::uint32_t element = first;
  if (field.dimensions == 2) {
    if (path.empty() || path.front() != '[')
      return Status::error(StatusCode::invalid_argument, "'%s' wants row and column, as in '%s[0][0]'",
                           field.name, field.name);
    std::uint32_t second = 0;
    if (const Status status = take_index(path, field.shape[1], field, second); !status) return status;
    element += second * field.shape[0];
  }
  place.offset += static_cast<std::uint32_t>(element * element_size(field));
  place.count = 1;
  place.is_element = true;
  return {};
}

const FieldDescriptor* field_named(const TypeDescriptor& type, std::string_view name) noexcept {
  for (const FieldDescriptor& field : type.fields)
    if (name == field.name) return &field;
  return nullptr;
}

Status unknown_field(const TypeDescriptor& type, std::string_view name) noexcept {
  NearestName nearest(name);
  for (const FieldDescriptor& field : type.fields) nearest.offer(field.name);
  const std::string_view best = nearest.best();
  return Status::error(StatusCode::not_found, "no '%.*s' in %s%s%.*s%s", static_cast<int>(name.size()),
                       name.data(), type.name, best.empty() ? "" : "; did you mean '",
                       static_cast<int>(best.size()), best.data(), best.empty() ? "" : "'?");
}

}  // namespace

FieldPlace whole(const FieldDescriptor& field) noexcept {
  return {&field, field.offset, field.count, false};
}

const ValueRange* range_of(const ParameterDescriptor& parameter, ValueRange& range) noexcept {
  if (!parameter.has_range) return nullptr;
  range = {parameter.minimum, parameter.maximum};
  return &range;
}

Result<FieldPlace> find_field(const TypeDescriptor& type, std::string_view path) noexcept {
  const TypeDescriptor* structure = &type;
  FieldPlace place;
  while (true) {
    const std::string_view name = path.substr(0, path.find_first_of(".["));
    place.field = field_named(*structure, name);
    if (place.field == nullptr) return unknown_field(*structure, name);
    place.offset += place.field->offset;
    place.count = place.field->count;
    place.is_element = false;
    path.remove_prefix(name.size());
    if (!path.empty() && path.front() == '[')
      if (const Status status = take_indices(path, place); !status) return status;
    if (path.empty()) return place;
    if (path.front() != '.')
      return Status::error(StatusCode::invalid_argument, "'%.*s' is not understood after '%s'",
                           static_cast<int>(path.size()), path.data(), place.field->name);
    if (place.field->scalar != Scalar::structure)
      return Status::error(StatusCode::not_found, "'%s' is not a structure and has no '%.*s'",
                           place.field->name, static_cast<int>(path.size() - 1), path.data() + 1);
    if (place.field->dimensions > 0 && !place.is_element)
      return Status::error(StatusCode::invalid_argument, "'%s' wants an index as in '%s[0]'",
                           place.field->name, place.field->name);
    structure = place.field->type;
    path.remove_prefix(1);
  }
}

bool is_whole(const FieldDescriptor& field, std::uint32_t offset, std::uint32_t size) noexcept {
  const FieldDescriptor* at = &field;
  while (size > 0 && std::size_t{offset} + size <= field_size(*at)) {
    if (at->scalar == Scalar::text) return offset == 0 && size == at->count;
    const std::size_t one = element_size(*at);
    if (offset % one == 0 && size % one == 0) return true;
    if (at->scalar != Scalar::structure) return false;
    const auto within = static_cast<std::uint32_t>(offset % one);
    const FieldDescriptor* member = nullptr;
    for (const FieldDescriptor& candidate : at->type->fields)
      if (within >= candidate.offset && within < candidate.offset + field_size(candidate))
        member = &candidate;
    if (member == nullptr) return false;
    offset = within - member->offset;
    at = member;
  }
  return false;
}

Status check_text(std::string_view text) noexcept {
  // Well-formed byte sequences as in table 3-7 of the Unicode standard.
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) {
      return static_cast<unsigned char>(at < text.size() ? text[at] : 0);
    };
    const unsigned lead = byte(i);
    if (lead < 0x80) {
      if ((lead < 0x20 && lead != '\t' && lead != '\n') || lead == 0x7F)
        return Status::error(StatusCode::invalid_argument, "control character %u in the text", lead);
      ++i;
      continue;
    }
    const std::size_t length = lead >= 0xC2 && lead <= 0xDF   ? 2
                               : lead >= 0xE0 && lead <= 0xEF ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    unsigned lowest = 0x80;
    unsigned highest = 0xBF;
    if (lead == 0xE0) lowest = 0xA0;
    if (lead == 0xED) highest = 0x9F;
    if (lead == 0xF0) lowest = 0x90;
    if (lead == 0xF4) highest = 0x8F;
    bool is_right = length > 0 && byte(i + 1) >= lowest && byte(i + 1) <= highest;
    for (std::size_t next = 2; next < length; ++next) is_right = is_right && byte(i + next) >> 6 == 2;
    if (!is_right) return Status::error(StatusCode::invalid_argument, "byte %zu of the text is not UTF-8", i);
    i += length;
  }
  return {};
}

Status check_value(const FieldDescriptor& field, std::uint32_t count, const void* value,
                   const ValueRange* range) noexcept {
  if (field.scalar == Scalar::text) {
    const Status status = check_text(text_in(value, count));
    return status ? status : Status::error(status.code(), "%s: %s", field.name, status.cause());
  }
  const std::size_t one = element_size(field);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Status status = check_element(field, bytes_at(value, i * one), range);
    if (!status) {
      const ElementName name(field, i, count);
      return Status::error(status.code(), field.scalar == Scalar::structure ? "%s.%s" : "%s: %s",
                           name.c_str(), status.cause());
    }
  }
  return {};
}

Status check_block(const ParameterBlock& block, const void* values, std::uint16_t& parameter) noexcept {
  for (std::size_t i = 0; i < block.parameters.size(); ++i) {
    const ParameterDescriptor& declared = block.parameters[i];
    ValueRange range{};
    const Status status = check_value(*declared.field, declared.field->count,
                                      bytes_at(values, declared.field->offset), range_of(declared, range));
    if (!status) {
      parameter = static_cast<std::uint16_t>(i);
      return status;
    }
  }
  return {};
}

Result<double> read_number(const FieldPlace& place, const void* structure, std::uint32_t element) noexcept {
  const FieldDescriptor& field = *place.field;
  if (element >= place.count || place.field->scalar == Scalar::text)
    return Status::error(StatusCode::not_found, "'%s' has no number %u", field.name, element);
  const std::byte* at = bytes_at(structure, place.offset + element * element_size(field));
  if (field.scalar == Scalar::boolean || field.scalar == Scalar::hold || field.scalar == Scalar::enumeration)
    return static_cast<double>(load<std::uint8_t>(at));
  if (field.scalar == Scalar::button) return static_cast<double>(load<std::uint32_t>(at));
  if (field.scalar == Scalar::structure)
    return Status::error(StatusCode::not_found, "'%s' is a structure: name a member", field.name);
  return visit_number(field.scalar, 0.0,
                      [&](auto tag) { return static_cast<double>(load<decltype(tag)>(at)); });
}

Status write_number(const FieldPlace& place, void* structure, double number, const ValueRange* range,
                    std::uint32_t element) noexcept {
  const FieldDescriptor& field = *place.field;
  const auto refused = [&] {
    return Status::error(StatusCode::invalid_argument, "%s: cannot hold the number %s", field.name,
                         NumberText(number).c_str());
  };
  if (element >= place.count) return refused();
  std::byte* at = bytes_at(structure, place.offset + element * element_size(field));
  if (field.scalar == Scalar::boolean) {
    if (number != 0.0 && number != 1.0) return refused();
    store(at, static_cast<std::uint8_t>(number));
    return {};
  }
  if (field.scalar == Scalar::enumeration) {
    if (!(number >= 0.0 && number < static_cast<double>(field.type->values.size())) ||
        number != std::floor(number))
      return refused();
    store(at, static_cast<std::uint8_t>(number));
    return {};
  }
  return visit_number(field.scalar,
                      Status::error(StatusCode::invalid_argument, "%s takes no number", field.name),
                      [&](auto tag) {
                        using Type = decltype(tag);
                        const Status status = check_number(field, number, range);
                        if (!status)
                          return Status::error(status.code(), "%s: %s", field.name, status.cause());
                        if constexpr (std::is_integral_v<Type>) {
                          // 2 to the number of value bits is exact as a double; the largest integer may not
                          // be.
                          const double beyond = std::ldexp(1.0, std::numeric_limits<Type>::digits);
                          const double least = std::is_signed_v<Type> ? -beyond : 0.0;
                          if (!(number >= least && number < beyond) || number != std::floor(number))
                            return refused();
                        } else if (std::isinf(static_cast<Type>(number))) {
                          return refused();
                        }
                        store(at, static_cast<Type>(number));
                        return Status{};
                      });
}

}  // namespace flexrf
