// What clients ask of runtime parameters: set, reset, press, hold, and of members of populations.
#pragma once

#include <optional>
#include <string_view>

#include "runtime/executive/cell.hpp"
#include "runtime/face/component_values.hpp"
#include "runtime/json/json_reader.hpp"
#include "web-ui/server/access.hpp"
#include "web-ui/server/api/answers.hpp"
#include "web-ui/server/api/places.hpp"

namespace flexrf::panel {

/// A hold that lives, and whose it is. Its number never comes again.
struct Lease {
  std::uint64_t number = 0;  ///< from new_lease_number()
  Caller owner;
  ComponentIndex component = 0;
  std::uint16_t parameter = 0;
  std::uint32_t offset = 0;    ///< bytes within the parameter
  std::uint64_t sequence = 0;  ///< of the last request
};

/// A request that a component's thread has not answered yet.
struct PendingRequest {
  enum class Purpose : std::uint8_t {
    values,   ///< answered with the values in force
    plain,    ///< answered with that it is done
    hold,     ///< begins a lease
    refresh,  ///< answered only when the lease is over
  };

  Caller caller;
  ComponentIndex component = 0;
  Purpose purpose = Purpose::plain;
  std::uint64_t lease = 0;  ///< 0: none
  Time overdue_at{};
  std::uint64_t correlation = 0;
};

/// Each operation checks role and control token, and answers its caller, most of them when the component's
/// thread has. The server's thread; nothing waits or allocates.
class ParameterOperations {
 public:
  /// `answer_timeout`: how long a component's thread may take.
  ParameterOperations(Cell& cell, const Directory& directory, ObservedSlots& slots, ComponentValues& values,
                      Answers& answers, Permission& permission, std::string_view boot,
                      Duration answer_timeout) noexcept
      : cell_(&cell),
        directory_(&directory),
        slots_(&slots),
        values_(&values),
        answers_(&answers),
        permission_(&permission),
        boot_(boot),
        answer_timeout_(answer_timeout) {}

  /// Registers where answers come, and what is rung for them (null: nothing). Before the start.
  Status prepare(Doorbell* bell);

  void set(const Caller& caller, ComponentIndex component, JsonObject values,
           std::optional<std::uint64_t> expected, Time now);
  /// Empty: all.
  void reset(const Caller& caller, ComponentIndex component, std::optional<JsonArray> parameters, Time now);
  void press(const Caller& caller, ComponentIndex component, std::string_view parameter, std::uint64_t count,
             Time now);
  void hold(const Caller& caller, ComponentIndex component, std::string_view parameter, Time now);
  void refresh(const Caller& caller, std::string_view lease, Time now);
  void release(const Caller& caller, std::string_view lease, Time now);
  /// activate, clone (of `source`), retire.
  void change_member(const Caller& caller, ComponentIndex component, RequestKind kind, ComponentIndex source,
                     Time now);

  void end_holds_of_client(std::uint32_t place, Time now);
  void end_holds_of_session(SessionIndex session, Time now);
  /// The runtime has ended them: their owners hear of it with the next refresh.
  void forget_holds();

  /// Fetches answers, gives up on those that do not come.
  void tick(Time now);

 private:
  /// False: who asks may not, or it makes no sense, as `refusal` says; that was answered.
  bool is_granted(const Caller& caller, const std::optional<Refusal>& refusal, Role role,
                  std::string_view act);
  /// Completes a request that is to be sent, and notes who waits for its answer. False: too many wait; that
  /// was answered.
  bool expect_answer(ParameterRequest& request, PendingRequest pending, Time now);
  void send_release(const Lease& lease, Time now);
  Lease* lease_of(const Caller& caller, std::string_view text);
  Lease* find_lease(std::uint64_t number);
  void forget_lease(std::uint64_t number);
  void accept(const PendingRequest& pending, const ParameterAnswer& answer);
  void refuse(const PendingRequest& pending, const ParameterAnswer& answer);

  Cell* cell_;
  const Directory* directory_;
  ObservedSlots* slots_;
  ComponentValues* values_;
  Answers* answers_;
  Permission* permission_;
  std::string_view boot_;
  Duration answer_timeout_;
  AnswerQueue queue_;
  std::uint16_t requester_ = 0;
  std::uint64_t last_correlation_ = 0;
  /// As many as the queue of answers holds, so that none is lost.
  Places<PendingRequest, AnswerQueue::capacity> pending_;
  Places<Lease, 64> leases_;
};

/// "BOOT-SEQUENCE" in quotation marks.
void write_etag(std::string& etag, std::string_view boot, std::uint64_t sequence);

}  // namespace flexrf::panel
