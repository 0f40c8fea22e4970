// Work that takes time and has a result, in a thread of its own: the socket goes on being served.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace flexrf::helper {

/// Computes a result for the latest question. Nobody waits for it.
template <class Question, class Value>
class Background {
 public:
  struct Found {
    std::uint64_t number = 0;  ///< of the question, as ask() returned it
    Value value;
  };

  /// `compute` is called by the thread of this object alone.
  explicit Background(std::function<Value(const Question&)> compute)
      : compute_(std::move(compute)), thread_([this] { work(); }) {}
  /// Waits for a computation that is under way.
  ~Background() {
    {
      const std::lock_guard lock(mutex_);
      has_to_end_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Replaces a question that has not been begun. @returns its number, from 1 on. Any thread.
  std::uint64_t ask(Question question) {
    const std::lock_guard lock(mutex_);
    question_ = std::move(question);
    changed_.notify_one();
    return ++number_;
  }
  /// The latest result; empty before the first one. Any thread.
  std::optional<Found> found() const {
    const std::lock_guard lock(mutex_);
    return found_;
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return has_to_end_ || question_; });
      if (has_to_end_) return;
      const Question question = std::move(*question_);
      question_.reset();
      const std::uint64_t number = number_;
      lock.unlock();
      Value value = compute_(question);
      lock.lock();
      found_ = Found{number, std::move(value)};
    }
  }

  std::function<Value(const Question&)> compute_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Question> question_;
  std::uint64_t number_ = 0;
  std::optional<Found> found_;
  bool has_to_end_ = false;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace flexrf::helper
