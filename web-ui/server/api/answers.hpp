// The way back to whoever asked, by REST or live, now or later.
#pragma once

#include <string_view>

#include "base/json_writer.hpp"
#include "runtime/face/refusal.hpp"
#include "web-ui/server/access.hpp"
#include "web-ui/server/api/caller.hpp"
#include "web-ui/server/api/clients.hpp"

namespace flexrf::panel {

/// The server's thread. Who is gone by now is not answered.
class Answers {
 public:
  Answers(Clients& clients, LaterReplies& replies) noexcept : clients_(&clients), replies_(&replies) {}

  /// Done: {"id", "ok": true} with the members that `write(JsonWriter&)` adds; by REST an object of these
  /// members.
  template <class Write>
  void done(const Caller& caller, Write&& write) {
    Open open = begin(caller);
    if (open.is_nobody()) return;
    write(open.json);
    end(open);
  }
  void done(const Caller& caller) {
    done(caller, [](JsonWriter&) {});
  }
  void refuse(const Caller& caller, const Refusal& refusal);
  /// As Refusal::make().
  [[gnu::format(printf, 4, 5)]] void refuse(const Caller& caller, RefusalKind kind, const char* format, ...);
  /// A REST answer that is no JSON: its empty body; null when who asked is gone.
  std::string* begin_bytes(const Caller& caller);
  void end_bytes(const Caller& caller, std::string_view content_type);

  /// While a REST request is handled: its reply, which need not wait for complete().
  void begin_request(Ticket ticket, Reply& reply) noexcept;
  /// Its reply is complete as it is.
  void answered() noexcept { answered_ = true; }
  /// Whether it was answered meanwhile.
  Handled end_request() noexcept;
  /// For what goes into the head of a REST reply; null for others and who is gone.
  Reply* reply_of(const Caller& caller);

 private:
  struct Open {
    Caller caller;
    Client* client = nullptr;
    Reply* reply = nullptr;
    JsonWriter json;
    bool is_nobody() const noexcept { return client == nullptr && reply == nullptr; }
  };
  Open begin(const Caller& caller);
  void end(Open& open);
  void complete(const Caller& caller);
  bool is_current(const Caller& caller) const noexcept;

  Clients* clients_;
  LaterReplies* replies_;
  Ticket current_{};
  Reply* current_reply_ = nullptr;
  bool answered_ = false;
};

/// Whether a session may do something; refuses in its name when not. The server's thread.
class Permission {
 public:
  Permission(AccessControl& access, Answers& answers) noexcept : access_(&access), answers_(&answers) {}

  /// The role, and the control token.
  bool may_control(const Caller& caller, Role role, std::string_view act);
  bool has_role(const Caller& caller, Role role, std::string_view act);
  /// As the audit names whoever asked.
  Who who(const Caller& caller) const noexcept { return who_of(access_->session(caller.session)); }

 private:
  AccessControl* access_;
  Answers* answers_;
};

}  // namespace flexrf::panel
