// For tests of units that look at pictures: queues of jobs, slots with a history, ranges, and pictures in a
// slot.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include "runtime/blackboard/history.hpp"
#include "runtime/blackboard/job_queue.hpp"
#include "runtime/blackboard/sized_slot.hpp"
#include "types/camera_frame.hpp"
#include "types/vision_region.hpp"
#include "units/unit_bench.hpp"
#include "units/vision/region_bitmap.hpp"

namespace flexrf::user {

/// Jobs by score, as in a cell. The other end is the test's.
class JobBench {
 public:
  QueueSource* source() { return &queue_; }
  std::span<QueueSink* const> sinks() const { return sinks_; }
  void push(const VisionRegion& job) { sink_.push(&job, Time{}); }
  std::optional<VisionRegion> pop() {
    VisionRegion job{};
    ItemHeader header{};
    if (!queue_.pop(&job, header)) return std::nullopt;
    return job;
  }

 private:
  JobQueueMemory<VisionRegion, 64> memory_{};
  JobQueue queue_{descriptor_of<VisionRegion>, memory_.view(), DropPolicy::drop_newest,
                  JobOrder{true, Scalar::f64, offsetof(VisionRegion, score)}};
  JobSink sink_{&queue_};
  QueueSink* sinks_[1] = {&sink_};
};

/// A slot of one reader that remembers.
template <class T, std::size_t K>
class HistoryBench {
 public:
  InputBinding input() { return {&reader_, 1, {}, nullptr}; }
  void publish(const T& value, Time at) {
    const std::uint8_t buffer = slot_.control().loan();
    std::memcpy(slot_.control().payload(buffer), &value, sizeof(T));
    slot_.control().publish(buffer, at);
  }

 private:
  HistoryMemory<T, K> memory_{};
  History history_{descriptor_of<T>, memory_.words, K};
  Slot<T, 1> slot_{{}, &history_};
  SlotReader reader_{&slot_.control()};
};

/// Slots of a population.
template <class T, std::size_t N>
class RangeBench {
 public:
  InputBinding input() { return {readers_.data(), static_cast<std::uint32_t>(N), {}, members_.data()}; }
  void publish(std::size_t member, const T& value, Time at) {
    SlotControl& control = slots_[member].control();
    const std::uint8_t buffer = control.loan();
    std::memcpy(control.payload(buffer), &value, sizeof(T));
    control.publish(buffer, at);
  }

 private:
  template <std::size_t... I>
  static std::array<SlotReader, N> readers_of(std::array<Slot<T, 1>, N>& slots, std::index_sequence<I...>) {
    return {SlotReader{&slots[I].control()}...};
  }
  std::array<Slot<T, 1>, N> slots_;
  std::array<SlotReader, N> readers_ = readers_of(slots_, std::make_index_sequence<N>{});
  std::array<Input<T>, N> members_{};
};

/// Pictures, of which a reader may keep one.
class FrameBench {
 public:
  InputBinding input() { return {&reader_, 1, {}, nullptr}; }
  CameraFrame& frame() { return *item_; }
  void draw(const PictureView& picture) {
    CameraFrame& to = *item_;
    to.width = static_cast<std::uint32_t>(picture.width);
    to.height = static_cast<std::uint32_t>(picture.height);
    to.stride = static_cast<std::uint32_t>(picture.stride);
    to.size = to.stride * to.height;
    to.format = PixelFormat::rgb24;
    std::memcpy(to.data().data(), picture.pixels, to.size);
  }
  void publish(std::uint64_t sequence, Time at) {
    CameraFrame& from = *item_;
    from.sequence = sequence;
    from.time = nanoseconds(at);
    SlotControl& control = slot_.control();
    const std::uint8_t buffer = control.loan();
    std::memcpy(control.payload(buffer), &from, control.type()->size);
    control.publish(buffer, at);
  }

 private:
  SizedItem<CameraFrame> item_;
  Slot<CameraFrame, 1, 1, 1> slot_;
  SlotReader reader_{&slot_.control()};
};

}  // namespace flexrf::user
