// An input device that a test makes, holds in its hand, and unplugs: through the kernel's uinput.
#pragma once

#include <linux/uinput.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace flexrf {

/// What a device says of itself.
struct UinputDescription {
  std::string name;
  std::string phys{};
  std::uint16_t vendor = 0x1209;
  std::uint16_t product = 0x0001;
  std::vector<int> keys{};  ///< and buttons
  std::vector<int> relative_axes{};
  struct Axis {
    int code;
    int minimum;
    int maximum;
  };
  std::vector<Axis> axes{};
};

class UinputDevice {
 public:
  explicit UinputDevice(UinputDescription description) : description_(std::move(description)) { plug_in(); }
  UinputDevice(const UinputDevice&) = delete;
  UinputDevice& operator=(const UinputDevice&) = delete;
  ~UinputDevice() { unplug(); }

  /// The kernel forgets it; whoever has it open learns of it.
  void unplug();
  /// It is there when this returns, as /dev/input/eventN.
  bool plug_in();
  const std::string& path() const { return path_; }

  /// One event, and the end of its report.
  void report(int type, int code, int value);
  void press(int code) { report(EV_KEY, code, 1); }
  void let_go(int code) { report(EV_KEY, code, 0); }

  /// Another program grabs it, until this device or this object ends.
  bool grab();

 private:
  bool describe();

  UinputDescription description_;
  int descriptor_ = -1;
  int grabbed_ = -1;
  std::string path_;
};

}  // namespace flexrf
