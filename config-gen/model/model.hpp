// The fully resolved application: what the tables say once groups are flattened, populations expanded, names
// turned into indices and sizes computed. The reader fills it, the checks judge it, the emitter writes it
// out.
//
// An index (`std::size_t`) always points into the Model's vector of that kind. Durations are nanoseconds,
// sizes bytes. Every vector is in table order, which is source order.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/cpu_role.hpp"
#include "config-gen/model/object_list.hpp"
#include "config-gen/model/panel_layers.hpp"
#include "config-gen/model/position.hpp"
#include "config-gen/model/register_map.hpp"
#include "config-gen/model/urdf_chain.hpp"

namespace flexrf::config_gen {

using Index = std::size_t;
using Nanoseconds = std::int64_t;

// Namespaces of generated names: of FlexRF's own tables, and of all others.
constexpr std::string_view library_space = "flexrf";
constexpr std::string_view user_space = "flexrf::user";

// ---- Types
// -----------------------------------------------------------------------------------------------------

enum class Scalar { boolean, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64, text };

struct FieldType {
  enum class Kind { scalar, declared };
  Kind kind = Kind::scalar;
  Scalar scalar = Scalar::boolean;  // kind scalar
  Index declared = 0;               // kind declared: into Model::types, a record or an enumeration
};

// A field of a record, or the value of a parameter. `text` is `capacity` bytes, padded with zeros,
// alignment 1.
struct Field {
  std::string name;
  Position position;
  FieldType type;
  std::vector<std::size_t> shape;  // none: one value; one or two dimensions, two stored column by column
  std::size_t capacity = 0;        // bytes of a text
  std::string unit;                // unit of measure; empty for what has none to declare
  std::string told_unit;           // the same for people: "m/s or rad/s" where each device's row chooses
  std::string summary;
  bool resizable = false;  // a slot's row may give it another shape; the last of its record

  std::size_t offset = 0;  // in the enclosing struct; of one that is resizable behind it
  std::size_t size = 0;    // of the whole array
  std::size_t alignment = 1;

  std::size_t elements() const;  // product of the shape, 1 without
};

struct EnumerationValue {
  std::string name;
  Position position;
  std::string summary;
};

struct Type {
  enum class Kind { record, enumeration };
  std::string name;  // CamelCase
  std::string stem;  // the file's name without .toml
  std::string_view space = user_space;
  std::filesystem::path file;
  Position position;
  Kind kind = Kind::record;
  std::string summary;
  bool image = false;
  bool operated = false;                 // its items are what a person does
  std::vector<Field> fields;             // record
  std::vector<EnumerationValue> values;  // enumeration; at most 256, stored as u8
  std::size_t single_fields = 1;         // scalars and arrays of them, of each element of a record
  std::size_t single_values = 1;         // scalars
  std::size_t size = 0;
  std::size_t alignment = 1;
  std::size_t elements_offset =
      0;  // of a record with a resizable field, its size being that with its own shape:
          // where the struct, which ends there, has its number of elements (u32)

  const Field* resizable() const { return elements_offset == 0 ? nullptr : &fields.back(); }
};

// ---- Values
// ----------------------------------------------------------------------------------------------------

// A value that has been checked against its Field. Arrays are flat (column by column for two dimensions); a
// record has one element per field in field order; an enumeration is its value's number, its name is
// Type::values[n].name.
struct Literal {
  std::variant<std::monostate, bool, std::int64_t, double, std::string> value;  // monostate: see `elements`
  std::vector<Literal> elements;                                                // of an array or a record
  Position position;
};

// ---- Parameters
// ------------------------------------------------------------------------------------------------

enum class PanelRole { viewer, op, engineer, admin };  // `op`: operator, which is a keyword

// A condition: without it a button or a hold has no effect, and a parameter of the configuration cannot be
// set.
struct Need {
  enum class Of { motion, runtime, feedback, configuration };  // the last of conditions only
  Of of = Of::motion;
  std::string field;          // empty: motion
  std::uint64_t numbers = 0;  // bit n: this value of a bool (0, 1) or an enumeration will do
  std::string reason;         // what the operator reads
};

struct Parameter {
  enum class Kind { configuration, runtime, feedback };
  enum class Input {
    value,
    button,
    hold
  };  // of a runtime parameter: button counts presses (u32), hold is a bool
  Kind kind = Kind::configuration;
  Input input = Input::value;
  Field field;                 // name, type, shape, unit, summary; place and size in its block
  std::optional<Literal> low;  // of the range, both or none; bool, int64 or double as the field's type
  std::optional<Literal> high;
  Literal initial;              // the default; zeros for buttons, holds and feedback
  std::optional<Literal> step;  // by what a button of the panel changes it; as the field's element, above 0
  std::string widget;
  std::string label;  // empty: made from the name
  std::string menu;
  PanelRole role = PanelRole::op;
  bool persist = true;           // runtime only
  bool address = false;          // configuration only: what one device alone may have on its bus
  std::vector<Need> needs;       // of a button or a hold: all of them
  std::vector<Need> conditions;  // of a parameter of the configuration that is set: all of them
};

// One generated struct of plain fields: Configuration, Runtime or Feedback.
struct ParameterBlock {
  std::vector<Parameter> parameters;
  std::size_t size = 1;  // an empty struct has size 1
  std::size_t alignment = 1;

  bool empty() const { return parameters.empty(); }
};

// ---- Unit types, interfaces, drivers
// ---------------------------------------------------------------------------

struct InputPort {
  std::string name;
  Position position;
  bool queue = false;  // items of a queue, else the latest of a slot
  Index type = 0;
  Position type_position;
  std::optional<Nanoseconds> max_age;
  bool hold = false;
  bool range = false;
  bool history = false;
  bool optional = false;
  std::string summary;
};

struct OutputPort {
  std::string name;
  Position position;
  bool queue = false;
  Index type = 0;
  Position type_position;
  std::size_t loans = 1;
  bool optional = false;  // no warning when it goes nowhere
  std::string summary;
};

struct DevicePort {
  std::string name;
  Position position;
  Index interface = 0;
  std::string summary;
};

struct UnitType {
  std::string name;         // the table's name: robot_control
  std::string class_name;   // RobotControl
  std::string base_class;   // RobotControlUnit
  std::string header;       // units/robot_control/robot_control.hpp, as the author's file is included
  std::string base_header;  // robot_control_unit.hpp
  std::string_view space = user_space;
  std::filesystem::path file;
  Position position;
  std::string summary;
  std::vector<InputPort> inputs;
  std::vector<OutputPort> outputs;
  std::vector<DevicePort> devices;
  bool cell_access = false;
  ParameterBlock configuration;
  ParameterBlock runtime;
  ParameterBlock feedback;
};

struct Resource {
  enum class Reader { urdf, register_map };
  std::string name;
  Position position;
  Reader reader = Reader::urdf;
  std::string key;  // of the device's row, by which it names the file
  std::string summary;
};

// A unit of measure that each device's row chooses: an axis is measured in m or in rad. Its name stands for
// it in the units of the parameters, as "axis/s".
struct UnitChoice {
  std::string name;
  Position position;
  std::vector<std::string> units;  // one or more, each a single symbol
};

struct Interface {
  std::string name;        // the table's name: robot_arm
  std::string class_name;  // RobotArm
  std::string header;      // hal/robot_arm/interface/robot_arm.hpp
  std::string_view space = user_space;
  std::filesystem::path file;
  Position position;
  std::string summary;
  bool bus = false;       // carries other devices
  bool operated = false;  // a person does something with it
  std::vector<Resource> resources;
  std::vector<OutputPort> outputs;  // published by the device's IO thread
  std::vector<UnitChoice> units;
  ParameterBlock configuration;
  ParameterBlock runtime;
  ParameterBlock feedback;
};

// An option of the command line that a driver reads.
struct DriverOption {
  enum class Kind { flag, text, number, duration, file, output_file, folder };  // order of option_words
  std::string name;
  Position position;
  Kind kind = Kind::flag;
  std::string value;  // how --help calls what follows: "FILE"; of a flag empty
  std::string unit;   // of measure, of a number; empty for what has none
  std::optional<std::pair<double, double>> range;
  std::string summary;
  bool chooses = false;  // given, it chooses this driver where a device permits it

  std::string flag() const {  // as it is given: "--edit-timeout" of edit_timeout
    std::string text = "--" + name;
    std::replace(text.begin(), text.end(), '_', '-');
    return text;
  }
  bool means_the_same(const DriverOption& other) const {
    return kind == other.kind && value == other.value && unit == other.unit && range == other.range &&
           summary == other.summary;
  }
};
constexpr std::array<std::string_view, 7> option_words = {"flag", "text",        "number", "duration",
                                                          "file", "output_file", "folder"};

struct Driver {
  enum class Kind { mock, simulated, real };
  std::string name;         // as in drivers = [...] and --hardware
  std::string stem;         // the file's name without .toml
  std::string class_name;   // SimulatedArm
  std::string base_class;   // SimulatedArmDriver
  std::string header;       // hal/robot_arm/simulated/simulated_arm.hpp
  std::string base_header;  // simulated_arm_driver.hpp
  std::string_view space = user_space;
  std::filesystem::path file;
  Position position;
  std::string summary;
  Index interface = 0;
  Kind kind = Kind::real;
  bool actuates = false;
  bool virtual_time = false;
  bool waits = false;
  std::size_t helper_threads = 0;      // of its own, which may wait
  std::optional<Index> bus_interface;  // the device must be on a bus with this interface
  std::vector<InputPort> inputs;       // the driver's own, as the outputs; the interface's come before
  std::vector<OutputPort> outputs;
  ParameterBlock configuration;  // likewise
  // The driver's own, with places, size and alignment of the struct that begins with the interface's.
  ParameterBlock runtime;
  ParameterBlock feedback;
  std::vector<DriverOption> options;
  bool takes_eds = false;  // a device may name its EDS file, which is checked against:
  std::vector<NeededObject> objects;
};

// ---- The application: slots and queues
// -------------------------------------------------------------------------

// What a slot carries: a type of the tables, or the generated parameter struct of a unit type, an interface
// or a driver that has more than its interface.
struct SlotType {
  enum class Kind {
    declared,
    unit_runtime,
    unit_feedback,
    interface_runtime,
    interface_feedback,
    driver_runtime,
    driver_feedback
  };
  Kind kind = Kind::declared;
  Index index = 0;  // into types, unit_types, interfaces or drivers
};

// Who has ports: a unit; a device, those of its interface; a device, those of one of its drivers.
struct PortOwner {
  enum class Kind { unit, device, driver };
  Kind kind = Kind::unit;
  Index component = 0;  // into units or devices, by kind
  Index choice = 0;     // of a driver: into the device's drivers

  auto operator<=>(const PortOwner&) const = default;
  // Of two drivers of one device one is chosen.
  bool excludes(const PortOwner& other) const {
    return kind == Kind::driver && other.kind == Kind::driver && component == other.component &&
           choice != other.choice;
  }
};

// Who writes: output `port` of its owner; or the executive on behalf of a unit or device, which publishes its
// feedback after each step and the runtime values in force after each change.
struct Writer {
  enum class Kind { output, feedback, values };
  Kind kind = Kind::output;
  PortOwner owner;
  Index port = 0;     // into the owner's outputs; outputs only
  Position position;  // where the connection was written
};

// A reader's share of a slot's buffers: one per thread and slot; a held input has its own, plus one for what
// it keeps.
struct SlotReader {
  enum class Kind { thread, held_input, observer };
  Kind kind = Kind::thread;
  Index thread = 0;         // thread, held_input
  std::size_t first = 0;    // its first reader number in the slot
  std::size_t readers = 1;  // how many reader numbers it uses: 2 for held inputs
};

// One input port of one owner (each has its own cursor on the slot or queue).
struct InputReference {
  PortOwner owner;
  Index port = 0;
  Position position;
};

struct Slot {
  std::string
      name;  // "tool_pose", "tracks[3]", "axis[2].position"; of parameters "jog.feedback", "jog.values"
  Position position;             // its row, or where it was first named
  SlotType type;                 // of a device's parameters: the largest that one of its drivers has
  std::size_t elements = 0;      // of the type's resizable field; 0: it has none
  std::size_t payload_size = 0;  // of the type; 0 until the layout is known
  std::size_t payload_alignment = 1;
  Writer writer;                       // the first; others are other drivers of its device
  std::vector<InputReference> inputs;  // all that read it
  std::vector<SlotReader> readers;     // threads in order, then held inputs, then the observer
  std::size_t reader_count = 0;  // sum of `readers` over all of them: the Readers of Slot<T, Readers, Loans>
  std::size_t loans = 1;
  bool observe = true;
  bool for_panel = false;  // observe = true is written: that nobody reads it is meant
  bool wall = false;
  std::size_t history = 0;       // entries, 0: none
  std::vector<Index> doorbells;  // threads that its publication releases
  std::string summary;
  bool partial = false;  // only with errors: a row that could not be read names it, so it is not judged

  std::size_t buffers() const { return reader_count + 1 + loans; }
};

// A physical queue. `share = "copies"` with several readers has become one Queue per reader, named
// "keys@jog.keys".
struct Queue {
  enum class Policy { drop_newest, drop_oldest };
  std::string name;
  std::string declared;  // the name in the tables, common to all copies
  Position position;
  Index type = 0;
  std::size_t capacity = 16;  // of each writer's ring, or of the whole job pool
  Policy policy = Policy::drop_newest;
  bool jobs = false;           // several readers share one pool; else one ring per writer and one reader
  std::optional<Index> score;  // order by this field of the type, highest first; jobs only
  bool wall = false;
  std::string summary;
  std::vector<Writer> writers;  // table order, which is the order of draining
  std::vector<InputReference> readers;
  std::vector<Index> doorbells;
  bool partial = false;  // as of a slot
};

// ---- Threads
// ---------------------------------------------------------------------------------------------------

struct SourceReference {
  bool queue = false;
  Index index = 0;  // into slots or queues
};

struct PeriodTrigger {
  Nanoseconds period = 0;
  Nanoseconds phase = 0;
};
struct SlotsTrigger {
  std::vector<SourceReference> sources;
  std::optional<Nanoseconds> min_interval;
  std::optional<Nanoseconds> timeout;
};
struct DeviceTrigger {  // the device becomes readable; of an IO thread without period, the thread's own
                        // device
  Index device = 0;
  std::optional<Nanoseconds> min_interval;
  std::optional<Nanoseconds> timeout;
};
struct BackoffTrigger {
  SourceReference source;
  Nanoseconds shortest = 0;
  Nanoseconds longest = 0;
  std::size_t tries = 4;
};
struct FreeTrigger {};
using Trigger = std::variant<PeriodTrigger, SlotsTrigger, DeviceTrigger, BackoffTrigger, FreeTrigger>;

struct Overrun {
  enum class Policy { skip, catch_up, fault };
  enum class Limit { none, consecutive, leaky };
  Policy policy = Policy::skip;
  Limit limit = Limit::none;
  std::size_t consecutive = 0;  // or leaky:
  std::size_t leaky_limit = 0;
  std::size_t leaky_drain = 0;
};

struct Thread {
  std::string name;  // an IO thread has its device's name
  Position position;
  Trigger trigger = FreeTrigger{};
  Position trigger_position;
  int priority = 0;  // 0: not real-time
  CpuRole role = CpuRole::any;
  std::optional<Index> io_device;  // an IO thread: the device that it serves (and, of a bus, all on it)
  std::vector<Index> units;        // step order
  std::vector<Index> devices;      // that live in it, buses before what they carry: the order of receive()
  std::optional<Nanoseconds> hang_timeout;
  std::optional<Nanoseconds> deadline;  // written; else the period or min_interval
  Overrun overrun;
  std::size_t stack = 256 * 1024;
  bool above_interrupts = false;
  std::string summary;

  Nanoseconds demand = 0;                    // sum of the units' budgets
  bool partial = false;                      // only with errors: its trigger could not be read
  bool units_unknown = false;                // only with errors: its list of units could not be read
  std::optional<Nanoseconds> response_time;  // real-time threads with known interval: the analysis' estimate
};

// ---- Devices and units
// -----------------------------------------------------------------------------------------

// Where an output or input goes. Exactly one of the two is used, by the port's kind; both empty: not
// connected.
struct OutputConnection {
  std::optional<Index> slot;
  std::vector<Index> queues;  // several for copies
  Position position;
};
struct InputConnection {
  std::vector<Index> slots;  // one; several, in member order, for range inputs
  std::optional<Index> queue;
  Position position;
};

struct DeviceResource {
  Index resource = 0;  // into the interface's resources
  std::filesystem::path file;
  Position position;
  std::optional<RegisterMap> registers;         // of a register map without errors
  std::optional<UrdfChain> chain;               // of a URDF without errors
  std::vector<std::filesystem::path> packages;  // of a URDF: where package://NAME/ is looked for
};

struct DriverChoice {
  Index driver = 0;
  std::vector<InputConnection> inputs;    // per input of the driver
  std::vector<OutputConnection> outputs;  // per output of the driver
  std::vector<Literal> configuration;     // per parameter of the driver's own block
  std::vector<Literal> runtime;           // likewise
  std::string eds;                        // the EDS file as the row names it; empty: none
  Position eds_position;
};

// What an application changes in how the panel shows one parameter.
struct ParameterOverride {
  std::string parameter;
  Parameter::Kind kind = Parameter::Kind::runtime;
  Position position;
  std::optional<std::string> label;
  std::optional<bool> hidden;
  std::optional<Literal> low;  // both or none; inside the parameter's own range, and enforced
  std::optional<Literal> high;
  std::optional<Literal> step;
  std::optional<std::string> widget;
  Position widget_position;
  std::optional<std::string> menu;
  std::optional<std::string> place;
  Position place_position;
  std::optional<std::string> confirm;  // what a person is asked before it is changed or pressed
};

struct Device {
  std::string name;
  Position position;
  Index interface = 0;
  std::vector<DriverChoice> drivers;  // the first is the default
  // Of each kind (Driver::Kind's order): the place of the driver for a --hardware KIND that this device
  // lacks.
  std::array<std::optional<Index>, 3> instead;
  std::optional<Index> bus;         // on = "..."
  std::vector<Index> children;      // the devices on this bus
  std::optional<Index> owner_unit;  // none: owned by its bus, or served by its IO thread only
  std::optional<Index> owner_port;  // into the unit type's devices
  std::optional<Index> thread;      // in which its calls are made: its IO thread, its bus's, or its owner's
  std::optional<Index> io_thread;
  std::vector<OutputConnection> outputs;  // per output of the interface
  std::vector<DeviceResource> resources;  // in the interface's order
  std::vector<std::string> units;         // chosen, per UnitChoice of the interface
  std::vector<Literal> configuration;     // per parameter of the interface's block
  std::vector<Literal> runtime;
  std::vector<ParameterOverride> overrides;
  Nanoseconds initialise_timeout = 5'000'000'000;
  bool required = true;                // false: the application runs without it, and takes it in later
  std::optional<Index> feedback_slot;  // none when it has no feedback
  std::optional<Index> values_slot;    // runtime values in force; none when it has no runtime parameters
  bool partial = false;                // as of a slot
};

struct Unit {
  enum class Restart { never, once, always };
  std::string name;  // "jog", "tracker[3]", "axis[2].drive"
  Position position;
  Index type = 0;
  std::optional<Index> population;  // and its number in it:
  std::size_t member = 0;
  bool active = true;                         // at start; false only for members of populations
  std::optional<Index> thread;                // always set once checked
  std::vector<InputConnection> inputs;        // per input port
  std::vector<OutputConnection> outputs;      // per output port
  std::vector<std::optional<Index>> devices;  // per device port; always set once checked
  std::vector<Literal> configuration;         // per parameter: the row's value, else the default
  std::vector<Literal> runtime;
  std::vector<ParameterOverride> overrides;
  std::optional<Nanoseconds> budget;
  Position budget_position;
  Nanoseconds initialise_timeout = 5'000'000'000;
  std::optional<Nanoseconds> stop_timeout;  // none: the application's
  Restart restart = Restart::never;
  std::optional<Index> feedback_slot;  // none when it has no feedback
  std::optional<Index> values_slot;    // runtime values in force; none when it has no runtime parameters
  bool partial = false;                // as of a slot
};

struct Population {
  std::string name;
  Position position;
  Index first = 0;  // its members are units[first] ... units[first + capacity - 1]
  std::size_t capacity = 0;
  std::size_t active = 0;
};

// What configuration files written before call otherwise; one for each member of a population.
struct Rename {
  std::string from;  // "jogger", "jog.step_size"
  std::string to;    // "jog", "jog.step"
  Position position;
};

// ---- The panel
// ---------------------------------------------------------------------------------------------------

// [widget.NAME]: what the page shows beside what it builds by itself.
struct PanelWidget {
  using Option = std::variant<bool, std::int64_t, double, std::string>;
  using Roles = std::vector<std::pair<std::string, std::string>>;
  std::string name;
  Position position;
  std::string kind;
  bool custom = false;             // made by widgets/KIND.js beside the table
  std::string label;               // empty: made from the name
  std::string place = "overview";  // or a unit's or device's name
  Roles slots;                     // role, name
  Roles parameters;  // role, and "jog.step", "jog.configuration.limit" or "jog.feedback.presses"
  std::optional<Index> device;
  std::vector<std::pair<std::string, Option>> options;
  std::vector<PanelOverlay> overlays;  // of an image
  std::vector<PanelBodies> bodies;     // of a robot, as the next
  std::vector<PanelFrame> frames;
  std::string base;  // the robot's link in which bodies and frames are told
  std::string summary;
};

// What the application carries for the page.
struct PanelFile {
  std::string path;  // as it is served: "widgets/jog_arrows.js"
  std::string content_type;
  std::filesystem::path file;
};

struct Panel {
  std::size_t connections = 32;
  std::vector<std::string> local;  // addresses
  bool loopback_is_local = true;
  Nanoseconds session_timeout = Nanoseconds{1} * 3600 * 1'000'000'000;
  Nanoseconds session_length = Nanoseconds{8} * 3600 * 1'000'000'000;
  std::vector<PanelWidget> widgets;
  std::vector<PanelFile> files;
};

struct GroupInstance {  // kept for the diagram and the panel; everything in it is already flattened
  std::string name;     // "axis[2]"
  std::string table;    // "axis"
  Position position;
};

// When the configuration file is written while the application runs.
struct SavePolicy {
  bool on_change = true;
  Nanoseconds quiet = 2'000'000'000;
  Nanoseconds interval = 10'000'000'000;
};

struct Application {
  std::string name;  // the table's name
  std::filesystem::path file;
  Position position;
  std::string summary;
  std::optional<std::size_t> memory_budget;
  Position memory_budget_position;
  bool autostart = false;
  Nanoseconds stop_timeout = 2'000'000'000;
  Nanoseconds finish_timeout = 10'000'000'000;
  Nanoseconds standstill_limit = 1'000'000'000;
  SavePolicy save;
};

// ---- The whole
// -------------------------------------------------------------------------------------------------

struct Model {
  std::vector<Type> types;  // a type comes after those it contains
  std::vector<UnitType> unit_types;
  std::vector<Interface> interfaces;
  std::vector<Driver> drivers;

  std::optional<Application> application;
  std::vector<GroupInstance> groups;
  std::vector<Device> devices;
  std::vector<Index> safe_order;  // all devices, children before their buses: the order of make_safe()
  std::vector<Unit> units;
  std::vector<Population> populations;
  std::vector<Rename> renames;
  Panel panel;
  std::vector<Slot> slots;
  std::vector<Queue> queues;
  std::vector<Thread> threads;  // declared threads, then IO threads

  std::vector<std::filesystem::path> files;  // all that was read, for the depfile
};

// Size, alignment and name of what a slot carries.
std::size_t size_of(const Model& model, const SlotType& type);
// With so many elements in its resizable field; 0: it has none.
std::size_t size_of(const Model& model, const SlotType& type, std::size_t elements);
std::size_t alignment_of(const Model& model, const SlotType& type);

}  // namespace flexrf::config_gen
