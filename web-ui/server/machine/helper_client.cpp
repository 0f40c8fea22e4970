#include "web-ui/server/machine/helper_client.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "runtime/realtime/signals.hpp"

namespace flexrf::panel {
namespace {

constexpr Duration between_attempts = std::chrono::milliseconds{50};
constexpr const char* advice = "it starts anew by itself; if it does not, restart the PC";

/// Who asked waits no longer; passwords do not stay in memory.
void forget(std::string& message) noexcept {
  explicit_bzero(message.data(), message.size());
  message.clear();
}

}  // namespace

Status HelperClient::start() {
  if (socket_.size() >= sizeof(sockaddr_un::sun_path)) {
    return Status::error(StatusCode::invalid_argument,
                         "--helper %s: the path of a socket has at most %zu bytes", socket_.c_str(),
                         sizeof(sockaddr_un::sun_path) - 1);
  }
  interruption_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (interruption_ < 0)
    return Status::error(StatusCode::unavailable, "the panel's thread for the PC: %s", std::strerror(errno));
  try {
    // The signals that end the application are for others to take.
    const signals::Blocked blocked;
    thread_ = std::thread([this] {
      pthread_setname_np(pthread_self(), "panel-machine");
      run();
    });
  } catch (const std::system_error& error) {
    return Status::error(StatusCode::unavailable, "the panel's thread for the PC: %s", error.what());
  }
  return {};
}

void HelperClient::stop() noexcept {
  if (thread_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_one();
    eventfd_write(interruption_, 1);
    thread_.join();
  }
  if (interruption_ >= 0) close(std::exchange(interruption_, -1));
}

std::uint64_t HelperClient::ask(std::string message, Duration patience, bool repeatable) {
  if (unanswered_ == places) {
    forget(message);
    return 0;
  }
  ++unanswered_;
  const std::uint64_t number = ++last_number_;
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back({number, std::move(message), MonotonicClock::now() + patience, repeatable});
  }
  wake_.notify_one();
  return number;
}

std::optional<HelperClient::Answer> HelperClient::pop() {
  std::optional<Answer> answer = answers_.pop();
  if (answer) --unanswered_;
  return answer;
}

void HelperClient::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return ends_ || !requests_.empty(); });
    if (ends_) break;
    Request request = std::move(requests_.front());
    requests_.pop_front();
    lock.unlock();
    Result<std::string> text = carry_out(request);
    forget(request.message);
    Answer answer;
    answer.number = request.number;
    if (text) {
      answer.text = std::move(*text);
    } else {
      answer.status = text.status();
      // What it says later is no answer to the next.
      disconnect();
    }
    answers_.push(std::move(answer));
    lock.lock();
  }
  for (Request& request : requests_) forget(request.message);
  disconnect();
}

Result<std::string> HelperClient::carry_out(const Request& request) {
  // What is there before anybody asked is the end of the connection, or no answer to what comes now.
  if (connection_ >= 0 && has_something_to_say()) disconnect();
  for (bool again = true;; again = false) {
    const bool is_new = connection_ < 0;
    if (is_new) {
      if (const Status status = connect(request.deadline); !status) return status;
    }
    if (const Status status = send(request.message, request.deadline); !status) {
      // The helper was started anew since the last request: nobody has got this one.
      if (status.code() != StatusCode::unavailable || is_new) return status;
      disconnect();
      continue;
    }
    Result<std::string> answer = receive(request.deadline);
    if (answer || answer.status().code() != StatusCode::unavailable || !request.repeatable || !again)
      return answer;
    disconnect();
  }
}

Status HelperClient::connect(Time deadline) {
  connection_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (connection_ < 0)
    return Status::error(StatusCode::unavailable, "the panel got no socket: %s", std::strerror(errno));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, socket_.c_str(), socket_.size() + 1);
  while (::connect(connection_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    const int error = errno;
    if (error != EAGAIN && error != EINTR) {
      return Status::error(StatusCode::unavailable, "the PC's helper is not there (%s: %s); %s",
                           socket_.c_str(), std::strerror(error), advice);
    }
    // It does not take connections as fast as they come; no descriptor tells when it does.
    if (MonotonicClock::now() >= deadline) return late();
    pollfd end{interruption_, POLLIN, 0};
    poll(&end, 1, static_cast<int>(between_attempts / std::chrono::milliseconds{1}));
    if (end.revents != 0) return Status::error(StatusCode::closed, "the application ends");
  }
  return {};
}

Status HelperClient::send(const std::string& message, Time deadline) {
  for (;;) {
    if (const Status status = wait_for(POLLOUT, deadline); !status) return status;
    if (::send(connection_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0) return {};
    if (errno == EAGAIN || errno == EINTR) continue;
    return Status::error(StatusCode::unavailable, "the PC's helper takes no request (%s); %s",
                         std::strerror(errno), advice);
  }
}

Result<std::string> HelperClient::receive(Time deadline) {
  std::string text(longest_answer, '\0');
  for (;;) {
    if (const Status status = wait_for(POLLIN, deadline); !status) return status;
    const ssize_t size = recv(connection_, text.data(), text.size(), MSG_TRUNC | MSG_DONTWAIT);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (size <= 0) {
      return Status::error(
          StatusCode::unavailable,
          "the PC's helper ended before it answered; look whether it did what was asked for, "
          "then try again");
    }
    if (static_cast<std::size_t>(size) > text.size()) {
      return Status::error(StatusCode::out_of_range,
                           "the PC's helper gave an answer of %zd bytes; update the PC", size);
    }
    text.resize(static_cast<std::size_t>(size));
    return text;
  }
}

bool HelperClient::has_something_to_say() const noexcept {
  pollfd one{connection_, POLLIN, 0};
  return poll(&one, 1, 0) > 0;
}

Status HelperClient::wait_for(short events, Time deadline) const {
  for (;;) {
    const Duration left = deadline - MonotonicClock::now();
    if (left <= Duration{}) return late();
    pollfd both[] = {{connection_, events, 0}, {interruption_, POLLIN, 0}};
    const int count = poll(both, 2, static_cast<int>(left / std::chrono::milliseconds{1}) + 1);
    if (both[1].revents != 0) return Status::error(StatusCode::closed, "the application ends");
    // An end or an error is told by the call that follows.
    if (count > 0 && both[0].revents != 0) return {};
  }
}

Status HelperClient::late() const {
  return Status::error(
      StatusCode::timeout,
      "the PC's helper does not answer in time; look whether it did what was asked for, then try "
      "again, or restart the PC");
}

void HelperClient::disconnect() noexcept {
  if (connection_ >= 0) close(std::exchange(connection_, -1));
}

}  // namespace flexrf::panel
