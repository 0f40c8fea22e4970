// SensorBench: a force-torque sensor and its slot, for tests.
#pragma once

#include "hal/driver/device_bench.hpp"
#include "hal/force_torque/conformance/force_torque_conformance.hpp"

namespace flexrf {

template <class Driver>
class SensorBench {
 public:
  DeviceBench<Driver>& bench() { return bench_; }
  Driver& driver() { return bench_.driver(); }
  SlotControl* slot() { return &slot_.control(); }

 private:
  Slot<Wrench, 1> slot_;  // outlives the driver
  DeviceBench<Driver> bench_{nullptr, {}, nullptr, slot()};
};

/// A world whose sensor is a driver on a bench.
template <class Driver>
class BenchWorld : public ForceTorqueWorld {
 public:
  /// `start`: of its clock.
  explicit BenchWorld(Time start = Time{std::chrono::seconds(1)}) : now_(start) {}

  ForceTorqueSensor& sensor() override { return sensor_.driver(); }
  const ForceTorqueSensorFeedback& feedback() override { return sensor_.bench().feedback(); }
  ForceTorqueSensorRuntime& runtime() override { return sensor_.bench().runtime(); }
  SlotControl* slot() override { return sensor_.slot(); }
  Time now() const override { return now_; }

 protected:
  void advance(Duration elapsed) {
    sensor_.bench().receive(elapsed);
    now_ = sensor_.bench().now();
  }
  auto& bench() { return sensor_.bench(); }
  Driver& driver() { return sensor_.driver(); }

 private:
  SensorBench<Driver> sensor_;
  Time now_;
};

}  // namespace flexrf
