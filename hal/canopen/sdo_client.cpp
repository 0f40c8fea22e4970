#include "hal/canopen/sdo_client.hpp"

#include "hal/canopen/sdo_abort.hpp"
#include "hal/canopen/sdo_frames.hpp"

namespace flexrf::canopen {

bool SdoClient::read(ObjectAddress object, Time now, Outbox& outbox) noexcept {
  if (state_ == State::busy) return false;
  begin(Step::read_first, object, now);
  send(request(sdo::read_request), now, outbox);
  return true;
}

bool SdoClient::write(ObjectAddress object, std::span<const std::uint8_t> value, Time now,
                      Outbox& outbox) noexcept {
  if (state_ == State::busy || value.size() > capacity) return false;
  begin(Step::write_first, object, now);
  std::copy(value.begin(), value.end(), value_.begin());
  size_ = value.size();
  Message message = request(sdo::write_segmented);
  if (size_ >= 1 && size_ <= 4) {
    message.data[0] = sdo::expedited(sdo::write_expedited, size_);
    std::copy(value.begin(), value.end(), message.data.begin() + 4);
  } else {
    write_number(&message.data[4], 4, size_);
  }
  send(message, now, outbox);
  return true;
}

void SdoClient::cancel(Outbox& outbox) noexcept {
  if (state_ == State::busy) give_up(sdo_abort::general, outbox);
  state_ = State::idle;
}

void SdoClient::receive(const Message& message, Time now, Outbox& outbox) noexcept {
  if (message.identifier != identifier_of(sdo_answer_base, node_)) return;
  if (state_ != State::busy || message.size != 8 || message.remote) {
    ++dropped_;
    return;
  }
  if (message.data[0] == sdo::abort) {
    if (!is_own_abort(message)) {
      ++dropped_;
      return;
    }
    answered_ = true;
    fail(static_cast<std::uint32_t>(read_number(&message.data[4], 4)));
    return;
  }
  if (step_ == Step::read_first || step_ == Step::write_first) {
    take_first(message, now, outbox);
  } else {
    take_segment(message, now, outbox);
  }
}

void SdoClient::advance(Time now, Outbox& outbox) noexcept {
  if (state_ == State::busy && now - asked_ > timeout_) give_up(sdo_abort::timeout, outbox);
}

Status SdoClient::status() const noexcept {
  if (state_ != State::failed) return {};
  const bool reads = step_ == Step::read_first || step_ == Step::read_segment;
  const char* act = reads ? "reading" : "writing";
  if (!answered_ && abort_code_ == sdo_abort::timeout) {
    return Status::error(StatusCode::timeout,
                         "node %u did not answer within %lld ms while %s object %04X:%02X", unsigned{node_},
                         static_cast<long long>(timeout_.count() / 1'000'000), act, unsigned{object_.index},
                         unsigned{object_.subindex});
  }
  return Status::error(StatusCode::device_fault, "%s object %04X:%02X of node %u was aborted %s: %s (%08lX)",
                       act, unsigned{object_.index}, unsigned{object_.subindex}, unsigned{node_},
                       answered_ ? "by the node" : "by us", describe_sdo_abort(abort_code_),
                       static_cast<unsigned long>(abort_code_));
}

void SdoClient::begin(Step step, ObjectAddress object, Time now) noexcept {
  state_ = State::busy;
  step_ = step;
  object_ = object;
  toggle_ = false;
  answered_ = false;
  abort_code_ = sdo_abort::none;
  announced_ = 0;
  size_ = 0;
  sent_ = 0;
  asked_ = now;
}

Message SdoClient::request(std::uint8_t command) const noexcept {
  return sdo::frame(identifier_of(sdo_request_base, node_), command, object_);
}

void SdoClient::send(const Message& message, Time now, Outbox& outbox) noexcept {
  asked_ = now;
  outbox.push(message);
}

void SdoClient::fail(std::uint32_t code) noexcept {
  state_ = State::failed;
  abort_code_ = code;
}

void SdoClient::give_up(std::uint32_t code, Outbox& outbox) noexcept {
  Message message = request(sdo::abort);
  write_number(&message.data[4], 4, code);
  outbox.push(message);
  fail(code);
}

bool SdoClient::is_about_object(const Message& message) const noexcept {
  return sdo::object_of(message) == object_;
}

bool SdoClient::is_own_abort(const Message& message) const noexcept {
  // Within segments, which name no object, some servers name none in their abort either.
  const bool in_segments = step_ == Step::read_segment || step_ == Step::write_segment;
  return is_about_object(message) || (in_segments && sdo::object_of(message) == ObjectAddress{});
}

void SdoClient::take_first(const Message& message, Time now, Outbox& outbox) noexcept {
  const std::uint8_t kind = sdo::kind_of(message);
  const std::uint8_t expected = step_ == Step::read_first ? sdo::read_answer : sdo::write_answer;
  if (kind != expected || !is_about_object(message)) {
    ++dropped_;
    return;
  }
  if (step_ == Step::write_first) {
    if (size_ >= 1 && size_ <= 4) {
      state_ = State::done;
      return;
    }
    step_ = Step::write_segment;
    send_segment(now, outbox);
    return;
  }
  if (sdo::is_expedited(message)) {
    size_ = sdo::expedited_size(message);
    std::copy_n(message.data.begin() + 4, size_, value_.begin());
    state_ = State::done;
    return;
  }
  announced_ = sdo::states_size(message) ? static_cast<std::uint32_t>(read_number(&message.data[4], 4)) : 0;
  if (announced_ > capacity) {
    give_up(sdo_abort::out_of_memory, outbox);
    return;
  }
  step_ = Step::read_segment;
  ask_segment(now, outbox);
}

void SdoClient::take_segment(const Message& message, Time now, Outbox& outbox) noexcept {
  const bool reads = step_ == Step::read_segment;
  if (sdo::kind_of(message) != (reads ? sdo::segment_answer : sdo::write_segment_answer)) {
    ++dropped_;
    return;
  }
  if (sdo::toggle_of(message) != toggle_) {
    give_up(sdo_abort::toggle, outbox);
    return;
  }
  toggle_ = !toggle_;
  if (!reads) {
    if (sent_ == size_) {
      state_ = State::done;
    } else {
      send_segment(now, outbox);
    }
    return;
  }
  const std::size_t count = sdo::segment_size(message);
  if (size_ + count > capacity) {
    give_up(sdo_abort::out_of_memory, outbox);
    return;
  }
  std::copy_n(message.data.begin() + 1, count, value_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += count;
  if (!sdo::is_last_segment(message)) {
    ask_segment(now, outbox);
  } else if (announced_ != 0 && announced_ != size_) {
    give_up(sdo_abort::wrong_length, outbox);
  } else {
    state_ = State::done;
  }
}

void SdoClient::ask_segment(Time now, Outbox& outbox) noexcept {
  Message message{identifier_of(sdo_request_base, node_), 8, {}};
  message.data[0] = sdo::with_toggle(sdo::read_segment_request, toggle_);
  send(message, now, outbox);
}

void SdoClient::send_segment(Time now, Outbox& outbox) noexcept {
  const std::size_t count = std::min<std::size_t>(size_ - sent_, 7);
  send(sdo::segment(identifier_of(sdo_request_base, node_), toggle_, {value_.data() + sent_, count},
                    sent_ + count == size_),
       now, outbox);
  sent_ += count;
}

}  // namespace flexrf::canopen
