#include "runtime/executive/tests/fixture_components.hpp"

#include <algorithm>
#include <cstring>

namespace flexrf::fixture {
namespace {

template <class Struct>
constexpr FieldDescriptor field(const char* name, Scalar scalar, std::size_t offset, const char* unit) {
  return {name, scalar, 0, {0, 0}, 1, static_cast<std::uint32_t>(offset), unit, name, nullptr};
}

constexpr FieldDescriptor item_fields[] = {field<Item>("number", Scalar::i64, offsetof(Item, number), "1"),
                                           field<Item>("value", Scalar::f64, offsetof(Item, value), "m")};
constexpr ByteRange item_bytes[] = {{0, 16}};
constexpr FieldDescriptor configuration_fields[] = {
    field<Configuration>("offset", Scalar::f64, offsetof(Configuration, offset), "m")};
constexpr ByteRange configuration_bytes[] = {{0, 8}};
constexpr FieldDescriptor settings_fields[] = {
    field<Settings>("gain", Scalar::f64, offsetof(Settings, gain), "1"),
    field<Settings>("kick", Scalar::button, offsetof(Settings, kick), ""),
    field<Settings>("move", Scalar::hold, offsetof(Settings, move), "")};
constexpr ByteRange settings_bytes[] = {{0, 13}};
constexpr FieldDescriptor readings_fields[] = {
    field<Readings>("steps", Scalar::u64, offsetof(Readings, steps), "1"),
    field<Readings>("value", Scalar::f64, offsetof(Readings, value), "m")};
constexpr ByteRange readings_bytes[] = {{0, 16}};
}  // namespace

const TypeDescriptor item_type{"Item",      "",         sizeof(Item), alignof(Item), 0x1234,
                               item_fields, item_bytes, {},           false};
const TypeDescriptor configuration_type{"Configuration",        "",     sizeof(Configuration),
                                        alignof(Configuration), 0x1235, configuration_fields,
                                        configuration_bytes,    {},     false};
const TypeDescriptor settings_type{
    "Settings", "", sizeof(Settings), alignof(Settings), 0x1236, settings_fields, settings_bytes, {}, false};
const TypeDescriptor readings_type{
    "Readings", "", sizeof(Readings), alignof(Readings), 0x1237, readings_fields, readings_bytes, {}, false};

namespace {

constexpr ParameterDescriptor parameter(const FieldDescriptor& of, bool has_range = false) {
  return {&of, has_range, has_range, Role::operator_, 0, 10, "", "", ""};
}
constexpr ParameterDescriptor configuration_parameters[] = {parameter(configuration_fields[0])};
constexpr ParameterDescriptor settings_parameters[] = {
    parameter(settings_fields[0], true), parameter(settings_fields[1]), parameter(settings_fields[2])};
constexpr ParameterDescriptor readings_parameters[] = {parameter(readings_fields[0]),
                                                       parameter(readings_fields[1])};

using Direction = PortDescriptor::Direction;
constexpr PortDescriptor device_ports[] = {
    {"input", Direction::input, "Item", ""},
    {"output", Direction::output, "Item", ""},
    {"orders", Direction::queue_output, "Item", ""},
};
constexpr PortDescriptor unit_ports[] = {
    {"first", Direction::input, "Item", ""},
    {"second", Direction::input, "Item", ""},
    {"third", Direction::input, "Item", ""},
    {"fourth", Direction::input, "Item", ""},
    {"out_first", Direction::output, "Item", ""},
    {"out_second", Direction::output, "Item", ""},
    {"out_third", Direction::output, "Item", ""},
    {"out_fourth", Direction::output, "Item", ""},
    {"jobs", Direction::queue_input, "Item", "", true},
    {"orders", Direction::queue_output, "Item", ""},
    {"device", Direction::device, "Actuator", "Arrows move it.", true},
};

}  // namespace

const Configuration TestUnit::default_configuration{0.5};
const Settings TestUnit::default_settings{1.0, 0, false};
const ComponentType TestUnit::type{"test_unit",
                                   "A unit whose behaviour is the test's.",
                                   {&configuration_type, configuration_parameters},
                                   {&settings_type, settings_parameters},
                                   {&readings_type, readings_parameters},
                                   unit_ports};
const ComponentType TestDevice::type{"test_device", "A device whose behaviour is the test's.", {}, {}, {},
                                     device_ports};

// ---- events

void Events::add(std::string_view who, std::string_view what) {
  const std::lock_guard lock(mutex_);
  events_.push_back(std::string{who} + ": " + std::string{what});
}

std::vector<std::string> Events::all() const {
  const std::lock_guard lock(mutex_);
  return events_;
}

std::size_t Events::place_of(std::string_view event) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::find(events_.begin(), events_.end(), event);
  return found == events_.end() ? never : static_cast<std::size_t>(found - events_.begin());
}

std::size_t Events::count_of(std::string_view event) const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(std::count(events_.begin(), events_.end(), event));
}

// ---- unit

Status TestUnit::initialise() {
  events_->add(name(), "initialise");
  return script_->initialise ? script_->initialise(*this) : Status{};
}

void TestUnit::step(const Tick& tick) {
  if (script_->step) script_->step(*this, tick);
}

void TestUnit::stop() {
  events_->add(name(), "stop");
  if (script_->stop) script_->stop(*this);
}

void TestUnit::reset() noexcept {
  memory = 0;
  events_->add(name(), "reset");
}

Status TestUnit::accept_runtime(const void* proposed) noexcept {
  return script_->accept ? script_->accept(*static_cast<const Settings*>(proposed)) : Status{};
}

void TestUnit::connect(const UnitBinding& binding) noexcept {
  for (std::size_t i = 0; i < binding.inputs.size(); ++i)
    inputs[i].connect(binding.context, binding.inputs[i]);
  for (std::size_t i = 0; i < binding.outputs.size(); ++i)
    outputs[i].connect(binding.context, binding.outputs[i]);
  jobs.connect(binding.queue_inputs[0]);
  orders.connect(binding.context, binding.queue_outputs[0]);
  device = binding.devices.empty() ? nullptr : static_cast<TestDevice*>(*binding.devices[0]);
}

// ---- device

Status TestDevice::initialise() {
  events_->add(name(), "initialise");
  return script_->initialise ? script_->initialise(*this) : Status{};
}

void TestDevice::stop() {
  events_->add(name(), "stop");
  if (script_->stop) script_->stop(*this);
}

void TestDevice::receive(const Tick& tick) noexcept {
  if (script_->receive) script_->receive(*this, tick);
}

void TestDevice::send(const Tick& tick) noexcept {
  if (!is_inhibited() && position != command) {
    position = command;
    ++moves;
  }
  if (script_->send) script_->send(*this, tick);
}

bool TestDevice::make_safe() noexcept {
  events_->add(name(), "make_safe");
  return !script_->make_safe || script_->make_safe(*this);
}

void TestDevice::connect(const DeviceBinding& binding) noexcept {
  input.connect(binding.context, binding.input(0));
  output.connect(binding.context, binding.output(0));
  jobs.connect(binding.queue_input(0));
  orders.connect(binding.context, binding.queue_output(0));
}

}  // namespace flexrf::fixture
