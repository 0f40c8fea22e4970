#include "hal/socket/stream/mock/mock_stream_transport.hpp"

#include <algorithm>

namespace flexrf {

std::size_t MockStreamTransport::add(State state) {
  End& end = ends_.emplace_back();
  end.state = state;
  end.given.reserve(pipe_capacity);
  end.got.reserve(pipe_capacity);
  return ends_.size() - 1;
}

std::size_t MockStreamTransport::connect_to_it() {
  return add(State::waiting);
}

bool MockStreamTransport::give(std::size_t number, std::string_view bytes) {
  End& end = ends_[number];
  if (end.state == State::closed || end.ended || end.given.size() - end.taken + bytes.size() > pipe_capacity)
    return false;
  end.given += bytes;
  return true;
}

void MockStreamTransport::break_off(std::size_t number, const Status& cause) {
  End& end = ends_[number];
  end.broken = cause;
  end.taken = end.given.size();
}

Status MockStreamTransport::open(std::string_view /*address*/, bool /*listen*/, Duration /*peer_timeout*/) {
  places_.fill(nobody);
  return refusal_;
}

StreamTransport::Attempt MockStreamTransport::attempt() noexcept {
  if (!listening_) {
    error_ = Status::error(StatusCode::unavailable, "scripted: nobody listens there");
    return Attempt::failed;
  }
  places_[0] = add(State::open);
  return Attempt::done;
}

std::size_t MockStreamTransport::waiting() const noexcept {
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (ends_[i].state == State::waiting) return i;
  }
  return nobody;
}

bool MockStreamTransport::accept(std::size_t place) noexcept {
  const std::size_t number = waiting();
  if (number == nobody) return false;
  ends_[number].state = State::open;
  places_[place] = number;
  return true;
}

bool MockStreamTransport::turn_away() noexcept {
  const std::size_t number = waiting();
  if (number != nobody) ends_[number].state = State::closed;
  return number != nobody;
}

long MockStreamTransport::receive(std::size_t place, std::span<char> bytes) noexcept {
  End& end = ends_[places_[place]];
  const std::string_view rest = std::string_view(end.given).substr(end.taken);
  const std::size_t count = std::min(rest.size(), bytes.size());
  std::copy_n(rest.data(), count, bytes.data());
  end.taken += count;
  if (count > 0) return static_cast<long>(count);
  error_ = end.broken;
  return end.ended || !end.broken.is_ok() ? -1 : 0;
}

long MockStreamTransport::send(std::size_t place, std::string_view bytes) noexcept {
  End& end = ends_[places_[place]];
  if (!end.reads) return 0;
  end.got += bytes;
  return static_cast<long>(bytes.size());
}

void MockStreamTransport::close(std::size_t place) noexcept {
  if (places_[place] != nobody) ends_[places_[place]].state = State::closed;
  places_[place] = nobody;
}

}  // namespace flexrf
