// What the helper does at each look: the word for the application, and the version's confirmation.
#pragma once

#include <functional>
#include <string>

#include "base/time.hpp"
#include "image/boot/medium.hpp"
#include "image/helper/health_count.hpp"
#include "image/helper/permission.hpp"

namespace flexrf::helper {

/// Where things are on a PC.
struct Files {
  std::string word = "/run/flexrf-helper/motion";      ///< for --motion-permit
  std::string users = "/data/flexrf/panel-users";      ///< who may log in
  std::string choice = "/boot/efi/flexrf";             ///< the boot choice's folder
  std::string command_line = "/proc/cmdline";          ///< of the kernel
  std::string certificate = "/data/flexrf/panel.crt";  ///< the panel's
};

/// Times by which it decides.
struct Limits {
  Duration healthy = std::chrono::seconds{60};  ///< without a gap: the version confirms itself
  Duration trial = std::chrono::minutes{10};    ///< after that a version on trial gives up its turn
};

/// What a look asks of others, so that a test can be they.
struct Surroundings {
  std::function<std::string()> why_not_healthy;
  std::function<void(const std::string& line)> say;
  std::function<void()> restart;  ///< the PC; may return
};

/// One thread. Nothing of it is lost when the process ends: it reads everything anew at each look.
class Helper {
 public:
  Helper(Files files, Limits limits, Surroundings surroundings, Time began);

  void look(Time now);

 private:
  Facts facts() const;
  void supervise(const Facts& facts, Time now);
  void confirm(const Facts& facts);
  void leave_word(const std::string& word);
  void say(const std::string& line, std::string& said) const;

  Files files_;
  Limits limits_;
  Surroundings surroundings_;
  Time began_;  // the time of the trial
  HealthCount health_;
  std::string word_;         // as it stands in the file
  std::string said_health_;  // what was said last, so that it is said once
  std::string said_failure_;
};

}  // namespace flexrf::helper
