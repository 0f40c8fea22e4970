// A process that leads a drive dies in the midst of its motion, on a real interface (vcan), as root: what it
// says at last, and that the drive, another process, stops on account of that, long before it would for want
// of a heartbeat.
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "hal/canopen/can_message.hpp"
#include "hal/servo_drive/canopen/tests/real_axis.hpp"
#include "places.hpp"
#include "runtime/realtime/last_gasp.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;

constexpr double speed = 5;                   // unit/s: a quick stop of the drive takes 25 ms
constexpr Duration patience{30'000'000'000};  // against a hang
constexpr Duration promptly = milliseconds(100);
constexpr Duration heartbeat_limit = std::chrono::seconds(2);
// The last heartbeat may have been a period before the end.
constexpr Duration before_heartbeat_is_missed = milliseconds(1500);
constexpr std::uint32_t set_points = 0x205;
constexpr std::uint32_t emergencies = 0x085;

struct Death {
  ServoMode mode = ServoMode::cyclic_position;
  bool is_supervised = true;  ///< the drive looks for our heartbeat
  void (*die)() = nullptr;    ///< in the midst of a cycle; if it returns, cycles go on
  bool cable_is_out = false;
};

alignas(16) std::byte handler_stack[2][last_gasp::handler_stack_size];

void access_nothing() {
  volatile int* volatile nothing = nullptr;
  *nothing = 1;
}
void be_killed() {
  ::kill(::getpid(), SIGKILL);
}
/// While the bus's own thread goes on.
void abort_beside() {
  std::thread([] {
    const last_gasp::AlternateStack stack(handler_stack[1]);
    std::abort();
  }).detach();
}

void configure(CanopenServoDriveConfiguration& configuration, const Death& death) {
  configuration.mode = death.mode;
  configuration.acceleration = 100;
  configuration.lowest = -1000;
  configuration.highest = 1000;
  configuration.fastest = speed;
  configuration.node = 5;
  configuration.increments_per_unit = 1000;
  configuration.supervises_us = death.is_supervised;
  configuration.heartbeat_limit = seconds(heartbeat_limit);
}

/// The process that leads the drive, until a byte tells it to die.
[[noreturn]] void lead(const Death& death, int orders, int errors) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::dup2(errors, STDERR_FILENO);
  const last_gasp::AlternateStack stack(handler_stack[0]);
  RealAxis axis;
  configure(axis.configuration(), death);
  if (!last_gasp::install() || !axis.initialise()) ::_exit(1);
  for (;;) {
    axis.receive();
    axis.drive().command_position(900);
    axis.drive().command_velocity(speed);
    char order = 0;
    if (::read(orders, &order, 1) == 1) death.die();
    axis.send();
  }
}

/// Everything that is said on the interface.
class Listener {
 public:
  Listener() {
    ready_ = socket_->open().is_ok() && socket_->listen_to_all().is_ok() &&
             socket_->bind(static_cast<int>(if_nametoindex(can_interface))).is_ok();
  }
  bool is_ready() const { return ready_; }
  const std::vector<CanFrame>& heard() {
    for (std::size_t count = 0; (count = socket_->receive()) > 0;) {
      for (std::size_t i = 0; i < count; ++i) {
        if (!socket_->is_error(i)) heard_.push_back(socket_->frame(i));
      }
    }
    return heard_;
  }

 private:
  std::unique_ptr<CanSocket> socket_ = std::make_unique<CanSocket>();
  std::vector<CanFrame> heard_;
  bool ready_ = false;
};

struct Outcome {
  bool came_to_move = false;
  int signal = 0;       ///< that ended the process
  Duration dying{};     ///< from the order to the end
  std::string message;  ///< what it said on standard error
  CanFrame before;      ///< the last set-point in operation
  CanFrame last;        ///< and what was said with its identifier at last
  int syncs_behind = 0;
  int others_behind = 0;       ///< what the master said behind it beside SYNC
  std::string prompt_state;    ///< of the drive, promptly after the end
  std::string later_state;     ///< of the drive, before a heartbeat would be missed
  std::string last_state;      ///< long after that
  std::optional<Time> missed;  ///< when the drive said that our heartbeat was
  Time end{};
};

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

bool comes_to_move(SimulatorProcess& drive, Listener& listener) {
  const Time start = MonotonicClock::now();
  while (MonotonicClock::now() - start < patience) {
    listener.heard();
    const std::string state = drive.ask("state");
    if (has(state, "operation enabled") && has(state, " with 5000/s")) return true;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return false;
}

bool is_of_master(const CanFrame& frame) {
  return frame.identifier == canopen::sync_identifier || frame.identifier == set_points ||
         frame.identifier == 0x605 || frame.identifier == 0x77F || frame.identifier == 0;
}

void read_last_words(const std::vector<CanFrame>& heard, Outcome& outcome) {
  for (const CanFrame& frame : heard) {
    if (frame.identifier == set_points) {
      outcome.before = outcome.last;
      outcome.last = frame;
      outcome.syncs_behind = outcome.others_behind = 0;
    } else if (frame.identifier == canopen::sync_identifier) {
      ++outcome.syncs_behind;
    } else if (is_of_master(frame)) {
      ++outcome.others_behind;
    } else if (frame.identifier == emergencies && frame.data[0] == 0x30 && frame.data[1] == 0x81) {
      if (!outcome.missed) outcome.missed = frame.time;
    }
  }
}

std::string state_after(SimulatorProcess& drive, Time end, Duration time) {
  std::this_thread::sleep_for(end + time - MonotonicClock::now());
  return drive.ask("state");
}

/// Waits for its end and reads what it said; kills it if it does not come.
void see_it_die(pid_t process, int errors, Outcome& outcome) {
  const Time ordered = MonotonicClock::now();
  int result = 0;
  while (::waitpid(process, &result, WNOHANG) == 0) {
    if (MonotonicClock::now() - ordered > patience) ::kill(process, SIGKILL);
    std::this_thread::sleep_for(milliseconds(1));
  }
  outcome.end = MonotonicClock::now();
  outcome.dying = outcome.end - ordered;
  outcome.signal = WIFSIGNALED(result) ? WTERMSIG(result) : 0;
  char text[512];
  const ssize_t size = ::read(errors, text, sizeof text);
  if (size > 0) outcome.message.assign(text, static_cast<std::size_t>(size));
}

Outcome die(const Death& death) {
  Outcome outcome;
  const VirtualInterface interface { true };
  SimulatorProcess drive{place::cia402_simulator, {can_interface, "--node", "5"}};
  Listener listener;
  int orders[2];
  int errors[2];
  if (!drive.is_running() || !listener.is_ready() || ::pipe2(orders, O_CLOEXEC | O_NONBLOCK) != 0 ||
      ::pipe2(errors, O_CLOEXEC | O_NONBLOCK) != 0) {
    return outcome;
  }
  const pid_t process = ::fork();
  if (process == 0) lead(death, orders[0], errors[1]);
  outcome.came_to_move = comes_to_move(drive, listener);
  if (death.cable_is_out) {
    set_interface(false);
    std::this_thread::sleep_for(milliseconds(50));
  }
  outcome.came_to_move = ::write(orders[1], "d", 1) == 1 && outcome.came_to_move;
  see_it_die(process, errors[0], outcome);
  if (!death.cable_is_out) {
    outcome.prompt_state = state_after(drive, outcome.end, promptly);
    listener.heard();
    outcome.later_state = state_after(drive, outcome.end, before_heartbeat_is_missed);
    listener.heard();
    outcome.last_state = state_after(drive, outcome.end, 2 * heartbeat_limit);
    read_last_words(listener.heard(), outcome);
  }
  for (const int end : {orders[0], orders[1], errors[0], errors[1]}) ::close(end);
  if (!outcome.came_to_move) std::fprintf(stderr, "it did not come to move: %s\n", outcome.message.c_str());
  return outcome;
}

/// It said quick stop, then SYNC, then nothing; the drive has stopped at once.
void check_last_words(const Outcome& outcome, int signal) {
  assert_true(outcome.came_to_move);
  assert_int_equal(outcome.signal, signal);
  assert_non_null(std::strstr(outcome.message.c_str(), "prepared outputs written: 2\n"));
  assert_int_equal(outcome.last.length, 7);
  assert_int_equal(canopen::read_number(outcome.before.data.data(), 2), 0x000F);
  assert_int_equal(canopen::read_number(outcome.last.data.data(), 2), 0x0002);
  assert_memory_equal(outcome.last.data.data() + 2, outcome.before.data.data() + 2, 5);
  assert_int_equal(outcome.syncs_behind, 1);
  assert_int_equal(outcome.others_behind, 0);
  assert_true(outcome.last.time - outcome.before.time <= 2 * real_cycle);
  assert_non_null(std::strstr(outcome.prompt_state.c_str(), "operational, switch on disabled"));
  assert_non_null(std::strstr(outcome.prompt_state.c_str(), " with 0/s"));
  std::printf("quick stop %lld us after the last set-point, the end %lld us after it: %s\n",
              static_cast<long long>((outcome.last.time - outcome.before.time).count() / 1000),
              static_cast<long long>((outcome.end - outcome.last.time).count() / 1000),
              outcome.prompt_state.c_str());
}

// [can-bus-11] [stop-24]
void a_crash_stops_the_axis_long_before_its_heartbeat_is_missed(void**) {
  const Outcome outcome = die({.die = access_nothing});
  check_last_words(outcome, SIGSEGV);
  assert_true(outcome.missed.has_value());
  assert_true(*outcome.missed - outcome.end > before_heartbeat_is_missed);
}

// [stop-24]
void a_crash_stops_an_axis_that_does_not_look_for_us(void**) {
  const Outcome outcome =
      die({.mode = ServoMode::profile_velocity, .is_supervised = false, .die = access_nothing});
  check_last_words(outcome, SIGSEGV);
  assert_false(outcome.missed.has_value());
}

// [stop-26]
void so_does_one_of_another_thread(void**) {
  for (int i = 0; i < 5; ++i) {
    check_last_words(die({.mode = ServoMode::cyclic_velocity, .is_supervised = false, .die = abort_beside}),
                     SIGABRT);
  }
}

// What the others are told apart from.
// [stop-28]
void who_is_killed_says_nothing_and_the_drive_has_to_notice(void**) {
  const Outcome watched = die({.mode = ServoMode::profile_velocity, .die = be_killed});
  assert_true(watched.came_to_move);
  assert_int_equal(watched.signal, SIGKILL);
  assert_int_equal(canopen::read_number(watched.last.data.data(), 2), 0x000F);
  assert_non_null(std::strstr(watched.later_state.c_str(), "operation enabled"));
  assert_non_null(std::strstr(watched.later_state.c_str(), " with 5000/s"));
  assert_true(watched.missed.has_value());
  assert_non_null(std::strstr(watched.last_state.c_str(), "switch on disabled"));
  const Outcome alone = die({.mode = ServoMode::profile_velocity, .is_supervised = false, .die = be_killed});
  assert_true(alone.came_to_move);
  assert_non_null(std::strstr(alone.last_state.c_str(), "operation enabled"));
  assert_non_null(std::strstr(alone.last_state.c_str(), " with 5000/s"));
}

// [stop-27]
void an_interface_that_is_down_holds_no_death_up(void**) {
  const Outcome outcome = die({.die = access_nothing, .cable_is_out = true});
  assert_true(outcome.came_to_move);
  assert_int_equal(outcome.signal, SIGSEGV);
  assert_non_null(std::strstr(outcome.message.c_str(), "prepared outputs written: 0\n"));
  assert_true(outcome.dying <= promptly);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_crash_stops_the_axis_long_before_its_heartbeat_is_missed),
      cmocka_unit_test(a_crash_stops_an_axis_that_does_not_look_for_us),
      cmocka_unit_test(so_does_one_of_another_thread),
      cmocka_unit_test(who_is_killed_says_nothing_and_the_drive_has_to_notice),
      cmocka_unit_test(an_interface_that_is_down_holds_no_death_up),
  };
  return cmocka_run_group_tests_name("CANopen drives when their master dies", tests, nullptr, nullptr);
}
