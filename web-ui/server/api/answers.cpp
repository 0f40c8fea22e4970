#include "web-ui/server/api/answers.hpp"

#include <cstdarg>
#include <cstdio>

#include "web-ui/server/api/problem.hpp"

namespace flexrf::panel {
namespace {

constexpr std::size_t most_text = 512;  // a refusal holds less

}  // namespace

void Answers::begin_request(Ticket ticket, Reply& reply) noexcept {
  current_ = ticket;
  current_reply_ = &reply;
  answered_ = false;
}

Handled Answers::end_request() noexcept {
  current_reply_ = nullptr;
  return answered_ ? Handled::now : Handled::later;
}

bool Answers::is_current(const Caller& caller) const noexcept {
  return current_reply_ != nullptr && caller.ticket.connection == current_.connection &&
         caller.ticket.exchange == current_.exchange;
}

Reply* Answers::reply_of(const Caller& caller) {
  if (caller.kind != Caller::Kind::rest) return nullptr;
  return is_current(caller) ? current_reply_ : replies_->reply_of(caller.ticket);
}

void Answers::complete(const Caller& caller) {
  if (is_current(caller)) {
    answered_ = true;
  } else {
    replies_->complete(caller.ticket);
  }
}

Answers::Open Answers::begin(const Caller& caller) {
  Open open;
  open.caller = caller;
  open.reply = reply_of(caller);
  open.client = clients_->find(caller);
  if (open.reply != nullptr) {
    open.reply->text.clear();
    open.json = JsonWriter(std::move(open.reply->text));
    open.json.begin_object();
  } else if (open.client != nullptr) {
    open.json = JsonWriter(open.client->outbox.begin_message());
    open.json.begin_object().member("id", caller.id).member("ok", true);
  }
  return open;
}

void Answers::end(Open& open) {
  open.json.end_object();
  if (open.client != nullptr) {
    open.client->outbox.end_message(open.json.release());
    return;
  }
  open.reply->text = open.json.release();
  complete(open.caller);
}

std::string* Answers::begin_bytes(const Caller& caller) {
  Reply* const reply = reply_of(caller);
  if (reply == nullptr) return nullptr;
  reply->text.clear();
  return &reply->text;
}

void Answers::end_bytes(const Caller& caller, std::string_view content_type) {
  reply_of(caller)->content_type = content_type;
  complete(caller);
}

void Answers::refuse(const Caller& caller, const Refusal& refusal) {
  if (Reply* reply = reply_of(caller); reply != nullptr) {
    write_problem(*reply, refusal);
    complete(caller);
  } else if (Client* client = clients_->find(caller); client != nullptr) {
    JsonWriter json(client->outbox.begin_message());
    json.begin_object().member("id", caller.id).member("ok", false).key("problem");
    write_problem(json, refusal);
    json.end_object();
    client->outbox.end_message(json.release());
  }
}

void Answers::refuse(const Caller& caller, RefusalKind kind, const char* format, ...) {
  char text[most_text] = {};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  refuse(caller, Refusal::make(kind, "%s", text));
}

bool Permission::has_role(const Caller& caller, Role role, std::string_view act) {
  if (caller.session != no_session && access_->has_role(caller.session, role)) return true;
  answers_->refuse(caller, RefusalKind::role_missing,
                   "To %.*s needs the role %s; log in as somebody who has it.", static_cast<int>(act.size()),
                   act.data(), name_of(role));
  return false;
}

bool Permission::may_control(const Caller& caller, Role role, std::string_view act) {
  if (!has_role(caller, role, act)) return false;
  if (caller.session != no_session && access_->holder() == caller.session) return true;
  answers_->refuse(caller, RefusalKind::control_missing,
                   "To %.*s needs the control token, which %s; take control first.",
                   static_cast<int>(act.size()), act.data(),
                   access_->holder() == no_session ? "nobody holds" : "another session holds");
  return false;
}

}  // namespace flexrf::panel
