#include "web-ui/server/api/parameter_operations.hpp"

#include <charconv>

#include "runtime/face/change.hpp"

namespace flexrf::panel {
namespace {

Refusal no_place() noexcept {
  return Refusal::make(RefusalKind::busy, "Too many requests wait for an answer; try again in a moment.");
}

}  // namespace

void write_etag(std::string& etag, std::string_view boot, std::uint64_t sequence) {
  char digits[24];
  etag.assign("\"").append(boot).append("-");
  etag.append(digits, std::to_chars(digits, digits + sizeof(digits), sequence).ptr).append("\"");
}

Status ParameterOperations::prepare(Doorbell* bell) {
  queue_.set_bell(bell);
  requester_ = cell_->add_requester(queue_);
  if (requester_ != 0) return {};
  return Status::error(StatusCode::internal, "the panel: there are %zu requesters already",
                       Cell::max_requesters);
}

// ---- operations

void ParameterOperations::set(const Caller& caller, ComponentIndex component, JsonObject values,
                              std::optional<std::uint64_t> expected, Time now) {
  ParameterRequest request;
  request.expected = expected;
  Role role = Role::operator_;
  const auto refusal = add_values(directory_->entry(component), values, request, role);
  // Who may not change anything is told so first, and learns no more.
  if (!permission_->may_control(caller, refusal ? Role::operator_ : role, "change parameters")) return;
  if (refusal) return answers_->refuse(caller, *refusal);
  request.component = component;
  request.set_who(permission_->who(caller));
  send(request, {caller, component, Purpose::values, 0, {}}, now);
}

void ParameterOperations::reset(const Caller& caller, ComponentIndex component,
                                std::optional<JsonArray> parameters, Time now) {
  ParameterRequest request;
  request.kind = RequestKind::reset;
  Role role = Role::operator_;
  std::optional<Refusal> refusal;
  if (parameters) {
    for (const JsonElement name : *parameters) {
      std::string_view path;
      if (name.get(path) != simdjson::SUCCESS) {
        refusal = Refusal::make(RefusalKind::bad_request, "'parameters' is a list of names.");
      } else {
        refusal = add_name(directory_->entry(component), path, request, role);
      }
      if (refusal) break;
    }
  } else {
    for (const ParameterDescriptor& parameter : directory_->entry(component).type->runtime.parameters)
      role = std::max(role, parameter.role);
  }
  if (!permission_->may_control(caller, refusal ? Role::operator_ : role, "reset parameters")) return;
  if (refusal) return answers_->refuse(caller, *refusal);
  request.component = component;
  request.set_who(permission_->who(caller));
  send(request, {caller, component, Purpose::values, 0, {}}, now);
}

void ParameterOperations::press(const Caller& caller, ComponentIndex component, std::string_view parameter,
                                std::uint64_t count, Time now) {
  ParameterRequest request;
  Role role = Role::operator_;
  const auto refusal = add_presses(directory_->entry(component), parameter, count, request, role);
  if (!permission_->may_control(caller, refusal ? Role::operator_ : role, "press a button")) return;
  if (refusal) return answers_->refuse(caller, *refusal);
  request.component = component;
  request.set_who(permission_->who(caller));
  send(request, {caller, component, Purpose::plain, 0, {}}, now);
}

void ParameterOperations::hold(const Caller& caller, ComponentIndex component, std::string_view parameter,
                               Time now) {
  ParameterRequest request;
  request.kind = RequestKind::hold;
  Role role = Role::operator_;
  const auto refusal = add_name(directory_->entry(component), parameter, request, role);
  if (!permission_->may_control(caller, refusal ? Role::operator_ : role, "hold")) return;
  if (refusal) return answers_->refuse(caller, *refusal);
  request.component = component;
  request.set_who(permission_->who(caller));
  request.lease = new_lease_number();
  request.lease_sequence = 1;
  const Lease lease{
      request.lease, caller, component, request.changes[0].parameter, request.changes[0].offset, 1};
  if (leases_.add(lease) == nullptr) return answers_->refuse(caller, no_place());
  if (!send(request, {caller, component, Purpose::hold, request.lease, {}}, now))
    leases_.forget(request.lease);
}

void ParameterOperations::refresh(const Caller& caller, std::string_view text, Time now) {
  Lease* const lease = lease_of(caller, text);
  if (lease == nullptr) return;
  ParameterRequest request;
  request.kind = RequestKind::refresh;
  request.component = lease->component;
  request.lease = lease->number;
  request.lease_sequence = ++lease->sequence;
  request.add_name(lease->parameter, lease->offset);
  send(request, {caller, lease->component, Purpose::refresh, lease->number, {}}, now);
}

void ParameterOperations::release(const Caller& caller, std::string_view text, Time now) {
  Lease* const lease = lease_of(caller, text);
  if (lease == nullptr) return;
  send_release(*lease, now);
  leases_.forget(lease->number);
  answers_->done(caller);
}

void ParameterOperations::change_member(const Caller& caller, ComponentIndex component, RequestKind kind,
                                        ComponentIndex source, Time now) {
  if (!permission_->may_control(caller, Role::operator_, "change a population")) return;
  ParameterRequest request;
  request.kind = kind;
  request.component = component;
  request.set_who(permission_->who(caller));
  request.source = source;
  send(request, {caller, component, Purpose::plain, 0, {}}, now);
}

// ---- holds

Lease* ParameterOperations::lease_of(const Caller& caller, std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  Lease* const lease =
      error == std::errc{} && end == text.data() + text.size() ? leases_.find(number) : nullptr;
  if (lease != nullptr && lease->owner.place == caller.place && lease->owner.opening == caller.opening)
    return lease;
  answers_->refuse(caller, Refusal::make(RefusalKind::wrong_state, "This hold is over; press again."));
  return nullptr;
}

/// Nobody waits for its answer: if it is lost, the lease ends by itself, as nothing refreshes it.
void ParameterOperations::send_release(const Lease& lease, Time now) {
  ParameterRequest request;
  request.kind = RequestKind::release;
  request.component = lease.component;
  request.lease = lease.number;
  request.lease_sequence = lease.sequence + 1;
  request.requester = requester_;  // nobody else's release counts
  request.issued_at = now;
  request.add_name(lease.parameter, lease.offset);
  cell_->send(request);
}

void ParameterOperations::end_holds_of_client(std::uint32_t place, Time now) {
  leases_.end_if([place](const Lease& lease) { return lease.owner.place == place; },
                 [this, now](const Lease& lease) { send_release(lease, now); });
}

void ParameterOperations::end_holds_of_session(SessionIndex session, Time now) {
  leases_.end_if([session](const Lease& lease) { return lease.owner.session == session; },
                 [this, now](const Lease& lease) { send_release(lease, now); });
}

void ParameterOperations::forget_holds() {
  leases_.end_if([](const Lease&) { return true; }, [](const Lease&) {});
}

// ---- requests and answers

bool ParameterOperations::send(ParameterRequest& request, PendingRequest pending, Time now) {
  pending.overdue_at = now + answer_timeout_;
  request.correlation = pending_.add(pending);
  if (request.correlation == 0) {
    answers_->refuse(pending.caller, no_place());
    return false;
  }
  request.requester = requester_;
  request.issued_at = now;
  cell_->send(request);
  return true;
}

void ParameterOperations::tick(Time now) {
  ParameterAnswer answer;
  PendingRequest pending;
  while (queue_.pop(answer)) {
    if (!pending_.take(answer.correlation, pending)) continue;
    if (answer.kind == AnswerKind::accepted) {
      accept(pending, answer);
    } else {
      refuse(pending, answer);
    }
  }
  while (pending_.take_overdue(now, pending)) {
    // Whatever becomes of it: nobody knows, so nobody may go on holding.
    if (pending.lease != 0) leases_.forget(pending.lease);
    answers_->refuse(pending.caller, no_answer(directory_->entry(pending.component), answer_timeout_));
  }
}

void ParameterOperations::accept(const PendingRequest& pending, const ParameterAnswer& answer) {
  switch (pending.purpose) {
    case Purpose::plain:
      return answers_->done(pending.caller);
    case Purpose::refresh:
      return;
    case Purpose::hold: {
      const Lease* const lease = leases_.find(pending.lease);
      if (lease == nullptr) {
        return answers_->refuse(
            pending.caller,
            Refusal::make(RefusalKind::wrong_state, "The hold ended before it began; press again."));
      }
      char digits[24];
      const char* const end = std::to_chars(digits, digits + sizeof(digits), pending.lease).ptr;
      const std::string_view text(digits, static_cast<std::size_t>(end - digits));
      return answers_->done(pending.caller, [text](JsonWriter& json) { json.member("lease", text); });
    }
    case Purpose::values:
      break;
  }
  // What was published before this answer came is what the answer speaks of.
  slots_->begin_turn();
  std::uint64_t sequence = values_->sequence(pending.component);
  if (sequence == 0) sequence = answer.sequence;
  const bool is_rest = pending.caller.kind == Caller::Kind::rest;
  if (Reply* reply = answers_->reply_of(pending.caller); reply != nullptr)
    write_etag(reply->etag, boot_, sequence);
  answers_->done(pending.caller, [&](JsonWriter& json) {
    if (is_rest) return values_->write_all(json, pending.component);
    json.member("sequence", sequence).key("values");
    values_->write_runtime(json, pending.component);
  });
}

void ParameterOperations::refuse(const PendingRequest& pending, const ParameterAnswer& answer) {
  // A refresh that found the queue full may be followed by one that does not.
  if (pending.purpose == Purpose::refresh && answer.kind == AnswerKind::busy) return;
  if (pending.lease != 0) leases_.forget(pending.lease);
  answers_->refuse(pending.caller, refusal_of(answer, directory_->entry(pending.component)));
}

}  // namespace flexrf::panel
