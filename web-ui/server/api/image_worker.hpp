// Pictures of image slots as JPEG, encoded once for all who look, in a thread of their own.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "runtime/face/directory.hpp"
#include "runtime/log/log.hpp"
#include "web-ui/server/api/picture.hpp"

namespace flexrf::panel {

/// demand, newest, copy: the server's thread. Memory of a slot's pictures is allocated when somebody looks
/// for the first time.
class ImageWorker {
 public:
  /// `bell`: rung when a picture is there that demand_once() asked for; null: nothing is.
  ImageWorker(const Cell& cell, const Directory& directory, Doorbell* bell);
  ~ImageWorker() { stop(); }
  ImageWorker(const ImageWorker&) = delete;
  ImageWorker& operator=(const ImageWorker&) = delete;

  /// Nothing is started where there is no picture to look at.
  Status start();
  void stop() noexcept;

  bool is_image(std::uint16_t slot) const noexcept { return slots_[slot] != nullptr; }
  /// How a slot is looked at: at most `width` pixels wide are of use, one picture each `interval`. Zero
  /// interval: nobody looks.
  void demand(std::uint16_t slot, std::uint32_t width, Duration interval);
  /// One picture more, soon, whatever the interval.
  void demand_once(std::uint16_t slot, std::uint32_t width);

  struct Newest {
    ItemHeader header{};
    NullReason reason = NullReason::nothing_yet;
    std::uint64_t version = 0;    ///< rises with each look at the slot; 0: not looked yet
    std::size_t size = 0;         ///< bytes of the JPEG; 0: there is none
    std::uint16_t scaled_by = 0;  ///< by how much each of its sides is smaller than the image's
  };
  Newest newest(std::uint16_t slot) const;
  /// Appends the JPEG; false: there is none, as `cause` says (it lives for ever).
  bool copy(std::uint16_t slot, std::string& to, Newest& newest, const char*& cause) const;

 private:
  struct Slot {
    const char* name = nullptr;
    PictureLayout layout;
    std::size_t size = 0;  // bytes of an item
    std::uint32_t width = 0;
    std::uint32_t width_once = 0;  // 0: nobody asked
    Duration interval{};
    Time due{};
    std::uint64_t encoded_sequence = 0;
    std::uint32_t encoded_width = 0;
    // The worker's own.
    std::vector<std::byte> raw;
    PictureEncoder encoder;
    const char* told = nullptr;  // why pictures cannot be encoded, as the log has it
    LogLimit telling;
    // What was encoded last.
    Newest newest;
    std::string jpeg;
    std::string not_chosen;  // reason_text() of a driver that was not
    const char* cause = "nobody looked at it yet";
  };

  void run();
  void encode(std::uint16_t index, Slot& slot, std::uint32_t width);
  static void tell(Slot& slot);

  const Cell* cell_;
  Doorbell* bell_;
  std::vector<std::unique_ptr<Slot>> slots_;  // null: no image, or not observed
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace flexrf::panel
