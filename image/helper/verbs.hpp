// What the helper does when it is asked: the verbs that change something.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "image/helper/admin_check.hpp"
#include "image/helper/answer.hpp"
#include "image/helper/facts.hpp"
#include "image/helper/files.hpp"
#include "image/helper/motion_word.hpp"
#include "image/helper/network.hpp"
#include "image/helper/request.hpp"
#include "image/helper/surroundings.hpp"
#include "image/helper/upload.hpp"

namespace flexrf::helper {

/// One thread, which may wait here. What outlives the process stands in files: it begins where they say.
class Verbs {
 public:
  /// For the application to end motion that was permitted a moment ago.
  static constexpr Duration wait_for_standstill = std::chrono::seconds{5};
  /// For a bundle that is of no more use.
  static constexpr Duration keeping = std::chrono::minutes{10};
  /// For systemd to begin with a unit.
  static constexpr Duration wait_for_unit = std::chrono::seconds{60};

  /// Both references outlive it.
  Verbs(Files files, const Surroundings& surroundings, MotionWord& word,
        std::function<Time()> clock = &MonotonicClock::now);

  /// Any verb but `state`; `peer` is who asks, for the journal.
  Answer perform(const Request& request, const std::string& peer);
  /// About once a second: goes on with what a helper before this one began, and removes what is of no more
  /// use.
  void tick();
  /// Any thread.
  Upload::Received received() const { return upload_.received(); }

 private:
  Answer perform(const Request& request);
  Answer begin_upload(const Request& request);
  Answer take_part(const Request& request);
  Answer install(const Request& request);
  Answer choose(const Request& request);
  Answer restart();
  Answer set_address(const Request& request);
  Answer keep_address(const std::string& reached_by);
  Answer dismiss_failure(boot::Slot slot);
  Answer make_room(const std::string& what);
  Answer declare_hosts(const std::string& hosts) const;

  /// How the bundle differs from what runs in a way that an admin has to have meant.
  struct Deviation {
    bool is_older = false;
    bool has_other_drivers = false;
  };

  Answer check_installable(const Request& request, Deviation& deviation) const;
  Answer check_drivers(const Request& request, const std::string& other) const;
  Answer check_standstill() const;
  Answer hold_motion(const std::string& why);
  Status permit(const Deviation& deviation) const;
  Answer start(Job job);
  void look_after(Job job);
  void release_when_unit_speaks();
  void remove_what_is_of_no_use();
  void say_outcome(const Request& request, const std::string& peer, const Answer& answer);

  Files files_;
  const Surroundings& surroundings_;
  MotionWord& word_;
  std::function<Time()> clock_;
  AdminCheck admin_;
  Upload upload_;
  Network network_;
  std::array<std::optional<Time>, 2> asked_for_;  // by Job: when its unit was
  bool holds_for_unit_ = false;                   // the word, until the unit that installs has begun
  std::optional<Time> of_no_use_since_;           // the bundle
  std::string said_part_;                         // why one was refused, so that it is said once
};

}  // namespace flexrf::helper
