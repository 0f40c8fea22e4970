// What is the FT300's driver's own: a line that is not there, another user's or in use, and how it leaves the
// sensor.
#include "hal/force_torque/ft300/tests/ft300_line_cases.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <string>

#include "hal/driver/device_bench.hpp"
#include "hal/force_torque/ft300/ft300_sensor.hpp"
#include "hal/force_torque/ft300/simulator/ft300_server.hpp"
#include "hal/modbus/link/simulator/pseudo_serial_line.hpp"
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

constexpr Duration patience = std::chrono::seconds(40);

template <class Condition>
bool until(DeviceBench<Ft300Sensor>& bench, const Condition& is_so) {
  for (const Time begun = MonotonicClock::now(); MonotonicClock::now() - begun < patience;) {
    pollfd wanted{bench.driver().descriptor(), POLLIN, 0};
    poll(&wanted, 1, 10);
    bench.receive(MonotonicClock::now() - bench.now());
    if (is_so()) return true;
  }
  return false;
}

bool streams(DeviceBench<Ft300Sensor>& bench) {
  return until(bench, [&] { return bench.feedback().samples >= 3; });
}

struct Refusal {
  StatusCode code;
  const char* hint;
};

/// The driver's part of a refusal: 0, as a process ends that was told, and measures once the cause is gone.
int refused_at_first(const std::string& device, const Refusal& refusal, int told, int mended) {
  constexpr uid_t nobody = 65534;
  if (geteuid() == 0 && setuid(nobody) != 0) return 1;  // root may open everything
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  DeviceBench<Ft300Sensor> bench(nullptr);
  bench.configuration().set_device(device);
  const Status started = bench.driver().initialise();
  const Status& trouble = started ? bench.driver().trouble() : started;
  if (started && !until(bench, [&] { return !bench.driver().trouble().is_ok(); })) return 2;
  if (trouble.code() != refusal.code || std::strstr(trouble.cause(), device.c_str()) == nullptr ||
      std::strstr(trouble.cause(), refusal.hint) == nullptr)
    return 3;
  char word = 0;
  if (write(told, &word, 1) != 1 || read(mended, &word, 1) != 1) return 4;
  if (!started && !bench.driver().initialise()) return 5;
  return streams(bench) ? 0 : 6;
}

/// In a process of its own, which is another user's; `mend` takes the cause away.
template <class Mend>
bool is_refused_until(PseudoSerialLine& line, const Refusal& refusal, const Mend& mend) {
  int told[2];
  int mended[2];
  if (pipe(told) != 0 || pipe(mended) != 0) return false;
  const pid_t process = fork();
  if (process == 0) _exit(refused_at_first(line.path(), refusal, told[1], mended[0]));
  close(told[1]);
  char word = 0;
  const bool was_told = read(told[0], &word, 1) == 1 && mend();
  const auto server = Ft300Server::on_descriptor(line.descriptor(), ft300::usual_unit_id);
  const bool goes_on = was_told && write(mended[1], &word, 1) == 1;
  close(mended[1]);
  close(mended[0]);
  close(told[0]);
  int end = 1;
  return process > 0 && waitpid(process, &end, 0) == process && goes_on && end == 0;
}

bool another_users_line_is_refused_until_it_is_ours() {
  PseudoSerialLine line;
  if (!line.open() || chmod(line.path().c_str(), 0) != 0) return false;
  return is_refused_until(line, {StatusCode::not_permitted, "add this user to the group dialout"},
                          [&] { return chmod(line.path().c_str(), 0666) == 0; });
}

bool a_line_in_use_is_taken_when_it_is_free() {
  PseudoSerialLine line;
  SerialPort other;
  if (!line.open() || chmod(line.path().c_str(), 0666) != 0 || !other.open(line.path().c_str())) return false;
  return is_refused_until(line, {StatusCode::busy, "is in use by another program; end that program"}, [&] {
    other.close();
    return true;
  });
}

template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

/// Its driver is gone, and it sends no more.
bool the_stream_is_ended() {
  PseudoSerialLine line;
  if (!line.open()) return false;
  auto server = Ft300Server::on_descriptor(line.descriptor(), ft300::usual_unit_id);
  DeviceBench<Ft300Sensor> bench(nullptr);
  bench.configuration().set_device(line.path());
  if (!server || !bench.driver().initialise()) return false;
  const bool streamed = streams(bench);
  bench.driver().stop();
  // It was told, and takes it in when it has a CPU; nobody else would tell it any more.
  for (const Time left = MonotonicClock::now();
       (*server)->streams() && MonotonicClock::now() - left < patience;)
    poll(nullptr, 0, 1);
  return streamed && !(*server)->streams();
}

}  // namespace

int run_ft300_line_cases() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_line_that_is_not_there_is_waited_for),
      cmocka_unit_test(what_is_no_line_is_refused),
      {"another user's line is refused until it is ours",
       judged<another_users_line_is_refused_until_it_is_ours>, nullptr, nullptr, nullptr},
      {"a line in use is taken when it is free", judged<a_line_in_use_is_taken_when_it_is_free>, nullptr,
       nullptr, nullptr},
      {"a driver that stops ends the stream", judged<the_stream_is_ended>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}

}  // namespace flexrf
