// What a unit that serves others may do with the cell around it: see everything, and ask for changes.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/executive/value_saver.hpp"
#include "runtime/parameters/request.hpp"
#include "runtime/unit/component.hpp"

namespace flexrf {

class Cell;

/// For units whose table says access = "cell", which are in no real-time thread: whoever looks at a slot as
/// the observer takes a lock (Cell::observe()). From connect() on; initialise() and stop() on the lifecycle
/// thread, else the unit's.
class CellAccess {
 public:
  /// Where answers wait. The cell keeps it, so that answers find it while the unit is constructed anew.
  struct Post {
    ComponentIndex unit = 0;
    std::uint16_t requester = 0;
    std::uint64_t sent = 0;
    AnswerQueue answers;
  };

  /// To look at, not to change: names and types of everything, slots, configurations, mode.
  const Cell& cell() const noexcept { return *cell_; }
  /// The unit itself.
  ComponentIndex self() const noexcept { return post_->unit; }

  /// Sends it, in the unit's name, and gives the number that comes back as the answer's correlation; a number
  /// is never used twice while the application runs. Roles are the caller's to judge. `keeps`: what it sets
  /// belongs into the configuration file; it does so in any case where the request names a person.
  std::uint64_t send(ParameterRequest& request, Time now, bool keeps = false) noexcept;
  /// What a person did who came in by this unit, for the audit: AuditIntake::note().
  void note(std::string_view who, const char* did, std::string_view what = {}) noexcept;
  /// The next answer that has come, also to what the unit asked before it was restarted.
  bool take_answer(ParameterAnswer& answer) noexcept { return post_->answers.pop(answer); }

  /// *Save now*, as ValueSaver::request(): the number under which save_state() tells that it is done.
  Result<std::uint64_t> save_values();
  SaveState save_state() const;

  /// The latch that anybody may set; there is no way from here to clear it, nor to Start.
  void stop_motion(std::string_view who) noexcept;

  // ---- for the cell

  void connect(Cell& cell, Post& post) noexcept {
    cell_ = &cell;
    post_ = &post;
  }

 private:
  Cell* cell_ = nullptr;
  Post* post_ = nullptr;
};

}  // namespace flexrf
