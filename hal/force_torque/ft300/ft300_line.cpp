#include "hal/force_torque/ft300/ft300_line.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/text.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;

/// How often a line that is not there is looked for.
constexpr Duration looking_interval = milliseconds(200);
/// A sensor may send already, as it was left; it is asked when it does not.
constexpr Duration listening_time = milliseconds(100);
/// A frame comes every 10 ms.
constexpr Duration longest_silence = milliseconds(300);
constexpr int quiet_time = 40;  // ms
constexpr int most_endings = 5;

}  // namespace

Status Ft300Line::start(const char* name, const std::string& device, std::uint8_t unit_id) {
  stop();
  device_ = device;
  unit_id_ = unit_id;
  report_ = {};
  damaged_before_ = 0;
  decoder_ = {};
  static_cast<void>(take_news());  // of the run before
  news_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (news_ < 0)
    return Status::error(StatusCode::internal, "the line cannot be waited for: %s", std::strerror(errno));
  reports_.connect(&context_, &slot_.control());
  open_line();
  const auto code = static_cast<StatusCode>(report_.code);
  if (!port_.is_open() && code != StatusCode::unavailable && code != StatusCode::busy) {
    const Status why = Status::error(code, "%s", report_.trouble.data());
    stop();
    return why;
  }
  const Status status = thread_.begin<Ft300Line, &Ft300Line::run>(name, *this);
  if (!status) stop();
  return status;
}

void Ft300Line::stop() {
  thread_.end();
  port_.close();
  if (news_ >= 0) close(news_);
  news_ = -1;
}

const Ft300Report* Ft300Line::take_news() noexcept {
  if (rung_.exchange(false, std::memory_order_relaxed)) {
    eventfd_t count = 0;
    eventfd_read(news_, &count);  // empty when another cycle was quicker
  }
  const ItemHeader* const header = reader_.newest();
  if (header == nullptr || header->sequence == seen_) return nullptr;
  seen_ = header->sequence;
  return static_cast<const Ft300Report*>(reader_.payload());
}

void Ft300Line::run() {
  while (true) {
    if (!port_.is_open() && !open_line()) {
      if (!thread_.wait(looking_interval)) return;
      continue;
    }
    if (!listen(listening_time)) return end_stream();
    ask(MonotonicClock::now());
  }
}

bool Ft300Line::open_line() {
  const Status status = port_.open(device_.c_str());
  if (!status) {
    tell(status);
    return false;
  }
  damaged_before_ += decoder_.damaged();
  decoder_ = {};
  asked_in_vain_ = false;
  // It is given the time to be heard, then asked.
  quiet_since_ = MonotonicClock::now() + listening_time - longest_silence;
  return true;
}

/// While nothing comes. What it sends may be garbled because it was not begun well, so it is ended first.
void Ft300Line::ask(Time now) {
  if (!port_.is_open() || now - quiet_since_ < longest_silence) return;
  if (asked_in_vain_) {
    tell(Status::error(StatusCode::unavailable,
                       "the sensor does not send over %s; is it on, its line A and B not exchanged, and its "
                       "address %d?",
                       device_.c_str(), int{unit_id_}));
    end_stream();
    if (!port_.is_open()) return;
  }
  port_.write(ft300::stream_request(unit_id_));
  asked_in_vain_ = true;
  quiet_since_ = MonotonicClock::now();
}

/// False: the thread is to end.
bool Ft300Line::listen(Duration longest) {
  pollfd line{port_.descriptor(), POLLIN, 0};
  const bool goes_on = thread_.wait(longest, {&line, 1});
  if (line.revents == 0 || read_line()) return goes_on;
  port_.close();
  tell(Status::error(StatusCode::unavailable, "the serial line %s was lost; is the adapter plugged in?",
                     device_.c_str()));
  return goes_on;
}

/// False: the line is lost.
bool Ft300Line::read_line() {
  std::array<std::uint8_t, 256> bytes{};
  const int size = port_.read(bytes);
  if (size < 0) return false;
  const Time now = MonotonicClock::now();
  bool has_news = false;
  for (const std::uint8_t byte : std::span(bytes).first(static_cast<std::size_t>(size))) {
    decoder_.put(byte);
    const auto frame = decoder_.take();
    if (!frame) continue;
    const RawWrench raw = ft300::measured(*frame);
    report_.force = raw.force;
    report_.torque = raw.torque;
    report_.time = nanoseconds(now);
    ++report_.frames;
    quiet_since_ = now;
    asked_in_vain_ = false;
    has_news = true;
  }
  const std::uint64_t damaged = damaged_before_ + decoder_.damaged();
  if (!has_news && damaged == report_.damaged) return true;
  report_.damaged = damaged;
  if (has_news) {
    report_.code = 0;
    report_.trouble = {};
  }
  publish();
  return true;
}

/// Until it is quiet: one that sends on is told again.
void Ft300Line::end_stream() {
  std::array<std::uint8_t, ft300::stop_count> ones{};
  ones.fill(ft300::stop_byte);
  std::array<std::uint8_t, 256> dropped{};
  for (int told = 0; told < most_endings && port_.is_open(); ++told) {
    port_.write(ones);
    const Time since = MonotonicClock::now();
    bool quiet = false;
    while (!quiet && MonotonicClock::now() - since < listening_time) {
      pollfd line{port_.descriptor(), POLLIN, 0};
      quiet = poll(&line, 1, quiet_time) == 0;
      if (!quiet && port_.read(dropped) < 0) return port_.close();
    }
    if (quiet) return;
  }
}

void Ft300Line::tell(const Status& trouble) {
  report_.code = static_cast<std::uint8_t>(trouble.code());
  set_text(report_.trouble, trouble.cause());
  publish();
}

void Ft300Line::publish() {
  reports_.publish(report_, Time{});
  eventfd_write(news_, 1);
  rung_.store(true, std::memory_order_relaxed);
}

}  // namespace flexrf
