// The command line of every application.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "runtime/executive/application.hpp"
#include "runtime/executive/observer.hpp"

namespace flexrf {

/// `--hardware mock` (device empty: all that have it) or `--hardware arm=simulated`.
struct HardwareChoice {
  std::string device;
  std::string driver;
};

struct Options {
  std::vector<HardwareChoice> hardware;
  std::optional<Duration> virtual_time;  ///< run this long on the simulated clock
  std::string configuration_file;        ///< empty: none
  std::string report_file;               ///< empty: none
  /// Who did what. Empty: beside the configuration file, and without one nowhere; "off": nowhere.
  std::string audit_file;
  std::string motion_permit_file;            ///< who else permits motion (MotionPermit); empty: nobody
  bool observed = false;                     ///< somebody observes: memory is locked for its threads too
  std::optional<Duration> standstill_limit;  ///< instead of the application's
  std::uint64_t seed = 1;
  bool realtime = true;
  bool autostart = true;     ///< false: the table's does not count
  bool status_view = false;  ///< show the live status while standard output is a terminal
  bool digest = false;
  /// All that was given, in order, for the observer and the drivers too. The values are the arguments
  /// themselves.
  std::vector<GivenOption> given;

  OptionValues values() const noexcept { return OptionValues{given}; }
};

/// Understands the arguments: options of the application, of who observes it (null: nobody) and of the
/// drivers that its devices permit. An error names the argument, what is allowed, and the nearest known word.
Result<Options> parse_options(const Application& application, const ObserverPart* observer,
                              int argument_count, char** arguments);

/// What `--help` prints.
std::string usage(const Application& application, const ObserverPart* observer);

}  // namespace flexrf
