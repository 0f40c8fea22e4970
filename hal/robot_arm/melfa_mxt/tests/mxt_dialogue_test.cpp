// Which answers the dialogue believes: of this arm, of this session, and when they arrived.
#include "hal/robot_arm/melfa_mxt/mxt_dialogue.hpp"

#include <algorithm>
#include <deque>

#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::melfa;
using std::chrono::milliseconds;

constexpr Time beginning{std::chrono::seconds(1)};

/// A controller whose answers the test writes.
class WrittenLink final : public DatagramLink {
 public:
  bool send(std::span<const std::uint8_t> datagram, Time /*now*/) noexcept override {
    last_ = unpack(datagram).value_or(Packet{});
    return true;
  }
  std::optional<ArrivedDatagram> receive(std::span<std::uint8_t> into, Time /*now*/) noexcept override {
    if (answers_.empty()) return std::nullopt;
    const Answer answer = answers_.front();
    answers_.pop_front();
    std::copy(answer.bytes.begin(), answer.bytes.end(), into.begin());
    return ArrivedDatagram{answer.bytes.size(), answer.at};
  }
  std::uint64_t strangers() const noexcept override { return 0; }

  std::uint32_t last_number() const { return last_.counter; }
  void answer(std::uint32_t number, const Joints& joints, Time at) {
    Packet packet;
    packet.reply_contents[0] = contents::measured_joints;
    packet.data[0] = words_of(joints);
    packet.counter = number;
    answers_.push_back({pack(packet), at});
  }

 private:
  struct Answer {
    PacketBytes bytes;
    Time at;
  };
  Packet last_;
  std::deque<Answer> answers_;
};

struct Talk {
  explicit Talk(std::uint32_t first_number = 0) {
    DialoguePlan plan;
    plan.pacing = {.answer = milliseconds(12),
                   .silence = milliseconds(60),
                   .search = milliseconds(100),
                   .first_number = first_number};
    good = dialogue.begin(plan, six_axis, link).is_ok();
    dialogue.send(false, beginning);
  }

  WrittenLink link;
  MxtDialogue dialogue;
  bool good = false;
};

bool an_answer_counts_from_when_it_arrived() {
  Talk talk;
  talk.link.answer(talk.link.last_number(), {0.1F, 0.2F}, beginning + milliseconds(3));
  talk.dialogue.receive(beginning + milliseconds(7));
  const auto& told = talk.dialogue.told();
  return talk.good && told && told->measured[1] > 0.19 &&
         talk.dialogue.told_at() == beginning + milliseconds(3);
}

bool an_answer_of_the_session_before_is_foreign() {
  Talk talk(70'000);
  for (const std::uint32_t number : {1U, 2U, 60'000U, 70'001U - 256U})
    talk.link.answer(number, {0.5F}, beginning);
  talk.dialogue.receive(beginning + milliseconds(1));
  const bool none = !talk.dialogue.told() && talk.dialogue.counters().foreign == 4;
  talk.link.answer(talk.link.last_number(), {0.1F}, beginning + milliseconds(2));
  talk.dialogue.receive(beginning + milliseconds(3));
  return talk.link.last_number() == 70'001 && none && talk.dialogue.told().has_value();
}

bool an_arm_with_more_joints_is_another_one() {
  Talk talk;
  Joints joints{};
  joints[0] = 0.1F;
  joints[six_axis.joint_count] = 0.3F;
  talk.link.answer(talk.link.last_number(), joints, beginning);
  talk.dialogue.receive(beginning + milliseconds(1));
  return !talk.dialogue.told() && talk.dialogue.counters().foreign == 1 &&
         talk.dialogue.unknown_joint() == six_axis.joint_count + 1;
}

void counts_from_when_it_arrived(void**) {
  assert_true(an_answer_counts_from_when_it_arrived());
}
void of_the_session_before(void**) {
  assert_true(an_answer_of_the_session_before_is_foreign());
}
void of_another_arm(void**) {
  assert_true(an_arm_with_more_joints_is_another_one());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(counts_from_when_it_arrived),
      cmocka_unit_test(of_the_session_before),
      cmocka_unit_test(of_another_arm),
  };
  return cmocka_run_group_tests_name("MXT dialogue", tests, nullptr, nullptr);
}
