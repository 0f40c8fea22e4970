#include "runtime/executive/audit_text.hpp"

#include <cstdio>
#include <ctime>

#include "base/json_writer.hpp"
#include "runtime/core/value_json.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

/// A field, an element of it, or some, within a struct.
struct AuditPlace {
  std::string path;
  FieldDescriptor field{};  // as if these elements were all of it
};

/// Of a struct's bytes [offset, offset + size), which are a field, whole elements, or a member of one.
AuditPlace place_of(const TypeDescriptor& type, std::uint32_t offset, std::uint32_t size) {
  for (const FieldDescriptor& field : type.fields) {
    const auto whole_size = static_cast<std::uint32_t>(field_size(field));
    if (offset < field.offset || offset >= field.offset + whole_size) continue;
    const std::uint32_t within = offset - field.offset;
    if (within == 0 && (size == whole_size || field.scalar == Scalar::text)) {
      AuditPlace place{field.name, field};
      if (size < whole_size) place.field.count = place.field.shape[0] = size;
      return place;
    }
    const auto element = static_cast<std::uint32_t>(element_size(field));
    const std::uint32_t index = within / element;
    AuditPlace place{field.name, field};
    place.field.offset = 0;
    place.field.count = size / element;
    place.field.dimensions = place.field.count > 1 ? 1 : 0;
    place.field.shape[0] = place.field.count;
    place.field.shape[1] = 0;
    if (field.dimensions > 0) {
      place.path += "[" + std::to_string(index);
      if (place.field.count > 1) place.path += ".." + std::to_string(index + place.field.count - 1);
      place.path += "]";
    }
    if (field.scalar != Scalar::structure || (within % element == 0 && size >= element)) return place;
    AuditPlace member = place_of(*field.type, within % element, size);
    member.path = place.path + "." + member.path;
    return member;
  }
  return {};
}

struct Told {
  std::string did;
  std::string what;
  std::string before;  // JSON; empty: there is none
  std::string after;
};

std::string json_of(const FieldDescriptor& field, const std::byte* value) {
  JsonWriter json(std::string{}, JsonWriter::Style::compact);
  write_field(json, field, value);
  return json.release();
}

Told tell(const Cell& cell, const AuditRecord& record) {
  Told told{record.did, record.what, {}, {}};
  if (record.component == no_component) return told;
  const ComponentType& type = cell.component_type(record.component);
  const ParameterBlock& block =
      record.block == ParameterKind::configuration ? type.configuration : type.runtime;
  AuditPlace place;
  if (block.type != nullptr) place = place_of(*block.type, record.offset, record.size);
  told.what = std::string{cell.component_name(record.component)} + "." + place.path;
  switch (record.kind) {
    case AuditRecord::Kind::change:
      told.did = "changed";
      told.before = json_of(place.field, record.before);
      told.after = json_of(place.field, record.after);
      break;
    case AuditRecord::Kind::press:
      told.did = "pressed";
      break;
    case AuditRecord::Kind::hold_begin:
      told.did = "held";
      break;
    case AuditRecord::Kind::hold_end:
      told.did = std::string{"let go ("} + record.did + ")";
      break;
    case AuditRecord::Kind::act:
    case AuditRecord::Kind::stop:
    case AuditRecord::Kind::clear:
      break;
  }
  return told;
}

}  // namespace

std::string audit_time(std::int64_t milliseconds_since_1970) {
  const auto seconds = static_cast<std::time_t>(milliseconds_since_1970 / 1000);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[40];
  const std::size_t size = std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(text + size, sizeof(text) - size, ".%03dZ", static_cast<int>(milliseconds_since_1970 % 1000));
  return text;
}

std::string audit_json(const Cell& cell, const AuditEntry& entry, std::int64_t at) {
  const Told told = tell(cell, entry.record);
  JsonWriter json(std::string{}, JsonWriter::Style::compact);
  json.begin_object().member("at", std::string_view{audit_time(at)});
  json.member("who", std::string_view{entry.who}).member("did", std::string_view{told.did});
  if (!told.what.empty()) json.member("what", std::string_view{told.what});
  if (!told.after.empty()) json.key("before").raw(told.before).key("after").raw(told.after);
  if (entry.count > 1) json.member("count", entry.count);
  json.end_object();
  return json.release();
}

std::string audit_words(const Cell& cell, const AuditEntry& entry) {
  const Told told = tell(cell, entry.record);
  std::string words = entry.who + " " + told.did;
  if (!told.what.empty()) words += " " + told.what;
  if (!told.after.empty()) words += ": " + told.before + " -> " + told.after;
  if (entry.count > 1) words += " (" + std::to_string(entry.count) + " times)";
  return words;
}

}  // namespace flexrf
