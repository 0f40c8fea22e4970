// What another thread hands to the server's.
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "runtime/blackboard/doorbell.hpp"

namespace flexrf::panel {

/// Bounded by what was asked for and is not answered yet, which whoever asks counts. push: any thread that is
/// not real-time. pop: the server's.
template <class Value>
class Mailbox {
 public:
  /// `bell`: of the server's thread, rung for each value; null: it looks by itself. Outlives the mailbox.
  explicit Mailbox(Doorbell* bell) noexcept : bell_(bell) {}

  void push(Value value) {
    {
      const std::lock_guard lock(mutex_);
      values_.push_back(std::move(value));
    }
    if (bell_ != nullptr) bell_->ring();
  }
  std::optional<Value> pop() {
    const std::lock_guard lock(mutex_);
    if (values_.empty()) return std::nullopt;
    std::optional<Value> value(std::move(values_.front()));
    values_.pop_front();
    return value;
  }

 private:
  Doorbell* bell_;
  std::mutex mutex_;
  std::deque<Value> values_;
};

}  // namespace flexrf::panel
