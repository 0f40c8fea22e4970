// CAN, serial lines and the loopback network of the guest.
#include <arpa/inet.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#include "tests/cmocka.hpp"
#include "tests/guest/prepared_devices.hpp"
#include "tests/guest/waiting.hpp"

namespace flexrf {

namespace {

int can_socket(const char* interface) {
  const int descriptor = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  assert_true(descriptor >= 0);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface));
  if (address.can_ifindex == 0) fail_msg("there is no interface %s", interface);
  assert_int_equal(::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  return descriptor;
}

void send_frame(int descriptor, std::uint32_t identifier, std::uint8_t value) {
  can_frame frame{};
  frame.can_id = identifier;
  frame.can_dlc = 1;
  frame.data[0] = value;
  assert_int_equal(::write(descriptor, &frame, sizeof frame), sizeof frame);
}

void expect_frame(int descriptor, std::uint32_t identifier, std::uint8_t value) {
  can_frame frame{};
  read_exactly(descriptor, &frame, sizeof frame);
  assert_int_equal(frame.can_id, identifier);
  assert_int_equal(frame.can_dlc, 1);
  assert_int_equal(frame.data[0], value);
}

int serial_line(const char* path) {
  const int descriptor = open_device(path);
  termios settings{};
  assert_int_equal(::tcgetattr(descriptor, &settings), 0);
  ::cfmakeraw(&settings);
  assert_int_equal(::cfsetspeed(&settings, B115200), 0);
  assert_int_equal(::tcsetattr(descriptor, TCSANOW, &settings), 0);
  return descriptor;
}

/// Sends a line of text, and reads from the other end until it is there: a byte from before may come first.
void expect_text(int from, int to, const char* text) {
  assert_int_equal(::write(from, text, std::strlen(text)), std::strlen(text));
  char got[64] = {};
  for (std::size_t held = 0; std::strstr(got, text) == nullptr; ++held) {
    assert_true(held + 1 < sizeof got);
    read_exactly(to, got + held, 1);
  }
}

}  // namespace

void a_frame_on_the_virtual_can_reaches_another_socket(void**) {
  const int one = can_socket("vcan0");
  const int other = can_socket("vcan0");
  send_frame(one, 0x123, 7);
  expect_frame(other, 0x123, 7);
  ::close(one);
  ::close(other);
}

void frames_cross_the_bus_between_two_can_controllers(void**) {
  const int one = can_socket("can0");
  const int other = can_socket("can1");
  send_frame(one, 0x181, 1);
  expect_frame(other, 0x181, 1);
  send_frame(other, 0x201, 2);
  expect_frame(one, 0x201, 2);
  ::close(one);
  ::close(other);
}

void both_can_controllers_run_at_500_kilobit_per_second(void**) {
  for (const char* name : {"can0", "can1"}) {
    char command[96];
    std::snprintf(command, sizeof command, "ip -details link show dev %s up | grep -q 'bitrate 500000 '",
                  name);
    if (std::system(command) != 0) fail_msg("%s is down, or has another bit rate", name);
  }
}

void a_datagram_comes_back_over_the_loopback_network(void**) {
  const int descriptor = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  assert_true(descriptor >= 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const general = reinterpret_cast<sockaddr*>(&address);
  assert_int_equal(::bind(descriptor, general, sizeof address), 0);
  socklen_t size = sizeof address;
  assert_int_equal(::getsockname(descriptor, general, &size), 0);
  assert_int_equal(::sendto(descriptor, "flexrf", 6, 0, general, size), 6);
  char got[6];
  read_exactly(descriptor, got, sizeof got);
  assert_memory_equal(got, "flexrf", sizeof got);
  ::close(descriptor);
}

void bytes_cross_the_serial_line_both_ways(void**) {
  const int one = serial_line("/dev/ttyS1");
  const int other = serial_line("/dev/ttyS2");
  expect_text(one, other, "  there");  // the first byte after opening may be lost
  expect_text(other, one, "  and back");
  ::close(one);
  ::close(other);
}

}  // namespace flexrf
