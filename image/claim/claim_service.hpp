// What a PC that nobody has claimed serves: the page, its style, and the attempt.
#pragma once

#include <functional>
#include <string>

#include "image/claim/claim.hpp"
#include "image/claim/claim_page.hpp"
#include "image/claim/host_declaration.hpp"
#include "web-ui/server/access/host_rules.hpp"
#include "web-ui/server/service.hpp"

namespace flexrf::claim {

/// Any well-formed Host is answered, because the code proves that this PC is meant; the panel's own rules are
/// stricter. prepare_cryptography() went well before. The server's thread. An attempt with the right code
/// takes longer than a handler of the panel may: nothing else is served here.
class ClaimService final : public panel::Service, public panel::LiveService {
 public:
  /// Declares the host by which this PC was claimed, for the admin; the status says why that failed.
  using DeclareHost = std::function<Status(const Admin& admin, const std::string& host)>;

  ClaimService(Claim& claim, std::string machine, DeclareHost declare_host);

  /// The answer to a claim has had time to arrive: the server may end.
  bool may_end() const noexcept { return may_end_; }

  bool admit(const panel::Request& request, panel::SessionIndex& session, panel::Reply& reply) override;
  void on_connection_closed(std::uint32_t) override {}
  panel::Handled handle(const panel::Request& request, panel::Reply& reply, panel::Ticket ticket) override;
  panel::LiveService& live() noexcept override { return *this; }
  void on_tick(Time now) override;
  Duration until_next(Time) const override { return std::chrono::milliseconds{100}; }

  // Nobody talks here.
  void on_open(panel::LiveLink& link) override { link.close(1008, "this PC is not claimed"); }
  void on_text(panel::LiveLink&, std::string_view) override {}
  void on_writable(panel::LiveLink&) override {}
  void on_close(panel::LiveLink&) override {}

 private:
  void attempt(const panel::Request& request, panel::Reply& reply);
  /// Before the claim is answered as done, so that the page can tell it.
  ReachedBy declare(const panel::Request& request, const Wish& wish) const;

  Claim& claim_;
  std::string machine_;
  DeclareHost declare_host_;
  std::string token_;  // in the form, so that only who read the page can send it
  panel::HostRules rules_;
  Time done_at_{};
  bool may_end_ = false;
};

}  // namespace flexrf::claim
