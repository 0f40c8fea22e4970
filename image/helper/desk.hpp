// Who changes something waits his turn here, in a thread of its own: the socket goes on being served.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "image/helper/answer.hpp"
#include "image/helper/request.hpp"

namespace flexrf::helper {

/// Does one request at a time, in their order, and is quiet for at most a second.
class Desk {
 public:
  struct Task {
    std::uint32_t place = 0;  ///< whose it is, for who asks
    std::string peer;
    Request request;
  };
  struct Done {
    std::uint32_t place = 0;
    Answer answer;
  };

  /// `perform` and `tick` are called by the desk's thread alone; `is_done` by it, when there is an answer to
  /// take.
  Desk(std::function<Answer(const Task&)> perform, std::function<void()> tick, std::function<void()> is_done);
  /// What is being done is done; what waits is not.
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  /// As many as the caller has places.
  void hand_in(Task task);
  std::optional<Done> take();

 private:
  void work();

  std::function<Answer(const Task&)> perform_;
  std::function<void()> tick_;
  std::function<void()> is_done_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  std::deque<Done> done_;
  bool has_to_end_ = false;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace flexrf::helper
