// The industrial PC on which the application runs: what its helper knows of it and does to it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/json/json_reader.hpp"
#include "runtime/parameters/audit_intake.hpp"
#include "web-ui/server/access.hpp"
#include "web-ui/server/api/answers.hpp"
#include "web-ui/server/api/places.hpp"
#include "web-ui/server/machine/helper_client.hpp"

namespace flexrf::panel {

/// Asks the helper, which judges password, bundle and state itself, and answers its callers when it has
/// answered: its refusals keep their status and words. The server's thread.
class MachineOperations {
 public:
  /// `helper` empty: the application does not run on a FlexRF PC.
  MachineOperations(std::string helper, Doorbell* bell, AuditIntake& audit, const AccessControl& access,
                    JsonReader& reader, Answers& answers, Permission& permission)
      : is_there_(!helper.empty()),
        helper_(std::move(helper), bell),
        audit_(&audit),
        access_(&access),
        reader_(&reader),
        answers_(&answers),
        permission_(&permission) {}

  /// The helper's thread. The main thread.
  Status start() { return is_there_ ? helper_.start() : Status{}; }
  void stop() noexcept { helper_.stop(); }

  bool is_there() const noexcept { return is_there_; }

  void read(const Caller& caller);
  /// `verb`: as the helper calls it: upload, install, choose, restart, network, keep-network,
  /// dismiss-failure, make-room, hosts. `reached_by`: the PC's own address that the caller asked at.
  void act(const Caller& caller, std::string_view verb, Fields& fields, const Address& reached_by);
  /// A part of what is uploaded under this token.
  void put(const Caller& caller, std::string_view upload, std::uint64_t offset, std::string_view bytes);
  /// Answers of the helper.
  void tick();

 private:
  static constexpr Duration patience = std::chrono::seconds{30};
  static constexpr Duration patience_with_a_part = std::chrono::seconds{10};

  struct Waiting {
    Caller caller;
    std::uint64_t number = 0;
    std::string_view wants{};       ///< what the answer has to have; empty: nothing
    const char* did = nullptr;      ///< for the audit; null: it is not told
    const char* refused = nullptr;  ///< likewise, if the password is wrong
    std::array<char, 160> what{};
    Who who{"", ""};
  };

  /// False: there is no helper, and `caller` was told.
  bool check_there(const Caller& caller);
  void send(Waiting waiting, std::string message, Duration patience);
  Result<JsonObject> understand(const HelperClient::Answer& answer);
  void answer(const Waiting& waiting, const Result<JsonObject>& said);
  void answer_state(const Result<JsonObject>& said);
  /// In the helper's own words.
  void refuse(const Caller& caller, Fields& said);
  /// `why`: nothing was heard of the helper, or nothing that makes sense.
  void refuse(const Caller& caller, const Status& why);
  /// Notes what an installation would install.
  void note_update(JsonObject update);

  bool is_there_;
  HelperClient helper_;
  AuditIntake* audit_;
  const AccessControl* access_;
  JsonReader* reader_;
  Answers* answers_;
  Permission* permission_;
  Places<Waiting, HelperClient::places> waiting_;
  // All who ask how things are before the helper has said so hear the same.
  std::uint64_t state_number_ = 0;  // of the request that is under way; 0: none
  Places<Caller, 64> want_state_;
  std::string update_;  // "pick-station 20261128T001500Z-4fb48992"
};

}  // namespace flexrf::panel
