// The command line of every application.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/status.hpp"
#include "runtime/executive/application.hpp"

namespace flexrf {

/// `--hardware mock` (device empty: all that have it) or `--hardware arm=simulated`.
struct HardwareChoice {
  std::string device;
  std::string driver;
};

struct Options {
  std::vector<HardwareChoice> hardware;
  std::optional<Duration> virtual_time;  ///< run this long on the simulated clock
  std::string keys_file;                 ///< key presses for the keyboard's `script` driver
  std::string configuration_file;        ///< empty: none
  std::string report_file;               ///< empty: none
  /// Who did what. Empty: beside the configuration file, and without one nowhere; "off": nowhere.
  std::string audit_file;
  std::string panel = "127.0.0.1:8080";  ///< address:port, or "off"
  bool panel_given = false;              ///< the command line says where
  std::string panel_users;               ///< file of who may log in; empty: none
  std::vector<std::string> panel_hosts;  ///< names that the panel answers to, beside this machine's own
  std::string tls_certificate;           ///< PEM file; empty: no TLS
  std::string tls_key;                   ///< PEM file
  bool insecure_http = false;            ///< the panel may be served to other machines without TLS
  bool observed = false;                 ///< somebody observes: memory is locked for its threads too
  /// Of an edit of the configuration that nobody applies.
  Duration panel_edit_timeout = std::chrono::minutes{5};
  std::optional<Duration> standstill_limit;  ///< instead of the application's
  std::uint64_t seed = 1;
  bool realtime = true;
  bool status_view = false;  ///< show the live status while standard output is a terminal
  bool digest = false;
  bool help = false;
  bool version = false;     ///< print it and end
  bool descriptor = false;  ///< print descriptor.json and end
};

/// Understands the arguments; an error names the argument, what is allowed, and the nearest known word.
Result<Options> parse_options(const Application& application, int argument_count, char** arguments);

/// What `--help` prints.
std::string usage(const Application& application);

}  // namespace flexrf
