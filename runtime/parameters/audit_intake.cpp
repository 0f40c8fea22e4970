#include "runtime/parameters/audit_intake.hpp"

#include <algorithm>
#include <cstring>

#include "base/text.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

/// Finds what differs and gives each part that fits into a record.
class Differences {
 public:
  Differences(AuditIntake& intake, const AuditRecord& record, const void* before, const void* after) noexcept
      : intake_(intake),
        record_(record),
        before_(static_cast<const std::byte*>(before)),
        after_(static_cast<const std::byte*>(after)) {}

  /// `start`: bytes from the start of the outermost struct to the field.
  void note(const FieldDescriptor& field, std::uint32_t start) noexcept {
    const auto size = static_cast<std::uint32_t>(field_size(field));
    if (is_same(start, size)) return;
    if (size <= AuditRecord::value_capacity) return put(start, size);
    if (field.scalar == Scalar::text) return put(start, AuditRecord::value_capacity);
    const auto element = static_cast<std::uint32_t>(element_size(field));
    if (field.scalar != Scalar::structure) return note_elements(start, size, element);
    for (std::uint32_t at = start; at < start + size; at += element) {
      if (is_same(at, element)) continue;
      if (element <= AuditRecord::value_capacity) {
        put(at, element);
      } else {
        for (const FieldDescriptor& member : field.type->fields) note(member, at + member.offset);
      }
    }
  }

 private:
  bool is_same(std::uint32_t start, std::uint32_t size) const noexcept {
    return std::memcmp(before_ + start, after_ + start, size) == 0;
  }
  void note_elements(std::uint32_t start, std::uint32_t size, std::uint32_t element) noexcept {
    constexpr std::uint32_t capacity = AuditRecord::value_capacity;
    const std::uint32_t piece = capacity / element * element;
    for (std::uint32_t at = start; at < start + size; at += piece) {
      const std::uint32_t length = std::min(piece, start + size - at);
      if (!is_same(at, length)) put(at, length);
    }
  }
  void put(std::uint32_t start, std::uint32_t size) noexcept {
    record_.offset = start;
    record_.size = static_cast<std::uint16_t>(size);
    std::memcpy(record_.before, before_ + start, size);
    std::memcpy(record_.after, after_ + start, size);
    intake_.put(record_);
  }

  AuditIntake& intake_;
  AuditRecord record_;
  const std::byte* before_;
  const std::byte* after_;
};

}  // namespace

void AuditIntake::put(const AuditRecord& record) noexcept {
  if (record.who[0] != '\0' && is_open()) intake_.put(record);
}

void AuditIntake::note(std::string_view who, const char* did, std::string_view what,
                       AuditRecord::Kind kind) noexcept {
  AuditRecord record;
  record.kind = kind;
  record.at = MonotonicClock::now();
  record.did = did;
  copy_text(record.who, who);
  copy_text(record.what, what);
  put(record);
}

void AuditIntake::note_differences(std::string_view who, std::uint16_t component, ParameterKind kind,
                                   const ParameterBlock& block, const void* before, const void* after,
                                   Time at) noexcept {
  if (who.empty() || !is_open() || block.type == nullptr) return;
  AuditRecord record;
  record.kind = AuditRecord::Kind::change;
  record.block = kind;
  record.component = component;
  record.at = at;
  copy_text(record.who, who);
  Differences differences(*this, record, before, after);
  for (const ParameterDescriptor& parameter : block.parameters) {
    const Scalar scalar = parameter.field->scalar;
    if (scalar != Scalar::button && scalar != Scalar::hold)
      differences.note(*parameter.field, parameter.field->offset);
  }
}

}  // namespace flexrf
