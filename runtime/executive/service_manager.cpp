#include "runtime/executive/service_manager.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

std::optional<std::int64_t> number_in_environment(const char* name) {
  const char* const value = std::getenv(name);
  if (value == nullptr) return std::nullopt;
  const char* const end = value + std::strlen(value);
  std::int64_t number = 0;
  const auto [rest, error] = std::from_chars(value, end, number);
  if (error != std::errc{} || rest != end) return std::nullopt;
  return number;
}

std::string words_of(const Control& control) {
  std::string words = phrase_of(control.mode());
  if (control.mode() == Mode::running) words += std::string{", "} + phrase_of_motion(control);
  if (const std::uint32_t faults = control.faults(); faults > 0)
    words += ", " + std::to_string(faults) + (faults == 1 ? " fault" : " faults");
  return words;
}

}  // namespace

std::optional<ServiceManagerAddress> ServiceManagerAddress::of_environment() {
  const char* const socket = std::getenv("NOTIFY_SOCKET");
  if (socket == nullptr || socket[0] == '\0') return std::nullopt;
  ServiceManagerAddress address{.socket = socket};
  const auto interval = number_in_environment("WATCHDOG_USEC");
  const auto process = number_in_environment("WATCHDOG_PID");
  // Whoever started us may have been meant, and have left its environment to us.
  if (interval && *interval > 0 && (!process || *process == getpid()))
    address.watchdog = std::chrono::microseconds{*interval};
  return address;
}

ServiceManager::ServiceManager(const char* application, std::optional<ServiceManagerAddress> address,
                               Heartbeat& heartbeat) noexcept
    : application_(application), address_(std::move(address)), heartbeat_(&heartbeat) {
  if (!address_) return;
  if (address_->watchdog.count() > 0) heartbeat_->watch();
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

ServiceManager::~ServiceManager() {
  if (socket_ >= 0) close(socket_);
}

void ServiceManager::observe(Time now, const Control& control) noexcept {
  if (socket_ < 0) return;
  const Mode mode = control.mode();
  if (mode == Mode::running && !ready_) ready_ = tell("READY=1");
  if (mode >= Mode::stopping && !stopping_) stopping_ = tell("STOPPING=1");
  if (const std::string words = words_of(control); words != status_ && tell("STATUS=" + words))
    status_ = words;
  if (address_->watchdog.count() > 0) keep_alive(now);
}

void ServiceManager::keep_alive(Time now) noexcept {
  if (now < keep_alive_at_ || !heartbeat_->is_met(now)) return;
  if (tell("WATCHDOG=1")) keep_alive_at_ = now + address_->watchdog / 2;
}

/// False: it is to be told again.
bool ServiceManager::tell(const std::string& message) noexcept {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& name = address_->socket;
  int error = ENAMETOOLONG;
  if (name.size() < sizeof(address.sun_path)) {
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name[0] == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    if (sendto(socket_, message.data(), message.size(), MSG_NOSIGNAL,
               reinterpret_cast<const sockaddr*>(&address), size) >= 0) {
      return true;
    }
    error = errno;
  }
  if (!complained_) {
    log_warning(application_, "the service manager cannot be told at {}: {}", std::string_view{name},
                std::string_view{std::strerror(error)});
  }
  complained_ = true;
  return false;
}

}  // namespace flexrf
