// cia402_simulator: CiA 402 drives on a CAN interface, to try a cell with.
//
//   cia402_simulator INTERFACE [--node N]... [--vendor N] [--product N] [--boot-delay MS] [--brake-delay MS]
//                    [--position INCREMENTS] [--off] [--each-object]
//
// With --each-object a drive acts on each object of a PDO as it is written, else when all of it is taken.
// Runs until it is interrupted, also while the interface is down or not there yet. Lines on its standard
// input make the drives misbehave: "help" tells which; with several drives the node's number comes first ("5
// off"). Each is answered with a line.
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "base/standard_descriptors.hpp"
#include "base/time.hpp"
#include "hal/can/socket_can/can_node_runner.hpp"
#include "hal/servo_drive/canopen/simulator/drive_console.hpp"

namespace {

using namespace flexrf;

constexpr const char* usage =
    "usage: cia402_simulator INTERFACE [--node N]... [--vendor N] [--product N] [--boot-delay MS]\n"
    "                        [--brake-delay MS] [--position INCREMENTS] [--off] [--each-object]\n";
constexpr Duration look = std::chrono::milliseconds(50);
constexpr Duration a_while = std::chrono::seconds(1);

std::atomic<bool> ends{false};

void end(int /*signal*/) {
  ends.store(true, std::memory_order_release);
}

struct Command {
  const char* interface = nullptr;
  std::vector<std::uint8_t> nodes;
  SimulatedCia402Drive::Options drive;
  std::optional<std::uint32_t> vendor;
  std::optional<std::uint32_t> product;
  bool off = false;
};

std::optional<long> number(const char* text, long least, long most) {
  const bool is_hexadecimal = std::strncmp(text, "0x", 2) == 0;
  const char* const last = text + std::strlen(text);
  long value = 0;
  const auto [rest, error] =
      std::from_chars(is_hexadecimal ? text + 2 : text, last, value, is_hexadecimal ? 16 : 10);
  if (error != std::errc() || rest != last || value < least || value > most) return std::nullopt;
  return value;
}

bool parse_option(const char* option, const char* text, Command& command) {
  const auto is = [option](const char* name) { return std::strcmp(option, name) == 0; };
  const auto value = number(text, 0, is("--node") ? 127L : 0xFFFF'FFFFL);
  if (!value) return false;
  if (is("--node")) {
    if (*value == 0) return false;
    command.nodes.push_back(static_cast<std::uint8_t>(*value));
  } else if (is("--vendor")) {
    command.vendor = static_cast<std::uint32_t>(*value);
  } else if (is("--product")) {
    command.product = static_cast<std::uint32_t>(*value);
  } else if (is("--boot-delay")) {
    command.drive.boot_delay = std::chrono::milliseconds(*value);
  } else if (is("--brake-delay")) {
    command.drive.brake_delay = std::chrono::milliseconds(*value);
  } else if (is("--position")) {
    command.drive.first_position = static_cast<double>(*value);
  } else {
    return false;
  }
  return true;
}

bool parse(int count, char** words, Command& command) {
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(words[i], "--off") == 0) {
      command.off = true;
    } else if (std::strcmp(words[i], "--each-object") == 0) {
      command.drive.acts_on_each_object = true;
    } else if (std::strncmp(words[i], "--", 2) != 0) {
      if (command.interface != nullptr) return false;
      command.interface = words[i];
    } else if (i + 1 == count || !parse_option(words[i], words[i + 1], command)) {
      return false;
    } else {
      ++i;
    }
  }
  if (command.nodes.empty()) command.nodes.push_back(1);
  return command.interface != nullptr;
}

/// All drives of this program, and its standard input.
class Drives final : public CanNode {
 public:
  explicit Drives(const Command& command) {
    for (const std::uint8_t node : command.nodes) {
      SimulatedCia402Drive::Options options = command.drive;
      options.node = node;
      auto& drive = *drives_.emplace_back(std::make_unique<DriveConsole>(options, MonotonicClock::now()));
      if (command.vendor) drive.drive().objects().set_first(canopen::objects::vendor, *command.vendor);
      if (command.product) drive.drive().objects().set_first(canopen::objects::product, *command.product);
      if (command.off) drive.drive().power_off();
    }
  }

  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    for (const auto& drive : drives_) drive->on_frame(frame, port);
  }
  Time next_event() const noexcept override { return drives_.front()->next_event(); }
  void on_time(Time now, CanPort& port) noexcept override {
    listen();
    for (const auto& drive : drives_) drive->on_time(now, port);
  }

 private:
  void listen() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (is_closed_ || ::poll(&input, 1, 0) != 1) return;
    char text[256];
    const ssize_t size = ::read(STDIN_FILENO, text, sizeof text);
    is_closed_ = size <= 0;
    for (ssize_t i = 0; i < size; ++i) {
      if (text[i] != '\n') {
        line_ += text[i];
        continue;
      }
      std::printf("%s\n", obey(line_).c_str());
      std::fflush(stdout);
      line_.clear();
    }
  }

  std::string obey(std::string_view line) {
    if (line == "help") return DriveConsole::help;
    if (drives_.size() == 1) return drives_.front()->obey(line);
    const std::size_t blank = std::min(line.find(' '), line.size());
    unsigned node = 0;
    std::from_chars(line.data(), line.data() + blank, node);
    for (const auto& drive : drives_) {
      if (drive->node() == node) return drive->obey(line.substr(std::min(blank + 1, line.size())));
    }
    return "which drive? Begin with its node's number, as 5 off";
  }

  std::vector<std::unique_ptr<DriveConsole>> drives_;
  std::string line_;
  bool is_closed_ = false;
};

/// Where there is no wire: what is said there is lost.
class NoWire final : public CanPort {
 public:
  bool send(const CanFrame& /*frame*/) noexcept override { return true; }
};

}  // namespace

int main(int count, char** words) {
  flexrf::hold_standard_descriptors();
  Command command;
  if (!parse(count, words, command)) {
    std::fputs(usage, stderr);
    return 2;
  }
  std::signal(SIGINT, end);
  std::signal(SIGTERM, end);
  Drives drives(command);
  std::printf("%zu drives on %s\n", command.nodes.size(), command.interface);
  std::fflush(stdout);
  bool told = false;
  while (!ends.load(std::memory_order_acquire)) {
    const Time start = MonotonicClock::now();
    const Status status = run_can_node(command.interface, drives, ends);
    if (status) break;
    // It ran for a while: what stops it now is new.
    if (MonotonicClock::now() - start > a_while) told = false;
    if (!told) std::fprintf(stderr, "cia402_simulator: %s; waiting for it\n", status.cause());
    told = true;
    NoWire nowhere;
    for (const Time until = MonotonicClock::now() + look; MonotonicClock::now() < until;) {
      drives.on_time(MonotonicClock::now(), nowhere);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  return 0;
}
