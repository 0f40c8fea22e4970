// The configuration flow: edit, apply, discard; and a reconfiguration in one request.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "runtime/executive/executive.hpp"
#include "runtime/face/component_values.hpp"
#include "runtime/json/json_reader.hpp"
#include "web-ui/server/api/answers.hpp"
#include "web-ui/server/api/configuration_changes.hpp"
#include "web-ui/server/api/mailbox.hpp"

namespace flexrf::panel {

/// One edit at a time; while it is open nothing moves. The server's thread.
class EditOperations {
 public:
  EditOperations(Executive& executive, Doorbell* bell, const Directory& directory, ComponentValues& values,
                 Answers& answers, Permission& permission, Duration timeout)
      : executive_(&executive),
        results_(std::make_shared<Mailbox<ReconfigureResult>>(bell)),
        directory_(&directory),
        values_(&values),
        answers_(&answers),
        permission_(&permission),
        timeout_(timeout) {}

  void begin(const Caller& caller, JsonArray components, Time now);
  void apply(const Caller& caller, std::string_view edit, JsonArray changes, Time now);
  void discard(const Caller& caller, std::string_view edit);
  /// All in one.
  void reconfigure(const Caller& caller, JsonArray changes, Time now);

  /// An edit that is not being applied ends with its session's control.
  void on_control_lost(SessionIndex session);
  void tick(Time now);

  bool is_open() const noexcept { return number_ != 0; }
  SessionIndex owner() const noexcept { return owner_; }
  const std::vector<ComponentIndex>& components() const noexcept { return components_; }
  Duration left(Time now) const noexcept { return ends_at_ > now ? ends_at_ - now : Duration{}; }
  /// Rises when an edit opens or ends.
  std::uint64_t revision() const noexcept { return revision_; }

 private:
  /// From now: what was left open too long, since it was begun or was last applied in vain, is discarded.
  void count_anew(Time now) noexcept;
  bool is_mine(const Caller& caller, std::string_view edit);
  bool is_at_rest(const Caller& caller);
  void run(const Caller& caller, const WantedChanges& wanted);
  void answer(const Caller& caller, const ReconfigureResult& result);
  void end() noexcept;

  Executive* executive_;
  std::shared_ptr<Mailbox<ReconfigureResult>> results_;
  const Directory* directory_;
  ComponentValues* values_;
  Answers* answers_;
  Permission* permission_;
  Duration timeout_;
  std::uint64_t number_ = 0;  // of the open edit; 0: none
  std::uint64_t last_number_ = 0;
  std::uint64_t revision_ = 1;
  SessionIndex owner_ = no_session;
  std::vector<ComponentIndex> components_;
  Time ends_at_{};
  bool applying_ = false;
  Caller applier_;
};

}  // namespace flexrf::panel
