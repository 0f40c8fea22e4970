#include "web-ui/server/api/parameter_operations.hpp"

#include <charconv>

#include "runtime/face/change.hpp"

namespace flexrf::panel {
namespace {

using Purpose = PendingRequest::Purpose;

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
  if (!is_granted(caller, refusal, role, "change parameters")) return;
  if (expect_answer(request, {caller, component, Purpose::values}, now)) cell_->send(request);
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
  if (!is_granted(caller, refusal, role, "reset parameters")) return;
  if (expect_answer(request, {caller, component, Purpose::values}, now)) cell_->send(request);
}

void ParameterOperations::press(const Caller& caller, ComponentIndex component, std::string_view parameter,
                                std::uint64_t count, Time now) {
  ParameterRequest request;
  Role role = Role::operator_;
  const auto refusal = add_presses(directory_->entry(component), parameter, count, request, role);
  if (!is_granted(caller, refusal, role, "press a button")) return;
  if (expect_answer(request, {caller, component, Purpose::plain}, now)) cell_->send(request);
}

void ParameterOperations::hold(const Caller& caller, ComponentIndex component, std::string_view parameter,
                               Time now) {
  ParameterRequest request;
  request.kind = RequestKind::hold;
  Role role = Role::operator_;
  const auto refusal = add_name(directory_->entry(component), parameter, request, role);
  if (!is_granted(caller, refusal, role, "hold")) return;
  request.lease = new_lease_number();
  request.lease_sequence = 1;
  const Lease lease{
      request.lease, caller, component, request.changes[0].parameter, request.changes[0].offset, 1};
  if (!leases_.add(lease)) return answers_->refuse(caller, no_place());
  if (!expect_answer(request, {caller, component, Purpose::hold, request.lease}, now))
    return forget_lease(request.lease);
  cell_->send(request);
}

void ParameterOperations::refresh(const Caller& caller, std::string_view text, Time now) {
  Lease* const lease = lease_of(caller, text);
  if (lease == nullptr) return;
  ParameterRequest request;
  request.kind = RequestKind::refresh;
  request.lease = lease->number;
  request.lease_sequence = ++lease->sequence;
  request.add_name(lease->parameter, lease->offset);
  if (expect_answer(request, {caller, lease->component, Purpose::refresh, lease->number}, now))
    cell_->send(request);
}

void ParameterOperations::release(const Caller& caller, std::string_view text, Time now) {
  Lease* const lease = lease_of(caller, text);
  if (lease == nullptr) return;
  send_release(*lease, now);
  forget_lease(lease->number);
  answers_->done(caller);
}

void ParameterOperations::change_member(const Caller& caller, ComponentIndex component, RequestKind kind,
                                        ComponentIndex source, Time now) {
  if (!permission_->may_control(caller, Role::operator_, "change a population")) return;
  ParameterRequest request;
  request.kind = kind;
  request.source = source;
  if (expect_answer(request, {caller, component, Purpose::plain}, now)) cell_->send(request);
}

// ---- holds

Lease* ParameterOperations::lease_of(const Caller& caller, std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  Lease* const lease =
      error == std::errc{} && end == text.data() + text.size() ? find_lease(number) : nullptr;
  if (lease != nullptr && lease->owner.place == caller.place && lease->owner.opening == caller.opening)
    return lease;
  answers_->refuse(caller, RefusalKind::wrong_state, "This hold is over; press again.");
  return nullptr;
}

Lease* ParameterOperations::find_lease(std::uint64_t number) {
  return leases_.find([number](const Lease& lease) { return lease.number == number; });
}

void ParameterOperations::forget_lease(std::uint64_t number) {
  leases_.take([number](const Lease& lease) { return lease.number == number; }, [](const Lease&) {});
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
  leases_.take([place](const Lease& lease) { return lease.owner.place == place; },
               [this, now](const Lease& lease) { send_release(lease, now); });
}

void ParameterOperations::end_holds_of_session(SessionIndex session, Time now) {
  leases_.take([session](const Lease& lease) { return lease.owner.session == session; },
               [this, now](const Lease& lease) { send_release(lease, now); });
}

void ParameterOperations::forget_holds() {
  leases_.take([](const Lease&) { return true; }, [](const Lease&) {});
}

// ---- requests and answers

bool ParameterOperations::is_granted(const Caller& caller, const std::optional<Refusal>& refusal, Role role,
                                     std::string_view act) {
  // Who may not change anything is told so first, and learns no more.
  if (!permission_->may_control(caller, refusal ? Role::operator_ : role, act)) return false;
  if (refusal) answers_->refuse(caller, *refusal);
  return !refusal;
}

bool ParameterOperations::expect_answer(ParameterRequest& request, PendingRequest pending, Time now) {
  pending.overdue_at = now + answer_timeout_;
  pending.correlation = request.correlation = ++last_correlation_;
  if (!pending_.add(pending)) {
    answers_->refuse(pending.caller, no_place());
    return false;
  }
  request.component = pending.component;
  if (pending.purpose != Purpose::refresh) request.set_who(permission_->who(pending.caller));
  request.requester = requester_;
  request.issued_at = now;
  return true;
}

void ParameterOperations::tick(Time now) {
  ParameterAnswer answer;
  while (queue_.pop(answer)) {
    pending_.take([&](const PendingRequest& one) { return one.correlation == answer.correlation; },
                  [&](const PendingRequest& pending) {
                    answer.kind == AnswerKind::accepted ? accept(pending, answer) : refuse(pending, answer);
                  });
  }
  pending_.take([now](const PendingRequest& one) { return now >= one.overdue_at; },
                [this](const PendingRequest& pending) {
                  // Whatever becomes of it: nobody knows, so nobody may go on holding.
                  forget_lease(pending.lease);
                  answers_->refuse(pending.caller,
                                   no_answer(directory_->entry(pending.component), answer_timeout_));
                });
}

void ParameterOperations::accept(const PendingRequest& pending, const ParameterAnswer& answer) {
  switch (pending.purpose) {
    case Purpose::plain:
      return answers_->done(pending.caller);
    case Purpose::refresh:
      return;
    case Purpose::hold: {
      const Lease* const lease = find_lease(pending.lease);
      if (lease == nullptr) {
        return answers_->refuse(pending.caller, RefusalKind::wrong_state,
                                "The hold ended before it began; press again.");
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
  forget_lease(pending.lease);
  answers_->refuse(pending.caller, refusal_of(answer, directory_->entry(pending.component)));
}

}  // namespace flexrf::panel
