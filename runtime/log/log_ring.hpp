// The bounded ring between those who log and the one who formats.
#pragma once

#include <atomic>
#include <cstdint>

#include "runtime/log/log_record.hpp"

namespace flexrf {

/// Many writers, one reader, records of fixed size. A writer reserves a place, then takes a ticket: as
/// many places as cells and cells freed in order mean that a ticket's cell is free, so writing takes two
/// read-modify-writes and never a retry. A writer preempted in mid-record holds up the reader, never another
/// writer.
class LogRing {
 public:
  static constexpr std::uint32_t capacity = 512;
  /// The last of them are kept for warnings and errors.
  static constexpr std::uint32_t reserve = 64;

  struct Cell {
    std::atomic<std::uint64_t> ready{0};  ///< ticket + 1 when filled
    LogRecord record{};
  };

  constexpr LogRing() noexcept = default;

  /// A cell to fill, or null when the ring is full (counted). Any thread, wait-free.
  Cell* claim(Severity severity) noexcept {
    const std::uint32_t room = severity < Severity::warning ? capacity - reserve : capacity;
    if (used_.fetch_add(1, std::memory_order_acquire) >= room) {
      used_.fetch_sub(1, std::memory_order_relaxed);
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return nullptr;
    }
    // Acquire and release: the place that a cell's freeing gave may be another writer's, one ticket before.
    const std::uint64_t ticket = tickets_.fetch_add(1, std::memory_order_acq_rel);
    Cell& cell = cells_[ticket % capacity];
    cell.record.ticket = ticket;
    return &cell;
  }
  /// Hands a filled cell to the reader.
  static void publish(Cell& cell) noexcept {
    cell.ready.store(cell.record.ticket + 1, std::memory_order_release);
  }

  /// The oldest record, or null. The reader only; valid until pop().
  const LogRecord* front() const noexcept {
    const Cell& cell = cells_[head_ % capacity];
    return cell.ready.load(std::memory_order_acquire) == head_ + 1 ? &cell.record : nullptr;
  }
  void pop() noexcept {
    ++head_;
    used_.fetch_sub(1, std::memory_order_release);
  }

  /// Any thread.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint32_t> used_{0};
  std::atomic<std::uint64_t> tickets_{0};
  std::atomic<std::uint64_t> dropped_{0};
  std::uint64_t head_ = 0;
  Cell cells_[capacity]{};
};

/// The process's own.
LogRing& process_log_ring() noexcept;

}  // namespace flexrf
