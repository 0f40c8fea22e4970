// What the helper does at each look: the word for the application, and the version's confirmation.
#pragma once

#include <mutex>
#include <string>

#include "base/time.hpp"
#include "image/boot/verbs.hpp"
#include "image/helper/files.hpp"
#include "image/helper/health_count.hpp"
#include "image/helper/motion_word.hpp"
#include "image/helper/permission.hpp"
#include "image/helper/start_log.hpp"
#include "image/helper/surroundings.hpp"

namespace flexrf::helper {

/// Times by which it decides.
struct Limits {
  Duration healthy = std::chrono::seconds{60};  ///< without a gap: the version confirms itself
  Duration trial = std::chrono::minutes{10};    ///< after that a version gives up its turn
};

/// For how long the version that runs has been healthy; nothing of one that has confirmed itself.
struct Health {
  Duration so_far{};
  std::string why_not;
};

/// One thread but for health(). Nothing of it is lost when the process ends: it reads everything anew at each
/// look.
class Helper {
 public:
  Helper(Files files, Limits limits, const Surroundings& surroundings, MotionWord& word, Time began);

  void look(Time now);
  /// As of the last look. Any thread.
  Health health() const;

 private:
  void remember_version(const Facts& facts);
  void tell_of_fallback(const Facts& facts);
  void supervise(const Facts& facts, Time now);
  void await_start(const Facts& facts, Time now);
  void note_reason(const Facts& facts, const PanelAnswer& panel, const std::string& why_not, Time now);
  void give_up_turn(const Facts& facts, Time now, const std::string& why);
  void confirm(const Facts& facts);
  boot::Outcome perform(const Facts& facts, const char* verb);
  void note(const Health& health);
  void say(const std::string& line, std::string& said) const;

  Files files_;
  Limits limits_;
  const Surroundings& surroundings_;
  MotionWord& word_;
  Time began_;  // the time of the trial, or of the start
  HealthCount count_;
  HealthCount up_;
  StartLog start_log_;
  std::string last_trouble_;  // why this version was not well when it was not the last time
  mutable std::mutex reading_;
  Health health_;
  std::string said_health_;  // what was said last, so that it is said once
  std::string said_failure_;
  bool has_remembered_version_ = false;
  bool has_told_of_fallback_ = false;
};

}  // namespace flexrf::helper
