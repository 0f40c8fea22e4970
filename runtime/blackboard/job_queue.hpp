// JobQueue: a queue shared by several writers and several readers. JobSink: one writer's way into it.
//
// A pool of N cells. One 64-bit word per cell says what state it is in and how it ranks among the full ones;
// whoever moves a cell by compare-and-swap owns its value until the next move. Readers look through all cells
// for the best full one and claim it, writers for an empty one. Nobody waits for a cell that another holds.
//
// Steps that bound each operation, N = number of cells:
// push: at most N passes over the cells, each N loads and N compare-and-swaps. Without rivals in the same
//   instant, 1 pass, 2 when the pool is full.
// pop: 1 pass and 1 compare-and-swap, and once more for each item that somebody else took or pushed out
//   between the pass and the claim: lock-free, as each repetition is another's success.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/blackboard/queue.hpp"

namespace flexrf {

class JobSink;

/// In which order jobs are handed out. Default: in order of arrival.
struct JobOrder {
  bool by_score = false;        ///< highest score first; of equal ones the first that came
  Scalar scalar = Scalar::f64;  ///< type of the score's field: any number or bool
  std::uint32_t offset = 0;     ///< of the score's field in the value, bytes
};

/// By arrival, jobs of one writer come out in the order it pushed them. A full queue refuses what comes
/// (drop_newest) or gives up its oldest (drop_oldest). By score, a full queue gives up its lowest, which is
/// what comes if nothing is lower. A job that is being copied in or out still takes its cell. Scores beyond
/// ±2^60 and the last two bits of a double do not count; NaN ranks lowest.
///
/// pop: any of its readers' threads; one object serves all readers. push: by each writer's JobSink.
class JobQueue final : public QueueSource {
 public:
  /// One job's place, without its value. All-zero is empty.
  struct Cell {
    std::atomic<std::uint64_t> word;    ///< [rank 63..2 | state 1..0]
    std::atomic<std::uint64_t> ticket;  ///< order of arrival
    JobSink* owner;                     ///< who pushed it
    ItemHeader header;
    std::uint32_t next;  ///< virtual time: next of the writer's jobs that wait for commit(), plus one
  };
  struct Memory {
    Cell* cells;
    void* values;  ///< value_stride bytes apart
    std::uint32_t value_stride;
    std::uint32_t count;  ///< N
  };

  constexpr JobQueue(const TypeDescriptor* type, Memory memory, DropPolicy policy, JobOrder order = {},
                     std::span<Doorbell* const> bells = {}) noexcept
      : memory_(memory), type_(type), bells_(bells), order_(order), policy_(policy) {}
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  bool pop(void* value, ItemHeader& header) noexcept override;
  std::uint32_t fill() const noexcept override;
  bool is_by_score() const noexcept override { return order_.by_score; }
  /// As they rank: without what does not count of them. N loads.
  std::uint32_t scores(std::span<double> scores) const noexcept override;
  std::uint64_t arrivals() const noexcept override { return arrivals_.load(std::memory_order_acquire); }
  /// By whichever reader.
  std::uint64_t departures() const noexcept override { return departures_.load(std::memory_order_acquire); }
  const TypeDescriptor* type() const noexcept override { return type_; }
  std::uint32_t capacity() const noexcept { return memory_.count; }
  /// So that tests can see the wrap-around. Before the start.
  void start_tickets_at(std::uint64_t ticket) noexcept;

 private:
  friend class JobSink;
  enum State : std::uint64_t { empty = 0, writing = 1, full = 2, reading = 3 };
  static constexpr std::uint32_t no_cell = 0xFFFFFFFF;
  /// A cell as it looked when it was passed.
  struct Candidate {
    std::uint32_t cell = no_cell;
    std::uint64_t word = 0;
    std::uint64_t ticket = 0;
  };

  void* value(std::uint32_t cell) const noexcept {
    return static_cast<std::byte*>(memory_.values) + std::size_t{cell} * memory_.value_stride;
  }
  /// The score of a value as a rank of 62 bits: a higher one is a higher rank.
  std::uint64_t rank_of(const void* value) const noexcept;
  double score_of(std::uint64_t rank) const noexcept;
  bool ranks_above(const Candidate& one, const Candidate& other) const noexcept;
  Candidate look_at(std::uint32_t index) const noexcept;
  bool has_empty_cell() const noexcept;
  /// A cell to write a job of this rank into; no_cell when the job is to be dropped.
  std::uint32_t claim(std::uint64_t rank) noexcept;
  std::uint32_t claim_empty() noexcept;
  Candidate one_to_push_out(std::uint64_t rank) const noexcept;
  void make_visible(std::uint32_t index) noexcept;

  Memory memory_;
  const TypeDescriptor* type_;
  std::span<Doorbell* const> bells_;
  JobOrder order_;
  DropPolicy policy_;

  alignas(64) std::atomic<std::uint64_t> tickets_{0};
  std::atomic<std::uint64_t> arrivals_{0};
  std::atomic<std::uint64_t> departures_{0};
};

/// One writer's way into a JobQueue, with its counters.
class JobSink final : public QueueSink {
 public:
  constexpr explicit JobSink(JobQueue* queue) noexcept : queue_(queue) {}
  JobSink(const JobSink&) = delete;
  JobSink& operator=(const JobSink&) = delete;

  bool push(const void* value, Time sampled_at) noexcept override;
  /// By score: whether there is an empty cell (a higher score than the lowest is accepted all the same).
  bool has_room() const noexcept override;
  void commit() noexcept override;
  /// Before the start.
  void set_deferred(bool on) noexcept override { deferred_ = on; }
  void set_digested(bool on) noexcept override { digested_ = on; }
  std::uint64_t digest() const noexcept override { return digest_; }
  /// dropped: refused (not in pushed) and pushed out by others (in pushed).
  QueueCounters counters() const noexcept override;
  const TypeDescriptor* type() const noexcept override;

 private:
  friend class JobQueue;

  JobQueue* queue_;
  bool deferred_ = false;
  bool digested_ = false;
  std::uint32_t first_waiting_ = 0;  ///< cell plus one; 0: none
  std::uint32_t last_waiting_ = 0;
  std::uint64_t sequence_ = 0;
  std::uint64_t digest_ = 0;
  std::atomic<std::uint64_t> pushed_{0};
  // Readers and other writers count here too.
  alignas(64) std::atomic<std::uint64_t> popped_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

/// The memory of a job queue, for `.bss`: `static JobQueueMemory<T, 16> memory; constinit JobQueue
/// queue{&type, memory.view(), policy, order, bells}; constinit JobSink sink{&queue};`
template <class T, std::size_t Cells>
struct JobQueueMemory {
  static_assert(Cells >= 1);
  struct alignas(64) Value {
    T value;
  };
  JobQueue::Cell cells[Cells];
  Value values[Cells];

  constexpr JobQueue::Memory view() noexcept {
    return {cells, &values[0].value, sizeof(Value), static_cast<std::uint32_t>(Cells)};
  }
};

}  // namespace flexrf
