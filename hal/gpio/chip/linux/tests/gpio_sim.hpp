// GpioSim: the far end of the guest's simulated chip, through its sysfs and configfs.
#pragma once

#include <map>
#include <string>

namespace flexrf {

/// The chip that the guest prepares (docs/guest.md). A check that fails says so on standard error and in
/// is_good().
class GpioSim {
 public:
  static constexpr const char* label = "flexrf-sim";

  GpioSim() : GpioSim("chip") {}
  /// Another one, by its name in configfs.
  explicit GpioSim(const std::string& chip) : folder_(folder_of_chip(chip)) {}
  static std::string folder_of_chip(const std::string& chip) { return "/sys/kernel/config/gpio-sim/" + chip; }

  void pull(const std::string& line, bool high);
  bool is_high(const std::string& line);
  /// The chip goes and comes back, with all lines pulled down.
  void unplug();
  void plug_in();
  bool is_plugged() const { return plugged_; }
  bool is_good() const { return good_; }

 private:
  const std::string& folder_of(const std::string& line);
  std::string find_folder(const std::string& line);
  void write(const std::string& file, const std::string& text);
  std::string read(const std::string& file);

  std::string folder_;
  // By the lines' names; their numbers and the chip's may be others after the chip came back.
  std::map<std::string, std::string> folders_;
  std::map<std::string, std::string> pulled_;
  bool plugged_ = true;
  bool good_ = true;
};

}  // namespace flexrf
