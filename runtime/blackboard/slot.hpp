// Slot: a wait-free register with one writer and a known number of readers.
//
// With one reader, one loan and no hold it is a triple buffer: one exchange publishes, one exchange takes.
// Otherwise it counts anonymous readers (Ianni, Pellegrini, Quaglia: "Anonymous readers counting", 2017,
// after Larsson et al. 2004): a word holds the current buffer's index and how often it was taken since it was
// published. A reader gives its former buffer back by one increment and takes the current one by another; the
// writer publishes by one exchange and finds a free buffer by comparing taken with given back. Each reader
// holds at most one buffer (one more per hold), so of Readers + Holds + 1 + Loans buffers one is always free
// for a writer that keeps to its loans: one is current, at most Loans - 1 others are out, at most
// Readers + Holds are held, and none but the current one can become held. No operation waits, copies or
// retries on account of the other side.
//
// Steps that bound each operation, B = number of buffers, whatever the other side does: loan at most B loads;
// publish 1 exchange and 1 store (and per doorbell 1 read-modify-write); take 1 load, and for a new item 1
// exchange (triple buffer) or 2 read-modify-writes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "runtime/blackboard/doorbell.hpp"
#include "runtime/blackboard/item.hpp"
#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

class History;

inline constexpr std::size_t cache_line = 64;
inline constexpr std::size_t page = 4096;

/// Bytes of an item's header in front of or beside its payload: payload at or above this size is page-aligned
/// and apart from the headers, below it both share cache lines.
inline constexpr std::size_t large_payload = 4096;

/// The control block of a slot, without its C++ type. Constant-initialised by the generated application.
///
/// loan, publish, abandon, commit: the writer's thread. take, give: the reader's thread, each with its own
/// held index. Everything else: any thread.
class SlotControl {
 public:
  static constexpr std::uint8_t none = 0xFF;
  static constexpr std::size_t max_buffers = 64;

  struct Memory {
    void* headers;  ///< B headers, header_stride bytes apart
    void* payload;  ///< B values, payload_stride bytes apart
    std::uint32_t header_stride;
    std::uint32_t payload_stride;
    std::uint32_t* taken;               ///< B counters, written by the writer only
    std::atomic<std::uint32_t>* given;  ///< B counters, incremented by readers
    std::uint8_t buffers;               ///< B = readers + holds + 1 + loans
    std::uint8_t loans;
    bool triple;  ///< one reader, one loan, no hold
  };

  constexpr SlotControl(const TypeDescriptor* type, Memory memory, std::span<Doorbell* const> bells = {},
                        History* history = nullptr) noexcept
      : memory_(memory), type_(type), bells_(bells), history_(history) {}
  SlotControl(const SlotControl&) = delete;
  SlotControl& operator=(const SlotControl&) = delete;

  // ---- the writer's side

  /// A buffer to fill, contents unspecified (poisoned in checked builds); `none` when all loans are out (or
  /// more readers hold a buffer than the slot was made for).
  std::uint8_t loan() noexcept;
  /// As loan(), starting as the last published value (zero before the first).
  std::uint8_t loan_last() noexcept;
  /// Makes the buffer the latest item, stamps it, rings the doorbells. In virtual time it becomes visible at
  /// commit(), or when the same step asks for another loan: there is no buffer more for that case.
  void publish(std::uint8_t buffer, Time sampled_at) noexcept;
  /// Gives an unpublished loan back.
  void abandon(std::uint8_t buffer) noexcept;
  /// Virtual time only: makes what was published since the last commit visible.
  void commit() noexcept;

  // ---- a reader's side

  /// Moves the reader on to the latest item. `held` is the reader's buffer (`none` at first) and is replaced;
  /// it stays `none` while nothing was published. True when the item is another than before.
  bool take(std::uint8_t& held) noexcept {
    std::uint16_t seen = 0;
    return take(held, seen);
  }
  /// Also tells what glance() gives until there is something newer.
  bool take(std::uint8_t& held, std::uint16_t& seen) noexcept;
  std::uint16_t glance() const noexcept {
    return static_cast<std::uint16_t>(word_.load(std::memory_order_relaxed) & (one_taken - 1));
  }
  /// True when take() would bring another item; changes nothing.
  bool has_newer(std::uint8_t held) const noexcept;
  /// Gives a held buffer back for good (a reader that goes away; a hold that ends); `held` becomes `none`. In
  /// a triple buffer the reader's buffer is nobody else's in any case: it stays held, and `held` as it is.
  void give(std::uint8_t& held) noexcept;

  // ---- anybody

  const ItemHeader& header(std::uint8_t buffer) const noexcept {
    return *reinterpret_cast<const ItemHeader*>(static_cast<const std::byte*>(memory_.headers) +
                                                buffer * std::size_t{memory_.header_stride});
  }
  std::byte* payload(std::uint8_t buffer) const noexcept {
    return static_cast<std::byte*>(memory_.payload) + buffer * std::size_t{memory_.payload_stride};
  }
  const TypeDescriptor* type() const noexcept { return type_; }
  History* history() const noexcept { return history_; }
  /// Sequence of the last visible publication, 0 before the first: what triggers compare and reports count.
  std::uint64_t published() const noexcept { return published_.load(std::memory_order_acquire); }
  /// When its value was true (sampled_at); no time before the first. May be one publication ahead of
  /// published().
  Time published_at() const noexcept { return Time{Duration{published_at_.load(std::memory_order_relaxed)}}; }
  WriterState writer_state() const noexcept { return writer_state_.load(std::memory_order_acquire); }
  void set_writer_state(WriterState state) noexcept { writer_state_.store(state, std::memory_order_release); }

  // ---- before the start, and after the end

  /// Tells each buffer how many elements it has, where the slot's row says that: once, before the first loan.
  void lay_out_items() noexcept;
  /// Of a slot with room for the largest of several types: which of them it carries. Before the first loan,
  /// and before anybody asks for the type.
  void set_type(const TypeDescriptor& type) noexcept { type_ = &type; }
  /// Virtual time: publications wait for commit().
  void set_deferred(bool on) noexcept { deferred_ = on; }
  /// Whether to digest publications, and the digest so far (name not included).
  void set_digested(bool on) noexcept { digested_ = on; }
  std::uint64_t digest() const noexcept { return digest_; }
  /// So that tests can see the wrap-around: the next publication has the one after this.
  void start_sequence_at(std::uint64_t sequence) noexcept { sequence_ = sequence; }

 private:
  // The word: [taken 63..10 | fresh 9 | published 8 | index 7..0]. The count is on top so that it may wrap.
  static constexpr std::uint64_t published_bit = std::uint64_t{1} << 8;
  static constexpr std::uint64_t fresh_bit = std::uint64_t{1} << 9;
  static constexpr int taken_shift = 10;
  static constexpr std::uint64_t one_taken = std::uint64_t{1} << taken_shift;
  static constexpr std::uint8_t index_of(std::uint64_t word) noexcept {
    return static_cast<std::uint8_t>(word & 0xFF);
  }
  static constexpr std::uint64_t word_of(std::uint8_t index) noexcept { return published_bit | index; }

  ItemHeader& header_for_writing(std::uint8_t buffer) noexcept {
    return *reinterpret_cast<ItemHeader*>(static_cast<std::byte*>(memory_.headers) +
                                          buffer * std::size_t{memory_.header_stride});
  }
  bool is_free(std::uint8_t buffer) const noexcept;
  void make_visible(std::uint8_t buffer) noexcept;
  void lay_out(std::uint8_t buffer) noexcept;
  void poison(std::uint8_t buffer) noexcept;

  // Whether this is a checked build. Known when it is linked: what uses slots is compiled once for both.
  static const bool poisons_loans;

  // Read by both sides, written by nobody after the start.
  Memory memory_;
  const TypeDescriptor* type_;
  std::span<Doorbell* const> bells_;
  History* history_;
  bool deferred_ = false;
  bool digested_ = false;

  // Shared.
  alignas(cache_line) std::atomic<std::uint64_t> word_{0};
  std::atomic<WriterState> writer_state_{WriterState::waiting};

  // The writer's own.
  alignas(cache_line) std::uint64_t sequence_ = 0;
  std::atomic<std::uint64_t> published_{0};
  std::atomic<std::int64_t> published_at_{0};
  std::uint64_t digest_ = 0;
  std::uint64_t loaned_ = 0;  ///< bit per buffer out on loan
  std::uint8_t current_ = 0;  ///< buffer in the word
  std::uint8_t back_ = 1;     ///< triple: the writer's buffer; else: probably free, tried first
  std::uint8_t last_ = none;  ///< last published buffer
  std::uint8_t loans_out_ = 0;
  std::uint8_t pending_ = none;  ///< virtual time: published, not yet visible
};

/// The memory of a slot's buffers: payload in .bss, small values beside their headers, large ones
/// page-aligned and apart.
template <class T, std::size_t Buffers, bool Large = (sizeof(T) >= large_payload)>
struct SlotMemory;

template <class T, std::size_t Buffers>
struct SlotMemory<T, Buffers, false> {
  // The value begins the cell, so that copies of it do not straddle cache lines.
  struct alignas(cache_line) Cell {
    T value;
    ItemHeader header;
  };
  Cell cells[Buffers];
  std::uint32_t taken[Buffers];
  alignas(cache_line) std::atomic<std::uint32_t> given[Buffers];

  constexpr SlotControl::Memory view(std::uint8_t loans, bool triple) noexcept {
    return {&cells[0].header, &cells[0].value, sizeof(Cell), sizeof(Cell), taken, given,
            Buffers,          loans,           triple};
  }
};

/// Values that begin a page each.
template <class Value, std::size_t Buffers>
struct LargeSlotMemory {
  // Apart from each other too: the writer fills one while readers look at others.
  struct alignas(cache_line) Header {
    ItemHeader header;
  };
  Value values[Buffers];
  Header headers[Buffers];
  std::uint32_t taken[Buffers];
  alignas(cache_line) std::atomic<std::uint32_t> given[Buffers];

  constexpr SlotControl::Memory view(std::uint8_t loans, bool triple) noexcept {
    return {&headers[0].header,
            &values[0].value,
            sizeof(Header),
            sizeof(Value),
            taken,
            given,
            Buffers,
            loans,
            triple};
  }
};

template <class T>
struct alignas(page) PageValue {
  T value;
};
template <class T, std::size_t Buffers>
struct SlotMemory<T, Buffers, true> : LargeSlotMemory<PageValue<T>, Buffers> {};

/// A value that is as large as the slot says: its elements lie behind it, and begin a page.
template <SizedBySlot T, std::size_t Elements>
struct alignas(page) SizedValue {
  T value;
  alignas(page) typename T::SlotElement elements[Elements];
};
template <SizedBySlot T, std::size_t Buffers, std::size_t Elements>
struct SizedSlotMemory : LargeSlotMemory<SizedValue<T, Elements>, Buffers> {
  using Value = SizedValue<T, Elements>;
  static_assert(offsetof(Value, elements) == T::elements_begin_);
};

template <SizedBySlot T, std::size_t Buffers>
struct SlotMemory<T, Buffers, false> : SizedSlotMemory<T, Buffers, T::usual_elements_> {};

/// Control block and memory in one, for code written by hand and for tests. The generator keeps them apart so
/// that payload lies in .bss.
template <class T, std::size_t Readers, std::size_t Loans = 1, std::size_t Holds = 0>
class Slot {
 public:
  static constexpr std::size_t buffers = Readers + Holds + 1 + Loans;
  static_assert(buffers <= SlotControl::max_buffers, "too many readers and loans for one slot");

  explicit Slot(std::span<Doorbell* const> bells = {}, History* history = nullptr) noexcept
      : control_(descriptor_of<T>, memory_.view(Loans, Readers == 1 && Loans == 1 && Holds == 0), bells,
                 history) {
    control_.lay_out_items();
  }
  SlotControl& control() noexcept { return control_; }
  operator SlotControl&() noexcept { return control_; }

 private:
  SlotMemory<T, buffers> memory_{};
  SlotControl control_;
};

}  // namespace flexrf

#include "runtime/blackboard/slot_inline.hpp"
