#include "runtime/blackboard/queue_ring.hpp"

#include <algorithm>

#include "runtime/core/digest.hpp"

namespace flexrf {

bool QueueRing::has_room() const noexcept {
  return written_ - read_.load(std::memory_order_acquire) < memory_.capacity;
}

bool QueueRing::push(const void* value, Time sampled_at) noexcept {
  sequence_ = next_sequence(sequence_);
  if (policy_ == DropPolicy::drop_newest && !has_room()) {
    refused_.store(refused_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    return false;
  }
  const ItemHeader header{sequence_, sampled_at};
  RingEntry::write(entry(written_), written_, header, value, type_->size);
  ++written_;
  if (digested_) digest_ = digest_of_item(digest_, *type_, header, value);
  if (!deferred_) make_visible();
  return true;
}

void QueueRing::commit() noexcept {
  if (visible_.load(std::memory_order_relaxed) != written_) make_visible();
}

void QueueRing::make_visible() noexcept {
  visible_.store(written_, std::memory_order_release);
  for (Doorbell* bell : bells_) bell->ring();
}

bool QueueRing::pop(void* value, ItemHeader& header) noexcept {
  std::uint64_t position = read_.load(std::memory_order_relaxed);
  std::uint64_t overwritten = 0;
  bool popped = false;
  for (int tries = 0; tries < 2 && !popped; ++tries) {
    const std::uint64_t waiting = visible_.load(std::memory_order_acquire) - position;
    if (waiting == 0) break;
    if (waiting > memory_.capacity) {
      overwritten += waiting - memory_.capacity;
      position += waiting - memory_.capacity;
    }
    popped = RingEntry::read(entry(position), position, header, value, type_->size);
    // Not whole: the writer is putting the next item in its place, so it is dropped.
    if (!popped) ++overwritten;
    ++position;
  }
  if (overwritten > 0) {
    overwritten_.store(overwritten_.load(std::memory_order_relaxed) + overwritten, std::memory_order_relaxed);
  }
  // The writer may use the entry again: after it was copied.
  read_.store(position, std::memory_order_release);
  return popped;
}

std::uint32_t QueueRing::fill() const noexcept {
  const std::uint64_t read = read_.load(std::memory_order_acquire);
  const std::uint64_t waiting = visible_.load(std::memory_order_acquire) - read;
  // What is beyond was overwritten.
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(waiting, memory_.capacity));
}

QueueCounters QueueRing::counters() const noexcept {
  const std::uint64_t overwritten = overwritten_.load(std::memory_order_relaxed);
  const std::uint64_t read = read_.load(std::memory_order_acquire);
  const std::uint64_t visible = visible_.load(std::memory_order_acquire);
  const std::uint64_t waiting = visible - read;
  // The reader finds out at its next pop; the report need not wait for that.
  const std::uint64_t doomed = waiting > memory_.capacity ? waiting - memory_.capacity : 0;
  return {visible - start_, read - start_ - overwritten,
          refused_.load(std::memory_order_relaxed) + overwritten + doomed};
}

void QueueRing::start_position_at(std::uint64_t position) noexcept {
  start_ = position;
  written_ = position;
  visible_.store(position, std::memory_order_relaxed);
  read_.store(position, std::memory_order_relaxed);
}

bool RingSet::pop(void* value, ItemHeader& header) noexcept {
  for (QueueRing* ring : rings_) {
    if (ring->pop(value, header)) return true;
  }
  return false;
}

std::uint32_t RingSet::fill() const noexcept {
  std::uint32_t sum = 0;
  for (const QueueRing* ring : rings_) sum += ring->fill();
  return sum;
}

std::uint64_t RingSet::arrivals() const noexcept {
  std::uint64_t sum = 0;
  for (const QueueRing* ring : rings_) sum += ring->arrivals();
  return sum;
}

std::uint64_t RingSet::departures() const noexcept {
  std::uint64_t sum = 0;
  for (const QueueRing* ring : rings_) sum += ring->departures();
  return sum;
}

}  // namespace flexrf
