# What the image takes from an application's tables (its --descriptor): lines of a word and a value.
# Drivers of any choice count: which of them a PC uses, the options of its cell say.
def classes: {
  linux_gpio_chip: "gpio", v4l2_camera: "camera", linux_watchdog: "watchdog",
  evdev_keyboard: "input", evdev_pointer: "input", evdev_joystick: "input"
};
def drivers: .devices[].drivers[];
([.threads[].priority] | max // 0 | "priority \(.)"),
([.threads[] | select(.priority > 0) | .role] | unique[] | "role \(.)"),
([drivers | classes[.type] // empty] | unique[] | "class \(.)"),
([drivers | (.configuration // {})[] | strings | select(startswith("/dev/"))] | unique[] | "file \(.)"),
([drivers | select(.type == "socket_can_bus") | .configuration.interface] | unique[] | "can \(.)")
