// A CiA 402 drive as a stranger would build it: from CiA 301 and CiA 402 alone, without a line of the
// master's or of the simulated drive's, so that it shares no view with them. Only the frame is theirs.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "hal/canopen/message.hpp"

namespace flexrf {

/// Acts on each object as it is written, as the standard permits: on a controlword before the target behind
/// it. Position in increments, velocity in increments/s, without ramps. Told the time in steps of 1 ms.
class ForeignDrive {
 public:
  struct Nature {
    std::uint8_t node = 5;
    double position = 1000;
    /// Enters operation by itself so many ms after its boot-up (object 1F80, bit 2 clear); nothing: it does
    /// not.
    std::optional<int> starts_itself{};
    bool starts_again = false;              ///< and once more, after it was brought back to pre-operational
    std::vector<std::uint32_t> lacks{};     ///< index << 8 | subindex
    std::vector<std::uint32_t> unmapped{};  ///< likewise: in no PDO
    std::vector<std::uint32_t> constant{};  ///< likewise: cannot be written
    std::uint16_t identifier_of_first = 0;  ///< of RPDO 1; 0: as CiA 301 predefines it
    int serves_after = 0;                   ///< ms until it looks at a request by SDO
    bool acts_at_last = false;              ///< on a controlword behind all else that came before SYNC
    bool leaves_bit_12 = false;             ///< of its statusword at 0 in cyclic position, as older drives do
    bool changes_mode_off = false;          ///< it takes another mode only while it is off
    /// Knows no bit 5 of the controlword: takes a target only when it is at the one before, and acknowledges
    /// it until then.
    bool finishes_targets = false;
    bool refuses_what_is_so = false;    ///< to be written what an object is already, in any state
    bool homes_without_bit_10 = false;  ///< that its home is found it says by bit 12 alone
    std::optional<std::uint32_t> quick_stop_option{};  ///< object 605A; nothing: it has none
    std::optional<std::uint32_t> window{};             ///< object 6067; nothing: it has none
    double stops_short = 0;     ///< increments before its target; it says that it is there within its window
    bool interpolates = false;  ///< of the position modes it has interpolated position (7) alone
  };
  struct SetPoint {
    std::int32_t target = 0;
    std::uint32_t speed = 0;
  };

  explicit ForeignDrive(const Nature& nature);

  void receive(const canopen::Message& frame, canopen::Outbox& answers);
  void step(canopen::Outbox& says);

  double position() const { return position_; }
  bool is_enabled() const { return state_ == State::operation_enabled; }
  /// What it took in mode profile position, with the speed that was there then.
  const std::vector<SetPoint>& set_points() const { return set_points_; }
  /// The farthest that an interpolation point which it followed ever was from the axis, in increments.
  double longest_jump() const { return longest_jump_; }
  /// As when points stay away: what comes is ignored from now on, until bit 4 of the controlword rises anew.
  void stop_interpolation() { interpolates_now_ = false; }
  /// Something holds its axis, and nothing in it notices.
  void stick() { sticks_ = true; }
  /// Bits of its statusword that it says beside its state.
  void say_beside(std::uint16_t bits, std::uint16_t never = 0) {
    beside_ = bits;
    never_ = never;
  }
  /// 0 where there is none.
  std::uint32_t object(std::uint16_t index, std::uint8_t subindex = 0) const;
  /// Aborts that it answered with.
  const std::vector<std::uint32_t>& aborts() const { return aborts_; }
  /// Modes that it was told, and did not take because it was not off.
  unsigned modes_refused() const { return modes_refused_; }

 private:
  enum class State { off, ready, switched_on, operation_enabled, quick_stop, fault };

  struct Entry {
    std::uint32_t value = 0;
    unsigned bytes = 4;
    bool writable = true;
    bool mappable = false;
  };

  void add(std::uint16_t index, std::uint8_t subindex, unsigned bytes, std::uint32_t value, bool writable,
           bool mappable);
  void boot();
  void obey(std::uint8_t command);
  void serve(const canopen::Message& request, canopen::Outbox& answers);
  std::uint32_t write(std::uint16_t index, std::uint8_t subindex, unsigned bytes, std::uint32_t value);
  std::uint32_t refusal_of(std::uint16_t index, std::uint8_t subindex, std::uint32_t value) const;
  void act_on(std::uint16_t index, std::uint8_t subindex);
  void take_controlword();
  void synchronise(canopen::Outbox& says);
  void unpack(std::uint16_t number, const canopen::Message& frame);
  void move();
  std::uint16_t statusword() const;

  Nature nature_;
  std::map<std::uint32_t, Entry> objects_;
  std::uint8_t nmt_ = 0;  // as a heartbeat says it
  int boots_in_ = 20;
  std::optional<int> starts_in_;
  int beats_in_ = 0;
  int master_silent_ = -1;  // ms; below 0: never heard
  std::map<std::uint16_t, canopen::Message> waiting_;
  std::optional<canopen::Message> asked_;  // by SDO
  int serves_in_ = 0;

  State state_ = State::off;
  std::uint16_t word_ = 0;
  double position_;
  double velocity_ = 0;
  double ramped_ = 0;  // in mode profile velocity
  double goal_ = 0;
  double goal_speed_ = 0;
  bool word_came_ = false;
  bool point_came_ = false;
  bool acknowledged_ = false;
  bool reached_ = true;
  bool homed_ = false;
  bool interpolates_now_ = false;
  bool sticks_ = false;
  std::uint16_t beside_ = 0;
  std::uint16_t never_ = 0;
  double longest_jump_ = 0;
  std::vector<SetPoint> set_points_;
  std::vector<std::uint32_t> aborts_;
  unsigned modes_refused_ = 0;
};

}  // namespace flexrf
