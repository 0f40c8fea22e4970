// For tests of drivers and units: a driver with what the executive gives it, and cycles by hand.
#pragma once

#include <span>

#include "runtime/blackboard/queue_ring.hpp"
#include "runtime/device/device.hpp"

namespace flexrf {

/// A queue of its own, for a test to read what a device pushes.
template <class T, std::size_t Capacity = 16>
class QueueBench {
 public:
  QueueRing& ring() { return ring_; }
  std::span<QueueSink* const> sinks() const { return sinks_; }
  std::optional<T> pop() {
    T value{};
    ItemHeader header{};
    if (!ring_.pop(&value, header)) return std::nullopt;
    return value;
  }
  bool push(const T& value, Time at = Time{Duration{1}}) { return ring_.push(&value, at); }

 private:
  QueueRingMemory<T, Capacity> memory_{};
  QueueRing ring_{descriptor_of<T>, memory_.view(), DropPolicy::drop_newest};
  QueueSink* sinks_[1] = {&ring_};
};

/// A driver, from construction to cycles, on a clock that moves as the test says. It may move from the start.
template <class Driver>
class DeviceBench {
 public:
  /// `resource`: of interfaces that have one, else null. `sinks`: where the device's queue output goes.
  /// `bus`: of a device on one, else null. `output`: the slot of its first output, or null.
  explicit DeviceBench(const void* resource, std::span<QueueSink* const> sinks = {}, Device* bus = nullptr,
                       SlotControl* output = nullptr)
      : resources_{resource}, outputs_{output}, queue_outputs_{sinks} {
    DeviceBinding binding;
    binding.outputs = outputs_;
    binding.queue_outputs = queue_outputs_;
    binding.resources = resources_;
    binding.bus = bus;
    connect(binding);
  }
  /// Of a driver with ports of its own: inputs, and outputs behind those of its interface. What the spans of
  /// `binding` refer to outlives the bench; its context is the bench's.
  explicit DeviceBench(DeviceBinding binding) { connect(binding); }

  Driver& driver() { return driver_; }
  DeviceEnvironment& environment() { return environment_; }
  auto& configuration() {
    return *static_cast<typename Driver::Configuration*>(driver_.parameter_memory().configuration);
  }
  const auto& feedback() {
    return *static_cast<const typename Driver::Feedback*>(driver_.parameter_memory().feedback);
  }
  auto& runtime() { return *static_cast<typename Driver::Runtime*>(driver_.parameter_memory().runtime); }
  Time now() const { return tick_.now; }
  const Tick& tick() const { return tick_; }

  /// The clock moves on, the device receives; send() ends the cycle.
  void receive(Duration elapsed) {
    tick_.now += elapsed;
    tick_.nominal = tick_.now;
    tick_.elapsed = elapsed;
    context_.now = tick_.now;
    ++context_.step;
    driver_.receive(tick_);
  }
  void send() {
    ++context_.step;
    driver_.send(tick_);
  }

 private:
  void connect(DeviceBinding& binding) {
    driver_.set_environment(&environment_);
    driver_.set_inhibited(false);
    binding.context = &context_;
    driver_.connect(binding);
  }

  StepContext context_;
  Tick tick_{.nominal = Time{std::chrono::seconds(1)}, .now = Time{std::chrono::seconds(1)}};
  DeviceEnvironment environment_{.seed = 1, .virtual_time = true};
  const void* resources_[1]{};
  SlotControl* outputs_[1]{};
  std::span<QueueSink* const> queue_outputs_[1];
  Driver driver_;
};

}  // namespace flexrf
