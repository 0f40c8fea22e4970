#include "runtime/parameters/parameter_store.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "runtime/core/scalar_types.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

bool is_momentary(const FieldDescriptor& field) noexcept {
  return field.scalar == Scalar::button || field.scalar == Scalar::hold;
}

Status invalid(const char* reason) noexcept {
  return Status::error(StatusCode::invalid_argument, "%s", reason);
}

bool is_saved(const ParameterDescriptor& parameter) noexcept {
  return parameter.persist && !is_momentary(*parameter.field);
}

}  // namespace

Status RuntimeParameters::connect(Component& component, SlotControl* slot, const void* defaults,
                                  ParameterScratch& scratch) noexcept {
  component_ = &component;
  block_ = &component.type_in_force().runtime;
  values_ = nullptr;
  slot_ = slot;
  defaults_ = static_cast<const std::byte*>(defaults);
  proposed_ = scratch.bytes;
  live_leases_ = 0;
  pressed_ = false;
  if (block_->type == nullptr) return {};
  if (block_->type->size > max_runtime_size)
    return Status::error(
        StatusCode::invalid_argument,
        "%s: runtime parameters of %u bytes, at most %zu are possible: move large ones to the "
        "configuration",
        component.name(), block_->type->size, max_runtime_size);
  // A component that is constructed anew has its offsets as before or, with another driver, anew: in either
  // case no lease of the former one may start again.
  std::uint64_t newest = 0;
  for (std::uint32_t i = 0; i < lease_count_; ++i) newest = std::max(newest, leases_[i].newest);
  lease_count_ = 0;
  for (const ParameterDescriptor& parameter : block_->parameters) {
    if (parameter.field->scalar != Scalar::hold) continue;
    for (std::uint32_t element = 0; element < parameter.field->count; ++element) {
      if (lease_count_ == max_holds)
        return Status::error(StatusCode::invalid_argument, "%s: more than %zu holds", component.name(),
                             max_holds);
      leases_[lease_count_++] = {parameter.field->offset + element, 0, false, false, newest, 0, 0, {}};
    }
  }
  values_ = static_cast<std::byte*>(component.parameter_memory().runtime);
  // One that is constructed anew keeps what was set before.
  if (record_.size() != block_->type->size) {
    former_.assign(values_, values_ + block_->type->size);
    kept_ = former_;
    marks_ = SetMarks(block_->type->size);
    record_.reserve(block_->type->size);
    record_.publish(kept_.data(), marks_);
  }
  return {};
}

void RuntimeParameters::restore(const SetMarks& marks) noexcept {
  if (values_ == nullptr || marks.size() != former_.size()) return;
  std::copy_n(values_, former_.size(), former_.begin());
  kept_ = former_;
  std::copy(marks.flags().begin(), marks.flags().end(), marks_.flags().begin());
  record_.publish(kept_.data(), marks_);
}

Status RuntimeParameters::adopt(const void* values, Time now) noexcept {
  if (values_ == nullptr) return {};
  propose(values);
  std::uint16_t parameter = no_parameter;
  Status status = check_block(*block_, proposed_, parameter);
  if (status) status = accept_proposed();
  if (!status) {
    put_settings_back();
    return status;
  }
  end_leases("the unit began anew", now);
  pressed_ = false;
  commit_settings(now);
  return {};
}

ParameterAnswer RuntimeParameters::apply(const ParameterRequest& request, Time now,
                                         const void* base) noexcept {
  if (values_ == nullptr && request.kind != RequestKind::activate && request.kind != RequestKind::clone &&
      request.kind != RequestKind::retire)
    return ParameterAnswer::refused(request, 0, no_parameter, "there are no runtime parameters");
  end_overdue_leases(now);
  const bool keeps_going = request.kind == RequestKind::refresh || request.kind == RequestKind::release;
  if (request.expected.has_value() && !keeps_going) {
    // Sequences wrap around; what was seen must lie between the last change of settings and now.
    const bool is_current = *request.expected - settings_ <= sequence_ - settings_;
    if (!is_current) return ParameterAnswer::stale(request, sequence_);
  }
  Verdict verdict;
  switch (request.kind) {
    case RequestKind::set:
    case RequestKind::reset:
      verdict = apply_values(request, now);
      break;
    case RequestKind::activate:
    case RequestKind::clone:
      if (values_ != nullptr) verdict = apply_member(request, now, base);
      break;
    case RequestKind::retire:
      end_all_leases(now);
      break;
    case RequestKind::press:
      verdict = apply_presses(request, now);
      break;
    case RequestKind::hold:
    case RequestKind::refresh:
    case RequestKind::release:
      verdict = apply_hold(request, now);
      break;
  }
  if (!verdict.status)
    return ParameterAnswer::refused(request, sequence_, verdict.parameter, verdict.status.cause());
  return ParameterAnswer::accepted(request, sequence_);
}

// ---- values

RuntimeParameters::Verdict RuntimeParameters::apply_values(const ParameterRequest& request,
                                                           Time now) noexcept {
  std::memcpy(proposed_, values_, block_->type->size);
  if (request.kind == RequestKind::set) {
    if (const Verdict verdict = propose_changes(request); !verdict.status) return verdict;
  } else {
    const auto reset = [this](const FieldDescriptor& field) {
      if (is_momentary(field)) return;
      if (defaults_ == nullptr)
        std::memset(proposed_ + field.offset, 0, field_size(field));
      else
        std::memcpy(proposed_ + field.offset, defaults_ + field.offset, field_size(field));
    };
    for (std::uint16_t i = 0; i < request.change_count; ++i) {
      Verdict verdict;
      const ParameterDescriptor* parameter = parameter_of(request.changes[i], request, verdict);
      if (parameter == nullptr) return verdict;
      reset(*parameter->field);
    }
    if (request.change_count == 0)
      for (const ParameterDescriptor& parameter : block_->parameters) reset(*parameter.field);
  }
  if (const Status status = accept_proposed(); !status) return {status};
  note_changes(request, now);
  commit_settings(now);
  return {};
}

RuntimeParameters::Verdict RuntimeParameters::apply_member(const ParameterRequest& request, Time now,
                                                           const void* base) noexcept {
  if (base == nullptr && request.kind == RequestKind::clone) return {invalid("there is no member to clone")};
  propose(base == nullptr ? defaults_ : base);
  if (const Verdict verdict = propose_changes(request); !verdict.status) return verdict;
  Verdict verdict;
  verdict.status = check_block(*block_, proposed_, verdict.parameter);
  if (!verdict.status) return verdict;
  if (const Status status = accept_proposed(); !status) return {status};
  end_leases("the member began anew", now);
  pressed_ = false;
  if (request.keeps) {
    kept_changed_ |= marks_.clear(0, marks_.size());
    // Somebody chose the other member's values for this one.
    if (request.kind == RequestKind::clone) keep_differences(defaults_);
  }
  note_changes(request, now);
  commit_settings(now);
  return {};
}

RuntimeParameters::Verdict RuntimeParameters::apply_presses(const ParameterRequest& request,
                                                            Time now) noexcept {
  std::memcpy(proposed_, values_, block_->type->size);
  for (std::uint16_t i = 0; i < request.change_count; ++i) {
    const ParameterChange& change = request.changes[i];
    Verdict verdict;
    const ParameterDescriptor* parameter = parameter_of(change, request, verdict);
    if (parameter == nullptr) return verdict;
    if (parameter->field->scalar != Scalar::button || change.size != sizeof(std::uint32_t))
      return {invalid("not a button"), change.parameter};
    std::byte* const at = proposed_ + parameter->field->offset + change.offset;
    const auto before = load<std::uint32_t>(at);
    const auto more = load<std::uint32_t>(request.values + change.position);
    store(at, before + std::min(more, std::numeric_limits<std::uint32_t>::max() - before));
  }
  if (const Status status = accept_proposed(); !status) return {status};
  if (audit_ != nullptr && request.who[0] != '\0') {
    for (std::uint16_t i = 0; i < request.change_count; ++i) {
      const ParameterChange& change = request.changes[i];
      AuditRecord record = record_of(AuditRecord::Kind::press, request,
                                     block_->parameters[change.parameter].field->offset + change.offset, now);
      record.size = sizeof(std::uint32_t);
      record.number = load<std::uint32_t>(request.values + change.position);
      audit_->put(record);
    }
  }
  std::memcpy(values_, proposed_, block_->type->size);
  pressed_ = true;
  publish(now);
  return {};
}

RuntimeParameters::Verdict RuntimeParameters::propose_changes(const ParameterRequest& request) noexcept {
  for (std::uint16_t i = 0; i < request.change_count; ++i) {
    const ParameterChange& change = request.changes[i];
    Verdict verdict;
    const ParameterDescriptor* parameter = parameter_of(change, request, verdict);
    if (parameter == nullptr) return verdict;
    if (is_momentary(*parameter->field))
      return {invalid(parameter->field->scalar == Scalar::button ? "a button is pressed, not set"
                                                                 : "a hold is held under a lease, not set"),
              change.parameter};
    std::memcpy(proposed_ + parameter->field->offset + change.offset, request.values + change.position,
                change.size);
  }
  // Only now: two changes may touch one structure.
  for (std::uint16_t i = 0; i < request.change_count; ++i) {
    const std::uint16_t index = request.changes[i].parameter;
    const ParameterDescriptor& parameter = block_->parameters[index];
    ValueRange range{};
    const Status status = check_value(*parameter.field, parameter.field->count,
                                      proposed_ + parameter.field->offset, range_of(parameter, range));
    if (!status) return {status, index};
  }
  return {};
}

// A whole set of values, without presses and holds.
void RuntimeParameters::propose(const void* base) noexcept {
  if (base == nullptr)
    std::memset(proposed_, 0, block_->type->size);
  else
    std::memcpy(proposed_, base, block_->type->size);
  for (const ParameterDescriptor& parameter : block_->parameters)
    if (is_momentary(*parameter.field))
      std::memset(proposed_ + parameter.field->offset, 0, field_size(*parameter.field));
}

Status RuntimeParameters::accept_proposed() noexcept {
  return component_->accept_runtime(proposed_);
}

AuditRecord RuntimeParameters::record_of(AuditRecord::Kind kind, const ParameterRequest& request,
                                         std::uint32_t offset, Time now) const noexcept {
  AuditRecord record;
  record.kind = kind;
  record.component = index_;
  record.offset = offset;
  record.at = now;
  std::memcpy(record.who, request.who, sizeof(record.who));
  return record;
}

const char* RuntimeParameters::unmet_need(const ParameterRequest& request, bool may_move) const noexcept {
  if (values_ == nullptr || (request.kind != RequestKind::press && request.kind != RequestKind::hold))
    return nullptr;
  const std::byte* const feedback = static_cast<const std::byte*>(component_->parameter_memory().feedback);
  for (std::uint16_t i = 0; i < request.change_count; ++i) {
    // Who names no parameter is refused by apply(), with words of its own.
    if (request.changes[i].parameter >= block_->parameters.size()) continue;
    for (const CommandNeed& need : block_->parameters[request.changes[i].parameter].needs) {
      if (need.kind == CommandNeed::Kind::motion) {
        if (!may_move) return need.reason;
        continue;
      }
      const bool is_feedback = need.kind == CommandNeed::Kind::feedback;
      const TypeDescriptor* const type =
          is_feedback ? component_->type_in_force().feedback.type : block_->type;
      const std::byte* const values = is_feedback ? feedback : values_;
      if (type == nullptr || values == nullptr) return need.reason;
      const Result<FieldPlace> place = find_field(*type, need.field);
      const unsigned number = place ? load<std::uint8_t>(values + place->offset) : 64U;
      if (number >= 64 || (need.numbers >> number & 1U) == 0) return need.reason;
    }
  }
  return nullptr;
}

void RuntimeParameters::commit_settings(Time now) noexcept {
  std::memcpy(values_, proposed_, block_->type->size);
  publish(now);
  settings_ = sequence_;
  if (!kept_changed_) return;
  kept_changed_ = false;
  record_.publish(kept_.data(), marks_);
  if (revision_ != nullptr) revision_->fetch_add(1, std::memory_order_acq_rel);
}

// ---- what is kept in the configuration file

/// `set` marks what it names, `reset` gives it back to the tables. Who did it is told.
void RuntimeParameters::note_changes(const ParameterRequest& request, Time now) noexcept {
  if (audit_ != nullptr)
    audit_->note_differences(request.who, index_, ParameterKind::runtime, *block_, values_, proposed_, now);
  if (!request.keeps) return;
  const auto apply_to = [&](const ParameterDescriptor& parameter, std::size_t offset, std::size_t size) {
    if (!is_saved(parameter)) return;
    if (request.kind == RequestKind::reset)
      kept_changed_ |= marks_.clear(offset, size);
    else
      keep(offset, size);
  };
  for (std::uint16_t i = 0; i < request.change_count; ++i) {
    const ParameterChange& change = request.changes[i];
    const ParameterDescriptor& parameter = block_->parameters[change.parameter];
    const FieldDescriptor& field = *parameter.field;
    if (request.kind == RequestKind::reset)
      apply_to(parameter, field.offset, field_size(field));
    else
      apply_to(parameter, field.offset + change.offset, change.size);
  }
  if (request.kind == RequestKind::reset && request.change_count == 0)
    kept_changed_ |= marks_.clear(0, marks_.size());
}

/// Of the proposed values; bytes within the struct.
void RuntimeParameters::keep(std::size_t offset, std::size_t size) noexcept {
  std::byte* const kept = kept_.data() + offset;
  kept_changed_ |= marks_.mark(offset, size);
  kept_changed_ |= std::memcmp(kept, proposed_ + offset, size) != 0;
  std::memcpy(kept, proposed_ + offset, size);
}

/// `before`: the whole struct; null: zeros.
void RuntimeParameters::keep_differences(const std::byte* before) noexcept {
  for (const ParameterDescriptor& parameter : block_->parameters)
    if (is_saved(parameter)) keep_differing(*parameter.field, before, 0);
}

/// Each value below the field that differs, as a whole. The field lies in a struct that lies `offset` bytes
/// within the outermost one.
void RuntimeParameters::keep_differing(const FieldDescriptor& field, const std::byte* before,
                                       std::size_t offset) noexcept {
  const std::size_t at = offset + field.offset;
  if (field.scalar != Scalar::structure) {
    const std::size_t size = field_size(field);
    const std::byte* const now = proposed_ + at;
    const bool same = before == nullptr
                          ? std::all_of(now, now + size, [](std::byte b) { return b == std::byte{0}; })
                          : std::memcmp(before + at, now, size) == 0;
    if (!same) keep(at, size);
    return;
  }
  for (std::uint32_t element = 0; element < field.count; ++element)
    for (const FieldDescriptor& member : field.type->fields)
      keep_differing(member, before, at + element * element_size(field));
}

// ---- what the component changes by itself

Status RuntimeParameters::judge_own_changes(Time now) noexcept {
  const bool any =
      std::any_of(block_->parameters.begin(), block_->parameters.end(), [this](const auto& parameter) {
        const FieldDescriptor& field = *parameter.field;
        return !is_momentary(field) &&
               std::memcmp(values_ + field.offset, former_.data() + field.offset, field_size(field)) != 0;
      });
  if (!any) {  // a press or a hold, or the bytes between the fields
    std::copy_n(values_, former_.size(), former_.begin());
    return {};
  }
  std::memcpy(proposed_, values_, former_.size());
  if (const Status status = check_own_changes(); !status) {
    put_settings_back();
    return Status::error(status.code(),
                         "it changed its own values, and they are refused: %s; they are as before",
                         status.cause());
  }
  // In a step with a press a person asked for it; otherwise a unit would wear out the disk.
  if (pressed_) keep_differences(former_.data());
  commit_settings(now);
  return {};
}

Status RuntimeParameters::check_own_changes() noexcept {
  std::uint16_t parameter = no_parameter;
  if (const Status status = check_block(*block_, proposed_, parameter); !status) return status;
  return accept_proposed();
}

/// Presses and holds are what persons do, not settings.
void RuntimeParameters::put_settings_back() noexcept {
  for (const ParameterDescriptor& parameter : block_->parameters) {
    const FieldDescriptor& field = *parameter.field;
    if (!is_momentary(field))
      std::memcpy(values_ + field.offset, former_.data() + field.offset, field_size(field));
  }
}

const ParameterDescriptor* RuntimeParameters::parameter_of(const ParameterChange& change,
                                                           const ParameterRequest& request,
                                                           Verdict& verdict) const noexcept {
  if (change.parameter >= block_->parameters.size()) {
    verdict = {Status::error(StatusCode::not_found, "there is no runtime parameter number %u",
                             static_cast<unsigned>(change.parameter)),
               change.parameter};
    return nullptr;
  }
  const ParameterDescriptor& parameter = block_->parameters[change.parameter];
  const std::size_t end = std::size_t{change.position} + change.size;
  const bool has_value = request.kind != RequestKind::reset;
  if (end > ParameterRequest::max_value_bytes ||
      (has_value && !is_whole(*parameter.field, change.offset, change.size))) {
    verdict = {Status::error(StatusCode::invalid_argument, "%u bytes at %u of '%s' are no whole elements",
                             static_cast<unsigned>(change.size), change.offset, parameter.field->name),
               change.parameter};
    return nullptr;
  }
  return &parameter;
}

// ---- holds

RuntimeParameters::Lease* RuntimeParameters::lease_of(std::uint32_t offset) noexcept {
  for (std::uint32_t i = 0; i < lease_count_; ++i)
    if (leases_[i].offset == offset) return &leases_[i];
  return nullptr;
}

RuntimeParameters::Verdict RuntimeParameters::apply_hold(const ParameterRequest& request, Time now) noexcept {
  if (request.change_count != 1) return {invalid("a lease is for one hold")};
  const ParameterChange& change = request.changes[0];
  Lease* lease = nullptr;
  if (change.parameter < block_->parameters.size()) {
    const FieldDescriptor& field = *block_->parameters[change.parameter].field;
    if (field.scalar == Scalar::hold && change.offset < field.count)
      lease = lease_of(field.offset + change.offset);
  }
  if (lease == nullptr) return {invalid("not a hold"), change.parameter};
  if (request.lease == 0) return {invalid("a lease has a number from new_lease_number()"), change.parameter};

  const bool is_live = lease->live && lease->number == request.lease && lease->requester == request.requester;
  const bool is_unseen = request.lease > lease->newest;
  // Whatever comes of it, this number starts nothing any more: a lease that was refused or ended before it
  // began must not begin later.
  lease->newest = std::max(lease->newest, request.lease);
  switch (request.kind) {
    case RequestKind::release:
      if (is_live) {
        end_lease(*lease, "released", now);
        publish(now);
      }
      return {};
    case RequestKind::refresh:
      if (!is_live)
        return {invalid(is_unseen ? "this lease was never begun: press again"
                                  : "the lease has ended: press again"),
                change.parameter};
      return refresh_lease(request, *lease, now);
    default:
      if (!is_unseen) return {invalid("the lease was used before: each press has its own"), change.parameter};
      return start_lease(request, *lease, now);
  }
}

RuntimeParameters::Verdict RuntimeParameters::start_lease(const ParameterRequest& request, Lease& lease,
                                                          Time now) noexcept {
  const std::uint16_t parameter = request.changes[0].parameter;
  if (lease.live && lease.requester != request.requester)
    return {Status::error(StatusCode::busy, "another holds it"), parameter};
  const Time issued_at = request.issued_at == Time{} ? now : std::min(request.issued_at, now);
  if (issued_at + lease_time <= now)
    return {Status::error(StatusCode::timeout, "the press waited too long: press again"), parameter};
  std::memcpy(proposed_, values_, block_->type->size);
  store<std::uint8_t>(proposed_ + lease.offset, 1);
  if (const Status status = accept_proposed(); !status) return {status, parameter};
  // A new press of the one who held it already.
  if (lease.live) end_lease(lease, "pressed anew", now);
  ++live_leases_;
  lease.live = true;
  lease.audited = request.who[0] != '\0';
  lease.requester = request.requester;
  lease.number = request.lease;
  lease.sequence = request.lease_sequence;
  lease.deadline = issued_at + lease_time;
  store<std::uint8_t>(values_ + lease.offset, 1);
  if (audit_ != nullptr && lease.audited) {
    AuditRecord record = record_of(AuditRecord::Kind::hold_begin, request, lease.offset, now);
    record.size = 1;
    record.number = lease.number;
    audit_->put(record);
  }
  publish(now);
  return {};
}

RuntimeParameters::Verdict RuntimeParameters::refresh_lease(const ParameterRequest& request, Lease& lease,
                                                            Time now) noexcept {
  const std::uint16_t parameter = request.changes[0].parameter;
  if (request.lease_sequence <= lease.sequence)
    return {invalid("the refresh is older than the last: its sequence did not increase"), parameter};
  lease.sequence = request.lease_sequence;
  const Time issued_at = request.issued_at == Time{} ? now : std::min(request.issued_at, now);
  lease.deadline = std::max(lease.deadline, issued_at + lease_time);
  return {};
}

void RuntimeParameters::end_overdue_leases(Time now) noexcept {
  if (live_leases_ == 0) return;
  bool any = false;
  for (std::uint32_t i = 0; i < lease_count_; ++i) {
    if (!leases_[i].live || now < leases_[i].deadline) continue;
    end_lease(leases_[i], "nobody asked for it any more", now);
    any = true;
  }
  if (any) publish(now);
}

void RuntimeParameters::end_all_leases(Time now) noexcept {
  if (live_leases_ == 0) return;
  end_leases("motion was stopped, or the unit", now);
  publish(now);
}

void RuntimeParameters::end_leases(const char* why, Time now) noexcept {
  for (std::uint32_t i = 0; i < lease_count_; ++i)
    if (leases_[i].live) end_lease(leases_[i], why, now);
}

void RuntimeParameters::end_lease(Lease& lease, const char* why, Time now) noexcept {
  if (audit_ != nullptr && lease.audited) {
    AuditRecord record;
    record.kind = AuditRecord::Kind::hold_end;
    record.component = index_;
    record.offset = lease.offset;
    record.size = 1;
    record.number = lease.number;
    record.at = now;
    record.did = why;
    // Whoever writes it down knows whose lease it is.
    record.who[0] = '?';
    audit_->put(record);
  }
  lease.live = false;
  --live_leases_;
  store<std::uint8_t>(values_ + lease.offset, 0);
}

// ----

void RuntimeParameters::clear_presses(Time now) noexcept {
  pressed_ = false;
  for (const ParameterDescriptor& parameter : block_->parameters)
    if (parameter.field->scalar == Scalar::button)
      std::memset(values_ + parameter.field->offset, 0, field_size(*parameter.field));
  publish(now);
}

void RuntimeParameters::publish(Time now) noexcept {
  std::copy_n(values_, former_.size(), former_.begin());
  if (slot_ == nullptr) {
    sequence_ = next_sequence(sequence_);
    return;
  }
  const std::uint8_t buffer = slot_->loan();
  const std::size_t size = block_->type->size;
  std::memcpy(slot_->payload(buffer), values_, size);
  slot_->publish(buffer, now);
  sequence_ = slot_->header(buffer).sequence;
}

}  // namespace flexrf
