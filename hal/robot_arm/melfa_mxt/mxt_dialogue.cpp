#include "hal/robot_arm/melfa_mxt/mxt_dialogue.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::melfa {
namespace {

// What comes faster than this is a flood, and looked at in the next cycle.
constexpr int most_received = 32;
constexpr int most_ends = 3;
constexpr double rest_velocity = 0.005;  // rad/s

JointAngles angles_of(const Joints& joints, std::size_t count) noexcept {
  JointAngles angles{};
  for (std::size_t i = 0; i < count; ++i) angles[i] = static_cast<double>(joints[i]);
  return angles;
}

Joints joints_of(const JointAngles& angles) noexcept {
  Joints joints{};
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = static_cast<float>(angles[i]);
  return joints;
}

bool is_reply_to_us(const Packet& reply) noexcept {
  return reply.command == commands::monitor || reply.command == commands::move ||
         reply.command == commands::end;
}

}  // namespace

Status MxtDialogue::begin(const DialoguePlan& plan, const KinematicChain& chain, DatagramLink& link) {
  if (plan.pacing.answer >= plan.pacing.silence) {
    return Status::error(StatusCode::invalid_argument,
                         "answer_timeout has to be shorter than silence_limit: an answer may be late before "
                         "the controller is not there");
  }
  if (seconds(plan.pacing.answer) <= plan.cycle) {
    return Status::error(
        StatusCode::invalid_argument,
        "answer_timeout (%g s) has to be longer than the controller's cycle (%g s): it answers "
        "once in a cycle, and every answer would come too late",
        seconds(plan.pacing.answer), plan.cycle);
  }
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const ChainJoint& joint = chain.joints[i];
    if (joint.kind == JointKind::prismatic) {
      return Status::error(StatusCode::invalid_argument,
                           "joint %.*s slides: linear joints of this controller are not supported",
                           static_cast<int>(joint.name.size()), joint.name.data());
    }
    if (joint.kind == JointKind::continuous) {
      return Status::error(
          StatusCode::invalid_argument,
          "joint %.*s turns without end, and no joint of this controller does: give it lower and "
          "upper in the device's row, by urdf.joint",
          static_cast<int>(joint.name.size()), joint.name.data());
    }
    if (joint.velocity > 0 && joint.acceleration > 0) continue;
    return Status::error(StatusCode::invalid_argument,
                         "joint %.*s has no velocity or acceleration in the URDF: the controller does not "
                         "limit them, we have to",
                         static_cast<int>(joint.name.size()), joint.name.data());
  }
  *this = MxtDialogue{};
  plan_ = plan;
  chain_ = &chain;
  link_ = &link;
  strangers_ = link.strangers();
  pacing_.begin(plan.pacing);
  follower_.begin(chain, plan.cycle);
  return {};
}

void MxtDialogue::close() {
  if (!pacing_.is_heard() || phase_ == Phase::ended) return;
  if (pacing_.is_waiting()) await();
  phase_ = Phase::ending;
  ends_said_ = 0;
  while (phase_ == Phase::ending) {
    static_cast<void>(pacing_.is_free(now_));
    finish(now_);
    if (phase_ == Phase::ending) await();
  }
}

// Whoever stepped us does so no more, and our clock stands still: it moves on by what an answer may take.
void MxtDialogue::await() {
  link_->wait(plan_.pacing.silence);
  receive(now_ + plan_.pacing.answer);
}

void MxtDialogue::receive(Time now) noexcept {
  now_ = now;
  // One byte more than a packet, so that a longer datagram shows.
  std::array<std::uint8_t, packet_bytes + 1> bytes{};
  for (int i = 0; i < most_received; ++i) {
    const auto datagram = link_->receive(bytes, now);
    if (!datagram) break;
    const auto reply = unpack(std::span(bytes).first(std::min(datagram->size, bytes.size())));
    if (reply && is_reply_to_us(*reply)) {
      take(*reply, datagram->at, now);
    } else {
      pacing_.count_foreign();
    }
  }
  const std::uint64_t strangers = link_->strangers();
  pacing_.count_foreign(strangers - strangers_);
  strangers_ = strangers;
  if (!pacing_.has_fallen_silent(now)) return;
  told_.reset();
  if (phase_ == Phase::leading) lost_ = true;
  if (phase_ == Phase::leading) phase_ = Phase::monitoring;
}

void MxtDialogue::take(const Packet& reply, Time at, Time now) noexcept {
  const auto commanded = joints_told(reply, contents::joints);
  const auto measured = joints_told(reply, contents::measured_joints);
  if ((!commanded && !measured) || has_unknown_joint(commanded) || has_unknown_joint(measured))
    return pacing_.count_foreign();
  const AnswerPacing::Answer worth = pacing_.judge(reply.counter, now);
  if (worth == AnswerPacing::Answer::foreign) return;
  // What a late answer tells is older than what is known, unless nothing newer came since.
  if (worth == AnswerPacing::Answer::late && told_ && taken_at_ == now) return;
  const JointAngles before = told_ ? told_->measured : JointAngles{};
  ToldJoints told;
  told.commanded = angles_of(commanded ? *commanded : *measured, chain_->joint_count);
  told.measured = angles_of(measured ? *measured : *commanded, chain_->joint_count);
  if (told_) {
    const double cycles = std::max(1.0, std::round(seconds(at - told_at_) / plan_.cycle));
    for (std::size_t i = 0; i < chain_->joint_count; ++i) {
      told.velocity[i] = (told.measured[i] - before[i]) / (cycles * plan_.cycle);
    }
  }
  told_ = told;
  told_at_ = at;
  taken_at_ = now;
  if (phase_ == Phase::ending && worth == AnswerPacing::Answer::in_time && ends_said_ > 0)
    phase_ = Phase::ended;
}

bool MxtDialogue::has_unknown_joint(const std::optional<Joints>& joints) noexcept {
  if (!joints) return false;
  for (std::size_t i = chain_->joint_count; i < joints->size(); ++i) {
    if ((*joints)[i] == 0.0F) continue;
    unknown_joint_ = i + 1;
    return true;
  }
  return false;
}

void MxtDialogue::command(const JointAngles& wanted) noexcept {
  if (is_leading()) follower_.command(wanted);
}

void MxtDialogue::send(bool may_move, Time now) noexcept {
  now_ = now;
  if (phase_ == Phase::ended || !pacing_.is_free(now)) return;
  const bool may_lead = may_move && !ends_ && !lost_;
  if (phase_ == Phase::monitoring && ends_) {
    ends_said_ = 0;
    if (!told_) {
      // One that fell silent while it was led has not said that it stands.
      if (!lost_) phase_ = Phase::ended;
    } else if (is_at_rest()) {
      phase_ = Phase::ending;
    }
  }
  // From where the controller says that it was led to, now and not some packets ago: nothing jumps.
  if (phase_ == Phase::monitoring && may_lead && told_ && !pacing_.has_given_up()) {
    follower_.seed(told_->commanded);
    phase_ = Phase::leading;
    return tell(commands::move, now);
  }
  switch (phase_) {
    case Phase::monitoring:
      return tell(commands::monitor, now);
    case Phase::leading:
      return lead(may_lead, now);
    case Phase::ending:
      return finish(now);
    case Phase::ended:
      return;
  }
}

// It is still on its way to where it was led when that is at rest.
bool MxtDialogue::is_at_rest() const noexcept {
  return std::all_of(told_->velocity.begin(), told_->velocity.end(),
                     [](double velocity) { return std::abs(velocity) < rest_velocity; });
}

void MxtDialogue::lead(bool may_move, Time now) noexcept {
  if (!may_move) follower_.brake();
  if (pacing_.has_given_up()) {
    // Two steps in one cycle would be too fast, if this one was lost on the way there: the same once more.
    follower_.stand();
  } else {
    follower_.next();
  }
  tell(commands::move, now);
  if (follower_.brakes() && follower_.is_at_rest()) phase_ = Phase::monitoring;
}

void MxtDialogue::finish(Time now) noexcept {
  if (ends_said_ == most_ends) {
    phase_ = Phase::ended;
    return;
  }
  ++ends_said_;
  tell(commands::end, now);
}

void MxtDialogue::tell(std::uint16_t what, Time now) noexcept {
  Packet packet;
  packet.command = what;
  if (what == commands::move) {
    packet.send_content = contents::joints;
    packet.data[0] = words_of(joints_of(follower_.set_point()));
  }
  packet.reply_contents[0] = contents::joints;
  packet.reply_contents[1] = contents::measured_joints;
  packet.counter = pacing_.number_next();
  // What did not go out is lost like what was lost on the way.
  static_cast<void>(link_->send(pack(packet), now));
  pacing_.sent(now);
}

void MxtDialogue::reopen() noexcept {
  ends_ = false;
  if (phase_ == Phase::ended) phase_ = Phase::monitoring;
}

}  // namespace flexrf::melfa
