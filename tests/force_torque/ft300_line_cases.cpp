// What is the FT300's driver's own: a line that is not there, and how it leaves the sensor.
#include "tests/force_torque/ft300_line_cases.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

#include "hal/interfaces/device_bench.hpp"
#include "hal/linux/ft300_sensor/ft300_sensor.hpp"
#include "hal/simulated/ft300_simulator/ft300_server.hpp"
#include "hal/simulated/modbus_server/pseudo_serial_line.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

/// What it says in the first cycle, or when it is initialised.
Status begin(const char* device) {
  DeviceBench<Ft300Sensor> bench(nullptr);
  bench.configuration().set_device(device);
  Status status = bench.driver().initialise();
  bench.receive(std::chrono::milliseconds(10));
  if (status) status = bench.driver().trouble();
  bench.driver().stop();
  return status;
}

void a_line_that_is_not_there_is_waited_for(void**) {
  const Status status = begin("/dev/no-such-line");
  assert_int_equal(status.code(), StatusCode::unavailable);
  assert_non_null(std::strstr(status.cause(), "/dev/no-such-line"));
}

void what_is_no_line_is_refused(void**) {
  const Status status = begin("/dev/null");
  assert_int_equal(status.code(), StatusCode::invalid_argument);
  assert_non_null(std::strstr(status.cause(), "/dev/null is no serial line"));
}

constexpr uid_t nobody = 65534;

/// In a process of its own, as root may open everything.
bool is_told_as_nobody(const char* device) {
  const pid_t process = fork();
  if (process == 0) {
    if (geteuid() == 0 && setuid(nobody) != 0) _exit(2);
    const Status status = begin(device);
    _exit(status.code() == StatusCode::not_permitted && std::strstr(status.cause(), device) != nullptr &&
                  std::strstr(status.cause(), "add this user to the group dialout") != nullptr
              ? 0
              : 1);
  }
  int end = 1;
  return process > 0 && waitpid(process, &end, 0) == process && end == 0;
}

void a_line_that_is_not_this_users_is_refused(void**) {
  bool told = false;
  {
    PseudoSerialLine line;
    told =
        line.open().is_ok() && chmod(line.path().c_str(), 0) == 0 && is_told_as_nobody(line.path().c_str());
  }
  assert_true(told);
}

/// Its driver is gone, and it sends no more.
bool the_stream_is_ended() {
  PseudoSerialLine line;
  if (!line.open()) return false;
  auto server = Ft300Server::on_descriptor(line.descriptor(), ft300::usual_unit_id);
  DeviceBench<Ft300Sensor> bench(nullptr);
  bench.configuration().set_device(line.path());
  if (!server || !bench.driver().initialise()) return false;
  const Time begun = MonotonicClock::now();
  while (bench.feedback().samples < 3 && MonotonicClock::now() - begun < std::chrono::seconds(40)) {
    pollfd wanted{bench.driver().descriptor(), POLLIN, 0};
    poll(&wanted, 1, 10);
    bench.receive(MonotonicClock::now() - bench.now());
  }
  const bool streamed = bench.feedback().samples >= 3;
  bench.driver().stop();
  // It was told, and takes it in when it has a CPU; nobody else would tell it any more.
  for (const Time left = MonotonicClock::now();
       (*server)->streams() && MonotonicClock::now() - left < std::chrono::seconds(40);)
    poll(nullptr, 0, 1);
  return streamed && !(*server)->streams();
}

void a_driver_that_stops_ends_the_stream(void**) {
  assert_true(the_stream_is_ended());
}

}  // namespace

int run_ft300_line_cases() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_line_that_is_not_there_is_waited_for),
      cmocka_unit_test(what_is_no_line_is_refused),
      cmocka_unit_test(a_line_that_is_not_this_users_is_refused),
      cmocka_unit_test(a_driver_that_stops_ends_the_stream),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

}  // namespace flexrf
