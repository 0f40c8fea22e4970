// How a device is meant, what its keys are, and what the operator reads when there is none. Everything that
// needs one is in evdev_guest_test.
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/text.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/operator/evdev/evdev_nodes.hpp"
#include "hal/operator/keyboard/evdev/evdev_keyboard.hpp"
#include "hal/operator/keyboard/evdev/evdev_keys.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

namespace fs = std::filesystem;

/// As the kernel's /sys/class/input, with what is there beside the devices.
struct Folder {
  Folder() : path("/tmp/flexrf_evdev_" + std::to_string(getpid())) {
    fs::remove_all(path);
    add("event12", "A mouse: with, marks", "usb-1/input0", "046d", "c077");
    add("event3", "AT keyboard", "", "0001", "0001");
    add("eventual", "no device", "", "", "");
    fs::create_directories(path + "/mouse0");
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path); }

  void add(const std::string& file, const char* name, const char* phys, const char* vendor,
           const char* product) const {
    const std::string device = path + '/' + file + "/device/";
    fs::create_directories(device + "id");
    std::ofstream(device + "name") << name << '\n';
    std::ofstream(device + "phys") << phys << '\n';
    std::ofstream(device + "id/vendor") << vendor << '\n';
    std::ofstream(device + "id/product") << product << '\n';
  }

  std::string path;
};

bool lists_what_is_there() {
  const Folder folder;
  const std::vector<EvdevNode> nodes = list_evdev_nodes(folder.path.c_str());
  if (nodes.size() != 2 || nodes[0].number != 3 || nodes[1].path() != "/dev/input/event12") return false;
  const EvdevNode& mouse = nodes[1];
  return mouse.name == "A mouse: with, marks" && mouse.phys == "usb-1/input0" && mouse.vendor == 0x046d &&
         mouse.product == 0xc077 && nodes[0].phys.empty() && list_evdev_nodes("/nowhere").empty();
}

void devices_are_listed_by_their_numbers(void**) {
  assert_true(lists_what_is_there());
}

bool means_one() {
  const EvdevNode mouse{12, "A mouse", "usb-1/input0", 0x046d, 0xc077};
  const EvdevNode bare{3, "AT keyboard", "", 1, 1};
  for (const char* wanted : {"A mouse", "usb-1/input0", "046d:c077", "046D:C077"})
    if (!is_meant(mouse, wanted) || is_meant(bare, wanted)) return false;
  for (const char* wanted : {"", "A mous", "46d:c077", "046d:c07", "046d:c0777", "046d-c077", "04 d:c077"})
    if (is_meant(mouse, wanted) || is_meant(bare, wanted)) return false;
  return is_meant(bare, "0001:0001");
}

void a_device_is_meant_by_name_phys_or_numbers(void**) {
  assert_true(means_one());
}

void keys_are_told_by_their_place(void**) {
  const auto writes = [](unsigned code, char plain, char shifted) {
    return key_of_code(code, false).character == static_cast<std::uint32_t>(plain) &&
           key_of_code(code, true).character == static_cast<std::uint32_t>(shifted);
  };
  assert_true(writes(KEY_W, 'w', 'W'));
  assert_true(writes(KEY_0, '0', ')'));
  assert_true(writes(KEY_EQUAL, '=', '+'));
  assert_true(writes(KEY_RIGHTBRACE, ']', '}'));
  assert_true(writes(KEY_GRAVE, '`', '~'));
  assert_true(writes(KEY_BACKSLASH, '\\', '|'));
  assert_true(writes(KEY_SLASH, '/', '?'));
  assert_true(writes(KEY_SPACE, ' ', ' '));
  assert_true(writes(KEY_KP7, '7', '7'));
  assert_true(writes(KEY_KP0, '0', '0'));
  assert_true(writes(KEY_KPDOT, '.', '.'));
  assert_true(key_of_code(KEY_KPENTER, false).key == Key::enter);
  assert_true(key_of_code(KEY_DELETE, true).key == Key::delete_key);
  for (const unsigned code : {KEY_RESERVED, KEY_LEFTSHIFT, KEY_LEFTCTRL, KEY_F1, KEY_NUMLOCK, BTN_LEFT})
    assert_true(key_of_code(code, false).key == Key::none);
}

bool refuses(const char* device, StatusCode code, const char* words) {
  DeviceBench<EvdevKeyboard> bench(nullptr);
  set_text(bench.configuration().device, device);
  const Status status = bench.driver().initialise();
  print_message("%s\n", status.cause());
  return status.code() == code && std::strstr(status.cause(), words) != nullptr;
}

void what_is_not_there_is_told(void**) {
  assert_true(refuses("", StatusCode::invalid_argument, "configuration.device"));
  assert_true(refuses("no such keyboard", StatusCode::not_found, "'no such keyboard'"));
  assert_true(refuses("/dev/input/by-id/none", StatusCode::not_found, "/dev/input/by-id/none"));
  assert_true(refuses("/dev/null", StatusCode::unavailable, "/dev/null"));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(devices_are_listed_by_their_numbers),
      cmocka_unit_test(a_device_is_meant_by_name_phys_or_numbers),
      cmocka_unit_test(keys_are_told_by_their_place),
      cmocka_unit_test(what_is_not_there_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
