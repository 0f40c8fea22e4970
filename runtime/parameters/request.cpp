#include "runtime/parameters/request.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace flexrf {
namespace {

ParameterAnswer answer_to(const ParameterRequest& request, AnswerKind kind, std::uint64_t sequence) noexcept {
  ParameterAnswer answer;
  answer.kind = kind;
  answer.component = request.component;
  answer.correlation = request.correlation;
  answer.sequence = sequence;
  return answer;
}

}  // namespace

bool ParameterRequest::add(std::uint16_t parameter, std::uint32_t offset, const void* value,
                           std::size_t size) noexcept {
  if (change_count == max_changes || size > std::size_t{max_value_bytes} - value_bytes) return false;
  changes[change_count++] = {parameter, static_cast<std::uint16_t>(size), offset, value_bytes};
  if (size > 0) std::memcpy(values + value_bytes, value, size);
  value_bytes = static_cast<std::uint16_t>(value_bytes + size);
  return true;
}

bool ParameterRequest::add_presses(std::uint16_t parameter, std::uint32_t presses) noexcept {
  return add(parameter, 0, &presses, sizeof(presses));
}

bool ParameterRequest::add_name(std::uint16_t parameter, std::uint32_t offset) noexcept {
  return add(parameter, offset, nullptr, 0);
}

void ParameterRequest::set_who(std::string_view person) noexcept {
  const std::size_t size = std::min(person.size(), sizeof(who) - 1);
  std::memcpy(who, person.data(), size);
  who[size] = '\0';
}

std::uint64_t new_lease_number() noexcept {
  static std::atomic<std::uint64_t> given{0};
  return given.fetch_add(1, std::memory_order_relaxed) + 1;
}

const char* name_of(AnswerKind kind) noexcept {
  switch (kind) {
    case AnswerKind::accepted:
      return "accepted";
    case AnswerKind::refused:
      return "refused";
    case AnswerKind::unmet:
      return "unmet";
    case AnswerKind::busy:
      return "busy";
    case AnswerKind::stale:
      return "stale";
  }
  return "unknown";
}

ParameterAnswer ParameterAnswer::accepted(const ParameterRequest& request, std::uint64_t sequence) noexcept {
  return answer_to(request, AnswerKind::accepted, sequence);
}

ParameterAnswer ParameterAnswer::refused(const ParameterRequest& request, std::uint64_t sequence,
                                         std::uint16_t parameter, const char* reason) noexcept {
  ParameterAnswer answer = answer_to(request, AnswerKind::refused, sequence);
  answer.parameter = parameter;
  std::snprintf(answer.reason, sizeof(answer.reason), "%s", reason);
  return answer;
}

ParameterAnswer ParameterAnswer::unmet(const ParameterRequest& request, std::uint64_t sequence,
                                       std::uint16_t parameter, const char* reason) noexcept {
  ParameterAnswer answer = refused(request, sequence, parameter, reason);
  answer.kind = AnswerKind::unmet;
  return answer;
}

ParameterAnswer ParameterAnswer::busy(const ParameterRequest& request) noexcept {
  ParameterAnswer answer = answer_to(request, AnswerKind::busy, 0);
  std::snprintf(answer.reason, sizeof(answer.reason), "the queue of requests is full: try again");
  return answer;
}

ParameterAnswer ParameterAnswer::stale(const ParameterRequest& request, std::uint64_t sequence) noexcept {
  ParameterAnswer answer = answer_to(request, AnswerKind::stale, sequence);
  std::snprintf(answer.reason, sizeof(answer.reason), "the values changed since you saw them");
  return answer;
}

}  // namespace flexrf
