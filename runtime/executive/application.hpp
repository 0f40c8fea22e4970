// The application as config-gen writes it: tables of constants that name everything there is and where it
// lives. Order within each table is the order of the application's source tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/cpu_role.hpp"
#include "runtime/blackboard/queue.hpp"
#include "runtime/blackboard/slot.hpp"
#include "runtime/device/device.hpp"
#include "runtime/executive/panel_record.hpp"
#include "runtime/executive/state.hpp"
#include "runtime/parameters/rename.hpp"
#include "runtime/unit/unit.hpp"

namespace flexrf {

inline constexpr std::uint16_t no_index = 0xFFFF;

struct SlotRecord {
  const char* name;
  const char* summary;
  SlotControl* control;
  SlotReader* observer;  ///< the observer's reader; null when observe = false
  const char* writer;    ///< "unit.port" or "device.port"; "" for parameters' and feedback's slots
  bool wall;             ///< left out of the digest
};

struct QueueRecord {
  const char* name;
  const char* summary;
  const TypeDescriptor* type;
  std::uint32_t capacity;                 ///< items per writer's ring, or of the pool
  std::span<QueueSink* const> sinks;      ///< one per writer
  std::span<const char* const> writers;   ///< "unit.port" of each sink
  std::span<QueueSource* const> sources;  ///< one per reader
  std::span<const char* const> readers;   ///< "unit.port" of each source
  bool wall;
};

/// Levels on which a component may stand: a device that nothing carries, a device on such a bus, and one
/// level more for each bus that is itself on a bus; a unit. What it stands on is started before it, and
/// stopped after it.
enum : std::uint8_t { level_base, level_carried, level_unit = 0xFF };

/// What the tables say of a unit and of a device alike.
struct ComponentRecord {
  ComponentIndex index;  ///< its own
  const char* kind;      ///< the word for it, for people and in files: "unit", "device"
  const char* name;
  const char* summary;
  std::uint8_t level;
  void* storage;  ///< of the object; of a device: of the largest of its drivers
  std::size_t storage_size;
  std::uint16_t thread;        ///< index of the thread it lives in
  SlotControl* runtime_slot;   ///< runtime parameters in force, sized for the largest driver; null: none
  SlotControl* feedback_slot;  ///< published after each step, sized likewise; null: none
  Duration initialise_timeout;
  Duration stop_timeout;
  std::uint16_t population = no_index;  ///< that it is a member of, or no_index
  std::uint16_t member = 0;             ///< index within the population
  Duration budget{};                    ///< declared execution time of one step; a device takes none
};

struct DriverRecord {
  const char* name;  ///< as in drivers = [...] and --hardware
  DriverKind kind;
  bool actuates;
  bool virtual_time;  ///< can live in virtual time
  std::size_t size;   ///< bytes of the object
  Device* (*construct)(void* storage);
  const ComponentType* type;
  const void* configuration;  ///< initial values from the tables; null where it has none
  const void* runtime;
  std::span<const Option> options = {};  ///< of the command line, that its table declares
  /// Of the device with this driver, the interface's among them; null: it has none of its own, and the
  /// device's are all.
  const PortBinding* ports = nullptr;
};

inline constexpr std::uint8_t no_driver = 0xFF;

/// What the tables say of a device beside that.
struct DevicePart {
  const char* interface;
  std::span<const DriverRecord> drivers;  ///< permitted ones; the first is the default
  /// By DriverKind: index of the driver that a `--hardware KIND` means where none is of that kind.
  std::array<std::uint8_t, 3> instead{no_driver, no_driver, no_driver};
  Device** instance;      ///< where the constructed driver is put
  DeviceBinding binding;  ///< with the interface's ports; the chosen driver's and the bus come at the start
  std::uint16_t bus;      ///< index of the device that carries it, or no_index
  std::uint16_t unit;     ///< index of the unit that owns it, or no_index
  /// False: while the device is not there the application runs without it, and Lifecycle waits for it.
  bool required = true;
};
struct DeviceRecord : ComponentRecord, DevicePart {};

enum class RestartPolicy : std::uint8_t { never, once, always };

/// What the tables say of a unit beside that.
struct UnitPart {
  const ComponentType* type;
  Unit* (*construct)(void* storage);
  UnitBinding binding;
  const void* configuration;  ///< initial values from the tables; null where it has none
  const void* runtime;
  RestartPolicy restart;
};
struct UnitRecord : ComponentRecord, UnitPart {};

struct PopulationRecord {
  const char* name;
  std::uint16_t first_unit;  ///< members are consecutive units
  std::uint16_t capacity;
  std::uint16_t active;  ///< members active after the start
};

enum class TriggerKind : std::uint8_t { period, slots, device, backoff, free };

/// Something whose publications release a thread: a slot or a queue.
struct TriggerSource {
  SlotControl* slot = nullptr;
  QueueSource* queue = nullptr;
};

struct TriggerRecord {
  TriggerKind kind;
  Duration period{};
  Duration phase{};
  Duration min_interval{};                 ///< between releases by slots or device
  Duration timeout{};                      ///< 0: none; else releases without a publication
  std::span<const TriggerSource> sources;  ///< slots; backoff has one
  std::uint16_t device = no_index;
  Duration shortest{};  ///< backoff: bounds of a sleep
  Duration longest{};
  std::uint32_t tries = 0;  ///< backoff: retries on a miss before the estimate widens
};

enum class OverrunPolicy : std::uint8_t { skip, catch_up, fault };

/// When overruns become a fault. Consecutive: `limit` in a row. Leaky: a counter rises by one per overrun,
/// falls by one each `drain` good cycles, and faults at `limit`. limit 0: never.
struct OverrunLimit {
  bool leaky = false;
  std::uint32_t limit = 0;
  std::uint32_t drain = 0;
};

struct ThreadRecord {
  const char* name;
  const char* summary;
  TriggerRecord trigger;
  std::uint8_t priority;  ///< SCHED_FIFO; 0: not real-time
  bool above_interrupts;
  CpuRole role;
  OverrunPolicy overrun;
  OverrunLimit limit;
  Duration budget;                         ///< sum of its units'
  Duration deadline;                       ///< of one release
  Duration hang_timeout{};                 ///< of a step; 0: 500 ms, or 20 deadlines where that is longer
  std::span<const std::uint16_t> units;    ///< in step order
  std::span<const std::uint16_t> devices;  ///< in receive order: buses before what they carry
  void* stack;                             ///< page-aligned, preallocated; the lowest page is the guard
  std::size_t stack_size;                  ///< bytes, guard included
  StepContext* context;
  Doorbell* bell;
};

/// A parameter whose range the application's table narrows.
struct NarrowedRange {
  std::uint16_t component;  ///< units in table order, then devices
  ParameterKind kind;
  const char* parameter;
  double minimum;
  double maximum;
};

/// When the configuration file is written while the application runs; beside that, whenever somebody asks.
struct SavePolicy {
  bool on_change = true;                     ///< by itself, and at the end; false: only when somebody asks
  Duration quiet = std::chrono::seconds{2};  ///< without a further change before it is written
  Duration interval = std::chrono::seconds{10};  ///< at least between two writings; no change waits longer
};

struct Application {
  const char* name;
  const char* summary;
  std::uint64_t descriptor_hash;
  const char* descriptor_json;
  std::size_t memory_budget;  ///< bytes
  bool autostart;
  Duration stop_timeout;
  Duration finish_timeout;
  Duration standstill_limit{};  ///< of a thread or the process, see Standstill; 0: not judged
  SavePolicy save;
  std::span<const SlotRecord> slots;
  std::span<const QueueRecord> queues;
  std::span<const DeviceRecord> devices;
  std::span<const UnitRecord> units;
  std::span<const PopulationRecord> populations;
  std::span<const ThreadRecord> threads;
  std::span<const Rename> renames;  ///< of what older configuration files call otherwise
  std::span<const NarrowedRange> ranges;
  const PanelRecord* panel;  ///< null: as its table's defaults are, without files
  // What the executive keeps, one each.
  std::span<UnitState> unit_states;
  std::span<DeviceState> device_states;
  std::span<ThreadState> thread_states;

  // ---- units and devices as what they have in common

  ComponentIndex component_count() const noexcept {
    return static_cast<ComponentIndex>(units.size() + devices.size());
  }
  const ComponentRecord& component(ComponentIndex component) const noexcept {
    return one_of<const ComponentRecord>(units, devices, component);
  }
  ComponentState& component_state(ComponentIndex component) const noexcept {
    return one_of<ComponentState>(unit_states, device_states, component);
  }

  // Who needs these two does something to the one that there is no word for with the other. Everybody else
  // asks the record, or the state.

  bool is_unit(ComponentIndex component) const noexcept { return component < units.size(); }
  /// Of a component that is no unit.
  std::uint16_t device_of(ComponentIndex component) const noexcept {
    return static_cast<std::uint16_t>(component - units.size());
  }

 private:
  template <class Common, class OfUnits, class OfDevices>
  Common& one_of(OfUnits of_units, OfDevices of_devices, ComponentIndex component) const noexcept {
    if (is_unit(component)) return of_units[component];
    return of_devices[device_of(component)];
  }
};

}  // namespace flexrf
