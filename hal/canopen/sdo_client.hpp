// SDO client (CiA 301): reads and writes one object of one node at a time, in one piece or in segments.
#pragma once

#include <span>

#include "base/status.hpp"
#include "base/time.hpp"
#include "hal/canopen/message.hpp"
#include "hal/canopen/object.hpp"

namespace flexrf::canopen {

/// A state machine without I/O: what it wants to send goes to the outbox that it is given, never blocking,
/// never allocating. One thread.
class SdoClient {
 public:
  static constexpr std::size_t capacity = 256;  ///< bytes of a value

  enum class State : std::uint8_t { idle, busy, done, failed };

  /// `timeout`: the longest that a server may take for each answer, above 0.
  SdoClient(std::uint8_t node, Duration timeout) noexcept : node_{node}, timeout_{timeout} {}

  /// Begins a transfer. False: one is under way. The transfer before is forgotten.
  bool read(ObjectAddress object, Time now, Outbox& outbox) noexcept;
  /// `value`: at most `capacity` bytes, else false.
  bool write(ObjectAddress object, std::span<const std::uint8_t> value, Time now, Outbox& outbox) noexcept;
  /// Tells the server that the transfer under way ends here; the client is idle then.
  void cancel(Outbox& outbox) noexcept;

  /// Of whichever message: what is no answer of the node's to the transfer under way is dropped and counted,
  /// so that one that comes late answers nothing else.
  void receive(const Message& message, Time now, Outbox& outbox) noexcept;
  /// Gives up when an answer took too long.
  void advance(Time now, Outbox& outbox) noexcept;

  State state() const noexcept { return state_; }
  ObjectAddress object() const noexcept { return object_; }
  /// Of a read that is done; as the server sent it. Valid until the next transfer.
  std::span<const std::uint8_t> value() const noexcept { return {value_.data(), size_}; }
  /// value() as a number; what it has beyond 8 bytes is left out.
  std::uint64_t number() const noexcept {
    return read_number(value_.data(), std::min<std::size_t>(size_, 8));
  }
  /// Of a failed transfer: the server's code, or the one that the client gave up with.
  std::uint32_t abort_code() const noexcept { return abort_code_; }
  /// Ok, or what failed with object, node and reason.
  Status status() const noexcept;
  /// Messages with the server's identifier that were no answer.
  std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  enum class Step : std::uint8_t { read_first, read_segment, write_first, write_segment };

  void begin(Step step, ObjectAddress object, Time now) noexcept;
  Message request(std::uint8_t command) const noexcept;
  void send(const Message& message, Time now, Outbox& outbox) noexcept;
  void fail(std::uint32_t code) noexcept;
  void give_up(std::uint32_t code, Outbox& outbox) noexcept;
  bool is_own_abort(const Message& message) const noexcept;
  bool is_about_object(const Message& message) const noexcept;
  void take_first(const Message& message, Time now, Outbox& outbox) noexcept;
  void take_segment(const Message& message, Time now, Outbox& outbox) noexcept;
  void ask_segment(Time now, Outbox& outbox) noexcept;
  void send_segment(Time now, Outbox& outbox) noexcept;

  std::uint8_t node_;
  Duration timeout_;
  State state_ = State::idle;
  Step step_ = Step::read_first;
  ObjectAddress object_{};
  bool toggle_ = false;
  bool answered_ = false;  // abort_code_ is the server's, not ours
  std::uint32_t abort_code_ = 0;
  std::uint32_t announced_ = 0;  // bytes, as a server that sends segments says; 0: it does not
  std::size_t size_ = 0;
  std::size_t sent_ = 0;
  Time asked_{};
  std::uint64_t dropped_ = 0;
  std::array<std::uint8_t, capacity> value_{};
};

}  // namespace flexrf::canopen
