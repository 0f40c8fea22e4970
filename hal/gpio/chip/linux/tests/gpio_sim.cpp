#include "hal/gpio/chip/linux/tests/gpio_sim.hpp"

#include <cstdio>
#include <fstream>

namespace flexrf {
namespace {

constexpr int most_lines = 8;

}  // namespace

void GpioSim::pull(const std::string& line, bool high) {
  const std::string text = high ? "pull-up" : "pull-down";
  std::string& pulled = pulled_[line];
  if (pulled == text) return;
  write(folder_of(line) + "/pull", text);
  pulled = text;
}

bool GpioSim::is_high(const std::string& line) {
  return read(folder_of(line) + "/value") == "1";
}

void GpioSim::unplug() {
  write(folder_ + "/live", "0");
  plugged_ = false;
}

void GpioSim::plug_in() {
  write(folder_ + "/live", "1");
  folders_.clear();
  pulled_.clear();
  plugged_ = true;
}

const std::string& GpioSim::folder_of(const std::string& line) {
  std::string& folder = folders_[line];
  if (folder.empty()) folder = find_folder(line);
  return folder;
}

std::string GpioSim::find_folder(const std::string& line) {
  for (int i = 0; i < most_lines; ++i) {
    if (read(folder_ + "/lines/line" + std::to_string(i) + "/name") != line) continue;
    return "/sys/devices/platform/" + read(folder_ + "/dev_name") + "/" + read(folder_ + "/lines/chip_name") +
           "/sim_gpio" + std::to_string(i);
  }
  std::fprintf(stderr, "gpio-sim has no line %s\n", line.c_str());
  good_ = false;
  return "/nowhere";
}

void GpioSim::write(const std::string& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text << std::flush;
  if (stream) return;
  std::fprintf(stderr, "cannot write %s to %s\n", text.c_str(), file.c_str());
  good_ = false;
}

std::string GpioSim::read(const std::string& file) {
  std::ifstream stream(file);
  std::string text;
  if (!std::getline(stream, text)) {
    std::fprintf(stderr, "cannot read %s\n", file.c_str());
    good_ = false;
  }
  return text;
}

}  // namespace flexrf
