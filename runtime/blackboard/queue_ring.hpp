// QueueRing: a queue's ring of one writer and one reader. RingSet: one reader's way out of several rings.
//
// Steps that bound each operation, for a value of W words: push W + 5 stores and 1 load, whatever the reader
// does; pop W + 5 loads, twice that at most when the writer laps it (drop_oldest).
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/blackboard/queue.hpp"
#include "runtime/blackboard/ring_entry.hpp"

namespace flexrf {

/// A bounded ring of one writer and one reader. Constant-initialised by the generated application.
///
/// A full ring refuses the item that comes (drop_newest), or overwrites the oldest, which the reader then
/// finds missing and skips (drop_oldest): the writer never moves the reader's cursor. An item's sequence
/// counts the pushes of its writer, those refused too, so a gap shows what was dropped.
///
/// QueueSink's part: the writer's thread. pop: the reader's thread.
class QueueRing final : public QueueSink, public QueueSource {
 public:
  struct Memory {
    std::atomic<std::uint64_t>* words;  ///< `entries` times RingEntry::words(size of the value)
    std::uint32_t entries;              ///< a power of two, >= capacity
    std::uint32_t capacity;             ///< items kept, >= 1
  };

  constexpr QueueRing(const TypeDescriptor* type, Memory memory, DropPolicy policy,
                      std::span<Doorbell* const> bells = {}) noexcept
      : memory_(memory), type_(type), bells_(bells), policy_(policy) {}
  QueueRing(const QueueRing&) = delete;
  QueueRing& operator=(const QueueRing&) = delete;

  bool push(const void* value, Time sampled_at) noexcept override;
  bool has_room() const noexcept override;
  void commit() noexcept override;
  /// Before the start.
  void set_deferred(bool on) noexcept override { deferred_ = on; }
  void set_digested(bool on) noexcept override { digested_ = on; }
  std::uint64_t digest() const noexcept override { return digest_; }
  /// drop_newest: dropped were refused and are not in pushed. drop_oldest: dropped were pushed and
  /// overwritten.
  QueueCounters counters() const noexcept override;
  const TypeDescriptor* type() const noexcept override { return type_; }

  bool pop(void* value, ItemHeader& header) noexcept override;
  std::uint32_t fill() const noexcept override;
  std::uint64_t arrivals() const noexcept override { return visible_.load(std::memory_order_acquire); }
  /// What was overwritten leaves, too, when the reader skips it.
  std::uint64_t departures() const noexcept override { return read_.load(std::memory_order_acquire); }

  std::uint32_t capacity() const noexcept { return memory_.capacity; }
  /// So that tests can see the wrap-around: positions begin here. Before the start.
  void start_position_at(std::uint64_t position) noexcept;

 private:
  void make_visible() noexcept;
  std::atomic<std::uint64_t>* entry(std::uint64_t position) const noexcept {
    return memory_.words + (position & (memory_.entries - 1)) * RingEntry::words(type_->size);
  }

  // Read by both sides, written by nobody after the start.
  Memory memory_;
  const TypeDescriptor* type_;
  std::span<Doorbell* const> bells_;
  DropPolicy policy_;
  bool deferred_ = false;
  bool digested_ = false;

  // The writer's own. Positions count items ever put in; they wrap around modulo 2^64.
  alignas(64) std::atomic<std::uint64_t> visible_{0};  ///< position after the last visible item
  std::uint64_t written_ = 0;                          ///< position after the last written item
  std::uint64_t sequence_ = 0;
  std::atomic<std::uint64_t> refused_{0};
  std::uint64_t start_ = 0;
  std::uint64_t digest_ = 0;

  // The reader's own.
  alignas(64) std::atomic<std::uint64_t> read_{0};  ///< position of the next item to read
  std::atomic<std::uint64_t> overwritten_{0};
};

/// The memory of a ring, for `.bss`: `static QueueRingMemory<T, 16> memory; constinit QueueRing ring{&type,
/// memory.view(), policy, bells};`
template <class T, std::size_t Capacity>
struct QueueRingMemory {
  static_assert(Capacity >= 1);
  static constexpr std::size_t entries = std::bit_ceil(Capacity);
  std::atomic<std::uint64_t> words[entries * RingEntry::words(sizeof(T))];

  constexpr QueueRing::Memory view() noexcept {
    return {words, static_cast<std::uint32_t>(entries), static_cast<std::uint32_t>(Capacity)};
  }
};

/// One reader's way out of the rings of several writers: drained in table order.
class RingSet final : public QueueSource {
 public:
  constexpr RingSet(const TypeDescriptor* type, std::span<QueueRing* const> rings) noexcept
      : type_(type), rings_(rings) {}
  RingSet(const RingSet&) = delete;
  RingSet& operator=(const RingSet&) = delete;

  /// The next item of the first ring that has one. At most one pop per ring.
  bool pop(void* value, ItemHeader& header) noexcept override;
  std::uint32_t fill() const noexcept override;
  std::uint64_t arrivals() const noexcept override;
  std::uint64_t departures() const noexcept override;
  const TypeDescriptor* type() const noexcept override { return type_; }

 private:
  const TypeDescriptor* type_;
  std::span<QueueRing* const> rings_;
};

}  // namespace flexrf
