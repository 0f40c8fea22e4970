// Binary frames of values, as docs/panel-protocol.md lays them out.
#pragma once

#include <cstdint>
#include <string>

#include "web-ui/server/api/clients.hpp"
#include "web-ui/server/api/image_worker.hpp"
#include "web-ui/server/api/observed_slots.hpp"

namespace flexrf::panel {

/// The server's thread.
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
  /// Appends what is due; false, and nothing is appended: nothing is. What is due while another message is
  /// under way is left out: the next frame has what is newest then.
  bool write(Client& client, Time now, std::string& to);

 private:
  bool write_item(SlotSubscription& subscription, std::string& to);
  bool write_picture(SlotSubscription& subscription, std::string& to);

  std::uint64_t descriptor_;
  ObservedSlots* slots_;
  const ImageWorker* images_;
};

}  // namespace flexrf::panel
