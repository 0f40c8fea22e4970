// RemoteControl: scripts look at the cell, and change what they are permitted to, in JSON-RPC 2.0.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "remote_control_unit.hpp"
#include "runtime/log/log.hpp"
#include "units/remote_control/remote_entrance.hpp"
#include "units/remote_control/remote_view.hpp"
#include "units/remote_control/rpc.hpp"

namespace flexrf::user {

/// Its thread is not real-time: a step allocates, and takes the observer's lock for as long as a value is
/// copied. What waits for whom is bounded, so that no script delays another: lines in a step, requests
/// without an answer, answers that are not read, slots subscribed.
class RemoteControl final : public RemoteControlUnit {
 public:
  static constexpr std::size_t lines_per_step = 16;      ///< of one script
  static constexpr std::size_t most_waiting = 8;         ///< requests of one script without an answer
  static constexpr std::size_t most_subscriptions = 32;  ///< of one script
  static constexpr Duration answer_timeout = std::chrono::seconds{1};
  static constexpr Duration saving_timeout = std::chrono::seconds{10};  ///< of the disk
  static constexpr Duration reading_timeout = std::chrono::seconds{5};  ///< of answers
  static constexpr std::size_t smallest_buffer = 4096;                  ///< bytes, of the door

  Status initialise() override;
  void step(const Tick& tick) override;
  void stop() override;

 private:
  using Problem = std::optional<remote::RpcProblem>;

  struct Subscription {
    std::uint16_t slot = 0;
    Duration interval{};
    Time next{};
    bool any = false;  // was sent
    std::uint64_t sequence = 0;
    NullReason reason = NullReason::none;
  };
  struct Client {
    SocketSession session = 0;
    Time since{};
    bool authenticated = false;
    bool leaving = false;
    std::uint64_t dropped = 0;
    std::vector<Subscription> subscriptions;
    std::deque<std::string> unread;  // answers for which there was no room
    Time stuck_since{};
  };
  struct Waiting {
    SocketSession session;
    std::string id;
    ComponentIndex component;
    bool wants_values;
    std::uint64_t correlation;
    Time overdue_at;
  };
  struct Save {
    SocketSession session;
    std::string id;
    std::uint64_t number;
    Time overdue_at;
  };
  enum class Need : std::uint8_t { nothing, to_look, to_change };
  struct Method {
    const char* name;
    Need need;
    Problem (RemoteControl::*perform)(Client&, const remote::RpcCall&, Fields&);
  };
  static const Method methods[];

  Status look_at_the_door();
  void meet_clients();
  void serve(Client& client);
  void handle(Client& client, std::string_view line);
  Problem perform(Client& client, const remote::RpcCall& call);
  Problem may(const Client& client, Need need) const;
  void take_answers();
  void take_saves();
  void answer(const Waiting& waiting, const ParameterAnswer& given);
  Client* find(SocketSession session) noexcept;
  /// As the audit names it.
  static std::string who(const Client& client);
  void count();

  void say(Client& client, std::string_view id, std::string line);
  /// A notification, which has no id, is not answered. `write(JsonWriter&)` writes the result, one value.
  template <class Write>
  void reply(Client& client, std::string_view id, Write&& write) {
    if (!id.empty()) say(client, id, remote::result_line(id, write));
  }
  void say_error(Client& client, std::string_view id, const remote::RpcProblem& problem);
  void send_unread(Client& client);
  void send_away(Client& client, const char* why);
  void send_updates(Client& client);

  Problem authenticate(Client& client, const remote::RpcCall& call, Fields& params);
  Problem list(Client& client, const remote::RpcCall& call, Fields& params);
  Problem read(Client& client, const remote::RpcCall& call, Fields& params);
  Problem state(Client& client, const remote::RpcCall& call, Fields& params);
  Problem set(Client& client, const remote::RpcCall& call, Fields& params);
  Problem press(Client& client, const remote::RpcCall& call, Fields& params);
  Problem save_values(Client& client, const remote::RpcCall& call, Fields& params);
  Problem change(Client& client, const remote::RpcCall& call, Fields& params, bool is_press);
  Problem subscribe(Client& client, const remote::RpcCall& call, Fields& params);
  Problem unsubscribe(Client& client, const remote::RpcCall& call, Fields& params);
  Problem stop_motion(Client& client, const remote::RpcCall& call, Fields& params);
  Problem read_subscription(JsonElement json, Subscription& subscription) const;
  void tell_subscriptions(Client& client, const remote::RpcCall& call);

  remote::RpcReader reader_;
  remote::Token token_;
  std::optional<remote::RemoteView> view_;
  std::vector<Client> clients_;
  std::vector<Waiting> waiting_;
  std::vector<Save> saves_;
  std::size_t buffer_ = 0;  // bytes that the door keeps for a script
  bool exposed_ = false;    // other machines reach the door
  Time now_{};
  LogLimit sent_away_;
};

}  // namespace flexrf::user
