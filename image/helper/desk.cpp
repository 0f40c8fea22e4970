#include "image/helper/desk.hpp"

#include <chrono>
#include <utility>

namespace flexrf::helper {

Desk::Desk(std::function<Answer(const Task&)> perform, std::function<void()> tick,
           std::function<void()> is_done)
    : perform_(std::move(perform)),
      tick_(std::move(tick)),
      is_done_(std::move(is_done)),
      thread_([this] { work(); }) {}

Desk::~Desk() {
  {
    const std::lock_guard lock(mutex_);
    has_to_end_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Desk::hand_in(Task task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  changed_.notify_one();
}

std::optional<Desk::Done> Desk::take() {
  const std::lock_guard lock(mutex_);
  if (done_.empty()) return std::nullopt;
  Done done = std::move(done_.front());
  done_.pop_front();
  return done;
}

void Desk::work() {
  constexpr std::chrono::seconds interval{1};
  auto next_tick = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!has_to_end_) {
    if (std::chrono::steady_clock::now() >= next_tick) {
      lock.unlock();
      tick_();
      next_tick = std::chrono::steady_clock::now() + interval;
      lock.lock();
      continue;
    }
    if (tasks_.empty()) {
      changed_.wait_until(lock, next_tick);
      continue;
    }
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    Done done{task.place, perform_(task)};
    lock.lock();
    done_.push_back(std::move(done));
    lock.unlock();
    is_done_();
    lock.lock();
  }
}

}  // namespace flexrf::helper
