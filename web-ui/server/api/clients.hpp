// The pages that are connected: what each subscribed to, and what waits to be sent to it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "runtime/blackboard/item.hpp"
#include "runtime/parameters/request.hpp"
#include "web-ui/server/api/caller.hpp"
#include "web-ui/server/live_link.hpp"

namespace flexrf::panel {

/// Text messages in the order they came, in one piece of memory that is kept.
class Outbox {
 public:
  /// Bytes that may wait. A client that reads nothing and keeps asking is not worth more.
  static constexpr std::size_t max_waiting = 256 * 1024;
  /// For which there is room from the beginning: a thread that was kept from its work answers all requests
  /// that wait for it at a time, and the end of a hold refuses all of its refreshes.
  static constexpr std::size_t usual_waiting = AnswerQueue::capacity * std::size_t{512};

  /// Takes the memory for what usually waits.
  void prepare() { bytes_.reserve(usual_waiting); }

  bool is_empty() const noexcept { return taken_ == bytes_.size(); }
  bool is_full() const noexcept { return bytes_.size() - taken_ > max_waiting; }
  void clear() noexcept { bytes_.clear(), taken_ = 0; }

  /// The memory to append one message to; give it back with end_message().
  std::string begin_message();
  void end_message(std::string memory);
  /// Appends the oldest message to `to` and forgets it. Not when empty.
  void take(std::string& to);

 private:
  std::string bytes_;  // each message after its size in 4 bytes
  std::size_t taken_ = 0;
  std::size_t begun_ = 0;
};

/// What a client was shown last of a slot.
struct Seen {
  std::uint64_t sequence = 0;
  NullReason reason = NullReason::none;
  bool any = false;

  friend bool operator==(const Seen&, const Seen&) = default;
};

struct SlotSubscription {
  std::uint16_t slot = 0;
  std::uint16_t width = 0;  ///< of an image
  Duration interval{};
  Time next{};
  Seen seen;
};

enum class Topic : std::uint8_t { components, slots, queues, threads, steps, log };
inline constexpr std::size_t topic_count = 6;

struct TopicSubscription {
  Duration interval{};  ///< zero: not subscribed
  Time next{};
  std::uint64_t seen = 0;  ///< version of the body; of the log, number of the last line
};

struct Client {
  LiveLink* link = nullptr;  ///< null: nobody has this place
  std::uint32_t opening = 0;
  SessionIndex session = no_session;
  bool closing = false;
  bool greeted = false;
  bool told_of_end = false;
  bool told_of_lapse = false;
  bool pumping = false;
  Time last_frame{};
  std::uint64_t frames = 0;
  std::uint32_t left_out = 0;  ///< frames that were due while another was under way
  std::uint64_t state_seen = 0;
  Outbox outbox;
  std::vector<SlotSubscription> slots;
  std::array<TopicSubscription, topic_count> topics{};

  bool is_open() const noexcept { return link != nullptr && !closing; }
};

/// The server's thread.
class Clients {
 public:
  explicit Clients(std::uint32_t places) : clients_(places) {}

  Client& open(LiveLink& link, Time now);
  void close(Client& client) noexcept;
  Client& at(std::uint32_t place) noexcept { return clients_[place]; }
  /// Who asked, while it is still the same connection and open.
  Client* find(const Caller& caller) noexcept;
  std::vector<Client>& all() noexcept { return clients_; }
  const std::vector<Client>& all() const noexcept { return clients_; }

 private:
  std::vector<Client> clients_;
  std::uint32_t openings_ = 0;
};

}  // namespace flexrf::panel
