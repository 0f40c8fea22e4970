// Requests to change runtime parameters, the answers to them, and the queues both travel in.
//
// Nobody waits: a full queue answers busy at once. The owning thread applies a request between two steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/blackboard/doorbell.hpp"
#include "runtime/parameters/audit_intake.hpp"
#include "runtime/parameters/intake.hpp"

namespace flexrf {

inline constexpr std::uint16_t no_parameter = 0xFFFF;

enum class RequestKind : std::uint8_t {
  set,       ///< changes give parameters new values: all or none
  press,     ///< changes name buttons; each value is a u32, the number of presses
  hold,      ///< a new press of the hold in changes[0], under a lease number that was never used before
  refresh,   ///< keeps that lease alive; never starts one
  release,   ///< ends that lease
  reset,     ///< the parameters in changes (none: all) back to the values in the application's tables
  activate,  ///< member of a population: values of the tables, then the changes, then reset()
  clone,     ///< the same, starting from the values of member `source`
  retire,    ///< the member is no longer stepped
};

/// What is changed: bytes of one runtime parameter. Values of a structure lie as they do in the structure.
struct ParameterChange {
  std::uint16_t parameter = no_parameter;  ///< index in the component's ParameterBlock
  std::uint16_t size = 0;                  ///< bytes; whole elements or whole members
  std::uint32_t offset = 0;  ///< bytes from the start of the parameter; other than 0 for elements and members
  std::uint32_t position = 0;  ///< bytes from the start of ParameterRequest::values
};

struct ParameterRequest {
  static constexpr std::uint16_t max_changes = 16;
  static constexpr std::uint16_t max_value_bytes = 512;

  RequestKind kind = RequestKind::set;
  std::uint16_t component = 0;    ///< executive's index: units in table order, then devices
  std::uint16_t requester = 0;    ///< executive's index of the answer queue
  std::uint16_t source = 0;       ///< clone: component index of the member to copy
  std::uint64_t correlation = 0;  ///< the requester's own; comes back in the answer
  /// The sequence of the values in force that the requester has seen: when settings changed since, the answer
  /// is stale and nothing happens. Presses and holds of others do not count as changes. Empty: whatever is in
  /// force.
  std::optional<std::uint64_t> expected;
  /// When the person acted; 0: unknown. A lease is counted from here, so that what waited does not run
  /// longer.
  Time issued_at{};
  std::uint64_t lease = 0;           ///< hold, refresh, release: from new_lease_number()
  std::uint64_t lease_sequence = 0;  ///< hold, refresh: greater than in every former request of this lease
  /// The person, for the audit. Empty: none, as when a unit asks; then nothing is written down.
  char who[longest_who] = {};
  /// What it sets belongs into the configuration file. Not so where a unit asks by itself
  /// (CellAccess::send()).
  bool keeps = true;

  /// Adds a change; false (and nothing is added) when it does not fit. `offset`: bytes into the parameter.
  bool add(std::uint16_t parameter, std::uint32_t offset, const void* value, std::size_t size) noexcept;
  /// press: so many presses of a button.
  bool add_presses(std::uint16_t parameter, std::uint32_t presses = 1) noexcept;
  /// hold, refresh, release, reset: names a parameter without a value.
  bool add_name(std::uint16_t parameter, std::uint32_t offset = 0) noexcept;

  void set_who(std::string_view person) noexcept;

  std::uint16_t change_count = 0;
  std::uint16_t value_bytes = 0;
  ParameterChange changes[max_changes]{};
  std::byte values[max_value_bytes]{};
};

/// A number for a new press of a hold: greater than all before it in this process, never 0. Any thread.
std::uint64_t new_lease_number() noexcept;

enum class AnswerKind : std::uint8_t {
  accepted,  ///< `sequence` is now in force
  refused,   ///< nothing happened; `parameter` (or no_parameter) and `reason` say why
  unmet,     ///< nothing happened: what the command needs is not there now, says `reason`
  busy,      ///< nothing happened: the queue was full; try again
  stale,     ///< nothing happened: settings changed since `expected`; `sequence` is in force
};
const char* name_of(AnswerKind kind) noexcept;

struct ParameterAnswer {
  AnswerKind kind = AnswerKind::accepted;
  std::uint16_t component = 0;
  std::uint16_t parameter = no_parameter;
  std::uint64_t correlation = 0;
  std::uint64_t sequence = 0;  ///< of the values in force, as in their slot
  char reason[Status::cause_capacity] = {};

  static ParameterAnswer accepted(const ParameterRequest& request, std::uint64_t sequence) noexcept;
  static ParameterAnswer refused(const ParameterRequest& request, std::uint64_t sequence,
                                 std::uint16_t parameter, const char* reason) noexcept;
  static ParameterAnswer unmet(const ParameterRequest& request, std::uint64_t sequence,
                               std::uint16_t parameter, const char* reason) noexcept;
  static ParameterAnswer busy(const ParameterRequest& request) noexcept;
  static ParameterAnswer stale(const ParameterRequest& request, std::uint64_t sequence) noexcept;
};

/// Requests to all components of one thread. push: any thread. pop, has_any: the owning thread.
class RequestQueue {
 public:
  static constexpr std::uint32_t capacity = 32;

  /// Rung after each accepted request. Set before the start.
  void set_bell(Doorbell* owner) noexcept { bell_ = owner; }

  /// False when full: the request is busy(), nothing else happens.
  bool push(const ParameterRequest& request) noexcept {
    if (!intake_.put(request)) return false;
    if (bell_ != nullptr) bell_->ring();
    return true;
  }
  bool pop(ParameterRequest& request) noexcept { return intake_.take(request); }
  bool has_any() const noexcept { return intake_.has_any(); }

  std::uint64_t accepted() const noexcept { return intake_.accepted(); }
  std::uint64_t refused() const noexcept { return intake_.refused(); }

 private:
  Intake<ParameterRequest, capacity> intake_;
  Doorbell* bell_ = nullptr;
};

/// Answers to one requester. push: any thread. pop, has_any: the requester's thread.
class AnswerQueue {
 public:
  static constexpr std::uint32_t capacity = 64;

  void set_bell(Doorbell* requester) noexcept { bell_ = requester; }

  /// A requester that does not fetch its answers loses them; they are counted.
  void push(const ParameterAnswer& answer) noexcept {
    if (intake_.put(answer) && bell_ != nullptr) bell_->ring();
  }
  bool pop(ParameterAnswer& answer) noexcept { return intake_.take(answer); }
  bool has_any() const noexcept { return intake_.has_any(); }
  std::uint64_t dropped() const noexcept { return intake_.refused(); }

 private:
  Intake<ParameterAnswer, capacity> intake_;
  Doorbell* bell_ = nullptr;
};

}  // namespace flexrf
