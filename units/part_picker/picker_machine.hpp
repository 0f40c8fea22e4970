// PickerMachine: takes parts that a camera on the hand sees, one after the other, each into the bin of its
// kind, and finds its way back from whatever goes wrong. It knows no ports: it is told what is seen and
// wished, and says where the tool shall go and what the gripper shall do.
//
// All places are of the tip, the point between the fingertips, in the robot's frame; the tool points straight
// down. Position-based visual servoing (Hutchinson, Hager, Corke 1996): the part's place follows its track,
// which is measured anew in each picture, until the camera no longer sees it from so near.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>

#include "base/time.hpp"
#include "types/gripper_object.hpp"
#include "types/picker_state.hpp"
#include "types/track_list.hpp"
#include "units/part_picker/grasp_choice.hpp"
#include "units/part_picker/travel_path.hpp"

namespace flexrf::user {

struct PickerBin {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d size = Eigen::Vector2d::Zero();    ///< m, its sides along x and y
  bool exists() const noexcept { return size.x() > 0; }
  bool contains(const Eigen::Vector2d& place) const noexcept {
    return ((place - middle).cwiseAbs().array() < size.array() / 2).all();
  }
};

/// Lengths in m, angles in rad.
struct PickerPlan {
  HandShape hand;
  HandRoom room;
  Eigen::Vector3d look_out = Eigen::Vector3d::Zero();
  double hand_angle =
      0;  ///< of the closing direction at the look-out; grasps turn as little as they can from it
  double travel_height = 0;    ///< above all that stands on the table
  double look_height = 0;      ///< above the grasp: from there the part is measured last
  double straight_height = 0;  ///< above the grasp: below it goes straight down
  double slanted_speed = 0;    ///< m/s, from the look to there: what comes into the way is seen in time
  double grasp_height = 0;     ///< above the table
  double drop_height = 0;      ///< above the table, in the bin
  double bin_look_offset = 0;  ///< behind a place in the bin: from there the camera sees it
  Eigen::Vector2d base = Eigen::Vector2d::Zero();  ///< the arm's first axis
  double nearest = 0;                              ///< from there it reaches
  double farthest = 0;
  const KnownParts* parts = nullptr;         ///< never null; as long as the machine is used
  std::array<PickerBin, most_kinds> bins{};  ///< by kind; of no size: such parts are left where they are
  std::span<const KeepOut> keep_outs;
};

struct PickerWishes {
  bool pick = true;
  bool open_gripper = false;  ///< pressed
  std::uint32_t survey_pictures = 8;
  std::uint32_t survey_after = 0;  ///< parts; 0: only where no part is known that can be picked
  std::uint32_t look_pictures = 4;
  Duration patience{};     ///< for a part to be seen again
  Duration leg_timeout{};  ///< for a way to be gone
  Duration rest{};         ///< for which a part that failed is left alone
};

struct PickerView {
  Time now{};
  bool may_move = false;
  bool stop_requested = false;
  bool finishing = false;             ///< the application ends: nothing new is begun
  const TrackList* tracks = nullptr;  ///< null: the camera tells nothing
  bool tracks_are_new = false;        ///< others than in the step before
  bool nobody_looks = false;          ///< for what is new on the table: then no way is begun to another part
  std::optional<Eigen::Isometry3d> tool;
  bool others_lead = false;    ///< a hand, or a mode in which the arm does not follow
  bool arm_rests = false;      ///< on the stream of poses
  const char* arm_holds = "";  ///< why it does
  bool arm_is_in_fault = false;
  struct {
    bool known = false;
    bool activated = false;
    bool moving = false;
    std::optional<double> opening;  ///< m; nothing: it is not known
    GripperObject object = GripperObject::unknown;
    const char* trouble = "";
  } gripper;
};

enum class PickerAct : std::uint8_t { none, activate, open, close };

/// A place on the table into which the hand goes down next, and what the hand takes up there: a box about
/// `middle`, whose y points to `angle`. In m and rad.
struct PickerWatch {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double angle = 0;
  Eigen::AlignedBox2d room;
};

class PickerMachine {
 public:
  void begin(const PickerPlan& plan) noexcept;
  void step(const PickerView& view, const PickerWishes& wishes) noexcept;
  /// The arm may not come to where the plan has it look at the whole table.
  bool is_look_out_kept_out() const noexcept { return paths_.is_kept_out(plan_.look_out.head<2>()); }

  // ---- what is to be done

  /// Where the tool shall go; nothing: the arm shall hold.
  const std::optional<Eigen::Isometry3d>& target() const noexcept { return target_; }
  /// Number of the straight way on which the target lies.
  std::uint32_t way() const noexcept { return way_; }
  /// m/s, no faster; 0: as fast as the arm may.
  double speed() const noexcept {
    return state_ == PickerState::descending && !is_straight_ ? plan_.slanted_speed : 0;
  }
  PickerAct act() const noexcept { return act_; }
  double opening() const noexcept { return opening_; }  ///< m, of PickerAct::open

  // ---- what it is at

  PickerState state() const noexcept { return state_; }
  /// Why, where the state has several causes; lives for ever.
  const char* cause() const noexcept { return cause_; }
  /// Identity of the track that it goes to; 0: none.
  std::uint32_t track() const noexcept { return track_.identity; }
  /// The part that it goes to or holds, as seen last.
  const ObjectTrack& part() const noexcept { return track_; }
  /// After begin().
  const KnownParts& parts() const noexcept { return *plan_.parts; }
  const Grasp& grasp() const noexcept { return grasp_; }
  bool holds_part() const noexcept { return in_hand_; }
  /// The release of a part was interrupted: whether it lies in its bin the next look at the table tells.
  bool is_in_doubt() const noexcept { return doubt_.has_value(); }
  /// The arm does not move where it is led, and does not say why.
  bool is_stuck() const noexcept { return stuck_on_.has_value(); }
  /// The place that the camera has to show before the hand goes down there; nothing: it goes down nowhere.
  const std::optional<PickerWatch>& watch_for() const noexcept { return watch_for_; }
  /// There is a part between the fingers, or was until just now.
  bool shows_part() const noexcept { return shows_part_; }
  /// Where it lies in the tool's frame: a box around it, upright as the hand is.
  Eigen::AlignedBox3d held_box() const noexcept;
  bool is_at_rest() const noexcept {
    return state_ == PickerState::off || state_ == PickerState::paused || state_ == PickerState::waiting ||
           state_ == PickerState::blocked || state_ == PickerState::unreachable ||
           state_ == PickerState::unknown_in_hand || state_ == PickerState::gripper_trouble;
  }

  struct Counters {
    std::uint64_t approaches = 0;  ///< begun
    std::uint64_t binned = 0;
    std::uint64_t lost_targets = 0;
    std::uint64_t failed_grasps = 0;
    std::uint64_t lost_parts = 0;
    std::uint64_t given_up = 0;  ///< approaches that were not finished, as the way became blocked or too long
    std::uint64_t interrupted = 0;  ///< approaches that others came between
    std::array<std::uint64_t, most_kinds> approaches_by_kind{};
    std::array<std::uint64_t, most_kinds> binned_by_kind{};
    double cycle_time = 0;  ///< s, from bin to bin
  };
  const Counters& counters() const noexcept { return counters_; }
  void clear_counters() noexcept { counters_ = {}; }

 private:
  struct Doubt {
    std::uint16_t kind = 0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of the part, if it fell where it was let go
    bool was_moved = false;                           // meanwhile: it may have fallen elsewhere
  };
  struct LeftAlone {
    std::uint32_t identity = 0;
    Time until{};
  };

  bool supervise() noexcept;
  void leave_off() noexcept;
  bool watch_gripper() noexcept;
  bool watch_person() noexcept;
  bool watch_arm() noexcept;
  bool watch_sight() noexcept;
  bool watch_progress() noexcept;
  void act_in_state() noexcept;

  void survey() noexcept;
  std::size_t confirmed_things() const noexcept;
  void watch() noexcept;
  void choose(bool has_surveyed) noexcept;
  const ObjectTrack* find_part(const HandRoom& room, Grasp& best_grasp, const char*& blocked_by,
                               bool& out_of_reach) const noexcept;
  HandRoom ample_room() const noexcept;
  bool is_candidate(const ObjectTrack& track) const noexcept;
  bool is_left_alone(std::uint32_t identity) const noexcept;
  void leave_alone(std::uint32_t identity) noexcept;
  bool is_in_reach(const ObjectTrack& track) const noexcept;
  bool is_in_bin(const ObjectTrack& track) const noexcept;
  double cost_of(const Grasp& grasp) const noexcept;
  bool follow_track() noexcept;
  const char* what_blocks_now() noexcept;
  void approach() noexcept;
  void look() noexcept;
  void descend() noexcept;
  void close() noexcept;
  void lift() noexcept;
  void begin_carrying() noexcept;
  void carry() noexcept;
  void look_into_bin() noexcept;
  void wait_beside_bin(const char* why) noexcept;
  void look_from_elsewhere() noexcept;
  void lower() noexcept;
  void release() noexcept;
  double release_opening() const noexcept;
  bool have_let_go() const noexcept;
  void count_binned(std::size_t kind) noexcept;
  void drop_from_hand() noexcept;
  bool is_in_its_bin() const noexcept;
  void fail(PickerState state, const char* cause) noexcept;
  void push_on() noexcept;
  void rise_and_go_on() noexcept;
  bool find_spot() noexcept;
  bool is_free(const Eigen::Vector2d& spot) const noexcept;
  Eigen::Vector2d tip_over(const Eigen::Vector2d& spot) const noexcept;
  void ask_to_watch(const Eigen::Vector2d& middle, const Eigen::AlignedBox2d& room) noexcept;
  void watch_grasp(double behind) noexcept;
  void watch_ahead_of_grasp() noexcept;
  void count_watched_pictures() noexcept;
  void watch_spot() noexcept;
  bool keeps_part() noexcept;
  bool fingers_hold() const noexcept;

  bool begin_way(const Eigen::Vector2d& to) noexcept;
  bool has_left(const Eigen::Vector3d& goal) const noexcept;
  bool go(const Eigen::Vector3d& goal, double angle) noexcept;
  void aim(const Eigen::Vector3d& tip, double angle) noexcept;
  bool is_at(const Eigen::Vector3d& tip, double within) const noexcept;
  bool is_turned(double angle) const noexcept;
  Eigen::Vector3d tip() const noexcept;
  double hand_angle() const noexcept;
  Eigen::Vector3d at_grasp(double above) const noexcept;
  Eigen::Vector3d over_part() const noexcept;
  Eigen::Vector3d over_bin(double height) const noexcept;
  Eigen::Vector3d beside_bin() const noexcept;
  void open_for_grasp() noexcept;
  void open(double opening) noexcept;
  void enter(PickerState state, const char* cause = "") noexcept;

  PickerPlan plan_;
  TravelPath paths_;
  TravelPath kept_out_;                   // where it may not go down: boxes of any height
  const PickerView* view_ = nullptr;      // of the step under way
  const PickerWishes* wishes_ = nullptr;  // likewise
  PickerState state_ = PickerState::off;
  const char* cause_ = "";
  std::optional<Eigen::Isometry3d> target_;
  PickerAct act_ = PickerAct::none;
  double opening_ = 0;
  Time entered_{};
  std::uint32_t way_ = 0;
  std::optional<Eigen::Isometry3d> led_to_;    // in the step before
  std::optional<Eigen::Isometry3d> stuck_on_;  // the way there: the arm does not move
  Time moved_{};                               // the arm came nearer, or was told something else
  ObjectTrack track_{};                        // as seen last
  Grasp grasp_{};
  std::uint32_t measured_frames_ = 0;  // of the track, when the look began
  std::uint32_t pictures_ = 0;         // in this state
  std::size_t known_ = 0;              // things that were confirmed, in the step before of a survey
  bool in_hand_ = false;
  bool shows_part_ = false;
  bool is_release_cut_short_ = false;  // the fingers were about to let go when others came between
  std::optional<Doubt> doubt_;
  ObjectTrack held_{};  // as it lay when the fingers closed
  Grasp held_grasp_{};
  Time let_go_{};                    // until then pictures may show it
  bool is_frozen_ = false;           // the way down no longer follows the track
  std::uint32_t rest_pictures_ = 0;  // while it rested above the straight way
  bool is_straight_ = false;         // the way down is the last, straight one
  std::uint32_t since_survey_ = 0;   // parts that were binned
  bool needs_survey_ = true;         // the whole table has not been looked at since others were here
  bool is_watching_ = false;         // at the look-out, until there is a part that can be picked
  std::uint32_t failed_track_ = 0;
  Eigen::Vector2d spot_ = Eigen::Vector2d::Zero();  // in the bin
  bool waits_at_bin_ = false;                       // blocked, beside the bin, where the camera sees into it
  double look_farther_ = 0;                         // m, than usual beside the place in the bin
  std::optional<PickerWatch> watch_for_;
  std::int64_t watched_at_ = 0;         // ns, the last picture that showed all of that place
  std::uint32_t watched_pictures_ = 0;  // that showed it since this state began
  Eigen::Vector2d way_begin_ = Eigen::Vector2d::Zero();
  std::size_t way_place_ = 0;
  bool needs_opening_ = false;  // as wide as the grasp says
  bool has_risen_ = false;      // on the way under way
  bool is_over_ = false;        // likewise: it is over its end, and goes down
  std::array<LeftAlone, 16> left_alone_{};
  std::size_t next_left_alone_ = 0;
  Time binned_{};
  Counters counters_;
};

}  // namespace flexrf::user
