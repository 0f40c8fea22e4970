#include "tests/guest/serial_adapter.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

namespace flexrf {
namespace {

bool tell_driver(const char* what, const std::string& port) {
  std::ofstream file{std::string{"/sys/bus/pnp/drivers/serial/"} + what};
  return static_cast<bool>(file << port << std::flush);
}

}  // namespace

SerialAdapter::SerialAdapter(const char* line) {
  std::error_code error;
  port_ = std::filesystem::canonical(std::string{"/sys/class/tty/"} + line + "/device", error).filename();
}

bool SerialAdapter::unplug() {
  if (plugged_) plugged_ = !tell_driver("unbind", port_);
  return !plugged_;
}

bool SerialAdapter::plug_in() {
  if (!plugged_) plugged_ = tell_driver("bind", port_);
  return plugged_;
}

}  // namespace flexrf
