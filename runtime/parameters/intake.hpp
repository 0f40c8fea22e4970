// Intake: a bounded list that many threads put values into and one thread takes them from, in order of
// arrival.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace flexrf {

/// A value is copied into a cell before the cell is linked in, so that a producer that is preempted half-way
/// delays nobody: lock-free on the producers' side (Treiber 1986, with counted indices against ABA),
/// wait-free on the consumer's. All-zero is the empty intake.
///
/// put: any thread. take, has_any: the consumer's thread. Counters: any thread.
template <class Value, std::uint32_t Capacity>
class Intake {
 public:
  static constexpr std::uint32_t capacity = Capacity;

  constexpr Intake() noexcept = default;
  Intake(const Intake&) = delete;
  Intake& operator=(const Intake&) = delete;

  /// False, at once, when all cells are in use; counted.
  bool put(const Value& value) noexcept;
  /// Copies the oldest value out; false when there is none.
  bool take(Value& value) noexcept;
  bool has_any() const noexcept { return ours_ != 0 || arrived_.load(std::memory_order_acquire) != 0; }

  std::uint64_t accepted() const noexcept { return accepted_.load(std::memory_order_relaxed); }
  std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

 private:
  // Cells are numbered from 1; 0 ends a list.
  struct Cell {
    std::atomic<std::uint32_t> next;
    Value value;
  };
  Cell& cell(std::uint32_t number) noexcept { return cells_[number - 1]; }

  std::uint32_t claim() noexcept;
  void release(std::uint32_t number) noexcept;

  std::atomic<std::uint64_t> free_{0};     // [times changed 63..32 | first free cell 31..0]
  std::atomic<std::uint32_t> touched_{0};  // cells 1..touched_ have been used before
  std::atomic<std::uint32_t> arrived_{0};  // newest first
  std::uint32_t ours_ = 0;                 // the consumer's, oldest first
  std::atomic<std::uint64_t> accepted_{0};
  std::atomic<std::uint64_t> refused_{0};
  Cell cells_[Capacity]{};
};

template <class Value, std::uint32_t Capacity>
std::uint32_t Intake<Value, Capacity>::claim() noexcept {
  std::uint64_t head = free_.load(std::memory_order_acquire);
  while (static_cast<std::uint32_t>(head) != 0) {
    // The cell may be claimed and reused meanwhile: then `next` is stale, and the count makes the exchange
    // fail.
    const std::uint32_t number = static_cast<std::uint32_t>(head);
    const std::uint64_t next = cell(number).next.load(std::memory_order_relaxed);
    if (free_.compare_exchange_weak(head, ((head >> 32) + 1) << 32 | next, std::memory_order_acquire))
      return number;
  }
  std::uint32_t touched = touched_.load(std::memory_order_relaxed);
  while (touched < Capacity) {
    if (touched_.compare_exchange_weak(touched, touched + 1, std::memory_order_relaxed)) return touched + 1;
  }
  return 0;
}

template <class Value, std::uint32_t Capacity>
void Intake<Value, Capacity>::release(std::uint32_t number) noexcept {
  std::uint64_t head = free_.load(std::memory_order_relaxed);
  do {
    cell(number).next.store(static_cast<std::uint32_t>(head), std::memory_order_relaxed);
  } while (!free_.compare_exchange_weak(head, ((head >> 32) + 1) << 32 | number, std::memory_order_release,
                                        std::memory_order_relaxed));
}

template <class Value, std::uint32_t Capacity>
bool Intake<Value, Capacity>::put(const Value& value) noexcept {
  const std::uint32_t number = claim();
  if (number == 0) {
    refused_.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  cell(number).value = value;
  accepted_.fetch_add(1, std::memory_order_relaxed);
  std::uint32_t head = arrived_.load(std::memory_order_relaxed);
  do {
    cell(number).next.store(head, std::memory_order_relaxed);
  } while (
      !arrived_.compare_exchange_weak(head, number, std::memory_order_release, std::memory_order_relaxed));
  return true;
}

template <class Value, std::uint32_t Capacity>
bool Intake<Value, Capacity>::take(Value& value) noexcept {
  if (ours_ == 0) {
    // Everything that arrived becomes ours in one exchange; turned around, the oldest comes first.
    std::uint32_t number = arrived_.exchange(0, std::memory_order_acquire);
    while (number != 0) {
      const std::uint32_t next = cell(number).next.load(std::memory_order_relaxed);
      cell(number).next.store(ours_, std::memory_order_relaxed);
      ours_ = number;
      number = next;
    }
    if (ours_ == 0) return false;
  }
  const std::uint32_t number = ours_;
  ours_ = cell(number).next.load(std::memory_order_relaxed);
  value = cell(number).value;
  release(number);
  return true;
}

}  // namespace flexrf
