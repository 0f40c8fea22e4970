// What a connection does with a request that is complete.
#include <algorithm>
#include <optional>

#include "web-ui/server/connection.hpp"
#include "web-ui/server/reply_head.hpp"
#include "web-ui/server/request_target.hpp"

namespace flexrf::panel {
namespace {

constexpr unsigned retry_after = 2;  // s

}  // namespace

unsigned Connection::fault_of_header(std::string_view& detail) const {
  const RequestHeader& header = parser_->header();
  if (header.hosts != 1 || header.host.empty()) {
    detail = "a request needs exactly one Host field";
    return 400;
  }
  if (header.origins > 1) {
    detail = "a request has one Origin field at most";
    return 400;
  }
  if (header.expects_other) {
    detail = "nothing but 100-continue can be expected of this server";
    return 417;
  }
  if (header.method == Method::other) {
    detail = "this server knows GET, HEAD, PUT and POST";
    return 405;
  }
  const bool changes = header.method == Method::put || header.method == Method::post;
  if (changes && !parser_->body().empty()) {
    const auto& types = surroundings_.settings.body_types;
    const auto is_it = [&](std::string_view type) { return is_media_type(header.content_type, type); };
    if (std::none_of(types.begin(), types.end(), is_it)) {
      detail = types.front() == "application/json" ? "the body has to be application/json"
                                                   : "the body has to be a form's";
      return 415;
    }
  }
  return 0;
}

void Connection::handle() {
  ++exchange_;
  used_ = true;
  const RequestHeader& header = parser_->header();
  keep_alive_ = header.version == 11 && parser_->keep_alive();
  clear_reply(reply_);
  if (!turned_away_.empty()) {
    turn_away_request();
    return;
  }
  // Where places are scarce, who has its answer gives its own to the next.
  if (surroundings_.connections * 4 > surroundings_.settings.places * 3) keep_alive_ = false;
  const std::optional<RequestTarget> target = decode_target(header.target, path_);
  std::string_view detail = "the request's target has to be a path";
  const unsigned fault = target ? fault_of_header(detail) : 400;
  if (fault != 0) {
    if (fault == 405) reply_.allow = "GET, HEAD, PUT, POST";
    refuse(fault, detail);
    return;
  }
  Request request = request_for(*target);
  if (!admit(request)) {
    send_reply();
  } else if (target->path == "/api/v1/live") {
    upgrade();
  } else {
    serve(request);
  }
}

/// A browser that asks for the page itself asks again by itself; the page's own requests say it to the page.
void Connection::turn_away_request() {
  keep_alive_ = false;
  const RequestHeader& header = parser_->header();
  const std::string_view path = header.target.substr(0, header.target.find('?'));
  if (path != "/" || header.method != Method::get) {
    reply_.retry_after = retry_after;
    refuse(503, turned_away_);
    return;
  }
  reply_.status = 503;
  reply_.retry_after = retry_after;
  reply_.content_type = "text/html; charset=utf-8";
  reply_.text =
      "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"2\">"
      "<title>FlexRF panel: no room</title><h1>No room</h1><p>The panel cannot be shown now: ";
  reply_.text.append(turned_away_)
      .append(". This page tries again by itself.</p><p>Motion is not stopped from here: ");
  reply_.text.append("use the emergency stop at the machine.</p></html>\n");
  send_reply();
}

Request Connection::request_for(const RequestTarget& target) const {
  const RequestHeader& header = parser_->header();
  Request request;
  request.place = place_;
  request.method = header.method;
  request.path = target.path;
  request.query = target.query;
  request.host = header.host;
  request.origin = header.origin;
  request.cookie = header.cookie;
  request.body = parser_->body();
  request.content_type = header.content_type;
  request.if_match = header.if_match;
  request.if_none_match = header.if_none_match;
  request.accepts_gzip = accepts_gzip(header.accept_encoding);
  request.remote_address = remote_address_;
  request.local_end = local_end_;
  request.loopback = loopback_;
  request.has_fetch_site = header.has_fetch_site;
  request.upgrade = wants_upgrade();
  return request;
}

bool Connection::admit(Request& request) {
  const Watch watch(surroundings_, request.path);
  const bool is_admitted = surroundings_.service.admit(request, session_, reply_);
  request.session = session_;
  return is_admitted;
}

void Connection::serve(const Request& request) {
  const Ticket ticket{place_, exchange_};
  completed_ = false;
  handler_runs_ = true;
  Handled handled{};
  {
    const Watch watch(surroundings_, request.path);
    handled = surroundings_.service.handle(request, reply_, ticket);
  }
  handler_runs_ = false;
  if (handled == Handled::now || completed_) {
    send_reply();
    return;
  }
  state_ = State::answering;
  wait_at_most(surroundings_.settings.reply_timeout);
}

Reply* Connection::reply_of(std::uint32_t exchange) noexcept {
  const bool waits = state_ == State::answering || handler_runs_;
  return waits && exchange == exchange_ ? &reply_ : nullptr;
}

void Connection::complete(std::uint32_t exchange) {
  if (reply_of(exchange) == nullptr) return;
  if (handler_runs_) {
    completed_ = true;
  } else {
    send_reply();
  }
}

}  // namespace flexrf::panel
