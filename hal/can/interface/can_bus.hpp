// CanBus: a CAN bus and the devices on it.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "can_bus_interface.hpp"
#include "hal/can/interface/can_frame.hpp"
#include "hal/can/interface/can_inbox.hpp"
#include "hal/can/interface/can_send_queue.hpp"
#include "hal/can/interface/turn.hpp"
#include "types/can_bus_state.hpp"

namespace flexrf {

class CanWire;

/// A cycle is: the bus receives everything that came, at once, and puts it into its devices' inboxes; they
/// take it in their receive(); they queue what they have to say in their send(), in any order; the bus sends
/// it at once, in the order of priority. So SYNC leaves before the process data, whichever device says
/// it [can-bus-1].
///
/// The bus and the devices on it live in one thread, without an IO thread: nothing here waits.
///
/// A bus that is off, down or gone is no fault of this device: state() says so, it comes back by itself, and
/// feedback.recoveries counts it [can-bus-2]. What a device does meanwhile is for the device to say.
class CanBus : public CanBusInterface {
 public:
  using CanBusInterface::CanBusInterface;

  static constexpr int no_last_word = -1;

  // ---- for devices on the bus: in initialise() and stop(), the lifecycle thread

  /// From now on frames with these identifiers go into `inbox` [can-bus-3], which keeps the newest `capacity`
  /// (rounded up to a power of two) [can-bus-4]. Several inboxes may want the same identifier [can-bus-5]. An
  /// inbox that is open is opened anew [can-bus-12]. Error: an identifier has too many bits, or none was
  /// named [can-bus-6].
  Status open(CanInbox& inbox, std::span<const CanIdentifier> identifiers, std::uint32_t capacity = 32);
  Status open(CanInbox& inbox, std::initializer_list<CanIdentifier> identifiers,
              std::uint32_t capacity = 32) {
    return open(inbox, std::span(identifiers.begin(), identifiers.size()), capacity);
  }
  /// From now on nothing comes into the inbox [can-bus-7]. Before it goes; nothing when it is not open.
  void close(CanInbox& inbox);

  /// Reserves a CANopen node, 1 to 127, for one device: two that lead the same node would contradict each
  /// other [can-bus-13]. `owner` is the device's name(), and is known by its address; its former node is
  /// released. Error: the node is another device's, whose name the message has.
  Status claim_node(std::uint8_t node, const char* owner);
  void release_node(const char* owner) noexcept;

  /// A place for a device's last word, see prepare_last_word(). Below 0: this bus says nothing then, or has
  /// no place left, which it has told.
  virtual int claim_last_word() { return no_last_word; }
  /// Nothing is said for this device any more. The device no longer steps. `place`: also below 0.
  virtual void release_last_word(int /*place*/) {}

  // ---- for devices on the bus: while they live in its thread

  /// Sends this frame at the end of the cycle; what does not fit into the controller's queue then waits for
  /// the next one. False, counted in feedback.frames_refused: this queue is full, the bus is not usable, or
  /// the frame is not valid [can-bus-8]. Frames of one identifier keep their order [can-bus-9].
  bool queue(const CanFrame& frame) noexcept { return put(frame, false); }
  /// As queue(), but takes the place of a frame with this identifier that was posted and has not
  /// left [can-bus-10]: for what is said in every cycle, where only the newest counts (set-points), and for
  /// what several devices may say and is to be said once (SYNC).
  bool post(const CanFrame& frame) noexcept { return put(frame, true); }

  /// Should this process crash from now on, or its thread hang, `word` is said for this device; then, once
  /// the words of all devices on the bus have been, `all`: the same for all of them, as SYNC [can-bus-11]. In
  /// each cycle, if need be; no system call. `place`: of claim_last_word(), not below 0.
  virtual void prepare_last_word(int /*place*/, const CanFrame& /*word*/, const CanFrame& /*all*/) noexcept {}

  CanBusState state() const noexcept { return feedback.state; }
  bool is_usable() const noexcept { return feedback.state >= CanBusState::error_passive; }
  /// As of this cycle.
  const Feedback& counters() const noexcept { return feedback; }

  /// Of a simulated bus: where simulated devices are attached (hal/can/in_process). Else null.
  virtual CanWire* wire() noexcept { return nullptr; }

 protected:
  // ---- for drivers

  /// Begins anew: no queue, no counters, state gone. The inboxes stay open.
  void restart() noexcept;
  /// The identifiers that somebody wants have changed. The lifecycle thread, beside the bus's own.
  virtual void listen_to(std::span<const CanIdentifier> /*identifiers*/) {}
  /// As for listen_to(); the lifecycle thread.
  std::vector<CanIdentifier> wanted() const;

  /// Between begin_delivery() and end_delivery(): into the inboxes of those who want it.
  void deliver(const CanFrame& frame) noexcept;
  /// False: a device is just coming or going; receive in the next cycle.
  bool begin_delivery() noexcept { return registry_.try_take(); }
  void end_delivery() noexcept { registry_.give_back(); }

  CanSendQueue& waiting() noexcept { return waiting_; }
  /// Counts the way there and back, and gives up what is queued when the bus is not usable.
  void enter(CanBusState state) noexcept;

 private:
  static constexpr std::uint16_t nobody = 0;
  /// One inbox's wish for one identifier; of those for the same, a list.
  struct Wish {
    CanIdentifier identifier;
    CanInbox* inbox = nullptr;
    std::uint16_t next = nobody;
  };

  bool put(const CanFrame& frame, bool replaces) noexcept;
  void forget(const CanInbox& inbox);
  void index_wishes();
  void deliver_to(std::uint16_t wish, const CanFrame& frame) noexcept;
  CanSendQueue waiting_;
  bool was_usable_ = false;
  std::array<const char*, 128> nodes_{};  // their owners; the lifecycle thread's

  // Who has the turn may touch what follows.
  Turn registry_;
  std::vector<Wish> wishes_;             // [0] is nobody's
  std::vector<std::uint16_t> standard_;  // first wish for each 11-bit identifier
  std::vector<std::uint16_t> extended_;  // first wish for each 29-bit identifier, in their order
};

}  // namespace flexrf
