// Service manager: what systemd, or who speaks its protocol, is told of the application.
#pragma once

#include <optional>
#include <string>

#include "base/status.hpp"
#include "runtime/device/heartbeat.hpp"
#include "runtime/executive/control.hpp"

namespace flexrf {

/// Where it listens, as sd_notify(3) and sd_watchdog_enabled(3) describe the environment.
struct ServiceManagerAddress {
  std::string socket;   ///< a path, or '@' and an abstract name
  Duration watchdog{};  ///< it wants to hear a keep-alive at least so often; zero: never

  /// From NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID; nothing: nobody listens.
  static std::optional<ServiceManagerAddress> of_environment();
};

/// Told when the application runs and when it comes to its end, in words how it is, and, if it wants to know,
/// twice within each of its intervals that every thread is alive; silence beyond that makes it kill the
/// application. The supervising thread; nothing here waits.
class ServiceManager {
 public:
  ServiceManager(const char* application, std::optional<ServiceManagerAddress> address,
                 Heartbeat& heartbeat) noexcept;
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;
  ~ServiceManager();

  /// Every few milliseconds, and once more after the end.
  void observe(Time now, const Control& control) noexcept;

 private:
  bool tell(const std::string& message) noexcept;
  void keep_alive(Time now) noexcept;

  const char* application_;
  std::optional<ServiceManagerAddress> address_;
  Heartbeat* heartbeat_;
  int socket_ = -1;
  bool ready_ = false;
  bool stopping_ = false;
  bool complained_ = false;
  std::string status_;
  Time keep_alive_at_{};
};

}  // namespace flexrf
