// The runtime parameters of one component, as its owning thread keeps them: applies requests between two
// steps, counts presses, ends leases, checks what the component changes by itself, publishes the values in
// force, and remembers which of them a person or a script has set.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/blackboard/slot.hpp"
#include "runtime/core/parameter_descriptor.hpp"
#include "runtime/parameters/request.hpp"
#include "runtime/parameters/set_marks.hpp"
#include "runtime/parameters/settings_record.hpp"
#include "runtime/unit/component.hpp"

namespace flexrf {

/// Bytes of the largest struct of runtime parameters.
inline constexpr std::size_t max_runtime_size = 4096;
/// Hold elements of one component.
inline constexpr std::size_t max_holds = 32;
/// How long a hold stays true after its last request.
inline constexpr Duration lease_time = std::chrono::milliseconds{250};

/// Where proposed values are checked before they come into force. One per thread serves all its components.
struct ParameterScratch {
  alignas(cache_line) std::byte bytes[max_runtime_size];
};

/// No function but the first connect() allocates, none waits; each is bounded by the size of the struct. All,
/// but what says otherwise: the owning thread (before the start: the one that prepares).
class RuntimeParameters {
 public:
  /// Rises whenever what belongs into the configuration file changes. Before connect(); null: nobody asks.
  void set_revision(std::atomic<std::uint64_t>& revision) noexcept { revision_ = &revision; }
  /// `slot` (may be null): where values in force are published. `defaults` (null: zero): the values of the
  /// tables. Refuses a component whose parameters exceed max_runtime_size or max_holds. To be called again
  /// for a component that was constructed anew. Does not touch the component's values.
  Status connect(Component& component, SlotControl* slot, const void* defaults,
                 ParameterScratch& scratch) noexcept;
  /// From connect() on.
  Component& component() const noexcept { return *component_; }
  bool has_any() const noexcept { return values_ != nullptr; }
  /// Before the start: the values in the component's memory are those of the configuration file, which gives
  /// the marked ones.
  void restore(const SetMarks& marks) noexcept;
  /// Where what persons change is told. Before the start; without it nowhere.
  void set_audit(AuditIntake& audit, std::uint16_t component) noexcept {
    audit_ = &audit;
    index_ = component;
  }

  /// Takes a whole set of values (at start: the tables' or the saved ones; after a restart: the former).
  /// Checked as a request is; buttons and holds become zero. Publishes. After an error the last good values
  /// are in the component's memory.
  Status adopt(const void* values, Time now) noexcept;

  /// Between two steps. All changes or none: ranges, then the component's accept, then the values are in
  /// force and published. activate and clone start from `base` (clone: the other member's values(); null: the
  /// tables'); retire ends all leases. Making a member active or not and reset() are the executive's.
  ParameterAnswer apply(const ParameterRequest& request, Time now, const void* base = nullptr) noexcept;

  /// What a press or a hold needs and has not (CommandNeed); null: it has all, or is neither. `may_move`:
  /// motion is permitted. The text lives for ever.
  const char* unmet_need(const ParameterRequest& request, bool may_move) const noexcept;

  /// Before each step: ends the leases whose time is over.
  void before_step(Time now) noexcept {
    if (live_leases_ != 0) end_overdue_leases(now);
  }
  /// After each step: it has seen the presses. What it changed of its own settings is checked as a request
  /// is; an error when it is refused: the component goes into fault, and all its settings are as before the
  /// step. It belongs into the configuration file only where the step saw a press, as then a person asked for
  /// it.
  [[nodiscard]] Status after_step(Time now) noexcept {
    Status status = take_own_changes(now);
    if (pressed_) clear_presses(now);
    return status;
  }
  /// The same of its settings, after other code of the component that may have changed them.
  [[nodiscard]] Status take_own_changes(Time now) noexcept {
    if (values_ == nullptr || std::memcmp(values_, former_.data(), former_.size()) == 0) [[likely]]
      return {};
    return judge_own_changes(now);
  }
  /// Stop motion, fault, stop: every hold becomes false; none of these leases revives.
  void end_all_leases(Time now) noexcept;

  /// The values in force; null when the component has none.
  const void* values() const noexcept { return values_; }
  /// Of the values in force, as in the slot.
  std::uint64_t sequence() const noexcept { return sequence_; }
  /// What belongs into the configuration file. Any thread that is not real-time.
  const SettingsRecord& settings() const noexcept { return record_; }

 private:
  struct Lease {
    std::uint32_t offset;  // of the hold's bool in the struct
    std::uint16_t requester;
    bool live;
    bool audited;
    std::uint64_t newest;    // greatest lease number seen: neither it nor any below starts again
    std::uint64_t number;    // of the live lease
    std::uint64_t sequence;  // of its last request
    Time deadline;
  };
  // Why a request is refused; ok: it is not.
  struct Verdict {
    Status status;
    std::uint16_t parameter = no_parameter;
  };

  Verdict apply_values(const ParameterRequest& request, Time now) noexcept;
  Verdict apply_member(const ParameterRequest& request, Time now, const void* base) noexcept;
  Verdict apply_presses(const ParameterRequest& request, Time now) noexcept;
  Verdict apply_hold(const ParameterRequest& request, Time now) noexcept;
  Verdict start_lease(const ParameterRequest& request, Lease& lease, Time now) noexcept;
  Verdict refresh_lease(const ParameterRequest& request, Lease& lease, Time now) noexcept;

  Verdict propose_changes(const ParameterRequest& request) noexcept;
  void propose(const void* base) noexcept;
  Status accept_proposed() noexcept;
  void commit_settings(Time now) noexcept;
  Status judge_own_changes(Time now) noexcept;
  Status check_own_changes() noexcept;
  void put_settings_back() noexcept;
  void note_changes(const ParameterRequest& request, Time now) noexcept;
  void keep(std::size_t offset, std::size_t size) noexcept;
  void keep_differences(const std::byte* before) noexcept;
  void keep_differing(const FieldDescriptor& field, const std::byte* before, std::size_t offset) noexcept;
  const ParameterDescriptor* parameter_of(const ParameterChange& change, const ParameterRequest& request,
                                          Verdict& verdict) const noexcept;
  Lease* lease_of(std::uint32_t offset) noexcept;

  void end_overdue_leases(Time now) noexcept;
  void end_lease(Lease& lease, const char* why, Time now) noexcept;
  void end_leases(const char* why, Time now) noexcept;
  AuditRecord record_of(AuditRecord::Kind kind, const ParameterRequest& request, std::uint32_t offset,
                        Time now) const noexcept;
  void clear_presses(Time now) noexcept;
  void publish(Time now) noexcept;

  AuditIntake* audit_ = nullptr;
  std::uint16_t index_ = 0;
  Component* component_ = nullptr;
  const ParameterBlock* block_ = nullptr;
  std::byte* values_ = nullptr;
  const std::byte* defaults_ = nullptr;
  std::byte* proposed_ = nullptr;
  SlotControl* slot_ = nullptr;
  std::uint64_t sequence_ = 0;  // of the last publication
  std::uint64_t settings_ = 0;  // of the last publication that changed more than presses and holds
  std::uint32_t lease_count_ = 0;
  std::uint32_t live_leases_ = 0;
  bool pressed_ = false;
  std::vector<std::byte> former_;  // the values as they were published last: the last good ones
  std::vector<std::byte> kept_;    // the values for the configuration file, of which the marked ones count
  SetMarks marks_;
  bool kept_changed_ = false;  // or the marks, since the record was published
  SettingsRecord record_;      // of both
  std::atomic<std::uint64_t>* revision_ = nullptr;
  Lease leases_[max_holds]{};
};

}  // namespace flexrf
