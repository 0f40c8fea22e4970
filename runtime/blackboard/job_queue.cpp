#include "runtime/blackboard/job_queue.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "runtime/core/digest.hpp"
#include "runtime/core/scalar_types.hpp"

namespace flexrf {
namespace {

constexpr int state_bits = 2;
constexpr std::uint64_t state_mask = 3;
constexpr std::uint64_t rank_mask = ~std::uint64_t{0} >> state_bits;

/// Order of arrival, which wraps around modulo 2^62 within the word.
bool is_before(std::uint64_t ticket, std::uint64_t other) noexcept {
  return static_cast<std::int64_t>((ticket - other) << state_bits) < 0;
}

constexpr std::int64_t largest_integer = std::int64_t{1} << 60;

std::uint64_t rank_of_integer(std::int64_t score) noexcept {
  return static_cast<std::uint64_t>(std::clamp(score, -largest_integer, largest_integer) +
                                    2 * largest_integer);
}

double score_of_integer(std::uint64_t rank) noexcept {
  return static_cast<double>(static_cast<std::int64_t>(rank) - 2 * largest_integer);
}

constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;

/// The bits of a double order as the doubles do once negative ones are inverted.
std::uint64_t rank_of_real(double score) noexcept {
  if (std::isnan(score)) return 0;
  const auto bits = std::bit_cast<std::uint64_t>(score + 0.0);  // −0 becomes 0
  return ((bits & sign_bit) != 0 ? ~bits : bits | sign_bit) >> state_bits;
}

double score_of_real(std::uint64_t rank) noexcept {
  if (rank == 0) return std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t bits = rank << state_bits;
  return std::bit_cast<double>((bits & sign_bit) != 0 ? bits ^ sign_bit : ~bits & ~state_mask);
}

/// NaN is the lowest.
bool is_higher(double one, double other) noexcept {
  return std::isnan(other) ? !std::isnan(one) : one > other;
}

}  // namespace

std::uint64_t JobQueue::rank_of(const void* value) const noexcept {
  const std::byte* at = static_cast<const std::byte*>(value) + order_.offset;
  switch (order_.scalar) {
    case Scalar::button:
      return rank_of_integer(load<std::uint32_t>(at));
    case Scalar::boolean:
    case Scalar::enumeration:
    case Scalar::hold:
      return rank_of_integer(load<std::uint8_t>(at));
    default:
      return visit_number(order_.scalar, std::uint64_t{0}, [at](auto tag) {
        using Score = decltype(tag);
        const auto score = load<Score>(at);
        if constexpr (std::is_floating_point_v<Score>) {
          return rank_of_real(score);
        } else {
          return rank_of_integer(std::in_range<std::int64_t>(score) ? static_cast<std::int64_t>(score)
                                                                    : INT64_MAX);
        }
      });
  }
}

double JobQueue::score_of(std::uint64_t rank) const noexcept {
  const bool is_real = order_.scalar == Scalar::f32 || order_.scalar == Scalar::f64;
  return is_real ? score_of_real(rank) : score_of_integer(rank);
}

bool JobQueue::ranks_above(const Candidate& one, const Candidate& other) const noexcept {
  if (!order_.by_score) return is_before(one.word >> state_bits, other.word >> state_bits);
  const std::uint64_t rank = one.word >> state_bits;
  const std::uint64_t other_rank = other.word >> state_bits;
  return rank != other_rank ? rank > other_rank : is_before(one.ticket, other.ticket);
}

bool JobQueue::pop(void* value_out, ItemHeader& header) noexcept {
  for (;;) {
    // Jobs that came after this look at the counter are left for the next pop: else one that was put into a
    // cell behind could overtake one of the same writer that was put into a cell already passed.
    const std::uint64_t horizon = tickets_.load(std::memory_order_acquire);
    Candidate best;
    for (std::uint32_t index = 0; index < memory_.count; ++index) {
      const Candidate candidate = look_at(index);
      if ((candidate.word & state_mask) != full) continue;
      if (!order_.by_score && !is_before(candidate.word >> state_bits, horizon)) continue;
      if (best.cell == no_cell || ranks_above(candidate, best)) best = candidate;
    }
    if (best.cell == no_cell) return false;
    Cell& cell = memory_.cells[best.cell];
    if (!cell.word.compare_exchange_strong(best.word, reading, std::memory_order_acquire,
                                           std::memory_order_relaxed)) {
      continue;
    }
    header = cell.header;
    std::memcpy(value_out, value(best.cell), type_->size);
    cell.owner->popped_.fetch_add(1, std::memory_order_relaxed);
    departures_.fetch_add(1, std::memory_order_release);
    cell.word.store(empty, std::memory_order_release);
    return true;
  }
}

std::uint32_t JobQueue::fill() const noexcept {
  std::uint32_t sum = 0;
  for (std::uint32_t index = 0; index < memory_.count; ++index) {
    if ((memory_.cells[index].word.load(std::memory_order_acquire) & state_mask) == full) ++sum;
  }
  return sum;
}

std::uint32_t JobQueue::scores(std::span<double> scores) const noexcept {
  if (!order_.by_score || scores.empty()) return 0;
  // A heap whose first is the lowest: it makes room for what is higher.
  double* const first = scores.data();
  std::uint32_t count = 0;
  for (std::uint32_t index = 0; index < memory_.count; ++index) {
    const std::uint64_t word = memory_.cells[index].word.load(std::memory_order_acquire);
    if ((word & state_mask) != full) continue;
    const double score = score_of(word >> state_bits);
    if (count == scores.size()) {
      if (!is_higher(score, *first)) continue;
      std::pop_heap(first, first + count, is_higher);
      --count;
    }
    first[count++] = score;
    std::push_heap(first, first + count, is_higher);
  }
  std::sort_heap(first, first + count, is_higher);
  return count;
}

bool JobQueue::has_empty_cell() const noexcept {
  for (std::uint32_t index = 0; index < memory_.count; ++index) {
    if (memory_.cells[index].word.load(std::memory_order_relaxed) == empty) return true;
  }
  return false;
}

JobQueue::Candidate JobQueue::look_at(std::uint32_t index) const noexcept {
  const Cell& cell = memory_.cells[index];
  const std::uint64_t word = cell.word.load(std::memory_order_acquire);
  // May belong to a later job already, which then only decides between equals.
  return {index, word, cell.ticket.load(std::memory_order_relaxed)};
}

std::uint32_t JobQueue::claim_empty() noexcept {
  for (std::uint32_t index = 0; index < memory_.count; ++index) {
    std::uint64_t expected = empty;
    std::atomic<std::uint64_t>& word = memory_.cells[index].word;
    if (word.load(std::memory_order_relaxed) == empty &&
        word.compare_exchange_strong(expected, writing, std::memory_order_acquire,
                                     std::memory_order_relaxed)) {
      return index;
    }
  }
  return no_cell;
}

JobQueue::Candidate JobQueue::one_to_push_out(std::uint64_t rank) const noexcept {
  Candidate victim;
  for (std::uint32_t index = 0; index < memory_.count; ++index) {
    const Candidate candidate = look_at(index);
    if ((candidate.word & state_mask) != full) continue;
    if (order_.by_score && candidate.word >> state_bits >= rank) continue;
    // By arrival the first goes, by score the last.
    if (victim.cell == no_cell || ranks_above(candidate, victim) != order_.by_score) victim = candidate;
  }
  return victim;
}

std::uint32_t JobQueue::claim(std::uint64_t rank) noexcept {
  for (std::uint32_t pass = 0; pass < memory_.count; ++pass) {
    const std::uint32_t free_cell = claim_empty();
    if (free_cell != no_cell) return free_cell;
    if (!order_.by_score && policy_ == DropPolicy::drop_newest) return no_cell;
    Candidate victim = one_to_push_out(rank);
    if (victim.cell == no_cell) return no_cell;
    Cell& cell = memory_.cells[victim.cell];
    if (cell.word.compare_exchange_strong(victim.word, writing, std::memory_order_acquire,
                                          std::memory_order_relaxed)) {
      cell.owner->dropped_.fetch_add(1, std::memory_order_relaxed);
      return victim.cell;
    }
  }
  return no_cell;
}

void JobQueue::make_visible(std::uint32_t index) noexcept {
  Cell& cell = memory_.cells[index];
  // Release: who sees this ticket handed out sees the jobs that its writer made visible before.
  const std::uint64_t ticket = tickets_.fetch_add(1, std::memory_order_acq_rel);
  const std::uint64_t rank = order_.by_score ? rank_of(value(index)) : ticket & rank_mask;
  cell.ticket.store(ticket, std::memory_order_relaxed);
  cell.word.store(rank << state_bits | full, std::memory_order_release);
  arrivals_.fetch_add(1, std::memory_order_release);
  for (Doorbell* bell : bells_) bell->ring();
}

bool JobSink::push(const void* value, Time sampled_at) noexcept {
  sequence_ = next_sequence(sequence_);
  const std::uint32_t index = queue_->claim(queue_->order_.by_score ? queue_->rank_of(value) : 0);
  if (index == JobQueue::no_cell) {
    dropped_.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  JobQueue::Cell& cell = queue_->memory_.cells[index];
  cell.owner = this;
  cell.header = {sequence_, sampled_at};
  std::memcpy(queue_->value(index), value, queue_->type_->size);
  pushed_.store(pushed_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  if (digested_) digest_ = digest_of_item(digest_, *queue_->type_, cell.header, value);
  if (!deferred_) {
    queue_->make_visible(index);
    return true;
  }
  cell.next = 0;
  if (first_waiting_ == 0) {
    first_waiting_ = index + 1;
  } else {
    queue_->memory_.cells[last_waiting_ - 1].next = index + 1;
  }
  last_waiting_ = index + 1;
  return true;
}

void JobSink::commit() noexcept {
  for (std::uint32_t waiting = first_waiting_; waiting != 0;) {
    const std::uint32_t index = waiting - 1;
    waiting = queue_->memory_.cells[index].next;
    queue_->make_visible(index);
  }
  first_waiting_ = 0;
  last_waiting_ = 0;
}

bool JobSink::has_room() const noexcept {
  return queue_->has_empty_cell();
}

QueueCounters JobSink::counters() const noexcept {
  return {pushed_.load(std::memory_order_relaxed), popped_.load(std::memory_order_relaxed),
          dropped_.load(std::memory_order_relaxed)};
}

const TypeDescriptor* JobSink::type() const noexcept {
  return queue_->type_;
}

void JobQueue::start_tickets_at(std::uint64_t ticket) noexcept {
  tickets_.store(ticket, std::memory_order_relaxed);
}

}  // namespace flexrf
