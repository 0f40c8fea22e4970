// An arm whose tool is led as the stream of poses leads it, fingers, and a camera that sees all, around a
// PickerMachine; and what has to hold in each of its steps, whatever happens.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "hal/gripper/interface/finger_control.hpp"
#include "hal/scene/interface/part_catalogue.hpp"
#include "motion/pose_motion.hpp"
#include "tests/cmocka.hpp"
#include "tests/distance_to_line.hpp"
#include "units/part_picker/picker_machine.hpp"
#include "units/part_picker/picker_messages.hpp"
#include "units/vision/tests/known_parts.hpp"

namespace flexrf::user {

inline constexpr Duration control_cycle = std::chrono::milliseconds(7);

/// As in the unit's table.
inline PickerPlan usual_plan() {
  PickerPlan plan;
  plan.look_out = {0.50, 0, 0.44};
  plan.hand_angle = 1.5707963;
  plan.travel_height = 0.165;
  plan.look_height = 0.10;
  plan.straight_height = 0.035;
  plan.slanted_speed = 0.08;
  plan.grasp_height = 0.008;
  plan.drop_height = 0.03;
  plan.bin_look_offset = 0.08;
  plan.nearest = 0.25;
  plan.farthest = 1.2;
  plan.parts = &parts_of_tests();
  for (std::size_t i = 0; i < part_bins.size(); ++i)
    plan.bins[i] = {{part_bins[i].middle.x, part_bins[i].middle.y},
                    {part_bins[i].size.x, part_bins[i].size.y}};
  return plan;
}

struct PickerWorld {
  struct Part {
    ObjectTrack track{};  ///< the truth about it
    double height = 0;    ///< m, of its lower face
    double width = 0;     ///< m, where it was gripped last
    bool is_seen = true;  ///< measured in each picture
    bool is_there = true;
    bool is_binned = false;
  };

  explicit PickerWorld(const PickerPlan& with = usual_plan()) : plan(with) {
    fingers.begin({.whose = "the test's", .open_width = 0.085, .speed = 0.15, .activation = 0.2});
    machine.begin(plan);
    parts.reserve(64);  // references to parts are kept
    wishes.patience = std::chrono::milliseconds(1500);
    wishes.leg_timeout = std::chrono::seconds(15);
    wishes.rest = std::chrono::seconds(30);
  }
  PickerWorld(const PickerWorld&) = delete;
  PickerWorld& operator=(const PickerWorld&) = delete;

  Part& add(std::uint16_t kind, double x, double y, double turned = 0) {
    Part& part = parts.emplace_back();
    part.track.kind = kind;
    part.track.found = VisualClass::target;
    part.track.may_be_target = true;
    part.track.radius = 0.03;
    part.track.angle = turned;
    return enlist(part, x, y);
  }
  Part& add_obstacle(double x, double y) {
    Part& post = parts.emplace_back();
    post.track.kind = 65535;
    post.track.found = VisualClass::obstacle;
    post.track.radius = 0.02;
    return enlist(post, x, y);
  }
  /// One of each kind.
  void lay_table() {
    add(0, 0.42, -0.15, 0.4);
    add(1, 0.50, 0.05);
    add(2, 0.38, 0.15, -0.2);
    add(3, 0.58, -0.05, 2.5);
  }

  void step() {
    now += control_cycle;
    move_arm();
    move_fingers();
    PickerView view = look();
    const PickerState before = machine.state();
    const std::uint64_t begun = machine.counters().approaches;
    machine.step(view, wishes);
    if (machine.state() != before) states.push_back(machine.state());
    count_interruption(before, begun);
    expect_that_it_looked(before);
    judge(view, before);
    act();
    wishes.open_gripper = false;
    jog.setZero();
  }
  bool run(double duration) {
    for (double t = 0; t < duration; t += seconds(control_cycle)) step();
    return is_well;
  }
  /// False: not within so many s, or something was wrong.
  bool until(PickerState state, double within = 20) {
    for (double t = 0; t < within && machine.state() != state; t += seconds(control_cycle)) step();
    return machine.state() == state && is_well;
  }
  bool until_binned(std::uint64_t count, double within = 60) {
    for (double t = 0; t < within && machine.counters().binned < count; t += seconds(control_cycle)) step();
    return machine.counters().binned == count && is_well;
  }
  /// Until so many parts are in their bins, and it waits for more.
  bool goes_on(std::size_t count) {
    for (double t = 0; t < 90 && parts_binned() < count; t += 0.5)
      if (!run(0.5)) return false;
    return parts_binned() == count && until(PickerState::waiting, 40);
  }
  bool visits(PickerState state) const {
    return std::find(states.begin(), states.end(), state) != states.end();
  }
  std::size_t parts_binned() const {
    return static_cast<std::size_t>(
        std::count_if(parts.begin(), parts.end(), [](const Part& part) { return part.is_binned; }));
  }
  /// It is not between the fingers any more, and no longer on the table.
  void take_from_hand() {
    if (held == nullptr) return;
    held->is_there = false;
    held = nullptr;
    was_taken = true;
  }
  /// For a second the fingers may drop the part that they hold.
  void allow_drop() { may_drop_ = now + std::chrono::seconds(1); }
  Part* target() {
    for (Part& part : parts)
      if (part.track.identity == machine.track()) return &part;
    return nullptr;
  }
  void expect(bool holds, const char* what) {
    if (!holds && is_well)
      print_message("%s, in %s (%s) after %.2f s\n", what, name_of(machine.state()), machine.cause(),
                    seconds(now - Time{}) - 1);
    is_well = is_well && holds;
  }

  PickerPlan plan;
  PickerMachine machine;
  PickerWishes wishes;
  FingerControl fingers;
  std::vector<Part> parts;
  std::vector<PickerState> states;  ///< one after the other
  Time now{std::chrono::seconds(1)};
  // What a test disturbs.
  bool may_move = true;
  bool stop_requested = false;
  bool finishing = false;
  bool sees = true;
  double sees_from = 0.045;  ///< m beside a place in the bin
  bool can_tell = true;      ///< what stands where the hand goes down next
  bool tells_pose = true;
  bool tells_opening = true;  ///< as a gripper that measures it
  bool is_led = false;
  bool is_stuck = false;
  double arm_speed = 0.9;                         // m/s, of the tool's limit
  Eigen::Vector3d jog = Eigen::Vector3d::Zero();  // m in the next step
  int steps_per_picture = 5;

  Eigen::Vector3d tip{0.35, 0.1, 0.25};
  double angle = 1.2;
  Part* held = nullptr;
  bool is_well = true;
  std::uint64_t interrupted = 0;  ///< approaches that others ended
  double motion = 0;              ///< m that the machine moved the arm

 private:
  Part& enlist(Part& part, double x, double y) {
    part.track.position = {x, y};
    part.track.identity = ++identities_;
    part.track.confirmed = true;
    part.track.frames = 10;
    return part;
  }
  void move_arm() {
    rests_ = true;
    if (!jog.isZero()) {
      tip += jog;
      anchor_ = tip;
      rests_ = false;
    }
    if (!may_move || is_led || is_stuck || !aim_) {
      arm_.place(tool_above(tip, angle, plan.hand.reach));
      return carry();
    }
    arm_.set_limits({{arm_speed, 4.0, 40.0}, {2.0, 12.0, 120.0}});
    const double part = machine.speed() > 0 ? std::min(1.0, machine.speed() / arm_speed) : 1;
    arm_.advance(*aim_, machine.way(), part, seconds(control_cycle));
    rests_ = arm_.is_at_rest();
    const Eigen::Isometry3d pose = arm_.pose();
    const Eigen::Vector3d before = tip;
    tip = pose * Eigen::Vector3d(0, 0, plan.hand.reach);
    motion += (tip - before).norm();
    angle = angle_of(pose);
    carry();
    expect_that_it_is_on_its_way();
  }
  /// The arm is on the straight line to its goal from where that was named, or beside it by no more than it
  /// needed to stop there.
  void expect_that_it_is_on_its_way() {
    const Eigen::Vector3d goal = *aim_ * Eigen::Vector3d(0, 0, plan.hand.reach);
    expect(distance_to_line(tip, way_from_, goal) < stop_distance_ + 0.012, "beside its way");
  }
  void begin_way() {
    way_from_ = tip;
    PoseMotion stops = arm_;
    while (!stops.is_at_rest()) stops.brake(seconds(control_cycle));
    stop_distance_ = (stops.pose() * Eigen::Vector3d(0, 0, plan.hand.reach) - tip).norm();
  }
  static double angle_of(const Eigen::Isometry3d& tool) {
    return std::atan2(tool.linear()(1, 1), tool.linear()(0, 1));
  }
  void carry() {
    if (held == nullptr) return;
    held->track.position = {tip.x(), tip.y()};
    held->height = std::max(0.0, tip.z() - plan.grasp_height);
  }
  void move_fingers() {
    Part* between = held;
    for (Part& part : parts) {
      const Eigen::Vector2d apart = tip.head<2>() - Eigen::Vector2d(part.track.position_map());
      if (part.is_there && part.track.found == VisualClass::target && apart.norm() < 0.022 &&
          tip.z() < part_catalogue[part.track.kind].height - 0.002)
        between = &part;
    }
    const double width = width_of(between);
    if (between != nullptr && (held != nullptr || fingers.fingers().opening() >= width)) {
      fingers.fingers().put_object(width);
    } else {
      fingers.fingers().take_away();
    }
    fingers.advance(control_cycle);
    if (held == nullptr && between != nullptr && fingers.known().object == GripperObject::gripped) {
      held = between;
      held->width = width;
      const PickerState state = machine.state();
      expect(state != PickerState::approaching && state != PickerState::looking, "took a part unasked");
    }
    if (held != nullptr && fingers.fingers().opening() > width + 0.002) let_go();
  }
  double width_of(const Part* between) const {
    if (between != nullptr && between->width > 0) return between->width;
    return machine.grasp().width > 0 ? machine.grasp().width : 0.03;
  }
  void let_go() {
    Part& part = *held;
    held = nullptr;
    was_taken = true;
    part.track.identity = ++identities_;
    part.track.frames = 10;
    const PickerBin& bin = plan.bins[part.track.kind];
    const Eigen::Vector2d place = part.track.position_map();
    part.is_binned = bin.contains(place);
    if (machine.state() == PickerState::releasing) {
      expect(part.is_binned, "not in its bin");
      expect(part.height < 0.05, "let go from high above");
    } else {
      expect(may_drop_ > now, "dropped a part");
    }
    part.height = 0;
  }
  PickerView look() {
    PickerView view;
    const bool new_picture = ++steps_ % steps_per_picture == 0;
    if (new_picture) {
      tracks_ = {};
      for (Part& part : parts) {
        if (!part.is_there || &part == held) continue;
        if (part.is_seen) ++part.track.frames;
        if (tracks_.count < tracks_.tracks.size()) tracks_.tracks[tracks_.count++] = part.track;
      }
      ++tracks_.frame;
      watch();
    }
    view.now = now;
    view.may_move = may_move;
    view.stop_requested = stop_requested;
    view.finishing = finishing;
    view.tracks = sees ? &tracks_ : nullptr;
    view.tracks_are_new = sees && new_picture;
    if (tells_pose) view.tool = tool_above(tip, angle, plan.hand.reach);
    view.others_lead = is_led;
    view.arm_rests = rests_ && !is_led;
    view.gripper.known = fingers.is_heard();
    view.gripper.activated = fingers.known().activated;
    view.gripper.moving = fingers.known().moving;
    if (tells_opening) view.gripper.opening = fingers.fingers().opening();
    view.gripper.object = fingers.known().object;
    view.gripper.trouble = fingers.trouble().cause();
    return view;
  }
  /// A part that hangs from the fingers hides the place right below.
  void watch() {
    const auto& watch = machine.watch_for();
    if (!watch || !can_tell) return;
    const Eigen::Vector2d x(-std::sin(angle), std::cos(angle));
    const double ahead = (watch->middle - tip.head<2>()).dot(x);
    if (held != nullptr && (ahead < sees_from || ahead > 0.13)) return;
    tracks_.watched = {watch->middle.x(), watch->middle.y(), watch->angle};
    tracks_.watched_at = now.time_since_epoch().count();
    told_ = now;
  }
  /// The hand goes down where nobody looked only if the camera told just before.
  void expect_that_it_looked(PickerState before) {
    const PickerState state = machine.state();
    const bool goes_down = (state == PickerState::descending && before == PickerState::looking) ||
                           (state == PickerState::lowering && before == PickerState::looking_into_bin);
    expect(!goes_down || now - told_ < std::chrono::seconds(1), "goes down where the camera did not look");
  }
  static bool is_before_grasp(PickerState state) {
    return state == PickerState::approaching || state == PickerState::looking ||
           state == PickerState::descending || state == PickerState::closing;
  }
  void count_interruption(PickerState before, std::uint64_t begun) {
    switch (machine.state()) {
      case PickerState::off:
      case PickerState::paused:
      case PickerState::no_sight:
      case PickerState::led_by_others:
      case PickerState::gripper_trouble:
      case PickerState::unknown_in_hand:
        if (is_before_grasp(before) && !machine.holds_part()) ++interrupted;
        break;
      default:
        break;
    }
    expect(machine.counters().approaches - begun <= 1, "two approaches in a step");
  }
  void judge(const PickerView& view, PickerState before) {
    const PickerState state = machine.state();
    const double low = plan.travel_height - 0.02;
    if (const auto& target = machine.target()) {
      expect(view.may_move && view.tool && view.tracks != nullptr && !is_led && !stop_requested,
             "a target where nothing may move");
      const Eigen::Vector3d goal = *target * Eigen::Vector3d(0, 0, plan.hand.reach);
      expect(goal.allFinite() && target->linear().col(2).z() < -0.999, "no target for a tool");
      if (tip.z() >= low - 1e-9) anchor_ = tip;
      // The slanted way, and what an arm that is over its goal may be beside it.
      const double sideways = (goal - anchor_).head<2>().norm();
      expect(sideways < plan.room.slant + 0.025 || tip.z() >= low - 1e-9, "sideways below the travel height");
      if (!aim_ || (target->translation() - aim_->translation()).norm() > 0.004) begin_way();
      aim_ = target;
    } else {
      aim_.reset();
    }
    if (is_led || !view.tool) anchor_ = tip;
    const bool drops = machine.act() == PickerAct::open || machine.act() == PickerAct::activate;
    const bool holds = held != nullptr && fingers.known().object == GripperObject::gripped;
    expect(!drops || !holds || state == PickerState::releasing || wishes.open_gripper,
           "opens with a part in hand");
    expect(view.may_move || machine.act() == PickerAct::none, "acts where nothing may move");
    expect(state != PickerState::off || before != PickerState::off || !machine.target(), "moves when off");
    expect(!stop_requested || machine.act() != PickerAct::open, "opens while a stop is requested");

    const auto& counted = machine.counters();
    expect(counted.interrupted == interrupted, "interruptions are not counted");
    expect(std::accumulate(counted.approaches_by_kind.begin(), counted.approaches_by_kind.end(),
                           std::uint64_t{0}) == counted.approaches &&
               std::accumulate(counted.binned_by_kind.begin(), counted.binned_by_kind.end(),
                               std::uint64_t{0}) == counted.binned,
           "the counters by kind do not agree");
    const bool has_track = is_before_grasp(state) || machine.holds_part();
    const bool under_way = has_track || machine.is_in_doubt();
    expect(counted.approaches == counted.binned + counted.lost_targets + counted.failed_grasps +
                                     counted.lost_parts + counted.given_up + interrupted +
                                     (under_way ? 1 : 0),
           "the counters do not agree");
    expect((machine.track() != 0) == has_track, "a track without an approach");
    const PickerMessage words = describe(machine, view, view.tracks != nullptr ? "" : "too old");
    expect(words.message[0] != '\0', "no words");
  }
  void act() {
    if (wishes.open_gripper) may_drop_ = now + std::chrono::seconds(3);
    if (!may_move) return fingers.halt();
    // A release that others come upon goes on.
    if (machine.act() == PickerAct::open && machine.state() == PickerState::releasing)
      may_drop_ = now + std::chrono::seconds(1);
    if (machine.act() == PickerAct::activate) fingers.activate();
    if (machine.act() == PickerAct::open) fingers.go({.opening = machine.opening()});
    if (machine.act() == PickerAct::close) fingers.go({.opening = 0});
  }

 public:
  bool was_taken = false;  ///< something left the fingers

 private:
  std::uint32_t identities_ = 0;
  int steps_ = 0;
  TrackList tracks_{};
  std::optional<Eigen::Isometry3d> aim_;
  Eigen::Vector3d way_from_ = Eigen::Vector3d::Zero();  // m, where the way to the goal began
  double stop_distance_ = 0;                            // m, that the arm needed to stop there
  PoseMotion arm_;
  Eigen::Vector3d anchor_ = tip;  // where it was last at the travel height, or was led to
  bool rests_ = true;
  Time may_drop_{};
  Time told_{};  // what stands in the place that is watched
};

}  // namespace flexrf::user
