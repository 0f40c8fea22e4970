// A small application made by hand, for tests of whatever runs applications: units and a device whose
// behaviour is the test's own functions, and the records that config-gen would have written.
#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/executive/application.hpp"
#include "runtime/executive/options.hpp"
#include "runtime/executive/tests/fixture_components.hpp"

namespace flexrf::fixture {

/// Where a test is not about a time-out, only a hang exceeds it: on a loaded machine each thread may stand
/// still for seconds at any point.
inline constexpr Duration patience = std::chrono::minutes{1};
/// Of a step: what counts as a hang are 20 of them.
inline constexpr Duration patient_deadline = std::chrono::seconds{1};
/// A step that takes half a second hangs.
inline constexpr Duration strict_deadline = std::chrono::milliseconds{1};

struct TriggerPlan {
  TriggerKind kind = TriggerKind::period;
  Duration period = std::chrono::milliseconds{1};
  Duration phase{};
  Duration min_interval{};
  Duration timeout{};
  std::vector<std::uint16_t> slots;   ///< sources: these first,
  std::vector<std::uint16_t> queues;  ///< then these
  std::uint16_t device = no_index;
  Duration shortest{};
  Duration longest{};
  std::uint32_t tries = 4;

  static TriggerPlan periodic(Duration period, Duration phase = {});
  static TriggerPlan on_slots(std::vector<std::uint16_t> slots, std::vector<std::uint16_t> queues = {});
  static TriggerPlan on_device(std::uint16_t device);
  static TriggerPlan backing_off(std::uint16_t slot, Duration shortest, Duration longest);
  static TriggerPlan free_running();
};

struct SlotPlan {
  std::string name;
  bool wall = false;
  bool observe = true;
};

/// Of Items; one ring per writer, at most one reader.
struct QueuePlan {
  std::string name;
  std::uint32_t capacity = 16;
  DropPolicy policy = DropPolicy::drop_newest;
};

struct InputPlan {
  std::uint16_t slot = no_index;  ///< no_index: not connected
  Duration max_age{};
};

struct UnitPlan {
  std::string name;
  UnitScript script;
  std::vector<InputPlan> inputs;       ///< at most TestUnit::ports
  std::vector<std::uint16_t> outputs;  ///< slots, likewise
  std::uint16_t pops = no_index;       ///< queue
  std::uint16_t pushes = no_index;     ///< queue
  std::uint16_t device = no_index;
  bool parameters = true;  ///< slots for its runtime parameters and feedback
  RestartPolicy restart = RestartPolicy::never;
  Duration budget = std::chrono::microseconds{50};
  Duration initialise_timeout = patience;
  Duration stop_timeout = patience;
};

struct DevicePlan {
  std::string name;
  DeviceScript script;
  DriverKind kind = DriverKind::mock;
  bool actuates = true;
  bool virtual_time = true;
  std::uint16_t bus = no_index;
  std::uint16_t reads = no_index;   ///< slot
  std::uint16_t output = no_index;  ///< slot
  std::uint16_t pops = no_index;    ///< queue
  std::uint16_t pushes = no_index;  ///< queue
  Duration initialise_timeout = patience;
  bool required = true;
  std::span<const Option> options = {};  ///< of the command line
};

struct ThreadPlan {
  std::string name;
  TriggerPlan trigger;
  std::vector<std::uint16_t> units;    ///< in step order
  std::vector<std::uint16_t> devices;  ///< buses first
  std::uint8_t priority = 0;
  OverrunPolicy overrun = OverrunPolicy::skip;
  OverrunLimit limit{};
  Duration deadline = patient_deadline;
  Duration hang_timeout{};
};

struct PopulationPlan {
  std::string name;
  std::uint16_t first_unit;
  std::uint16_t capacity;
  std::uint16_t active;
};

/// An application in the making, and what it is made of. Add and change plans, then ask for application(),
/// once; the plans are fixed from then on. One object per run: states are not set back.
class TestApplication {
 public:
  TestApplication();
  ~TestApplication();
  TestApplication(const TestApplication&) = delete;
  TestApplication& operator=(const TestApplication&) = delete;

  /// Each returns the index in its table.
  std::uint16_t add(SlotPlan slot);
  std::uint16_t add(QueuePlan queue);
  std::uint16_t add(DevicePlan device);
  std::uint16_t add(UnitPlan unit);
  std::uint16_t add(ThreadPlan thread);
  void add(PopulationPlan population);

  UnitPlan& unit(std::uint16_t index) { return units_[index]; }
  DevicePlan& device(std::uint16_t index) { return devices_[index]; }
  ThreadPlan& thread(std::uint16_t index) { return threads_[index]; }
  SlotPlan& slot(std::uint16_t index) { return slots_[index]; }
  QueuePlan& queue(std::uint16_t index) { return queues_[index]; }

  bool autostart = true;
  Duration stop_timeout = patience;
  Duration finish_timeout = patience;
  std::span<const Rename> renames;
  SavePolicy save;

  /// Makes the records at the first call.
  const Application& application();

  // ---- after application()

  const UnitState& unit_state(std::uint16_t index) const { return unit_states_[index]; }
  const DeviceState& device_state(std::uint16_t index) const { return device_states_[index]; }
  const ThreadState& thread_state(std::uint16_t index) const { return thread_states_[index]; }
  SlotControl& slot_control(std::uint16_t index) { return *slot_records_[index].control; }
  /// What was initialised, made safe, stopped, in which order.
  Events& events() { return events_; }

 private:
  struct Made;

  void make_threads();
  void make_slots();
  void make_queues();
  void make_devices();
  void make_units();
  void fill_application();
  SlotControl* make_slot(const char* name, const char* writer, const TypeDescriptor& type,
                         std::uint8_t readers, std::vector<Doorbell*> bells, bool observe, bool wall);
  SlotReader* reader_of(std::uint16_t thread, std::uint16_t slot);
  std::uint16_t thread_of_unit(std::uint16_t unit) const;
  std::uint16_t thread_of_device(std::uint16_t device) const;
  std::vector<Doorbell*> bells_of(const std::vector<std::uint16_t> TriggerPlan::*sources,
                                  std::uint16_t index);
  const char* keep(std::string text);

  std::vector<SlotPlan> slots_;
  std::vector<QueuePlan> queues_;
  std::vector<DevicePlan> devices_;
  std::vector<UnitPlan> units_;
  std::vector<ThreadPlan> threads_;
  std::vector<PopulationPlan> populations_;

  Events events_;
  std::unique_ptr<Made> made_;
  std::vector<SlotRecord> slot_records_;
  std::vector<UnitState> unit_states_;
  std::vector<DeviceState> device_states_;
  std::vector<ThreadState> thread_states_;
  Application application_{};
};

/// Two units in two threads, joined by a slot and a queue; the consumer owns an actuator.
///
/// The producer publishes its step's number and pushes it too, every millisecond, until it is to finish. The
/// consumer is released by either, reads the slot, empties the queue and commands the actuator. Change what a
/// test is about.
class ProducerAndConsumer : public TestApplication {
 public:
  ProducerAndConsumer();

  static constexpr std::uint16_t values = 0;  ///< slot
  static constexpr std::uint16_t jobs = 0;    ///< queue
  static constexpr std::uint16_t producer = 0;
  static constexpr std::uint16_t consumer = 1;
  static constexpr std::uint16_t actuator = 0;
  static constexpr std::uint16_t producing = 0;  ///< thread
  static constexpr std::uint16_t consuming = 1;  ///< thread
};

/// A step of either thread that takes half a second hangs.
class StrictProducerAndConsumer : public ProducerAndConsumer {
 public:
  StrictProducerAndConsumer() {
    thread(producing).deadline = strict_deadline;
    thread(consuming).deadline = strict_deadline;
  }
};

Options in_virtual_time(Duration duration, std::uint64_t seed = 1);
/// Ordinary priorities.
Options on_the_wall_clock();

}  // namespace flexrf::fixture
