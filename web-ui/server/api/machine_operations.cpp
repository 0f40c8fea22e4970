#include "web-ui/server/api/machine_operations.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>

#include "base/text.hpp"
#include "web-ui/server/http_problem.hpp"

namespace flexrf::panel {
namespace {

/// Statuses that the helper may give; whatever else it says, it is not understood.
constexpr unsigned statuses[] = {400, 403, 404, 409, 413, 429, 503, 507};

constexpr std::size_t token_size = 32;

bool is_token(std::string_view text) noexcept {
  constexpr std::string_view digits = "0123456789abcdef";
  return text.size() == token_size && text.find_first_not_of(digits) == std::string_view::npos;
}

/// As the audit tells them.
struct Act {
  std::string_view verb;
  const char* did;
  const char* refused;  // "was not allowed to ..."
};
constexpr Act acts[] = {
    {"upload", "began to upload an update", "upload an update"},
    {"install", "began to install", "install"},
    {"choose", "chose for the next start the slot", "choose the slot"},
    {"restart", "restarted the PC", "restart the PC"},
    {"network", "set the address of", "set an address"},
    {"keep-network", "kept the address", "keep an address"},
    {"make-room", "made room for data", "make room for data"},
    {"dismiss-failure", "dismissed the failure of the slot", "dismiss a failure"},
    {"hosts", "declared as other addresses of the PC", "declare other addresses of the PC"},
};

Status not_understood(const char* why) noexcept {
  return Status::error(StatusCode::internal,
                       "the PC's helper is not understood: %s. It may be of another version than the "
                       "application; restart the PC",
                       why);
}

const Act& act_of(std::string_view verb) noexcept {
  return *std::find_if(std::begin(acts), std::end(acts), [verb](const Act& act) { return act.verb == verb; });
}

}  // namespace

void MachineOperations::read(const Caller& caller) {
  if (!check_there(caller)) return;
  if (!want_state_.add(caller))
    return answers_->refuse(caller, RefusalKind::busy, "Too many ask how the PC is. Try again in a second.");
  if (state_number_ != 0) return;
  state_number_ = helper_.ask(R"({"verb":"state"})", patience, true);
  if (state_number_ == 0)
    answer_state(
        Status::error(StatusCode::busy, "the PC's helper has too much to do; try again in a second"));
}

void MachineOperations::act(const Caller& caller, std::string_view verb, Fields& fields,
                            const Address& reached_by) {
  if (!check_there(caller)) return;
  const Act& act = act_of(verb);
  if (!permission_->has_role(caller, Role::admin, act.refused)) return;
  const SessionInfo* const session = access_->session(caller.session);
  if (session->user.empty()) {
    return answers_->refuse(caller, RefusalKind::wrong_state,
                            "Nobody has logged in here: the PC asks for the password of an admin. Start the "
                            "application with --panel-users, and log in.");
  }
  Waiting waiting{.caller = caller, .did = act.did, .refused = act.refused, .who = permission_->who(caller)};
  if (verb == "upload") waiting.wants = "upload";
  if (verb == "make-room") waiting.wants = "freed";
  // Nothing that has a password in it is to be left behind by a text that grew.
  std::string text;
  text.reserve(2 * HelperClient::longest_line);
  JsonWriter json(std::move(text));
  json.begin_object().member("verb", verb).member("user", session->user);
  json.member("password", fields.text("password"));
  if (verb == "upload") {
    const std::uint64_t size = fields.integer("size");
    json.member("size", size);
    set_text(waiting.what, "(" + std::to_string(size) + " bytes)");
  } else if (verb == "install") {
    const bool older = fields.has("older") && fields.boolean("older");
    const bool other_drivers = fields.has("other_drivers") && fields.boolean("other_drivers");
    json.member("older", older).member("other_drivers", other_drivers);
    set_text(waiting.what,
             update_ + (older ? ", though it is older" : "") + (other_drivers ? ", with other drivers" : ""));
  } else if (verb == "choose") {
    const std::string_view slot = fields.text("slot");
    const bool other_drivers = fields.has("other_drivers") && fields.boolean("other_drivers");
    json.member("slot", slot).member("other_drivers", other_drivers);
    set_text(waiting.what, std::string{slot.substr(0, 1)} + (other_drivers ? ", with other drivers" : ""));
  } else if (verb == "network") {
    const std::string_view interface = fields.text("interface");
    const std::string_view address = fields.text("address");
    json.member("interface", interface).member("address", address);
    json.member("gateway", fields.has("gateway") ? fields.text("gateway") : std::string_view{});
    set_text(waiting.what, std::string{interface.substr(0, 16)} + ": " + std::string{address.substr(0, 20)});
  } else if (verb == "make-room") {
    const std::string_view what = fields.text("what");
    json.member("what", what);
    set_text(waiting.what, what.substr(0, 16));
  } else if (verb == "dismiss-failure") {
    const std::string_view slot = fields.text("slot");
    json.member("slot", slot);
    set_text(waiting.what, slot.substr(0, 1));
  } else if (verb == "keep-network") {
    json.member("reached_by", reached_by.text());
  } else if (verb == "hosts") {
    const std::string_view hosts = fields.text("hosts");
    json.member("hosts", hosts);
    set_text(waiting.what, hosts.empty() ? "(none)" : hosts);
  }
  json.end_object();
  std::string message = json.release();
  if (const Status& status = fields.status(); !status)
    return answers_->refuse(caller, RefusalKind::bad_request, "The body: %s.", status.cause());
  send(waiting, std::move(message), patience);
}

void MachineOperations::put(const Caller& caller, std::string_view upload, std::uint64_t offset,
                            std::string_view bytes) {
  if (!check_there(caller)) return;
  if (!permission_->has_role(caller, Role::admin, act_of("upload").refused)) return;
  if (!is_token(upload)) {
    return answers_->refuse(caller, RefusalKind::bad_request,
                            "'upload' is the token that POST machine/upload gave: 32 hexadecimal digits.");
  }
  if (bytes.empty() || bytes.size() > HelperClient::longest_part) {
    return answers_->refuse(caller, bytes.empty() ? RefusalKind::bad_request : RefusalKind::too_large,
                            "A part has from 1 to %zu bytes.", HelperClient::longest_part);
  }
  JsonWriter json(std::string{});
  json.begin_object().member("verb", "part").member("upload", upload).member("offset", offset).end_object();
  send({.caller = caller, .wants = "received"}, json.release().append("\n").append(bytes),
       patience_with_a_part);
}

bool MachineOperations::check_there(const Caller& caller) {
  if (is_there_) return true;
  answers_->refuse(caller, RefusalKind::not_found,
                   "This application does not run on a FlexRF PC: it was started without --helper.");
  return false;
}

void MachineOperations::send(Waiting waiting, std::string message, Duration patience_with_it) {
  if (std::min(message.find('\n'), message.size()) > HelperClient::longest_line) {
    return answers_->refuse(waiting.caller, RefusalKind::too_large,
                            "The request is too long for the PC's helper.");
  }
  waiting.number = helper_.ask(std::move(message), patience_with_it, false);
  // There are as many places as the helper's client has, so that one that took it has one here.
  if (waiting.number == 0 || !waiting_.add(waiting))
    answers_->refuse(waiting.caller, RefusalKind::busy,
                     "The PC's helper has too much to do. Try again in a second.");
}

/// What it said, or why that makes no sense.
Result<JsonObject> MachineOperations::understand(const HelperClient::Answer& answer) {
  if (!answer.status) return answer.status;
  const Result<JsonObject> said = reader_->object(answer.text);
  if (!said) return not_understood(said.status().cause());
  Fields fields(*said);
  const bool is_ok = fields.boolean("ok");
  if (!is_ok) fields.text("why");
  if (!fields.status()) return not_understood(fields.status().cause());
  return *said;
}

void MachineOperations::tick() {
  while (const std::optional<HelperClient::Answer> answered = helper_.pop()) {
    const Result<JsonObject> said = understand(*answered);
    if (answered->number == state_number_) {
      state_number_ = 0;
      answer_state(said);
    } else {
      waiting_.take([&](const Waiting& one) { return one.number == answered->number; },
                    [&](const Waiting& one) { answer(one, said); });
    }
  }
}

void MachineOperations::answer_state(const Result<JsonObject>& said) {
  const bool is_ok = said && Fields(*said).boolean("ok");
  Fields parts(is_ok ? *said : JsonObject{});
  if (is_ok) {
    const std::optional<JsonObject> update = parts.object("update");
    if (update && parts.object("slots")) note_update(*update);
    if (!parts.status()) return answer_state(not_understood(parts.status().cause()));
  }
  want_state_.take([](const Caller&) { return true; },
                   [&](const Caller& caller) {
                     if (!said) return refuse(caller, said.status());
                     Fields fields(*said);
                     if (!is_ok) return refuse(caller, fields);
                     answers_->done(caller, [&said](JsonWriter& json) {
                       for (const auto member : *said) {
                         if (member.key != "ok") json.key(member.key).raw(simdjson::minify(member.value));
                       }
                     });
                   });
}

void MachineOperations::answer(const Waiting& waiting, const Result<JsonObject>& said) {
  if (!said) return refuse(waiting.caller, said.status());
  Fields fields(*said);
  if (!fields.boolean("ok")) {
    const std::uint64_t status = fields.integer_or("status", 0);
    // As a failed log-in is: a wrong password, or too many of them.
    if (waiting.did != nullptr && (status == 403 || status == 429))
      audit_->note(waiting.who, "was not allowed to", waiting.refused);
    return refuse(waiting.caller, fields);
  }
  const std::string_view wanted = waiting.wants;
  if (!wanted.empty() && !fields.has(wanted))
    return refuse(waiting.caller, not_understood("its answer is not complete"));
  if (waiting.did != nullptr) audit_->note(waiting.who, waiting.did, text_view(waiting.what));
  answers_->done(waiting.caller, [&](JsonWriter& json) {
    if (wanted == "upload") json.member(wanted, fields.text(wanted));
    if (wanted == "freed") json.member(wanted, fields.integer(wanted));
    if (wanted == "received") json.member(wanted, fields.integer(wanted));
  });
}

void MachineOperations::note_update(JsonObject update) {
  Fields about(update);
  update_.assign(about.text_or("application", "")).append(" ").append(about.text_or("version", ""));
}

void MachineOperations::refuse(const Caller& caller, Fields& said) {
  const std::uint64_t status = said.integer_or("status", 0);
  if (std::find(std::begin(statuses), std::end(statuses), status) == std::end(statuses))
    return refuse(caller, not_understood("it refuses without a status that is known"));
  Reply* const reply = answers_->reply_of(caller);
  if (reply == nullptr) return;
  reply->status = static_cast<unsigned>(status);
  reply->retry_after =
      static_cast<unsigned>(std::min<std::uint64_t>(said.integer_or("retry_after", 0), 3600));
  std::string& text = *answers_->begin_bytes(caller);
  JsonWriter json(std::move(text));
  json.begin_object().member("type", "about:blank").member("title", title_of(reply->status));
  json.member("status", status).member("detail", said.text_or("why", ""));
  // From where an upload goes on.
  if (said.has("received")) json.member("received", said.integer("received"));
  json.end_object();
  text = json.release();
  answers_->end_bytes(caller, "application/problem+json");
}

void MachineOperations::refuse(const Caller& caller, const Status& why) {
  Reply* const reply = answers_->reply_of(caller);
  if (reply == nullptr) return;
  std::string words = why.cause();
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  answer_problem(*reply, 503, words + '.');
  answers_->end_bytes(caller, "application/problem+json");
}

}  // namespace flexrf::panel
