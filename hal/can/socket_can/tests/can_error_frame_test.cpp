// What needs no CAN in the kernel; the rest is socket_can_bus_guest_test.
#include "hal/can/socket_can/can_error_frame.hpp"

#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

#include "hal/can/socket_can/socket_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

can_frame error_frame(canid_t what, std::uint8_t controller = 0, std::uint8_t transmit_errors = 0) {
  can_frame frame{};
  frame.can_id = CAN_ERR_FLAG | what;
  frame.can_dlc = CAN_ERR_DLC;
  frame.data[1] = controller;
  frame.data[6] = transmit_errors;
  return frame;
}

void states_are_told(void**) {
  assert_true(read_error_frame(error_frame(CAN_ERR_BUSOFF)).state == CanBusState::bus_off);
  assert_true(read_error_frame(error_frame(CAN_ERR_RESTARTED)).state == CanBusState::error_active);
  assert_true(read_error_frame(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE)).state ==
              CanBusState::error_passive);
  assert_true(read_error_frame(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE)).state ==
              CanBusState::error_passive);
  assert_true(read_error_frame(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING)).state ==
              CanBusState::error_active);
  assert_true(read_error_frame(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE)).state ==
              CanBusState::error_active);
  // Nothing else changes the state.
  assert_false(read_error_frame(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW)).state.has_value());
  assert_false(read_error_frame(error_frame(CAN_ERR_LOSTARB | CAN_ERR_ACK)).state.has_value());
}

void events_are_told_apart(void**) {
  for (const canid_t what : {CAN_ERR_BUSERROR, CAN_ERR_PROT, CAN_ERR_ACK, CAN_ERR_TX_TIMEOUT}) {
    const CanErrorReport report = read_error_frame(error_frame(what));
    assert_true(report.bus_error && !report.arbitration_lost && !report.receive_overflow);
  }
  const CanErrorReport lost = read_error_frame(error_frame(CAN_ERR_LOSTARB));
  assert_true(lost.arbitration_lost && !lost.bus_error);
  assert_true(read_error_frame(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW)).receive_overflow);
  // The second byte means something else in other classes.
  assert_false(read_error_frame(error_frame(CAN_ERR_PROT, CAN_ERR_CRTL_RX_OVERFLOW)).receive_overflow);
}

void counters_are_told(void**) {
  const CanErrorReport report = read_error_frame(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE, 136));
  assert_true(report.has_counters);
  assert_int_equal(report.transmit_errors, 136);
  assert_int_equal(report.receive_errors, 0);
  assert_false(read_error_frame(error_frame(CAN_ERR_BUSOFF)).has_counters);
}

// The loopback interface is on every machine. Any socket will do to ask.
void an_interface_of_another_kind_is_told(void**) {
  using Link = CanLinkWatch::Link;
  const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  int loopback = 0;
  int none = 0;
  const Link found = CanLinkWatch::ask(any, "lo", loopback);
  const Link missing = CanLinkWatch::ask(any, "flexrf-none", none);
  close(any);
  assert_true(found == Link::not_can && loopback != 0);
  assert_true(missing == Link::gone && none == 0);
  assert_string_equal(CanLinkWatch::advice(found, "lo").cause(),
                      "lo is not a CAN interface; `ip link` lists those that are with `link/can`");
  assert_non_null(std::strstr(CanLinkWatch::advice(missing, "can7").cause(), "no network interface can7"));
  assert_non_null(std::strstr(CanLinkWatch::advice(Link::down, "can7").cause(), "set can7 up"));
  assert_true(CanLinkWatch::advice(Link::up, "can7").is_ok());
}

// Where the kernel has CAN, an interface that is not there is waited for; elsewhere a person is told what to
// do.
bool is_waited_for(const char* interface) {
  DeviceBench<SocketCanBus> bench(nullptr);
  bench.configuration().set_interface(interface);
  const Status status = bench.driver().initialise();
  bool good = status.is_ok() || std::strstr(status.cause(), "modprobe can_raw") != nullptr;
  if (status) {
    bench.receive(std::chrono::milliseconds(1));
    CanFrame frame;
    good = bench.driver().state() == CanBusState::gone && !bench.driver().queue(frame) &&
           bench.driver().fault().is_ok();
    bench.send();
  }
  bench.driver().stop();
  return good;
}
void missing_interface(void**) {
  assert_true(is_waited_for("flexrf-none"));
  assert_true(is_waited_for("lo"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(states_are_told),   cmocka_unit_test(events_are_told_apart),
      cmocka_unit_test(counters_are_told), cmocka_unit_test(an_interface_of_another_kind_is_told),
      cmocka_unit_test(missing_interface),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
