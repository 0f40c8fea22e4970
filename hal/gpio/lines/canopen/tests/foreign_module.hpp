// ForeignModule: a bought CANopen module for digital inputs and outputs, as the standards describe it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/can/interface/can_node.hpp"

namespace flexrf {

/// CiA 301 v4.2 and CiA 401 v3, frame by frame. It was written from the standards and from vendors' manuals
/// by somebody who had not seen the code of this repository that speaks CANopen, and it shares none with it:
/// what the two agree on is the standard. Where vendors differ, Settings has a switch, and its default is
/// what most of them do.
///
/// It reads no clock. One thread.
class ForeignModule {
 public:
  struct Settings {
    std::uint8_t node = 5;                               ///< node-ID, 1 to 127
    std::size_t input_bytes = 2;                         ///< 1 to 8: sub-indices of 6000h
    std::size_t output_bytes = 1;                        ///< 1 to 8: sub-indices of 6200h
    std::uint32_t vendor = 0x04C1;                       ///< 1018h:01
    std::uint32_t product = 0x16080;                     ///< 1018h:02
    std::uint32_t revision = 0x00010003;                 ///< 1018h:03
    std::uint32_t serial = 20260042;                     ///< 1018h:04
    std::string name = "Foreign DIO 16/8";               ///< 1008h; more than four characters go in segments
    Duration boot_time = std::chrono::milliseconds{20};  ///< from power or reset to the boot-up message: deaf
    Duration sdo_answer_time{};  ///< a request that comes before the answer to the one before is lost

    // ---- what is optional in the standards
    std::size_t heartbeat_consumers = 1;       ///< sub-indices of 1016h, 0 to 127; 0: no 1016h
    std::uint16_t heartbeat_milliseconds = 0;  ///< 1017h at power-on
    bool has_error_behaviour = true;           ///< 1029h; without it as with 0 (pre-operational)
    bool has_interrupt_masks = true;           ///< 6005h to 6008h; without them every change sends the TPDO
    bool has_polarity = true;                  ///< 6002h and 6202h
    bool has_input_filter = false;             ///< 6003h
    bool has_error_values = true;   ///< 6206h and 6207h; without them a fault sets all outputs to 0
    bool has_output_filter = true;  ///< 6208h
    Duration filter_time = std::chrono::milliseconds{2};  ///< of inputs whose bit in 6003h is set

    // ---- what vendors do differently
    bool enables_interrupts = false;      ///< 6005h is 1 at power-on
    bool is_silent_without_them = false;  ///< 6005h = 0 stops every TPDO, not only those of changes
    bool sends_tpdo_at_start = true;  ///< once when it, or the TPDO, becomes operational, without a change
    bool starts_itself = false;       ///< operational after boot-up, without NMT (1F80h bit 2)
    bool has_fixed_mapping = false;   ///< 1600h and 1A00h are read only
    bool locks_cob_ids = false;       ///< 1400h:01 and 1800h:01 may not be written when operational
    bool keeps_disabled_cob_ids = false;      ///< what sets bit 31 may not change the CAN-ID at the same time
    bool refuses_remote_requests = false;     ///< 1800h:01 must have bit 30 set
    std::uint16_t least_event_timer = 0;      ///< ms; a smaller 1800h:05 but 0 is refused, 06090032h
    bool raises_event_timer = false;          ///< a too small 1800h:05 becomes least_event_timer instead
    bool keeps_outputs_on_reset = false;      ///< NMT Reset Node leaves the outputs as they are
    bool keeps_outputs_when_paused = false;   ///< so do Enter Pre-Operational and Reset Communication
    bool keeps_outputs_when_stopped = false;  ///< so does Stop: only a fault sets error values
    bool returns_to_old_outputs = false;      ///< to 6200h as before a fault, as soon as operational again
    bool says_no_error_after_boot = false;    ///< an EMCY with error code 0 behind the boot-up message
  };

  enum class State : std::uint8_t { off, initialising, pre_operational, operational, stopped };

  /// Without power.
  explicit ForeignModule(const Settings& settings);

  /// With power already: as if it had been gone for a moment.
  void power_on(Time now);
  /// Silent, and all outputs 0.
  void power_off();

  /// A frame of another node. `now` never goes back, over all functions.
  void hear(const CanFrame& frame, Time now);
  /// What it has said until now and was not yet collected, in its order; `time` is when.
  std::vector<CanFrame> step(Time now);
  /// When it next says or does something by itself; Time::max(): never.
  Time next_event() const;

  /// The levels at its terminals: bit 0 is input 1, bit 8 the first of 6000h:02. Seen at the next hear() or
  /// step().
  void set_inputs(std::uint64_t levels) { terminals_ = levels; }
  /// `number` counts from 1.
  void set_input(unsigned number, bool on);
  /// The levels of its outputs; bit 0 is output 1.
  std::uint64_t outputs() const;

  State state() const { return state_; }
  /// What the object dictionary holds now; nothing: there is no such object, or it is a string.
  std::optional<std::uint32_t> object(std::uint16_t index, std::uint8_t sub) const;

 private:
  enum class Access : std::uint8_t { read_only, read_write };
  enum class Mapping : std::uint8_t { none, transmit, receive };
  struct Object {
    std::uint32_t value = 0;
    std::uint8_t size = 0;  // bytes
    Access access = Access::read_only;
    Mapping mapping = Mapping::none;
  };
  struct Consumer {
    bool is_watching = false;  // from the first heartbeat on
    bool is_lost = false;
    Time deadline{};
  };
  struct Upload {
    std::uint16_t index = 0;
    std::uint8_t sub = 0;
    std::string data;
    std::size_t sent = 0;
    std::uint8_t toggle = 0;
  };
  using Data = std::array<std::uint8_t, 8>;

  // Object dictionary
  void add(std::uint16_t index, std::uint8_t sub, std::uint8_t size, Access access, std::uint32_t value,
           Mapping mapping = Mapping::none);
  void add_bytes(std::uint16_t index, std::size_t count, Access access, std::uint8_t value,
                 Mapping mapping = Mapping::none);
  void remove(std::uint16_t first_index, std::uint16_t last_index);
  void lay_out_communication();
  void lay_out_application();
  bool has(std::uint16_t index) const;
  std::uint32_t& at(std::uint16_t index, std::size_t sub);
  std::uint32_t value_or(std::uint16_t index, std::size_t sub, std::uint32_t other) const;

  // Time
  Time next_timer() const;
  void run_until(Time now);
  void run_timers();
  void advance(Time now);

  // NMT and error control
  void initialise(bool with_application);
  void boot();
  void command(const CanFrame& frame);
  void enter(State next);
  void heartbeat_from(std::uint8_t node);
  void watch_heartbeats();
  std::uint8_t state_byte() const;

  // EMCY
  void report(std::uint16_t code, std::uint16_t information);
  void relieve();
  void say_emergency(std::uint16_t code, std::uint16_t information);

  // SDO
  void serve(const Data& request);
  void upload(std::uint16_t index, std::uint8_t sub);
  void upload_segment(std::uint8_t specifier);
  void download(const Data& request, std::uint16_t index, std::uint8_t sub);
  std::uint32_t missing(std::uint16_t index) const;
  std::uint32_t write(std::uint16_t index, std::uint8_t sub, std::uint32_t size, std::uint32_t value);
  std::uint32_t check(std::uint16_t index, std::uint8_t sub, std::uint32_t& value);
  std::uint32_t check_pdo_parameter(std::uint16_t index, std::uint8_t sub, std::uint32_t& value);
  std::uint32_t check_pdo_cob_id(std::uint16_t index, std::uint32_t value);
  std::uint32_t check_mapping(std::uint16_t index, std::uint8_t sub, std::uint32_t value);
  std::uint32_t check_mapped(std::uint32_t entry, Mapping direction) const;
  std::uint32_t check_consumer(std::uint8_t sub, std::uint32_t value) const;
  void written(std::uint16_t index, std::uint8_t sub);
  void abort(std::uint16_t index, std::uint8_t sub, std::uint32_t code);
  void answer(std::uint8_t specifier, std::uint16_t index, std::uint8_t sub, std::uint32_t data);

  // PDO
  bool is_valid(std::uint16_t communication) const;
  bool is_event_driven() const;
  bool is_silenced() const;
  bool is_mapped(std::uint16_t index, std::size_t sub) const;
  void receive_pdo(const CanFrame& frame);
  void apply_pdo(const Data& data);
  void send_pdo();
  void synchronise();
  void restart_tpdo(std::uint8_t sub);

  // Process
  bool is_filtered(std::size_t input) const;
  void scan();
  void change_inputs(std::size_t byte, std::uint8_t fresh);
  void set_output(std::size_t byte, std::uint32_t levels);
  void drive(std::size_t byte);
  void take_error_values();

  void say(std::uint32_t identifier, const Data& data, std::uint8_t length);

  Settings settings_;
  std::map<std::uint32_t, Object> objects_;  // by index << 8 | sub-index
  State state_ = State::off;
  Time clock_{};
  std::vector<CanFrame> said_;

  Time boot_at_{};
  Time heartbeat_at_{};
  std::vector<Consumer> consumers_;
  bool has_length_fault_ = false;

  std::optional<Upload> upload_;
  std::optional<Data> request_;  // waits for its answer
  Time answer_at_{};

  std::optional<Data> latched_;  // RPDO that waits for SYNC
  bool is_pending_ = false;      // an event has asked for the TPDO
  Time inhibited_until_{};
  Time event_timer_from_{};
  std::uint32_t syncs_ = 0;  // since the last TPDO

  static constexpr std::size_t most_bytes = 8;
  std::uint64_t terminals_ = 0;
  std::uint64_t settled_ = 0;                            // terminals_ behind the filter
  std::array<std::optional<Time>, 64> differs_since_{};  // of filtered inputs
  std::array<std::uint8_t, most_bytes> pins_{};
  std::array<std::uint8_t, most_bytes> in_error_{};  // outputs that show their error value
};

/// Puts the module on a wire, in virtual or in real time: it has power from the wire's first call on.
class ForeignModuleNode final : public CanNode {
 public:
  explicit ForeignModuleNode(ForeignModule& module) : module_(module) {}
  void on_frame(const CanFrame& frame, CanPort& port) noexcept override;
  Time next_event() const noexcept override;
  void on_time(Time now, CanPort& port) noexcept override;

 private:
  void collect(Time now, CanPort& port);

  ForeignModule& module_;
  bool was_attached_ = false;
  Time now_{};
};

}  // namespace flexrf
