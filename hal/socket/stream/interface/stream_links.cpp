#include "hal/socket/stream/interface/stream_links.hpp"

#include <algorithm>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// Of one connection in a cycle: a peer that sends without end must not hold the thread.
constexpr int reads_per_cycle = 8;
/// Peers that come and go at once are let in or sent away so many at a time.
constexpr int peers_per_cycle = 8;
/// What nobody reads of a connection that has ended, and what its peer does not read of one that is being
/// ended, is kept so long and no longer: the place is for the next.
constexpr Duration longest_rest = std::chrono::seconds(1);

}  // namespace

void StreamLinks::begin(const char* name, StreamTransport& transport, const StreamSettings& settings) {
  name_ = name;
  transport_ = &transport;
  settings_ = settings;
  places_.resize(settings.listen ? std::clamp<std::size_t>(settings.sessions, 1, most_sessions) : 1);
  for (Place& place : places_) {
    place.inbox.resize(settings.buffer);
    place.outbox_memory.resize(settings.buffer);
    place.outbox.use(place.outbox_memory);
    place.state = State::free;
  }
  list_sessions();
  retry_at_ = {};
  pause_ = settings.reconnect_shortest;
  told_ = {};
}

void StreamLinks::stop() noexcept {
  for (Place& place : places_) free(place);
  list_sessions();
}

void StreamLinks::receive(Time now) noexcept {
  if (settings_.listen) {
    accept(now);
  } else {
    connect(now);
  }
  for (Place& place : places_) {
    if (place.state == State::open) fetch(place, now);
    if (place.state == State::ended && (place.begin == place.end || now >= place.until)) free(place);
  }
  list_sessions();
}

void StreamLinks::send(Time now) noexcept {
  for (Place& place : places_) {
    while (place.state == State::open && !place.outbox.is_empty()) {
      const long count = transport_->send(index_of(place), place.outbox.front());
      if (count < 0) lose(place, now);
      if (count <= 0) break;
      place.outbox.drop(static_cast<std::size_t>(count));
      told_.sent_bytes += static_cast<std::uint64_t>(count);
    }
    if (!place.closing || place.state == State::free) continue;
    if (place.state == State::open && place.until == Time{}) place.until = now + longest_rest;
    if (place.state == State::open && !place.outbox.is_empty() && now < place.until) continue;
    free(place);
    if (!settings_.listen) pause(now);
  }
  list_sessions();
}

// ---- connections

void StreamLinks::connect(Time now) noexcept {
  Place& place = places_[0];
  if (place.state == State::connecting) {
    judge(transport_->attempt(), now);
    if (place.state != State::connecting || now < give_up_at_) return;
    note_trouble(Status::error(StatusCode::timeout,
                               "no connection within %.3g s; is the peer on, and the address right?",
                               seconds(settings_.connect_timeout)));
    free(place);
    pause(now);
  } else if (place.state == State::free && now >= retry_at_) {
    place.state = State::connecting;
    give_up_at_ = now + settings_.connect_timeout;
    judge(transport_->connect(), now);
  }
}

void StreamLinks::judge(StreamTransport::Attempt attempt, Time now) noexcept {
  Place& place = places_[0];
  if (attempt == StreamTransport::Attempt::done) open(place, now);
  if (attempt != StreamTransport::Attempt::failed) return;
  note_trouble(transport_->error());
  free(place);
  pause(now);
}

void StreamLinks::accept(Time now) noexcept {
  int peers = 0;
  for (Place& place : places_) {
    if (place.state != State::free) continue;
    if (peers == peers_per_cycle || !transport_->accept(index_of(place))) return;
    ++peers;
    open(place, now);
  }
  for (; peers < peers_per_cycle && transport_->turn_away(); ++peers) ++told_.refused_sessions;
}

void StreamLinks::open(Place& place, Time now) noexcept {
  place.state = State::open;
  place.session = ++last_session_;
  place.closing = place.skipping = false;
  place.until = {};
  place.begin = place.end = 0;
  place.outbox.clear();
  opened_at_ = now;
  ++told_.opened;
  if (!settings_.listen) told_.trouble = {};
}

/// What has been read makes room for what comes; views of the last cycle end here.
void StreamLinks::fetch(Place& place, Time now) noexcept {
  std::copy(place.inbox.begin() + static_cast<std::ptrdiff_t>(place.begin),
            place.inbox.begin() + static_cast<std::ptrdiff_t>(place.end), place.inbox.begin());
  place.end -= place.begin;
  place.begin = 0;
  for (int n = 0; n < reads_per_cycle && place.end < place.inbox.size(); ++n) {
    const long count = transport_->receive(index_of(place), std::span(place.inbox).subspan(place.end));
    if (count < 0) lose(place, now);
    if (count <= 0) return;
    place.end += static_cast<std::size_t>(count);
    told_.received_bytes += static_cast<std::uint64_t>(count);
  }
}

/// It ended or broke; what came before is still to be read.
void StreamLinks::lose(Place& place, Time now) noexcept {
  if (!transport_->error().is_ok()) {
    note_trouble(transport_->error());
  } else if (!settings_.listen) {
    note_trouble(Status::error(StatusCode::unavailable, "the peer has ended the connection"));
  }
  ++told_.ended;
  transport_->close(index_of(place));
  place.state = State::ended;
  place.until = now + longest_rest;
  if (!settings_.listen) pause(now);
}

void StreamLinks::free(Place& place) noexcept {
  if (place.state == State::open || place.state == State::connecting) transport_->close(index_of(place));
  place.state = State::free;
  place.session = 0;
  place.closing = false;
}

void StreamLinks::pause(Time now) noexcept {
  if (opened_at_ != Time{} && now - opened_at_ >= settings_.reconnect_longest) {
    pause_ = settings_.reconnect_shortest;
  }
  opened_at_ = {};
  retry_at_ = now + pause_;
  pause_ = std::min(2 * pause_, std::max(settings_.reconnect_shortest, settings_.reconnect_longest));
}

void StreamLinks::list_sessions() noexcept {
  session_count_ = 0;
  for (const Place& place : places_) {
    if (place.state == State::open || place.state == State::ended)
      sessions_[session_count_++] = place.session;
  }
  std::sort(sessions_.begin(), sessions_.begin() + static_cast<std::ptrdiff_t>(session_count_));
  told_.sessions = static_cast<std::uint8_t>(session_count_);
}

/// What fails again and again for the same reason is logged once.
void StreamLinks::note_trouble(const Status& cause) noexcept {
  const std::array<char, sizeof(told_.trouble)> before = told_.trouble;
  set_text(told_.trouble, cause.cause());
  if (told_.trouble != before) log_warning(name_, "{}", text_view(told_.trouble));
}

// ---- what a unit asks

StreamLinks::Place* StreamLinks::find(SocketSession session) noexcept {
  for (Place& place : places_) {
    if (session != 0 && place.session == session) return &place;
  }
  return nullptr;
}

const StreamLinks::Place* StreamLinks::find(SocketSession session) const noexcept {
  return const_cast<StreamLinks*>(this)->find(session);
}

bool StreamLinks::write(SocketSession session, std::string_view bytes, bool as_line) noexcept {
  Place* const place = find(session);
  if (place == nullptr || place->state != State::open || place->closing ||
      bytes.size() + (as_line ? 1 : 0) > place->outbox.room()) {
    ++told_.refused_writes;
    return false;
  }
  return place->outbox.put(bytes) && (!as_line || place->outbox.put("\n"));
}

std::optional<std::string_view> StreamLinks::read_line(SocketSession session) noexcept {
  Place* const place = find(session);
  if (place == nullptr) return std::nullopt;
  for (;;) {
    const std::string_view waiting = peek(session);
    const std::size_t end = waiting.find('\n');
    const bool whole = end != std::string_view::npos;
    // What the peer has sent without an end of line is a line once it has gone.
    const bool rest = !whole && place->state == State::ended && !waiting.empty();
    if (!whole && !rest) {
      if (place->skipping || waiting.size() == place->inbox.size()) {
        if (!place->skipping) ++told_.long_lines;
        place->skipping = true;
        place->begin = place->end = 0;
      }
      return std::nullopt;
    }
    place->begin += whole ? end + 1 : waiting.size();
    if (place->skipping) {
      place->skipping = false;
      continue;
    }
    std::string_view line = waiting.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
}

std::string_view StreamLinks::peek(SocketSession session) const noexcept {
  const Place* const place = find(session);
  if (place == nullptr) return {};
  return {place->inbox.data() + place->begin, place->end - place->begin};
}

void StreamLinks::take(SocketSession session, std::size_t count) noexcept {
  Place* const place = find(session);
  if (place != nullptr) place->begin += std::min(count, place->end - place->begin);
}

void StreamLinks::close(SocketSession session) noexcept {
  Place* const place = find(session);
  if (place != nullptr) place->closing = true;
}

}  // namespace flexrf
