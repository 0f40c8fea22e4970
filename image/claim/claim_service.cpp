#include "image/claim/claim_service.hpp"

#include <sodium.h>

#include <array>
#include <utility>

#include "image/claim/form.hpp"
#include "web-ui/server/http_problem.hpp"
#include "web-ui/server/request_target.hpp"

namespace flexrf::claim {
namespace {

using panel::Handled;
using panel::Method;
using panel::Reply;
using panel::Request;

constexpr Duration time_for_the_answer = std::chrono::seconds{1};
constexpr std::string_view first_user = "admin";

void answer_page(Reply& reply, unsigned status, std::string page) {
  reply.status = status;
  reply.content_type = "text/html; charset=utf-8";
  reply.text = std::move(page);
}

}  // namespace

ClaimService::ClaimService(Claim& claim, std::string machine, DeclareHost declare_host)
    : claim_(claim),
      machine_(std::move(machine)),
      declare_host_(std::move(declare_host)),
      rules_(true, panel::HostRules::names_of_machine()) {
  std::array<unsigned char, 16> secret{};
  randombytes_buf(secret.data(), secret.size());
  token_.resize(2 * secret.size() + 1);
  sodium_bin2hex(token_.data(), token_.size(), secret.data(), secret.size());
  token_.pop_back();  // the 0
}

bool ClaimService::admit(const Request& request, panel::SessionIndex& session, Reply& reply) {
  session = 0;
  if (!panel::HostRules::name_in(request.host)) {
    panel::answer_problem(reply, 421, "Ask for this PC by a name or an address.");
    return false;
  }
  return true;
}

Handled ClaimService::handle(const Request& request, Reply& reply, panel::Ticket) {
  const bool is_question = request.method == Method::get || request.method == Method::head;
  if (request.path == "/claim" && request.method == Method::post) {
    attempt(request, reply);
  } else if (request.path == "/claim.css" && is_question) {
    reply.content_type = "text/css";
    reply.fixed = page_style();
  } else if ((request.path == "/" || request.path == "/claim") && is_question) {
    answer_page(reply, 200, form_page(machine_, token_, first_user, nullptr));
  } else if (request.path.starts_with("/api/")) {
    panel::answer_problem(reply, 503, "Nobody has claimed this PC yet; its page, at /, tells how.");
  } else {
    panel::answer_problem(reply, 404,
                          "Until somebody has claimed this PC there is its page at / and nothing else.");
  }
  return Handled::now;
}

void ClaimService::attempt(const Request& request, Reply& reply) {
  auto fields = read_form(request.body);
  if (!fields || !panel::is_media_type(request.content_type, "application/x-www-form-urlencoded"))
    return panel::answer_problem(reply, 400, "Send a form with code, user, password and repeated.");
  // A form's own origin is not told where no referrer is; pages of others may not use up the tries.
  const std::string& token = (*fields)["token"];
  if (token.size() != token_.size() || sodium_memcmp(token.data(), token_.data(), token.size()) != 0) {
    const Answer stale{403, "This form was of before the PC was started. Type it once more.", 0};
    return answer_page(reply, 403, form_page(machine_, token_, (*fields)["user"], &stale));
  }
  Wish wish{(*fields)["code"], (*fields)["user"], (*fields)["password"], (*fields)["repeated"]};
  const Time now = MonotonicClock::now();
  const Answer answer =
      claim_.attempt(wish, panel::Address::parse(request.remote_address).value_or(panel::Address{}), now);
  if (answer.status == 200) {
    answer_page(reply, 200, done_page(machine_, wish.user, declare(request, wish)));
    done_at_ = MonotonicClock::now();
    return;
  }
  reply.retry_after = answer.wait_s;
  answer_page(reply, answer.status, form_page(machine_, token_, wish.user, &answer));
}

ReachedBy ClaimService::declare(const Request& request, const Wish& wish) const {
  if (rules_.allows_host(request.host, request.local_end)) return {};
  ReachedBy by{panel::HostRules::name_in(request.host).value_or(""), {}};
  if (const Status status = declare_host_({wish.user, wish.password}, by.host); !status)
    by.why_not = status.cause();
  return by;
}

void ClaimService::on_tick(Time now) {
  if (claim_.is_done() && now - done_at_ >= time_for_the_answer) may_end_ = true;
}

}  // namespace flexrf::claim
