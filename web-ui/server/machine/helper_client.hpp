// Asks flexrf-helper, which does on an industrial PC what takes root's rights, over its socket.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "base/status.hpp"
#include "base/time.hpp"
#include "web-ui/server/api/mailbox.hpp"

namespace flexrf::panel {

/// One connection, one request at a time, in a thread of its own: the helper may take its time, and the
/// server's thread has none. A message is a packet (SOCK_SEQPACKET), and each request has one answer.
class HelperClient {
 public:
  static constexpr std::size_t places = 8;                ///< requests that are not answered yet
  static constexpr std::size_t longest_line = 1024;       ///< of a request
  static constexpr std::size_t longest_part = 60U << 10;  ///< bytes behind it
  static constexpr std::size_t longest_answer = 16U << 10;

  struct Answer {
    std::uint64_t number = 0;
    std::string text;  ///< as the helper gave it: a JSON object, if all is well
    Status status;     ///< why there is none
  };

  /// `socket`: where the helper listens. `bell`: rung when there is an answer; null: it is looked for often
  /// enough.
  HelperClient(std::string socket, Doorbell* bell) : socket_(std::move(socket)), answers_(bell) {}
  ~HelperClient() { stop(); }
  HelperClient(const HelperClient&) = delete;
  HelperClient& operator=(const HelperClient&) = delete;

  // ---- the main thread

  Status start();
  /// Ends the thread at once; what was not answered never is.
  void stop() noexcept;

  // ---- the server's thread

  /// The request's number, from 1; 0: as many wait already. There will be one answer, `patience` from now at
  /// the latest. `repeatable`: it only asks, and may be carried out twice when the helper ends meanwhile.
  std::uint64_t ask(std::string message, Duration patience, bool repeatable);
  std::optional<Answer> pop();

 private:
  struct Request {
    std::uint64_t number = 0;
    std::string message;
    Time deadline{};
    bool repeatable = false;
  };

  void run();
  Result<std::string> carry_out(const Request& request);
  Status connect(Time deadline);
  Status send(const std::string& message, Time deadline);
  Result<std::string> receive(Time deadline);
  bool has_something_to_say() const noexcept;
  /// Until the connection is ready for `events`; timeout: not in time. closed: stop() was called.
  Status wait_for(short events, Time deadline) const;
  Status late() const;
  void disconnect() noexcept;

  std::string socket_;
  Mailbox<Answer> answers_;
  std::uint64_t last_number_ = 0;
  std::size_t unanswered_ = 0;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Request> requests_;
  bool ends_ = false;
  std::thread thread_;
  int interruption_ = -1;  // an eventfd: stop() was called

  // The thread's own.
  int connection_ = -1;
};

}  // namespace flexrf::panel
