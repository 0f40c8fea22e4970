// What the audit says of a record: as a JSON object for its file, and in words for the log.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/executive/cell.hpp"

namespace flexrf {

/// A record that may stand for several: what somebody did `count` times in a row.
struct AuditEntry {
  AuditRecord record;
  std::string who;
  std::uint64_t count = 1;
};

/// "2026-11-23T14:40:28.125Z" (RFC 3339, UTC).
std::string audit_time(std::int64_t milliseconds_since_1970);
/// {"at", "who", "did"} and, where they apply, "what", "before", "after", "count".
std::string audit_json(const Cell& cell, const AuditEntry& entry, std::int64_t at);
/// "ann (192.168.0.7) changed jog.step: 0.01 -> 0.02".
std::string audit_words(const Cell& cell, const AuditEntry& entry);

}  // namespace flexrf
