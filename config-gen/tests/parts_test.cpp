// What the build is told of tables before anything is made of them.
#include "config-gen/read/parts.hpp"

#include <unistd.h>

#include <fstream>

#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests::parts_test {
namespace {

namespace fs = std::filesystem;

// A folder that is removed in the end.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("flexrf-parts-" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path file(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  fs::path path_;
};

std::string parts(Target::Kind kind, const std::string& name, const std::string& text) {
  const Folder folder;
  return list_parts(kind, folder.file(name, text));
}

bool is(const std::string& actual, const std::string& expected) {
  if (actual != expected) print_error("'%s' instead of '%s'\n", actual.c_str(), expected.c_str());
  return actual == expected;
}

void a_unit_names_the_interfaces_of_its_devices(void**) {
  assert_true(
      is(parts(Target::Kind::unit, "jog.toml",
               "summary = \"Turns \\\"Camera\\\" into poses.\"\n[device.keys]\ninterface = \"Keyboard\"\n"
               "[device.arm]\ninterface = 'RobotArm'\n[input.keys]\nqueue = \"KeyEvent\"\n"),
         "name jog\ninterfaces Keyboard RobotArm\n"));
  assert_true(is(parts(Target::Kind::unit, "count.toml", ""), "name count\n"));
}

void an_interface_has_a_class(void**) {
  assert_true(is(parts(Target::Kind::interface, "robot_arm.toml", ""), "name robot_arm\nclass RobotArm\n"));
  assert_true(is(parts(Target::Kind::interface, "can_bus.toml",
                       "class = \"CanBus\"\n[configuration.class]\ntype = \"text\"\n"),
                 "name can_bus\nclass CanBus\n"));
}

void a_driver_names_interface_bus_and_what_it_links(void**) {
  assert_true(is(parts(Target::Kind::driver, "pneumatic_gripper.toml",
                       "interface = \"Gripper\"\nname = \"pneumatic\"\non = \"GpioChip\"\nlibraries = "
                       "[\"FlexRF::canopen\"]\n"
                       "packages = [\n  \"libgpiod\",  # \"libusb\"\n  "
                       "\"gtk+-3.0\",\n]\n[configuration.name]\ndefault = \"other\"\n"),
                 "name pneumatic\nclass Gripper\ninterfaces GpioChip Gripper\nlibraries FlexRF::canopen\n"
                 "packages gtk+-3.0 libgpiod\n"));
  assert_true(is(parts(Target::Kind::driver, "model_mover.toml",
                       "interface = \"Mover\"\nname = \"model\"\n[output.truth]\ntype = \"WayMark\"\n"),
                 "name model\nclass Mover\ninterfaces Mover\nports output\n"));
}

void an_application_names_units_and_drivers(void**) {
  assert_true(is(parts(Target::Kind::application, "cell.toml",
                       "summary = \"A \\\"lift\\\".\"\n[unit.a]\ntype = \"jog\"\n[unit.b]\ntype = "
                       "\"jog\"\n[unit]\nc.type = \"lift\"\n"
                       "[device.arm]\ninterface = \"RobotArm\"\ndrivers = [\"simulated\", \"mock\"]\n"
                       "[device.keys]\ninterface = \"Keyboard\"\ndrivers = [\"terminal\"]\n"),
                 "units jog lift\ndrivers Keyboard/terminal RobotArm/mock RobotArm/simulated\n"));
}

void groups_beside_an_application_belong_to_it(void**) {
  const Folder folder;
  const fs::path table = folder.file(
      "cell.toml",
      "[unit.a]\ntype = \"jog\"\n[group.axis]\ntable = \"axis\"\nwith = { kind = \"canopen\", count = 3 }\n");
  folder.file("groups/axis.toml",
              "[argument.kind]\ntype = \"text\"\ndefault = \"mock\"\n[unit.drive]\ntype = "
              "\"axis_${kind}\"\n[unit.other]\ntype = \"fence\"\n"
              "[device.servo]\ninterface = \"ServoDrive\"\ndrivers = [\"simulated\", \"${kind}\"]\n");
  folder.file("groups/notes.txt", "[unit.drive]\ntype = \"none\"\n");
  assert_true(is(list_parts(Target::Kind::application, table),
                 "units axis_canopen axis_mock fence jog\n"
                 "drivers ServoDrive/canopen ServoDrive/mock ServoDrive/simulated\n"));
}

void what_is_broken_is_left_out(void**) {
  assert_true(is(parts(Target::Kind::driver, "odd.toml", "interface = [\n"), ""));
  assert_true(is(
      parts(Target::Kind::driver, "odd.toml",
            "interface = 3\nname = \"a;b\"\nlibraries = [\"${HOME}\", 4, \"fine\"]\npackages = \"single\"\n"),
      "libraries fine\npackages single\n"));
  assert_true(is(list_parts(Target::Kind::application, "/nowhere/cell.toml"), ""));
}

}  // namespace
}  // namespace flexrf::config_gen::tests::parts_test

int main() {
  using namespace flexrf::config_gen::tests::parts_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_unit_names_the_interfaces_of_its_devices),
      cmocka_unit_test(an_interface_has_a_class),
      cmocka_unit_test(a_driver_names_interface_bus_and_what_it_links),
      cmocka_unit_test(an_application_names_units_and_drivers),
      cmocka_unit_test(groups_beside_an_application_belong_to_it),
      cmocka_unit_test(what_is_broken_is_left_out),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
