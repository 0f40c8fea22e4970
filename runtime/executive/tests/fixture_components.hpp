// Units and devices for tests: what they do is functions that the test gives.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/device/device.hpp"
#include "runtime/unit/unit.hpp"

namespace flexrf::fixture {

/// What travels through the test applications' slots and queues.
struct Item {
  std::int64_t number;
  double value;
};

struct Configuration {
  double offset;
};

struct Settings {
  double gain;         ///< 0 to 10; 1 in the tables
  std::uint32_t kick;  ///< button
  bool move;           ///< hold
};

struct Readings {
  std::uint64_t steps;
  double value;
};

/// Order of acts, from any thread.
class Events {
 public:
  static constexpr std::size_t never = static_cast<std::size_t>(-1);

  /// As "producer: initialise".
  void add(std::string_view who, std::string_view what);
  std::vector<std::string> all() const;
  /// Place of its first occurrence, or never.
  std::size_t place_of(std::string_view event) const;
  std::size_t count_of(std::string_view event) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> events_;
};

class TestUnit;
class TestDevice;

/// Empty functions do nothing and succeed. The script outlives the object: a restarted unit has the same.
struct UnitScript {
  std::function<Status(TestUnit&)> initialise;
  std::function<void(TestUnit&, const Tick&)> step;
  std::function<void(TestUnit&)> stop;
  std::function<bool(const TestUnit&)> is_idle;
  std::function<Status(const Settings&)> accept;
};

struct DeviceScript {
  std::function<Status(TestDevice&)> initialise;
  std::function<void(TestDevice&, const Tick&)> receive;
  std::function<void(TestDevice&, const Tick&)> send;
  std::function<void(TestDevice&)> stop;
  std::function<bool(TestDevice&)> make_safe;
  std::function<int()> descriptor;
  std::function<Time()> next_event;
  std::function<bool()> is_closed;
  std::function<bool()> demands_safe_state;  ///< given: the device guards motion
};

class TestUnit final : public Unit {
 public:
  static constexpr std::size_t ports = 4;

  TestUnit(const UnitScript& script, Events& events) : script_(&script), events_(&events) {}
  ~TestUnit() override { events_->add(name(), "destroy"); }

  std::array<Input<Item>, ports> inputs;
  std::array<Output<Item>, ports> outputs;
  QueueInput<Item> jobs;
  QueueOutput<Item> orders;
  TestDevice* device = nullptr;
  Configuration configuration{};
  Settings runtime{};
  Readings feedback{};
  std::int64_t memory = 0;  ///< the script's own; zero after construction and reset()

  using Unit::fail;
  using Unit::restrain;

  Status initialise() override;
  void step(const Tick& tick) override;
  void stop() override;
  void reset() noexcept override;
  bool is_idle() const noexcept override { return !script_->is_idle || script_->is_idle(*this); }

  const ComponentType& component_type() const noexcept override { return type; }
  ParameterMemory parameter_memory() noexcept override { return {&configuration, &runtime, &feedback}; }
  Status accept_runtime(const void* proposed) noexcept override;
  void connect(const UnitBinding& binding) noexcept override;
  InputCounters input_counters(std::size_t input, std::size_t member) const noexcept override {
    return inputs[input].counters(member);
  }

  static const ComponentType type;
  static const Configuration default_configuration;
  static const Settings default_settings;

 private:
  const UnitScript* script_;
  Events* events_;
};

class TestDevice final : public Device {
 public:
  TestDevice(const DeviceScript& script, Events& events) : script_(&script), events_(&events) {}
  ~TestDevice() override { events_->add(name(), "destroy"); }

  Input<Item> input;
  Output<Item> output;
  QueueInput<Item> jobs;
  QueueOutput<Item> orders;
  double command = 0;      ///< what its unit commands
  double position = 0;     ///< follows the command while not inhibited
  std::int64_t moves = 0;  ///< how often the position changed

  using Device::environment;
  using Device::fail;

  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;
  void send(const Tick& tick) noexcept override;
  bool make_safe() noexcept override;
  int descriptor() const noexcept override { return script_->descriptor ? script_->descriptor() : -1; }
  Time next_event() const noexcept override {
    return script_->next_event ? script_->next_event() : Time::max();
  }
  bool is_closed() const noexcept override { return script_->is_closed && script_->is_closed(); }
  bool guards_motion() const noexcept override { return static_cast<bool>(script_->demands_safe_state); }
  bool demands_safe_state() const noexcept override {
    return script_->demands_safe_state && script_->demands_safe_state();
  }

  const ComponentType& component_type() const noexcept override { return type; }
  ParameterMemory parameter_memory() noexcept override { return {}; }
  void connect(const DeviceBinding& binding) noexcept override;
  InputCounters input_counters(std::size_t /*input*/, std::size_t /*member*/) const noexcept override {
    return input.counters();
  }

  static const ComponentType type;

 private:
  const DeviceScript* script_;
  Events* events_;
};

}  // namespace flexrf::fixture

namespace flexrf {
namespace fixture {

extern const TypeDescriptor item_type;
extern const TypeDescriptor configuration_type;
extern const TypeDescriptor settings_type;
extern const TypeDescriptor readings_type;

}  // namespace fixture

template <>
inline constexpr const TypeDescriptor* descriptor_of<fixture::Item> = &fixture::item_type;
template <>
inline constexpr const TypeDescriptor* descriptor_of<fixture::Configuration> = &fixture::configuration_type;
template <>
inline constexpr const TypeDescriptor* descriptor_of<fixture::Settings> = &fixture::settings_type;
template <>
inline constexpr const TypeDescriptor* descriptor_of<fixture::Readings> = &fixture::readings_type;

}  // namespace flexrf
