// The cell: the application's objects, constructed in place and connected, and what stands beside each.
#pragma once

#include <array>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "runtime/executive/application.hpp"
#include "runtime/executive/cell_access.hpp"
#include "runtime/executive/control.hpp"
#include "runtime/executive/narrowed_type.hpp"
#include "runtime/executive/options.hpp"
#include "runtime/executive/step_trace.hpp"
#include "runtime/parameters/audit_intake.hpp"
#include "runtime/parameters/parameter_store.hpp"
#include "runtime/parameters/request.hpp"

namespace flexrf {

class ValueSaver;
struct FieldPlace;

/// What of one component's values belongs into the configuration file: copies, and what somebody has set.
struct ComponentSettings {
  std::vector<std::byte> configuration;  ///< empty: it has none
  std::vector<std::byte> runtime;
  SetMarks configuration_marks;
  SetMarks runtime_marks;
};

/// The payload is the generated application's; the cell constructs and destroys what lives there. Built and
/// torn down by the main thread; between the two, each part belongs to the thread that the design names.
class Cell {
 public:
  static constexpr std::size_t max_requesters = 32;

  Cell(const Application& application, const Options& options);
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;
  ~Cell();

  /// Chooses drivers, constructs devices and units in table order, connects them, fills in the tables'
  /// parameters.
  Status construct();
  /// Units in reverse order, then devices.
  void destroy() noexcept;
  /// For a restart in place: destroys and constructs a unit with the values it had; a device stays as it is.
  /// Lifecycle thread, owning the component.
  Status renew(ComponentIndex component) noexcept;
  /// Before it is initialised, again too: the device and its bus are connected, and its ports begin anew.
  /// Lifecycle thread, owning the device.
  void connect_device(std::uint16_t device) noexcept;

  const Application& application() const noexcept { return *application_; }
  const Options& options() const noexcept { return *options_; }
  /// Where everything that a person does is told, whichever way he came in. Any thread.
  AuditIntake& audit() noexcept { return *audit_; }
  /// Stop motion, for this person or part ("emergency stop"). Any thread.
  void stop_motion(std::string_view who) noexcept;
  void clear_stop_motion(std::string_view who) noexcept;
  Status start_motion(std::string_view who) noexcept;
  Control& control() noexcept { return control_; }
  const Control& control() const noexcept { return control_; }
  Heartbeat& heartbeat() noexcept { return heartbeat_; }

  const DriverRecord& driver(std::uint16_t device) const noexcept {
    return *application_->device_states[device].driver;
  }
  /// Of a component that has none "".
  const char* driver_name(ComponentIndex component) const noexcept;
  /// Names of the drivers that the component's row permits and that were not chosen.
  std::span<const char* const> other_drivers(ComponentIndex component) const noexcept {
    return other_drivers_[component];
  }
  ComponentIndex component_count() const noexcept { return application_->component_count(); }
  /// " (driver NAME)", or "" where there is none: for messages, behind its name.
  std::string driver_text(ComponentIndex component) const;
  /// What it reads and writes: of a device with the driver that was chosen.
  const PortBinding& ports(ComponentIndex component) const noexcept { return *ports_[component]; }
  /// Nobody takes from this queue: the drivers that would were not chosen.
  bool is_abandoned(const QueueSource* source) const noexcept;
  /// The devices that move where this component does: those that belong to the unit; of a device itself.
  std::span<const std::uint16_t> devices_of(ComponentIndex component) const noexcept {
    return devices_of_[component];
  }
  /// All components, each after those that it stands on, else in the order of the tables: devices that
  /// nothing carries, devices on buses, units.
  std::span<const ComponentIndex> in_starting_order() const noexcept { return starting_order_; }
  /// How long a thread or the process may do nothing before that is a fault; 0: as long as it likes.
  Duration standstill_limit() const noexcept {
    return options_->standstill_limit.value_or(application_->standstill_limit);
  }
  const char* component_name(ComponentIndex component) const noexcept {
    return application_->component(component).name;
  }
  /// The object: its owning thread, and whoever knows that nobody restarts it. Others ask component_type().
  Component& component(ComponentIndex component) const noexcept { return parameters_[component].component(); }
  /// ComponentState::type. Any thread, from construct() on.
  const ComponentType& component_type(ComponentIndex component) const noexcept {
    return *application_->component_state(component).type;
  }
  /// Copies the configuration values of the component as they were set last, at most `size` bytes; the object
  /// itself may be under restart. How many there are, 0: none. Any non-real-time thread.
  std::size_t copy_configuration(ComponentIndex component, void* to, std::size_t size) const;
  /// Rises with each initialisation and reconfiguration: the values may be others than before. Any thread.
  std::uint64_t configuration_revision() const noexcept {
    return configuration_revision_.load(std::memory_order_acquire);
  }
  /// The values in the component's memory are those that count now. Lifecycle thread; before the start: the
  /// main thread.
  void note_configuration(ComponentIndex component);
  RuntimeParameters& parameters(ComponentIndex component) noexcept { return parameters_[component]; }

  /// From here on somebody may ask for the steps that threads take. Main thread, before any of them runs.
  void keep_step_traces() {
    if (step_traces_ == nullptr) step_traces_ = std::make_unique<StepTraces>(application_->threads.size());
  }
  /// Null: nobody may.
  StepTraces* step_traces() noexcept { return step_traces_.get(); }

  // ---- for who keeps the configuration file

  /// The values in the component's memory are those of the file, which gives the marked ones. Main thread,
  /// before the start.
  void restore_settings(ComponentIndex component, const ComponentSettings& settings);
  /// Somebody has set this place of the configuration, whose value lies in the component's memory. Lifecycle
  /// thread.
  void note_configuration_set(ComponentIndex component, const FieldPlace& place);
  /// What is set, and the values with it. Any non-real-time thread.
  void copy_settings(ComponentIndex component, ComponentSettings& settings) const;
  /// Rises whenever what copy_settings() gives of any component becomes another. Any thread.
  std::uint64_t settings_revision() const noexcept {
    return settings_revision_.load(std::memory_order_acquire);
  }
  /// Who saves them; null: nobody. Set before anything runs.
  ValueSaver* saver() const noexcept { return saver_; }
  void set_saver(ValueSaver& saver) noexcept { saver_ = &saver; }

  ParameterScratch& scratch(std::uint16_t thread) noexcept { return scratch_[thread]; }

  /// Sends a request to the thread that owns its component; busy or refused is answered at once. Any thread.
  void send(const ParameterRequest& request) noexcept;
  /// Registers who waits for answers; its number goes into the requests. Before the start. 0 is nobody.
  std::uint16_t add_requester(AnswerQueue& answers) noexcept;
  void answer(std::uint16_t requester, const ParameterAnswer& answer) noexcept;
  RequestQueue& requests(std::uint16_t thread) noexcept { return requests_[thread]; }

  /// The observer's readers (SlotRecord::observer) serve one at a time: whoever reads a slot with one holds
  /// this lock while it takes the newest item and copies or writes it out, and no longer. Status view,
  /// report, panel; never a real-time thread, none of which reads as the observer.
  [[nodiscard]] std::unique_lock<std::mutex> observe() const { return std::unique_lock(observing_); }

  /// The chosen driver is of the kind `real`, and so is that of each bus that carries it.
  bool is_real(std::uint16_t device) const noexcept;
  /// The first device that would move something real; null: none.
  const char* real_actuator() const noexcept;
  /// A device that actuates, or a unit that owns one. Any thread.
  bool moves_something(ComponentIndex component) const noexcept;
  /// How readers see what the component writes.
  void set_writer_state(ComponentIndex component, WriterState state) noexcept;
  /// Publishes the cause, then that it is in fault. Who owns the component.
  void set_fault(ComponentIndex component, const Status& cause) noexcept;
  /// In virtual time, where publications wait: makes what the component published in its step visible.
  void commit(ComponentIndex component) noexcept;
  /// Virtual time: publications wait for commit, and are digested unless marked wall.
  void prepare_virtual_time(bool digest) noexcept;
  /// Of every slot and queue that is not marked wall: name, and all that was published.
  std::uint64_t digest() const noexcept;

 private:
  Status choose_drivers();
  void choose_ports() noexcept;
  void narrow_ranges();
  void choose_witnesses();
  Duration longest_step_of(const ThreadRecord& thread) const noexcept;
  Status construct_device(std::uint16_t device);
  Status construct_unit(std::uint16_t unit);
  Status construct(ComponentIndex component);
  Status give_access(std::uint16_t unit, CellAccess& access);

  const Application* application_;
  const Options* options_;
  std::vector<Doorbell*> bells_;
  std::vector<std::vector<const char*>> other_drivers_;  // per component, as the next three
  std::vector<std::vector<std::uint16_t>> devices_of_;
  std::vector<const PortBinding*> ports_;
  std::vector<ComponentIndex> starting_order_;
  Control control_;
  std::vector<MotionWitness> threads_that_move_;
  std::vector<SafetyWitness> actuators_;
  std::unique_ptr<AuditIntake> audit_;
  Heartbeat heartbeat_;
  std::unique_ptr<RuntimeParameters[]> parameters_;  // one per component
  std::unique_ptr<RequestQueue[]> requests_;         // one per thread
  std::unique_ptr<ParameterScratch[]> scratch_;      // one per thread
  std::deque<NarrowedType> narrowed_;
  std::array<AnswerQueue*, max_requesters> requesters_{};
  std::uint16_t requester_count_ = 1;
  std::deque<CellAccess::Post> posts_;
  mutable std::mutex observing_;
  mutable std::mutex configuration_mutex_;
  std::unique_ptr<std::vector<std::byte>[]> configurations_;  // one per component, as it was initialised
  std::atomic<std::uint64_t> configuration_revision_{0};
  // Of the configuration: what of it is set, and the values then. One per component.
  struct ConfigurationSettings {
    std::vector<std::byte> values;
    SetMarks marks;
  };
  std::unique_ptr<ConfigurationSettings[]> configuration_settings_;
  std::atomic<std::uint64_t> settings_revision_{0};
  std::unique_ptr<StepTraces> step_traces_;
  ValueSaver* saver_ = nullptr;
};

}  // namespace flexrf
