#include "tests/pick_station/real_station.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <future>
#include <memory>

#include "base/time.hpp"
#include "places.hpp"
#include "runtime/realtime/realtime_scope.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

constexpr auto patience = std::chrono::seconds(60);  // the end of it, for one step
constexpr auto look = std::chrono::milliseconds(20);

// Of vivid's control: all of its picture is white, or black.
constexpr std::int32_t brightest = 255;
constexpr std::int32_t darkest = 0;

Options real_hardware() {
  Options options;
  options.hardware.push_back({"", "real"});
  return options;
}

bool set_interface(const char* name, bool up) {
  const std::string command = std::string{"ip link set dev "} + name + (up ? " up" : " down");
  return std::system(command.c_str()) == 0;
}

template <class Records>
std::uint16_t index_of(const Records& records, const char* name) {
  for (std::size_t i = 0; i < records.size(); ++i)
    if (std::strcmp(records[i].name, name) == 0) return static_cast<std::uint16_t>(i);
  throw fixture::CheckFailed{std::string{"there is no "} + name};
}

}  // namespace

RealStation::RealStation(const char* vendor)
    : drives_(folder_, {place::cia402_simulator, "can1", "--node", "1", "--node", "2", "--position", "5000",
                        "--vendor", vendor, "--product", "0x456"}),
      gripper_(folder_, {place::robotiq_simulator, "--serial", "/dev/ttyS1", "115200"}),
      feeder_(folder_, {place::feeder_simulator, "1502"}),
      running_(application::application, real_hardware(), RightsOfATest::real_time) {
  box_.press_emergency_stop(false);
  tell_gripper("object 0.03");  // a part is there whenever the feeder says so
  light_feeder(true);
}

RealStation::~RealStation() {
  set_interface("can1", true);
  set_interface("lo", true);
  camera_.restore();
}

// ---- what is around it

void RealStation::light_feeder(bool bright) {
  CHECK(camera_.set("Brightness", bright ? brightest : darkest));
}

void RealStation::set_can_cable(bool in) {
  CHECK(set_interface("can1", in));
}

void RealStation::set_network_cable(bool in) {
  CHECK(set_interface("lo", in));
}

// ---- a person

ParameterRequest RealStation::to_pick(RequestKind kind) {
  ParameterRequest request;
  request.kind = kind;
  request.component = running_.unit("pick");
  return request;
}

std::uint16_t RealStation::parameter(const char* name) {
  const auto parameters = running_.application().units[running_.unit("pick")].type->runtime.parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (std::strcmp(parameters[i].field->name, name) == 0) return static_cast<std::uint16_t>(i);
  throw fixture::CheckFailed{std::string{"there is no parameter "} + name};
}

void RealStation::accept(const ParameterRequest& request) {
  const ParameterAnswer answer = running_.ask(request);
  if (answer.kind != AnswerKind::accepted) throw fixture::CheckFailed{answer.reason};
}

void RealStation::press(const char* button) {
  ParameterRequest request = to_pick(RequestKind::press);
  CHECK(request.add_presses(parameter(button)));
  accept(request);
}

void RealStation::change(const char* name, const void* value, std::size_t size) {
  ParameterRequest request = to_pick(RequestKind::set);
  CHECK(request.add(parameter(name), 0, value, size));
  accept(request);
}

void RealStation::initialise(const char* device) {
  const Application& application = running_.application();
  const auto component =
      static_cast<ComponentIndex>(application.units.size() + index_of(application.devices, device));
  auto outcome = std::make_shared<std::promise<std::string>>();
  running_.executive().act(ComponentAction::initialise, component, [outcome](const Status& status) {
    outcome->set_value(status ? "" : status.cause());
  });
  auto told = outcome->get_future();
  CHECK(told.wait_for(patience) == std::future_status::ready);
  CHECK_EQUAL(told.get(), "");
}

int RealStation::stop() {
  const int exit_code = running_.stop().exit_code;
  check_nothing_was_allocated();
  return exit_code;
}

void RealStation::check_nothing_was_allocated() {
  CHECK(has_allocation_guard());
  const Application& application = running_.application();
  bool has_any = false;
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    if (application.threads[i].priority == 0) continue;  // it may allocate
    const ThreadState& thread = application.thread_states[i];
    has_any = has_any || thread.cycles.load() > 0;
    std::fprintf(stderr, "%s allocated %llu times in %llu cycles\n", application.threads[i].name,
                 static_cast<unsigned long long>(thread.allocations.load()),
                 static_cast<unsigned long long>(thread.cycles.load()));
    CHECK_EQUAL(thread.allocations.load(), 0U);
  }
  CHECK(has_any);
}

void RealStation::give_start() {
  wait_for("Start", [this] {
    control().clear_stop_motion();
    if (control().start_motion()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the operator is told each time
    return false;
  });
}

void RealStation::make_ready() {
  give_start();
  wait_for_state("not_homed");
  press("home");
  wait_for_state("ready");
}

// ---- what is read

std::string RealStation::state() {
  const nlohmann::json feedback = told("pick");
  return feedback.is_null() ? "" : feedback.at("state").get<std::string>();
}

void RealStation::wait_for(const char* what, const std::function<bool()>& condition) {
  const Time end = MonotonicClock::now() + patience;
  while (!condition()) {
    if (MonotonicClock::now() > end) {
      throw fixture::CheckFailed{std::string{"it waits in vain for "} + what + ": " + told("pick").dump()};
    }
    std::this_thread::sleep_for(look);
  }
}

void RealStation::wait_for_state(const char* wanted) {
  wait_for(wanted, [&] { return state() == wanted; });
}

void RealStation::wait_for_message(const char* part) {
  wait_for(part, [&] { return text("message").find(part) != std::string::npos; });
}

void RealStation::wait_until_it_carries() {
  wait_for("a part on its way", [this] { return state() == "to_tray" && position_of("axis_x") > 0.2; });
}

void RealStation::wait_for_parts(std::uint64_t parts) {
  wait_for("a part", [&] { return count("parts") >= parts; });
}

}  // namespace flexrf::whole
