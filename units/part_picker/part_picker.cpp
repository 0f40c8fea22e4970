#include "units/part_picker/part_picker.hpp"

#include <algorithm>

#include "hal/gripper/interface/gripper.hpp"
#include "motion/pose_conversion.hpp"
#include "units/part_picker/picker_messages.hpp"
#include "units/vision/part_model.hpp"

namespace flexrf::user {
namespace {

/// Of nobody but the stream of poses.
bool do_others_lead(const RobotLead& lead) {
  if (lead.mode == ControlMode::manual || lead.stepping) return true;
  return lead.moving && lead.activity != RobotActivity::servo && lead.activity != RobotActivity::none;
}

/// `trouble`: of the pictures, as their unit tells it; null: it tells nothing.
const char* why_blind(NullReason reason, const char* trouble) {
  if (trouble != nullptr && *trouble != '\0') return trouble;
  return reason == NullReason::too_old ? "no picture that can be used comes" : name_of(reason);
}

}  // namespace

Status PartPicker::initialise() {
  for (const KeepOut& box : configuration.keep_out) {
    const bool is_none = std::equal(box.from.begin(), box.from.end(), box.to.begin());
    const bool is_box = box.from[0] < box.to[0] && box.from[1] < box.to[1] && box.from[2] < box.to[2];
    if (!is_none && !is_box)
      return Status::error(
          StatusCode::invalid_argument,
          "a box of keep_out ends before it begins: `from` has to be less than `to` in x, y and "
          "z, or equal to it where there is no box");
  }
  const GripperCapabilities can = gripper->capabilities();
  if (!can.positions || !can.detects_object)
    return Status::error(StatusCode::invalid_argument,
                         "the gripper has to go to any opening and to tell whether it holds something");
  if (configuration.reach[0] >= configuration.reach[1])
    return Status::error(StatusCode::invalid_argument,
                         "reach: the least distance, %g m, has to be below the greatest, %g m",
                         configuration.reach[0], configuration.reach[1]);
  if (const Status status = parts_.take(configuration.catalogue); !status) return status;
  machine_.begin(plan());
  if (machine_.is_look_out_kept_out())
    return Status::error(
        StatusCode::invalid_argument,
        "look_out (%g, %g) lies in a box of keep_out, or so near that the hand would come into "
        "it: move the one or the other",
        configuration.look_out[0], configuration.look_out[1]);
  led_by_picture_ = 0;
  frame_.reset();
  return {};
}

PickerPlan PartPicker::plan() const noexcept {
  PickerPlan plan;
  plan.hand.reach = configuration.hand_reach;
  plan.hand.widest = gripper->capabilities().open_width;
  plan.room.beside_part = configuration.beside_part;
  plan.room.to_parts = configuration.to_parts;
  plan.room.to_obstacles = configuration.to_obstacles;
  plan.room.slant = configuration.look_offset;
  plan.look_out = configuration.look_out_map();
  plan.hand_angle = configuration.hand_angle;
  plan.travel_height = configuration.travel_height;
  plan.look_height = configuration.look_height;
  plan.straight_height = configuration.straight_height;
  plan.slanted_speed = configuration.slanted_speed;
  plan.grasp_height = configuration.grasp_height;
  plan.drop_height = configuration.drop_height;
  plan.bin_look_offset = configuration.bin_look_offset;
  plan.base = configuration.base_map();
  plan.nearest = configuration.reach[0];
  plan.farthest = configuration.reach[1];
  plan.parts = &parts_;
  const auto parts = parts_.all();
  std::transform(parts.begin(), parts.end(), plan.bins.begin(), [](const PartModel& part) {
    return PickerBin{part.bin.middle_map(), part.bin.size_map()};
  });
  plan.keep_outs = configuration.keep_out;
  return plan;
}

void PartPicker::step(const Tick& tick) {
  const auto seen = tracks.latest();
  const auto lead = led_by.latest();
  if (runtime.clear_counters > 0) machine_.clear_counters();
  const PickerView view = look(tick, seen, lead);
  machine_.step(view, wishes());
  command();
  tell(view, seen);
}

PickerView PartPicker::look(const Tick& tick, const View<TrackList>& seen,
                            const View<RobotLead>& lead) noexcept {
  PickerView view;
  view.now = tick.now;
  view.may_move = !tick.motion_inhibited;
  view.stop_requested = tick.stop_requested;
  view.finishing = tick.finishing;
  if (seen) {
    view.tracks = &*seen;
    // What recognition tells of the same picture is no other picture.
    view.tracks_are_new = frame_ != seen->frame;
    frame_ = seen->frame;
  }
  const auto population = generation.latest();
  const auto looks = [](const AttentionMember& member) { return member.active; };
  view.nobody_looks =
      population && std::none_of(population->members.begin(), population->members.end(), looks);
  const auto pose = tool_pose.latest();
  if (pose && lead) view.tool = to_isometry(*pose);
  if (lead) {
    view.others_lead = do_others_lead(*lead);
    view.arm_rests = !lead->moving && lead->activity == RobotActivity::servo;
    view.arm_holds = lead->holding.data();
    view.arm_is_in_fault = lead->in_fault;
  }
  view.gripper.trouble = gripper->fault().is_ok() ? gripper->trouble().cause() : gripper->fault().cause();
  if (const auto state = gripper->state()) {
    view.gripper.known = true;
    view.gripper.activated = state->activated;
    view.gripper.moving = state->moving;
    view.gripper.opening = state->opening;
    view.gripper.object = state->object;
  }
  return view;
}

PickerWishes PartPicker::wishes() const noexcept {
  return {.pick = runtime.pick,
          .open_gripper = runtime.open_gripper > 0,
          .survey_pictures = runtime.survey_pictures,
          .survey_after = runtime.survey_after,
          .look_pictures = runtime.look_pictures,
          .patience = duration_of(runtime.patience),
          .leg_timeout = duration_of(runtime.leg_timeout),
          .rest = duration_of(runtime.rest)};
}

void PartPicker::command() noexcept {
  ServoTarget aim{};
  if (const auto& target = machine_.target()) {
    aim.valid = true;
    aim.pose = to_pose(*target);
    aim.way = machine_.way();
    aim.speed = machine_.speed();
  }
  servo.publish(aim);
  TargetInHand hand{};
  hand.track = machine_.track();
  hand.holds = machine_.holds_part();
  if (machine_.shows_part()) {
    const Eigen::AlignedBox3d box = machine_.held_box();
    hand.held_from_map() = box.min();
    hand.held_to_map() = box.max();
  }
  if (const auto& watch = machine_.watch_for()) {
    hand.watch_map() = watch->middle;
    hand.watch_angle = watch->angle;
    hand.watch_from_map() = watch->room.min();
    hand.watch_to_map() = watch->room.max();
  }
  in_hand.publish(hand);
  switch (machine_.act()) {
    case PickerAct::activate:
      gripper->activate();
      break;
    case PickerAct::open:
      gripper->command({.opening = machine_.opening()});
      break;
    case PickerAct::close:
      gripper->close();
      break;
    case PickerAct::none:
      break;
  }
}

void PartPicker::tell(const PickerView& view, const View<TrackList>& seen) noexcept {
  const ObjectTrack& part = machine_.part();
  const bool has_part = machine_.track() != 0;
  if (has_part && seen && part.measured_at > led_by_picture_ && machine_.target()) {
    led_by_picture_ = part.measured_at;
    feedback.latency = seconds(view.now - Time{std::chrono::nanoseconds{part.measured_at}});
  }
  const auto pictures = condition.latest();
  const PickerMessage text = describe(
      machine_, view, seen ? "" : why_blind(seen.reason(), pictures ? pictures->trouble.data() : nullptr));
  feedback.state = machine_.state();
  feedback.set_message(text.message.data());
  feedback.set_remedy(text.remedy);
  feedback.target = machine_.track();
  feedback.target_kind = has_part ? part.kind : no_kind;
  feedback.target_place = {part.position[0], part.position[1], part.angle};
  const Grasp& grasp = machine_.grasp();
  feedback.grasp_place = {grasp.middle.x(), grasp.middle.y(), grasp.angle};
  const PickerMachine::Counters& counted = machine_.counters();
  feedback.approaches = counted.approaches;
  feedback.binned = counted.binned;
  feedback.lost_targets = counted.lost_targets;
  feedback.given_up = counted.given_up;
  feedback.failed_grasps = counted.failed_grasps;
  feedback.lost_parts = counted.lost_parts;
  feedback.interrupted = counted.interrupted;
  std::copy(counted.approaches_by_kind.begin(), counted.approaches_by_kind.end(),
            feedback.approaches_by_kind.begin());
  std::copy(counted.binned_by_kind.begin(), counted.binned_by_kind.end(), feedback.binned_by_kind.begin());
  feedback.cycle_time = counted.cycle_time;
}

}  // namespace flexrf::user
