// What the operator reads when something is wrong from the start, and that it ends once the cause is gone;
// and a link in a thread of its own.
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>

#include "hal/modbus/link/simulator/modbus_server.hpp"
#include "hal/modbus/link/simulator/pseudo_serial_line.hpp"
#include "hal/modbus/station/real/tests/rtu_world.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr Duration patience = std::chrono::seconds(30);

constexpr ModbusRegister registers[] = {
    {"level", 5, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "mm", 0},
    {"speed", 6, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd,
     ModbusAccess::read_write, ModbusPollGroup::fast, 1, "", 0},
};
constexpr ModbusRegisterMap map{registers};

// Each case runs apart from the assertion, so that a failing one jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  const bool good = Run();
  assert_true(good);
}

template <class Condition>
bool until(ModbusStationWorld& world, const Condition& is_so) {
  for (const Time start = world.now(); world.now() - start < patience;) {
    world.receive();
    const bool so = is_so();
    world.send();
    if (so) return true;
  }
  return false;
}

bool says(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

const ModbusStationFeedback& feedback_of(ModbusStation& station) {
  return *static_cast<const ModbusStationFeedback*>(station.parameter_memory().feedback);
}
const ModbusLinkFeedback& feedback_of(ModbusLink& link) {
  return *static_cast<const ModbusLinkFeedback*>(link.parameter_memory().feedback);
}

bool a_wrong_unit_id_is_asked_about() {
  TcpWorld world;
  world.set_unit_id(9);
  world.set_response_timeout(0.4);
  if (!world.start(map)) return false;
  return until(world, [&] {
    const ModbusStationFeedback& feedback = feedback_of(world.station());
    return feedback.timeouts > 0 && says(feedback.last_error_view(), "of unit 9") &&
           says(feedback.last_error_view(), "its unit id right?") &&
           world.station().read(0).reason == NullReason::nothing_yet;
  });
}

bool an_impossible_unit_id_is_refused() {
  RtuWorld serial;
  serial.set_unit_id(255);
  const Status on_serial = serial.start(map);
  TcpWorld tcp;
  tcp.set_unit_id(250);
  const Status on_tcp = tcp.start(map);
  return says(on_serial.cause(), "1 to 247") && says(on_tcp.cause(), "250 is reserved");
}

bool a_refusal_is_told_in_words() {
  TcpWorld world;
  if (!world.start(map)) return false;
  world.make(ModbusFarEnd::refuses);
  return until(world, [&] {
    const ModbusStationFeedback& feedback = feedback_of(world.station());
    return feedback.exceptions > 0 && feedback.online &&
           says(feedback.last_error_view(), "holding_register") &&
           says(feedback.last_error_view(), "the station refuses: Slave device or server failure");
  });
}

// It answers itself for what is off: that is no answer of the station, and no reason to connect anew.
bool a_station_that_is_off_behind_a_gateway_is_not_online() {
  TcpWorld world;
  if (!world.start(map)) return false;
  if (!until(world, [&] { return feedback_of(world.station()).online; })) return false;
  const std::uint64_t connections = feedback_of(world.link()).connections;
  if (!world.say("off_behind_gateway")) return false;
  const bool told = until(world, [&] {
    const ModbusStationFeedback& feedback = feedback_of(world.station());
    return !feedback.online && feedback.timeouts > 1 && feedback.exceptions == 0 &&
           says(feedback.last_error_view(), "a gateway answers in its place") &&
           says(feedback.last_error_view(), "the station behind it on?") &&
           world.station().read(0).reason == NullReason::writer_stopped;
  });
  world.make(ModbusFarEnd::well);
  return told && until(world, [&] { return feedback_of(world.station()).online; }) &&
         feedback_of(world.link()).connections == connections;
}

// Over TCP, and on a serial line, which nobody has answered yet when the first value is written.
template <class World>
bool a_station_is_written_to_by_the_functions_that_it_knows() {
  for (const char* const knows : {"only_single", "only_multiple"}) {
    World world;
    if (!world.start(map) || !world.say(knows)) return false;
    world.station().set_inhibited(false);
    const auto set = [&](double value) {
      return until(world, [&] {
        world.station().set(1, value);
        const ModbusValue speed = world.station().read(1);
        return speed && speed.value == value;
      });
    };
    if (!set(41) || !set(42)) return false;
    const Time start = world.now();
    for (world.receive(); !world.station().make_safe(); world.receive())
      if (world.now() - start > patience) return false;
    if (world.held(1) != 0) return false;
    // One exception for the function that it does not know, and no more, whatever was written.
    if (feedback_of(world.station()).exceptions > 1) return false;
  }
  return true;
}

class Serial {
 public:
  explicit Serial(const std::string& device) {
    bench_.configuration().set_device(device);
    bench_.configuration().parity = ModbusParity::none;  // a pseudo-terminal knows no other
    bench_.configuration().reconnect_longest = 0.1;
  }
  ModbusRtuLink& link() { return bench_.driver(); }
  void receive() { bench_.receive(std::chrono::milliseconds(1)); }

 private:
  DeviceBench<ModbusRtuLink> bench_{nullptr};
};

bool a_missing_serial_line_is_no_failure_to_start_and_is_told() {
  Serial serial("/dev/flexrf-no-such-line");
  if (!serial.link().initialise()) return false;
  serial.receive();
  const ModbusLinkFeedback& feedback = feedback_of(serial.link());
  return !feedback.connected &&
         says(feedback.last_error_view(), "serial line /dev/flexrf-no-such-line cannot be opened") &&
         says(feedback.last_error_view(), "plugged in");
}

bool a_line_that_another_link_has_is_told_and_taken_once_it_is_free() {
  PseudoSerialLine line;
  if (!line.open()) return false;
  Serial first(line.path());
  Serial second(line.path());
  if (!first.link().initialise() || !second.link().initialise()) return false;
  first.receive();
  second.receive();
  const bool kept_out = feedback_of(first.link()).connected && !feedback_of(second.link()).connected &&
                        says(feedback_of(second.link()).last_error_view(), "another program has it open");
  first.link().stop();
  for (const Time start = MonotonicClock::now();
       !feedback_of(second.link()).connected && MonotonicClock::now() - start < patience;)
    second.receive();
  return kept_out && feedback_of(second.link()).connected;
}

// Root may open everything: for as long as this lives, it is nobody.
class WithoutPrivileges {
 public:
  WithoutPrivileges() : given_up_(geteuid() != 0 || seteuid(nobody) == 0) {}
  WithoutPrivileges(const WithoutPrivileges&) = delete;
  WithoutPrivileges& operator=(const WithoutPrivileges&) = delete;
  ~WithoutPrivileges() {
    if (geteuid() != before_ && seteuid(before_) != 0) std::abort();
  }
  bool given_up() const { return given_up_; }

 private:
  static constexpr uid_t nobody = 65534;
  uid_t before_ = geteuid();
  bool given_up_ = false;
};

bool a_line_that_may_not_be_opened_is_told_and_taken_once_it_may() {
  PseudoSerialLine line;
  if (!line.open() || chmod(line.path().c_str(), 0) != 0) return false;
  Serial serial(line.path());
  if (!serial.link().initialise()) return false;
  {
    const WithoutPrivileges user;
    serial.receive();
    if (!user.given_up()) return false;
  }
  const ModbusLinkFeedback& feedback = feedback_of(serial.link());
  const bool told = !feedback.connected &&
                    says(feedback.last_error_view(), "serial line " + line.path() + " cannot be opened") &&
                    says(feedback.last_error_view(), "the user needs the right to it") &&
                    says(feedback.last_error_view(), "dialout");
  if (chmod(line.path().c_str(), 0666) != 0) return false;
  const WithoutPrivileges user;
  for (const Time start = MonotonicClock::now();
       !feedback.connected && MonotonicClock::now() - start < patience;)
    serial.receive();
  return told && feedback.connected;
}

// A port that is taken, and on which nobody listens.
class ClosedPort {
 public:
  ClosedPort() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    auto* any = reinterpret_cast<sockaddr*>(&address);
    if (bind(socket_, any, size) == 0 && getsockname(socket_, any, &size) == 0)
      port_ = ntohs(address.sin_port);
  }
  ClosedPort(const ClosedPort&) = delete;
  ClosedPort& operator=(const ClosedPort&) = delete;
  ~ClosedPort() { close(socket_); }
  std::uint16_t port() const { return port_; }

 private:
  int socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  std::uint16_t port_ = 0;
};

bool a_closed_port_is_told() {
  const ClosedPort closed;
  DeviceBench<ModbusTcpLink> bench{nullptr};
  bench.configuration().port = closed.port();
  bench.configuration().response_timeout = 10;  // what is refused is told at once, when this thread has a CPU
  if (closed.port() == 0 || !bench.driver().initialise()) return false;
  bench.receive(std::chrono::milliseconds(1));
  const ModbusLinkFeedback& feedback = feedback_of(bench.driver());
  return !feedback.connected && says(feedback.last_error_view(), "127.0.0.1, port ") &&
         says(feedback.last_error_view(), "nothing listens");
}

bool a_name_for_an_address_is_refused() {
  DeviceBench<ModbusTcpLink> bench{nullptr};
  bench.configuration().set_address("plc-7.local");
  const Status status = bench.driver().initialise();
  return status.code() == StatusCode::invalid_argument && std::strstr(status.cause(), "numeric") != nullptr;
}

bool an_unplugged_adapter_is_told_and_found_again() {
  RtuWorld world;
  if (!world.start(map)) return false;
  world.put(0, 11);
  const auto reads = [&](double value) {
    const ModbusValue got = world.station().read(0);
    return got && got.value == value;
  };
  if (!until(world, [&] { return reads(11); })) return false;
  world.make(ModbusFarEnd::disconnected);
  const bool told = until(world, [&] {
    return !feedback_of(world.link()).connected &&
           says(feedback_of(world.link()).last_error_view(), "serial line");
  });
  world.make(ModbusFarEnd::well);
  world.put(0, 12);
  return told && until(world, [&] { return reads(12) && feedback_of(world.link()).connected; });
}

// The link waits in its own thread while the station, in this one, never does.
bool link_and_station_live_in_two_threads() {
  auto server = ModbusServer::on_tcp(1, 0);
  if (!server) return false;
  DeviceBench<ModbusTcpLink> link{nullptr};
  link.configuration().port = (*server)->port();
  if (!link.driver().initialise()) return false;
  std::atomic<bool> ends{false};
  std::thread thread([&] {
    while (!ends.load()) {
      link.receive(MonotonicClock::now() - link.now());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  bool good = true;
  {
    DeviceBench<RealModbusStation> station(&map, {}, &link.driver());
    // Again and again: each registers while the link is at work, and goes while it is.
    for (int round = 1; round <= 5 && good; ++round) {
      good = station.driver().initialise().is_ok();
      (*server)->put(ModbusArea::holding_register, 5, static_cast<std::uint16_t>(round));
      bool done = false;
      for (const Time start = MonotonicClock::now();
           good && !done && MonotonicClock::now() - start < patience;) {
        station.receive(MonotonicClock::now() - station.now());
        station.driver().set(1, 100 + round);
        const ModbusValue level = station.driver().read(0);
        const ModbusValue speed = station.driver().read(1);
        done = level && level.value == round && speed && speed.value == 100 + round;
        station.send();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      good = good && done;
      station.driver().stop();
    }
  }
  ends.store(true);
  thread.join();
  return good;
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      {"a wrong unit id is asked about", judged<a_wrong_unit_id_is_asked_about>, nullptr, nullptr, nullptr},
      {"an impossible unit id is refused", judged<an_impossible_unit_id_is_refused>, nullptr, nullptr,
       nullptr},
      {"a refusal is told in words", judged<a_refusal_is_told_in_words>, nullptr, nullptr, nullptr},
      {"a station that is off behind a gateway is not online",
       judged<a_station_that_is_off_behind_a_gateway_is_not_online>, nullptr, nullptr, nullptr},
      {"a station over TCP is written to by the functions that it knows",
       judged<a_station_is_written_to_by_the_functions_that_it_knows<TcpWorld>>, nullptr, nullptr, nullptr},
      {"a station on a serial line is written to by the functions that it knows",
       judged<a_station_is_written_to_by_the_functions_that_it_knows<RtuWorld>>, nullptr, nullptr, nullptr},
      {"a missing serial line is no failure to start, and is told",
       judged<a_missing_serial_line_is_no_failure_to_start_and_is_told>, nullptr, nullptr, nullptr},
      {"a line that another link has is told, and taken once it is free",
       judged<a_line_that_another_link_has_is_told_and_taken_once_it_is_free>, nullptr, nullptr, nullptr},
      {"a line that may not be opened is told, and taken once it may",
       judged<a_line_that_may_not_be_opened_is_told_and_taken_once_it_may>, nullptr, nullptr, nullptr},
      {"a closed port is told", judged<a_closed_port_is_told>, nullptr, nullptr, nullptr},
      {"a name for an address is refused", judged<a_name_for_an_address_is_refused>, nullptr, nullptr,
       nullptr},
      {"an unplugged adapter is told and found again", judged<an_unplugged_adapter_is_told_and_found_again>,
       nullptr, nullptr, nullptr},
      {"link and station live in two threads", judged<link_and_station_live_in_two_threads>, nullptr, nullptr,
       nullptr},
  };
  return cmocka_run_group_tests_name("Modbus faults", tests, nullptr, nullptr);
}
