#include "web-ui/server/api/image_worker.hpp"

#include <algorithm>
#include <cstring>
#include <system_error>

#include "runtime/face/observed_slots.hpp"
#include "runtime/realtime/signals.hpp"

namespace flexrf::panel {

ImageWorker::ImageWorker(const Cell& cell, const Directory& directory, Doorbell* bell)
    : cell_(&cell), bell_(bell) {
  for (const SlotRecord& record : directory.slots()) {
    std::unique_ptr<Slot>& slot = slots_.emplace_back();
    const TypeDescriptor& type = *record.control->type();
    const PictureLayout layout = PictureLayout::of(type);
    if (!type.is_image || record.observer == nullptr || !layout.is_complete()) continue;
    slot = std::make_unique<Slot>();
    slot->name = record.name;
    slot->not_chosen =
        reason_text(cell, static_cast<std::uint16_t>(slots_.size() - 1), NullReason::driver_not_chosen);
    slot->layout = layout;
    slot->size = type.size;
  }
}

Status ImageWorker::start() {
  const bool has_any =
      std::any_of(slots_.begin(), slots_.end(), [](const auto& slot) { return slot != nullptr; });
  if (!has_any || thread_.joinable()) return {};
  try {
    // The signals that end the application are for others to take.
    const signals::Blocked blocked;
    thread_ = std::thread([this] {
      pthread_setname_np(pthread_self(), "panel-pictures");
      run();
    });
  } catch (const std::system_error& error) {
    return Status::error(StatusCode::unavailable, "the panel's thread for pictures: %s", error.what());
  }
  return {};
}

void ImageWorker::stop() noexcept {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void ImageWorker::demand(std::uint16_t index, std::uint32_t width, Duration interval) {
  Slot& slot = *slots_[index];
  {
    const std::lock_guard lock(mutex_);
    if (slot.width == width && slot.interval == interval) return;
    slot.width = width;
    slot.interval = interval;
    slot.due = MonotonicClock::now();
  }
  wake_.notify_one();
}

void ImageWorker::demand_once(std::uint16_t index, std::uint32_t width) {
  Slot& slot = *slots_[index];
  {
    const std::lock_guard lock(mutex_);
    slot.width_once = std::max(slot.width_once, width);
  }
  wake_.notify_one();
}

ImageWorker::Newest ImageWorker::newest(std::uint16_t index) const {
  const std::lock_guard lock(mutex_);
  return slots_[index]->newest;
}

bool ImageWorker::copy(std::uint16_t index, std::string& to, Newest& newest, const char*& cause) const {
  const Slot& slot = *slots_[index];
  const std::lock_guard lock(mutex_);
  newest = slot.newest;
  cause = slot.cause;
  if (slot.newest.size == 0) return false;
  to += slot.jpeg;
  return true;
}

void ImageWorker::run() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    const Time now = MonotonicClock::now();
    Time next = now + std::chrono::seconds{1};
    bool encoded = false;
    for (std::size_t i = 0; i < slots_.size() && !ends_; ++i) {
      if (slots_[i] == nullptr) continue;
      Slot& slot = *slots_[i];
      const bool looked_at = slot.interval.count() > 0;
      if (slot.width_once == 0 && (!looked_at || now < slot.due)) {
        if (looked_at) next = std::min(next, slot.due);
        continue;
      }
      const std::uint32_t width = std::max(looked_at ? slot.width : 0, slot.width_once);
      const bool is_awaited = slot.width_once != 0;
      slot.width_once = 0;
      if (looked_at) slot.due = std::max(slot.due + slot.interval, now);
      lock.unlock();
      encode(static_cast<std::uint16_t>(i), slot, width);
      if (is_awaited && bell_ != nullptr) bell_->ring();
      lock.lock();
      encoded = true;
    }
    if (encoded || ends_) continue;
    wake_.wait_for(lock, next - now);
  }
}

void ImageWorker::encode(std::uint16_t index, Slot& slot, std::uint32_t width) {
  slot.raw.resize(slot.size);
  bool copied = false;
  const ObservedSlot seen = look_at(*cell_, index, [&](const ItemHeader& header, const void* payload) {
    copied = header.sequence != slot.encoded_sequence || width > slot.encoded_width;
    if (copied) std::memcpy(slot.raw.data(), payload, slot.size);
  });
  const std::string_view jpeg =
      copied ? slot.encoder.encode(slot.layout, slot.raw.data(), width) : std::string_view{};
  if (copied) tell(slot);
  const std::lock_guard lock(mutex_);
  if (copied) {
    slot.encoded_sequence = seen.header.sequence;
    slot.encoded_width = width;
    slot.jpeg.assign(jpeg);
    slot.newest.header = seen.header;
    slot.newest.scaled_by = slot.encoder.scaled_by();
  }
  slot.cause = seen.reason == NullReason::none                ? slot.encoder.cause()
               : seen.reason == NullReason::driver_not_chosen ? slot.not_chosen.c_str()
                                                              : name_of(seen.reason);
  slot.newest.reason = seen.reason;
  slot.newest.size = seen.reason == NullReason::none ? slot.jpeg.size() : 0;
  ++slot.newest.version;
}

/// Once for each cause in a row: a camera whose pictures are all alike does not fill the log.
void ImageWorker::tell(Slot& slot) {
  const char* const cause = slot.encoder.cause();
  if (cause == slot.told) return;
  if (cause[0] != '\0')
    log_warning(slot.telling, "panel", "Slot {}: a picture cannot be shown: {}", slot.name, cause);
  // One that was held back is tried again with the next picture.
  slot.told = slot.telling.held_back() == 0 ? cause : nullptr;
}

}  // namespace flexrf::panel
