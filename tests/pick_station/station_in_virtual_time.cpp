#include "tests/pick_station/station_in_virtual_time.hpp"

#include <cstring>

#include "hal/gpio/chip/mock/mock_gpio_chip.hpp"
#include "hal/gpio/chip/simulated/simulated_gpio_chip.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::pick_station {
namespace {

Options options_for(const char* hardware) {
  Options options;
  options.hardware.push_back({"", hardware});
  options.virtual_time = std::chrono::hours(24);  // run() says when it ends
  options.realtime = false;
  options.digest = true;
  return options;
}

template <class Records>
std::uint16_t index_of(const Records& records, const char* name) {
  std::uint16_t i = 0;
  while (std::strcmp(records[i].name, name) != 0) ++i;
  return i;
}

}  // namespace

StationInVirtualTime::StationInVirtualTime(const char* hardware)
    : executive_(application::application, options_for(hardware)) {
  const Status status = executive_.prepare();
  if (!status) throw fixture::CheckFailed{std::string{"prepare: "} + status.cause()};
  requester_ = executive_.cell().add_requester(answers_);
  const Application& application = executive_.cell().application();
  pick_ = index_of(application.units, "pick");
  const std::uint16_t control = index_of(application.threads, "control");
  clock_ = application.threads[control].context;
  cycles_ = &application.thread_states[control].cycles;
  feedback_ = &told_by<PickSequenceFeedback>("pick");
}

RunSummary StationInVirtualTime::run(Duration longest, std::function<void(Time)> world) {
  world_ = std::move(world);
  const Time end = Time{} + std::chrono::seconds(1) + longest;
  when(
      "the end", [] { return true; }, [this] { executive_.request_end(); });
  std::function<void()> job;
  job = [this, end, &job] {
    look();
    if (looked_at_ > end || !problem_.empty()) executive_.request_end();
    executive_.lifecycle().post(job);
  };
  executive_.lifecycle().post(job);
  const RunSummary summary = executive_.run();
  if (!problem_.empty()) throw fixture::CheckFailed{problem_};
  if (place_ < steps_.size()) {
    throw fixture::CheckFailed{"it waits in vain for: " + steps_[place_].what + "; it says: " + message() +
                               " / " + remedy()};
  }
  return summary;
}

/// On the thread of the virtual time, between two events: nothing else runs.
void StationInVirtualTime::look() {
  const std::uint64_t cycle = cycles_->load();
  if (cycle == cycle_) return;
  cycle_ = cycle;
  looked_at_ = clock_->now;
  ParameterAnswer answer;
  while (answers_.pop(answer)) {
    const bool in_vain = answer.correlation == in_vain_number;
    if (in_vain && (answer.kind != AnswerKind::unmet || answer.reason != in_vain_)) {
      problem_ =
          "a press was to be refused, as it " + in_vain_ + ": " + name_of(answer.kind) + " " + answer.reason;
    } else if (!in_vain && answer.kind != AnswerKind::accepted) {
      problem_ = std::string{"refused: "} + answer.reason;
    }
  }
  try {
    if (world_) world_(looked_at_);
    go_on(looked_at_);
  } catch (const fixture::CheckFailed& failed) {
    problem_ = failed.message;
  }
}

void StationInVirtualTime::go_on(Time now) {
  if (place_ == steps_.size() || !steps_[place_].condition()) return;
  const Step& step = steps_[place_];
  stepped_at_ = now;
  ++place_;
  if (step.act) step.act();
}

StationInVirtualTime& StationInVirtualTime::when(std::string what, std::function<bool()> condition,
                                                 std::function<void()> act) {
  steps_.push_back({std::move(what), std::move(condition), std::move(act)});
  return *this;
}

StationInVirtualTime& StationInVirtualTime::when_in(PickState state, std::function<void()> act) {
  return when(
      "state " + std::to_string(static_cast<int>(state)), [this, state] { return seen().state == state; },
      std::move(act));
}

StationInVirtualTime& StationInVirtualTime::after(Duration pause, std::function<void()> act) {
  return when(
      "a pause", [this, pause] { return looked_at_ - stepped_at_ >= pause; }, std::move(act));
}

StationInVirtualTime& StationInVirtualTime::clear_and_start() {
  return when("Start is accepted", [this] {
    control().clear_stop_motion();
    return control().start_motion().is_ok();
  });
}

StationInVirtualTime& StationInVirtualTime::leave_fault_and_home() {
  when_in(PickState::off).after(std::chrono::seconds(1)).clear_and_start();
  when_in(PickState::fault, [this] { press("reset"); });
  return when_in(PickState::not_homed, [this] { press("home"); });
}

StationInVirtualTime& StationInVirtualTime::make_ready() {
  clear_and_start();
  when_in(PickState::not_homed, [this] { press("home"); });
  return when_in(PickState::ready);
}

std::uint16_t StationInVirtualTime::parameter(std::uint16_t unit, const char* name) {
  const Application& application = executive_.cell().application();
  const auto parameters = application.units[unit].type->runtime.parameters;
  std::uint16_t i = 0;
  while (std::strcmp(parameters[i].field->name, name) != 0) ++i;
  return i;
}

const void* StationInVirtualTime::feedback_of(const char* component) {
  const Application& application = executive_.cell().application();
  for (std::size_t i = 0; i < application.units.size(); ++i) {
    if (std::strcmp(application.units[i].name, component) == 0)
      return application.unit_states[i].unit->parameter_memory().feedback;
  }
  return find(component).parameter_memory().feedback;
}

void StationInVirtualTime::press_in_vain(const char* button, const char* reason) {
  in_vain_ = reason;
  send_press(button, in_vain_number);
}

void StationInVirtualTime::press(const char* button) {
  send_press(button, 0);
}

void StationInVirtualTime::send_press(const char* button, std::uint64_t correlation) {
  ParameterRequest request;
  request.correlation = correlation;
  request.kind = RequestKind::press;
  request.component = pick_;
  request.requester = requester_;
  CHECK(request.add_presses(parameter(pick_, button)));
  executive_.cell().send(request);
}

void StationInVirtualTime::change(const char* unit, const char* name, const void* value, std::size_t size) {
  ParameterRequest request;
  request.kind = RequestKind::set;
  request.component = index_of(executive_.cell().application().units, unit);
  request.requester = requester_;
  CHECK(request.add(parameter(request.component, name), 0, value, size));
  executive_.cell().send(request);
}

Device& StationInVirtualTime::find(const char* name) {
  const Application& application = executive_.cell().application();
  return *application.device_states[index_of(application.devices, name)].device;
}

std::uint64_t StationInVirtualTime::restraints() {
  std::uint64_t count = 0;
  for (const DeviceState& device : executive_.cell().application().device_states)
    count += device.restraint.count();
  return count;
}

void StationInVirtualTime::initialise(const char* device) {
  const Application& application = executive_.cell().application();
  const auto component =
      static_cast<ComponentIndex>(application.units.size() + index_of(application.devices, device));
  executive_.act(ComponentAction::initialise, component, [this](const Status& status) {
    if (!status) problem_ = std::string{"initialise: "} + status.cause();
  });
}

void StationInVirtualTime::plug_box(bool in) {
  const auto plug = [in](auto& chip) { in ? chip.plug_in() : chip.unplug(); };
  Device& box = find("box");
  if (auto* const mock = dynamic_cast<MockGpioChip*>(&box)) return plug(*mock);
  plug(dynamic_cast<SimulatedGpioChip&>(box));
}

void StationInVirtualTime::press_emergency_stop(bool pressed) {
  Device& box = find("box");
  VirtualLine& line = dynamic_cast<MockGpioChip*>(&box) != nullptr
                          ? dynamic_cast<MockGpioChip&>(box).line("ESTOP")
                          : dynamic_cast<SimulatedGpioChip&>(box).line("ESTOP");
  line.drive(!pressed);
}

bool StationInVirtualTime::is_lit(const char* line) {
  Device& box = find("box");
  return dynamic_cast<MockGpioChip*>(&box) != nullptr
             ? dynamic_cast<MockGpioChip&>(box).line(line).is_high()
             : dynamic_cast<SimulatedGpioChip&>(box).line(line).is_high();
}

}  // namespace flexrf::pick_station
