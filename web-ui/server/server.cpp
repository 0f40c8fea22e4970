#include "web-ui/server/server.hpp"

#include <sys/eventfd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "runtime/log/log.hpp"
#include "web-ui/server/reply_head.hpp"

namespace flexrf::panel {
namespace {

constexpr Duration beat_interval = std::chrono::milliseconds{10};
constexpr std::uint32_t beats_per_check = 10;
constexpr Duration time_to_wind_up = std::chrono::milliseconds{300};
/// Handlers that run before what is due is looked at again.
constexpr int handlers_per_turn = 64;
/// So many at a time are told that there is no room.
constexpr std::uint32_t porter_count = 4;

void write_date(std::string& text) {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char date[40];
  text.assign(date, std::strftime(date, sizeof(date), "%a, %d %b %Y %H:%M:%S GMT", &parts));
}

std::chrono::steady_clock::time_point on_asios_clock(Time time) noexcept {
  return std::chrono::steady_clock::time_point{time.time_since_epoch()};
}

}  // namespace

Server::Server(const ServerSettings& settings, std::unique_ptr<net::ssl::context> encryption,
               Service& service)
    : settings_(settings),
      encryption_(std::move(encryption)),
      service_(service),
      surroundings_{context_, encryption_.get(), settings_, service},
      acceptor_(context_),
      accepted_(context_),
      beat_timer_(context_),
      tick_timer_(context_),
      rings_(context_) {
  surroundings_.now = MonotonicClock::now();
  write_date(surroundings_.date);
  for (std::uint32_t place = 0; place < settings_.places; ++place) {
    connections_.emplace_back(surroundings_, place);
  }
  for (std::uint32_t i = 0; i < porter_count; ++i) porters_.emplace_back(surroundings_, no_place);
}

Status Server::make_bell() {
  const int descriptor = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (descriptor < 0)
    return Status::error(StatusCode::unavailable, "the panel: no event descriptor: %s", std::strerror(errno));
  rings_.assign(descriptor);
  bell_.use_descriptor(descriptor);
  return {};
}

Status Server::listen(const ListenAddress& address) {
  if (const Status status = make_bell(); !status) return status;
  error_code error;
  const tcp::endpoint endpoint(net::ip::make_address(address.address, error), address.port);
  if (!error) acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(net::socket_base::reuse_address{true}, error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
  if (!error) acceptor_.non_blocking(true, error);
  if (!error) {
    port_ = acceptor_.local_endpoint(error).port();
    return {};
  }
  error_code ignored;
  acceptor_.close(ignored);
  const std::string where = address.text();
  if (error == net::error::address_in_use) {
    return Status::error(StatusCode::busy,
                         "the panel cannot listen at %s: another program does; choose another port with "
                         "--panel %s:0 (any free one), or --panel off",
                         where.c_str(), where.substr(0, where.rfind(':')).c_str());
  }
  if (error == net::error::access_denied) {
    return Status::error(StatusCode::invalid_argument,
                         "the panel may not listen at %s: ports below 1024 are for root; choose another",
                         where.c_str());
  }
  return Status::error(StatusCode::invalid_argument,
                       "the panel cannot listen at %s: %s; `ip address` lists this machine's addresses",
                       where.c_str(), error.message().c_str());
}

// ---- the thread

void Server::run() {
  for (Connection& connection : connections_) connection.unlock_memory();
  for (Connection& porter : porters_) porter.unlock_memory();
  surroundings_.now = MonotonicClock::now();
  accept();
  hear();
  beat_timer_.expires_at(on_asios_clock(surroundings_.now + beat_interval));
  beat();
  tick();
  while (!stops_.load(std::memory_order_acquire)) {
    // Rung while the last tick looked: the next follows what is there already.
    bell_announced_ ? context_.run_one() : context_.poll_one();
    for (int i = 1; i < handlers_per_turn && context_.poll_one() > 0; ++i) {
    }
    // When a place may have become free, and now and then, as who has nothing to say is not told of.
    if (!newcomers_.empty() &&
        (surroundings_.connections < occupied_ || surroundings_.now >= next_placing_)) {
      next_placing_ = surroundings_.now + beat_interval;
      place_newcomers();
    }
    occupied_ = surroundings_.connections;
    if (std::exchange(surroundings_.handled, false) || !bell_announced_) tick();
  }
  wind_up();
}

void Server::wind_up() {
  tick();  // what is to be said at the end
  error_code ignored;
  acceptor_.close(ignored);
  const Time latest = MonotonicClock::now() + time_to_wind_up;
  for (Connection& connection : connections_) connection.end();
  const auto is_free = [](const Connection& connection) { return connection.is_free(); };
  while (!std::ranges::all_of(connections_, is_free) && MonotonicClock::now() < latest) {
    context_.run_one_for(std::chrono::milliseconds{10});
  }
  newcomers_.clear();
  for (Connection& connection : connections_) connection.shut();
  for (Connection& porter : porters_) porter.shut();
  beat_timer_.cancel();
  tick_timer_.cancel();
  rings_.cancel(ignored);
  context_.poll();
}

void Server::beat() {
  beat_timer_.async_wait(HandlerIn(handler_memory_, [this](error_code error) {
    if (!error) on_beat();
  }));
}

void Server::on_beat() {
  surroundings_.now = MonotonicClock::now();
  const auto due = beat_timer_.expiry();
  const auto now = on_asios_clock(surroundings_.now);
  loop_delay_.add(now - due);
  // What was missed is not made up for.
  beat_timer_.expires_at(std::max(due + beat_interval, now));
  beat();
  if (++beats_ % beats_per_check == 0) check_connections();
}

void Server::check_connections() {
  write_date(surroundings_.date);
  loop_delay_p99_ = loop_delay_.quantile(0.99);
  for (Connection& connection : connections_) connection.check(surroundings_.now);
  for (Connection& porter : porters_) porter.check(surroundings_.now);
  if (!accepts_) accept();
  surroundings_.handled = true;
}

void Server::hear() {
  rings_.async_wait(Descriptor::wait_read, HandlerIn(handler_memory_, [this](error_code error) {
                      if (error) return;
                      surroundings_.handled = true;
                      hear();
                    }));
}

void Server::tick() {
  if (std::exchange(bell_announced_, false)) bell_.settle();
  const std::uint32_t heard = bell_.listen();
  surroundings_.now = MonotonicClock::now();
  {
    const Watch watch(surroundings_, "what is due");
    service_.on_tick(surroundings_.now);
  }
  bell_announced_ = bell_.announce(heard);
  surroundings_.handled = false;
  plan_tick();
}

void Server::plan_tick() {
  const Time next = surroundings_.now + service_.until_next(surroundings_.now);
  // A timer that comes too early is put right then.
  if (tick_planned_ != Time{} && tick_planned_ <= next) return;
  tick_planned_ = next;
  tick_timer_.expires_at(on_asios_clock(next));
  tick_timer_.async_wait(HandlerIn(handler_memory_, [this](error_code error) {
    if (error) return;
    tick_planned_ = Time{};
    surroundings_.handled = true;
  }));
}

// ---- clients

void Server::accept() {
  accepts_ = true;
  acceptor_.async_accept(accepted_,
                         HandlerIn(handler_memory_, [this](error_code error) { on_accepted(error); }));
}

void Server::on_accepted(error_code error) {
  accepts_ = false;
  if (error == net::error::operation_aborted) return;
  // Too many open files, for one: tried again at the next check.
  if (error && error != net::error::connection_aborted) return;
  if (!error) welcome(std::move(accepted_));
  accept();
}

Reply* Server::reply_of(Ticket ticket) {
  return ticket.connection < connections_.size() ? connections_[ticket.connection].reply_of(ticket.exchange)
                                                 : nullptr;
}

void Server::complete(Ticket ticket) {
  if (ticket.connection < connections_.size()) connections_[ticket.connection].complete(ticket.exchange);
}

ServerFigures Server::figures() const noexcept {
  ServerFigures figures;
  figures.connections = surroundings_.connections;
  figures.places = settings_.places;
  figures.refused = refused_;
  figures.loop_delay_p99 = loop_delay_p99_;
  figures.loop_delay_max = loop_delay_.maximum();
  figures.slow_calls = surroundings_.slow_calls;
  return figures;
}

}  // namespace flexrf::panel
