#include "tests/pick_station/station_box.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

constexpr const char* chip_name = "pick-station";  // its label, too
constexpr std::array<const char*, 4> line_names = {"ESTOP", "LAMP_GREEN", "LAMP_YELLOW", "LAMP_RED"};

std::string folder() {
  return GpioSim::folder_of_chip(chip_name);
}

std::string folder_of(std::size_t line) {
  return folder() + "/lines/line" + std::to_string(line);
}

/// What somebody left, too. In configfs it is empty folders that can be removed, whatever files they show.
void take_apart() {
  std::error_code ignored;
  if (!std::filesystem::exists(folder(), ignored)) return;
  write_file(folder() + "/live", "0");
  for (std::size_t i = 0; i < line_names.size(); ++i) std::filesystem::remove(folder_of(i), ignored);
  std::filesystem::remove(folder() + "/lines", ignored);
  std::filesystem::remove(folder(), ignored);
}

}  // namespace

StationBox::StationBox() : chip_(chip_name) {
  take_apart();
  std::filesystem::create_directory(folder());
  std::filesystem::create_directory(folder() + "/lines");
  write_file(folder() + "/lines/num_lines", std::to_string(line_names.size()));
  write_file(folder() + "/lines/label", chip_name);
  for (std::size_t i = 0; i < line_names.size(); ++i) {
    std::filesystem::create_directory(folder_of(i));
    write_file(folder_of(i) + "/name", line_names[i]);
  }
  chip_.plug_in();
  CHECK(chip_.is_good());
}

StationBox::~StationBox() {
  try {
    take_apart();
  } catch (const fixture::CheckFailed& failed) {
    std::fprintf(stderr, "%s\n", failed.message.c_str());
  }
}

}  // namespace flexrf::whole
