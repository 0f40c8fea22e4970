// Binary frames of values, as docs/panel-protocol.md lays them out.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/face/observed_slots.hpp"
#include "web-ui/server/api/clients.hpp"
#include "web-ui/server/api/image_worker.hpp"

namespace flexrf::panel {

/// What is due to clients that want the same and have seen the same is put together once in a turn; each gets
/// it with a header of its own. The server's thread.
class FrameWriter {
 public:
  /// A message without values at least so often: who hears nothing knows that nobody is there.
  static constexpr Duration heartbeat = std::chrono::milliseconds{250};

  FrameWriter(const Cell& cell, ObservedSlots& slots, const ImageWorker& images) noexcept
      : descriptor_(cell.application().descriptor_hash), slots_(&slots), images_(&images) {}

  /// From here on the newest values are looked at anew.
  void begin_turn() noexcept { slots_->begin_turn(); }
  /// When there may be something to send.
  static Time next(const Client& client) noexcept;
  /// A message of what is due, behind LiveLink::head_room bytes, until the next call; empty: nothing is due.
  /// What is due while another message is under way is left out: the next frame has what is newest then.
  std::span<char> write(Client& client, Time now);

 private:
  /// What one subscription got of the last message that was put together.
  struct Part {
    std::uint16_t slot = 0;
    Seen before;
    Seen after;
  };

  /// @returns frames that were left out.
  std::int64_t find_due(Client& client, Time now);
  bool is_for_due() const noexcept;
  void put_together();
  bool write_item(SlotSubscription& subscription);
  bool write_picture(SlotSubscription& subscription);

  std::uint64_t descriptor_;
  ObservedSlots* slots_;
  const ImageWorker* images_;

  std::vector<SlotSubscription*> due_;  // of the client that is being served
  std::vector<Part> parts_;             // of the message, in its order
  std::string message_;                 // behind LiveLink::head_room bytes
  std::uint64_t turn_ = 0;              // in which it was put together
  std::uint32_t items_ = 0;
};

}  // namespace flexrf::panel
