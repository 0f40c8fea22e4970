// Ports: how units and devices read and write the blackboard. Used by their thread only: inside step(), and
// in what the executive and the unit call of a device in it.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "runtime/blackboard/copy.hpp"
#include "runtime/blackboard/history.hpp"
#include "runtime/blackboard/item.hpp"
#include "runtime/blackboard/queue.hpp"
#include "runtime/blackboard/slot.hpp"

namespace flexrf {

/// One thread's hold on one slot: the buffer is held per thread, so that all that live in it share it.
class SlotReader {
 public:
  constexpr SlotReader() noexcept = default;
  constexpr explicit SlotReader(SlotControl* slot) noexcept : slot_(slot) {}

  /// The slot's latest item as of this step: the first call in a step takes the newest, later calls give the
  /// same. Null when nothing was published yet.
  const ItemHeader* latch(std::uint64_t step) noexcept {
    if (step != step_) {
      step_ = step;
      advance();
    }
    return header_;
  }
  /// As latch(), for a reader that knows no steps: takes the newest at every call.
  const ItemHeader* newest() noexcept {
    advance();
    return header_;
  }
  /// Of the item that the last latch() or newest() gave.
  const void* payload() const noexcept { return payload_; }
  SlotControl* slot() const noexcept { return slot_; }

  /// Keeps the buffer beyond the step (inputs with hold = true, which have a reader of their own). What was
  /// kept before is given back.
  void keep() noexcept {
    if (kept_ == held_) return;
    if (kept_ != SlotControl::none) slot_->give(kept_);
    kept_ = held_;
  }
  const void* kept_payload() const noexcept { return slot_->payload(kept_); }
  const ItemHeader* kept() const noexcept {
    return kept_ == SlotControl::none ? nullptr : &slot_->header(kept_);
  }

 private:
  void advance() noexcept {
    if (slot_->glance() != seen_) [[unlikely]] {
      // A kept buffer is given back by keep(), not by taking the next.
      if (held_ == kept_) held_ = SlotControl::none;
      slot_->take(held_, seen_);
      header_ = &slot_->header(held_);
      payload_ = slot_->payload(held_);
    }
  }

  SlotControl* slot_ = nullptr;
  const ItemHeader* header_ = nullptr;
  const void* payload_ = nullptr;
  std::uint64_t step_ = 0;
  std::uint16_t seen_ = 0;
  std::uint8_t held_ = SlotControl::none;
  std::uint8_t kept_ = SlotControl::none;
};

/// What a read gives: the value with its provenance, or the NULL item with its reason. Valid until the step
/// ends.
template <class T>
class View {
 public:
  View() noexcept = default;
  explicit View(NullReason reason) noexcept : reason_(reason) {}
  View(const T* value, const ItemHeader& header, std::uint64_t missed, Duration age,
       Freshness freshness) noexcept
      : value_(value),
        sequence_(header.sequence),
        missed_(missed),
        sampled_at_(header.sampled_at),
        age_(age),
        reason_(NullReason::none),
        freshness_(freshness) {}

  explicit operator bool() const noexcept { return value_ != nullptr; }
  const T& operator*() const noexcept { return *value_; }
  const T* operator->() const noexcept { return value_; }
  /// Copies the value, faster than `value = *view` where it is large. False, and nothing copied, for NULL.
  bool copy_to(T& value) const noexcept requires(!SizedBySlot<T>) {
    if (value_ != nullptr) copy_item<T>(&value, value_);
    return value_ != nullptr;
  }

  NullReason reason() const noexcept { return reason_; }
  Freshness freshness() const noexcept { return freshness_; }
  bool is_new() const noexcept { return freshness_ == Freshness::new_item; }
  std::uint64_t sequence() const noexcept { return sequence_; }
  /// Items published since the one this input saw before, and never seen by it.
  std::uint64_t missed() const noexcept { return missed_; }
  Time sampled_at() const noexcept { return sampled_at_; }
  /// Against the step's time.
  Duration age() const noexcept { return age_; }

 private:
  const T* value_ = nullptr;
  std::uint64_t sequence_ = 0;
  std::uint64_t missed_ = 0;
  Time sampled_at_{};
  Duration age_{};
  NullReason reason_ = NullReason::nothing_yet;
  Freshness freshness_ = Freshness::null;
};

/// How the generated application connects an input. max_age zero: no limit.
struct InputBinding {
  SlotReader* readers = nullptr;  ///< one, or one per member of a population
  std::uint32_t count = 0;        ///< 0: not connected, always NULL
  Duration max_age{};
  void* members = nullptr;  ///< range inputs: `count` Input<T>, one cursor per member
};

/// What one input saw of one slot. For reports; may lag by what is being read.
struct InputCounters {
  std::uint64_t read = 0;    ///< items
  std::uint64_t missed = 0;  ///< items published between two that it read
};

/// Untyped half of an input: the cursor of one unit or device in one slot.
class InputCursor {
 public:
  /// `type`: what is read; a slot of another is as good as none. Begins anew, counters too: the next item is
  /// new.
  void connect(const StepContext* context, SlotReader* reader, const TypeDescriptor& type,
               Duration max_age) noexcept {
    const bool fits = reader != nullptr && reader->slot()->type()->hash == type.hash;
    context_ = context;
    reader_ = fits ? reader : nullptr;
    max_age_ = max_age;
    header_ = nullptr;
    step_ = 0;
    cursor_ = 0;
    read_.store(0, std::memory_order_relaxed);
    missed_total_.store(0, std::memory_order_relaxed);
    reason_ = fits                ? NullReason::nothing_yet
              : reader == nullptr ? NullReason::not_registered
                                  : NullReason::wrong_type;
  }
  bool is_connected() const noexcept { return reader_ != nullptr; }
  /// Counters for reports; relaxed, any thread.
  std::uint64_t read() const noexcept { return read_.load(std::memory_order_relaxed); }
  std::uint64_t missed() const noexcept { return missed_total_.load(std::memory_order_relaxed); }
  InputCounters counters() const noexcept { return {read(), missed()}; }
  InputCounters counters(std::size_t /*member*/) const noexcept { return counters(); }
  /// Forgets what was seen: the next item is new (a member of a population begins again).
  void forget() noexcept { cursor_ = 0; }

 protected:
  /// Latches; the header, or null with reason_ set.
  const ItemHeader* latch() noexcept {
    if (context_->step != step_ && reader_ != nullptr) {
      step_ = context_->step;
      header_ = reader_->latch(step_);
      judge();
    }
    return header_;
  }
  Duration age(const ItemHeader& header) const noexcept { return context_->now - header.sampled_at; }

  const StepContext* context_ = &no_step;
  SlotReader* reader_ = nullptr;
  std::uint64_t missed_ = 0;
  NullReason reason_ = NullReason::not_registered;
  Freshness freshness_ = Freshness::null;

 private:
  static constexpr StepContext no_step{};

  void judge() noexcept {
    missed_ = 0;
    reason_ = null_reason_of(reader_->slot()->writer_state());
    if (reason_ == NullReason::none) {
      if (header_ == nullptr) {
        reason_ = NullReason::nothing_yet;
      } else if (max_age_.count() > 0 && age(*header_) > max_age_) {
        reason_ = NullReason::too_old;
      } else if (max_age_.count() > 0 && age(*header_) < -max_age_) {
        // It would never become too old.
        reason_ = NullReason::ahead_of_time;
      } else if (header_->sequence == cursor_) {
        freshness_ = Freshness::old_item;
        return;
      } else {
        see(header_->sequence);
        return;
      }
    }
    header_ = nullptr;
  }
  void see(std::uint64_t sequence) noexcept {
    freshness_ = Freshness::new_item;
    // The first item an input sees misses nothing.
    if (cursor_ != 0) missed_ = sequences_between(cursor_, sequence);
    cursor_ = sequence;
    read_.store(read() + 1, std::memory_order_relaxed);
    if (missed_ > 0) missed_total_.store(missed() + missed_, std::memory_order_relaxed);
  }

  Duration max_age_{};
  const ItemHeader* header_ = nullptr;  ///< of this step
  std::uint64_t step_ = 0;
  std::uint64_t cursor_ = 0;
  std::atomic<std::uint64_t> read_{0};
  std::atomic<std::uint64_t> missed_total_{0};
};

/// Latest item of a slot.
template <class T>
class Input : public InputCursor {
 public:
  void connect(const StepContext* context, const InputBinding& binding) noexcept {
    InputCursor::connect(context, binding.count == 0 ? nullptr : binding.readers, *descriptor_of<T>,
                         binding.max_age);
  }

  /// The newest item at the first call in a step; the same item at later calls in that step.
  View<T> latest() noexcept {
    const ItemHeader* header = latch();
    if (header == nullptr) return View<T>{reason_};
    return View<T>{static_cast<const T*>(reader_->payload()), *header, missed_, age(*header), freshness_};
  }

  /// hold = true: keeps the view that latest() gave beyond the step, until the next keep().
  void keep() noexcept {
    if (reader_ != nullptr) reader_->keep();
  }
  View<T> kept() const noexcept {
    const ItemHeader* header = reader_ == nullptr ? nullptr : reader_->kept();
    if (header == nullptr) return View<T>{reader_ == nullptr ? reason_ : NullReason::nothing_yet};
    return View<T>{static_cast<const T*>(reader_->kept_payload()), *header, 0, age(*header),
                   Freshness::old_item};
  }

  /// history = true: what the slot held at `time`, by value; the reason when it is no longer (or not yet)
  /// known.
  NullReason at(Time time, T& value, Time* sampled_at = nullptr) const noexcept requires(!SizedBySlot<T>) {
    if (reader_ == nullptr) return reason_;
    if (reader_->slot()->history() == nullptr) return NullReason::not_registered;
    ItemHeader header{};
    const NullReason reason = reader_->slot()->history()->at(time, header, &value);
    if (sampled_at != nullptr) *sampled_at = header.sampled_at;
    return reason;
  }
  /// history = true: the items sampled in [from, to], oldest first; returns how many fit.
  std::size_t between(Time from, Time to, std::span<ItemHeader> headers, T* values) const noexcept
      requires(!SizedBySlot<T>) {
    if (reader_ == nullptr || reader_->slot()->history() == nullptr) return 0;
    return reader_->slot()->history()->between(from, to, headers, values);
  }
};

/// Latest items of all members of a population (range = true). A unit type is compiled without knowing how
/// large the populations are that it will read, so the cursors lie in the application.
template <class T>
class InputRange {
 public:
  void connect(const StepContext* context, const InputBinding& binding) noexcept {
    const std::span<Input<T>> members{static_cast<Input<T>*>(binding.members), binding.count};
    // Reports may be counting meanwhile: of what is connected again it stays the same.
    if (members.data() != members_.data()) members_ = members;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      members_[i].connect(context, InputBinding{binding.readers + i, 1, binding.max_age, nullptr});
    }
  }
  std::size_t size() const noexcept { return members_.size(); }
  InputCounters counters(std::size_t member) const noexcept { return members_[member].counters(); }
  Input<T>& operator[](std::size_t index) noexcept { return members_[index]; }
  auto begin() noexcept { return members_.begin(); }
  auto end() noexcept { return members_.end(); }

 private:
  std::span<Input<T>> members_;
};

/// A buffer to fill in place. Discarded unless published.
template <class T>
class Loan {
 public:
  Loan() noexcept = default;
  Loan(SlotControl* slot, const StepContext* context, std::uint8_t buffer) noexcept
      : slot_(slot), context_(context), buffer_(buffer) {}
  Loan(Loan&& other) noexcept : slot_(other.slot_), context_(other.context_), buffer_(other.release()) {}
  Loan& operator=(Loan&& other) noexcept {
    if (this != &other) {
      discard();
      slot_ = other.slot_;
      context_ = other.context_;
      buffer_ = other.release();
    }
    return *this;
  }
  ~Loan() { discard(); }

  /// False when all loans of the slot are out.
  explicit operator bool() const noexcept { return buffer_ != SlotControl::none; }
  T& operator*() const noexcept { return *static_cast<T*>(static_cast<void*>(slot_->payload(buffer_))); }
  T* operator->() const noexcept { return &**this; }

  void publish() noexcept { publish(context_->now); }
  void publish(Time sampled_at) noexcept { slot_->publish(release(), sampled_at); }
  void discard() noexcept {
    if (buffer_ != SlotControl::none) slot_->abandon(release());
  }

 private:
  std::uint8_t release() noexcept {
    const std::uint8_t buffer = buffer_;
    buffer_ = SlotControl::none;
    return buffer;
  }
  SlotControl* slot_ = nullptr;
  const StepContext* context_ = nullptr;
  std::uint8_t buffer_ = SlotControl::none;
};

/// What is published. An unconnected output accepts and forgets.
template <class T>
class Output {
  static_assert(std::is_trivially_copyable_v<T>, "items are plain structs");

 public:
  void connect(const StepContext* context, SlotControl* slot) noexcept {
    context_ = context;
    slot_ = slot;
  }
  bool is_connected() const noexcept { return slot_ != nullptr; }

  /// How many elements its items have room for, of a type that is as large as its slot says.
  std::size_t elements() const noexcept requires SizedBySlot<T> {
    return slot_ == nullptr ? 0 : slot_->type()->fields.back().count;
  }

  /// False when nothing was published because all loans are out.
  bool publish(const T& value) noexcept requires(!SizedBySlot<T>) {
    return slot_ == nullptr || publish(value, context_->now);
  }
  bool publish(const T& value, Time sampled_at) noexcept requires(!SizedBySlot<T>) {
    if (slot_ == nullptr) return true;
    const std::uint8_t buffer = slot_->loan();
    if (buffer == SlotControl::none) return false;
    copy_item<T>(slot_->payload(buffer), &value);
    slot_->publish(buffer, sampled_at);
    return true;
  }
  Loan<T> loan() noexcept { return slot_ == nullptr ? Loan<T>{} : Loan<T>{slot_, context_, slot_->loan()}; }
  Loan<T> loan_last() noexcept {
    return slot_ == nullptr ? Loan<T>{} : Loan<T>{slot_, context_, slot_->loan_last()};
  }

 private:
  const StepContext* context_ = nullptr;
  SlotControl* slot_ = nullptr;
};

/// Items of a queue, each given to one reader.
template <class T>
class QueueInput {
 public:
  void connect(QueueSource* source) noexcept { source_ = source; }
  std::optional<T> pop() noexcept {
    ItemHeader header{};
    T value{};
    if (source_ == nullptr || !source_->pop(&value, header)) return std::nullopt;
    return value;
  }
  bool pop(T& value, ItemHeader& header) noexcept {
    return source_ != nullptr && source_->pop(&value, header);
  }
  bool is_empty() const noexcept { return source_ == nullptr || source_->is_empty(); }

 private:
  QueueSource* source_ = nullptr;
};

/// A way into one or (fan-out) several queues.
template <class T>
class QueueOutput {
 public:
  void connect(const StepContext* context, std::span<QueueSink* const> sinks) noexcept {
    context_ = context;
    sinks_ = sinks;
  }
  /// False when at least one queue dropped it.
  bool push(const T& value) noexcept { return sinks_.empty() || push(value, context_->now); }
  bool push(const T& value, Time sampled_at) noexcept {
    bool accepted = true;
    for (QueueSink* sink : sinks_) accepted = sink->push(&value, sampled_at) && accepted;
    return accepted;
  }
  bool has_room() const noexcept {
    for (const QueueSink* sink : sinks_) {
      if (!sink->has_room()) return false;
    }
    return true;
  }
  bool is_connected() const noexcept { return !sinks_.empty(); }

 private:
  const StepContext* context_ = nullptr;
  std::span<QueueSink* const> sinks_;
};

}  // namespace flexrf
