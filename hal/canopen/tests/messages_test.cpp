// Messages, as bytes: NMT, heartbeat, emergency, PDOs and the list that configures them.
#include <cstring>

#include "hal/canopen/configuration.hpp"
#include "hal/canopen/emergency.hpp"
#include "hal/canopen/nmt.hpp"
#include "hal/canopen/pdo.hpp"
#include "hal/canopen/sdo_abort.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::canopen {
namespace {

using std::chrono::milliseconds;

Time at(int ms) {
  return Time{std::chrono::seconds(1) + milliseconds(ms)};
}

void identifiers_are_the_predefined_ones(void**) {
  assert_int_equal(transmit_pdo_identifier(1, 5), 0x185);
  assert_int_equal(transmit_pdo_identifier(4, 5), 0x485);
  assert_int_equal(receive_pdo_identifier(1, 5), 0x205);
  assert_int_equal(receive_pdo_identifier(4, 127), 0x57F);
  assert_int_equal(identifier_of(sdo_answer_base, 2), 0x582);
  assert_int_equal(identifier_of(sdo_request_base, 2), 0x602);
}

void nmt_commands_reach_their_node_or_all(void**) {
  const Message one = nmt_message(NmtCommand::start, 4);
  assert_int_equal(one.identifier, 0);
  assert_int_equal(one.size, 2);
  assert_int_equal(one.data[0], 0x01);
  assert_int_equal(one.data[1], 4);
  assert_true(nmt_command_for(one, 4) == NmtCommand::start);
  assert_false(nmt_command_for(one, 5).has_value());
  assert_true(nmt_command_for(nmt_message(NmtCommand::reset_node, 0), 5) == NmtCommand::reset_node);
  Message cut = one;
  cut.size = 1;
  assert_false(nmt_command_for(cut, 4).has_value());
}

void heartbeats_tell_the_state_without_the_toggle_bit(void**) {
  assert_true(heartbeat_of({0x702, 1, {0x00}}, 2) == NmtState::boot_up);
  assert_true(heartbeat_of({0x702, 1, {0x85}}, 2) == NmtState::operational);
  assert_false(heartbeat_of({0x702, 1, {0x05}}, 3).has_value());
  assert_false(heartbeat_of({0x702, 2, {0x05}}, 2).has_value());
  assert_true(heartbeat_message(NmtState::pre_operational, 2) == (Message{0x702, 1, {0x7F}}));
  assert_string_equal(name_of(NmtState::operational), "operational");
  assert_string_equal(name_of(static_cast<NmtState>(9)), "a state of its own");
}

void guarding_asks_by_a_remote_frame_and_answers_toggle(void**) {
  const Message question = guard_message(2);
  assert_true(question.identifier == 0x702 && question.size == 1 && question.remote);
  assert_false(heartbeat_of(question, 2).has_value());
  const Message answer = guard_answer(NmtState::operational, true, 2);
  assert_true(answer == (Message{0x702, 1, {0x85}}));
  assert_true(toggle_of(answer) && !toggle_of(guard_answer(NmtState::stopped, false, 2)));
  assert_true(heartbeat_of(answer, 2) == NmtState::operational);
}

void silence_counts_from_the_first_heartbeat_on(void**) {
  HeartbeatConsumer consumer;
  consumer.begin(milliseconds(100));
  assert_false(consumer.is_lost(at(10000)));
  consumer.observe(at(10000));
  assert_false(consumer.is_lost(at(10100)));
  assert_true(consumer.is_lost(at(10101)));
  consumer.observe(at(10150));
  assert_false(consumer.is_lost(at(10200)));
  consumer.begin(milliseconds(100));
  assert_false(consumer.is_lost(at(20000)));
  consumer.begin({});
  consumer.observe(at(20000));
  assert_false(consumer.is_lost(at(90000)));
}

void our_heartbeat_comes_once_a_period_without_bursts(void**) {
  HeartbeatProducer producer;
  producer.begin(milliseconds(100), at(0));
  assert_true(producer.is_due(at(0)));
  assert_false(producer.is_due(at(99)));
  assert_true(producer.is_due(at(103)));
  assert_true(producer.is_due(at(200)));
  assert_true(producer.is_due(at(1000)));
  assert_false(producer.is_due(at(1001)));
  producer.begin({}, at(0));
  assert_false(producer.is_due(at(1000)));
}

// As one was captured from a node that starts.
void emergencies_are_decoded_and_named(void**) {
  const auto emergency = emergency_of({0x084, 8, {0x00, 0x50, 0x01, 0x2F, 0x14, 0, 0, 0}}, 4);
  assert_true(emergency.has_value());
  assert_int_equal(emergency->code, 0x5000);
  assert_int_equal(emergency->error_register, 1);
  assert_int_equal(emergency->own[0], 0x2F);
  assert_false(emergency->is_reset());
  assert_string_equal(describe_error_code(emergency->code), "the device's hardware");
  assert_true(emergency_message(*emergency, 4) ==
              (Message{0x084, 8, {0x00, 0x50, 0x01, 0x2F, 0x14, 0, 0, 0}}));
  assert_true(emergency_of({0x084, 8, {}}, 4)->is_reset());
  assert_false(emergency_of({0x084, 7, {}}, 4).has_value());
  assert_false(emergency_of({0x085, 8, {}}, 4).has_value());
  assert_non_null(std::strstr(describe_error_code(0x8130), "heartbeat"));
  assert_string_equal(describe_error_code(0x8150), "monitoring");
  assert_string_equal(describe_error_code(0x2310), "current at the device's output");
  assert_string_equal(describe_error_code(0xB000), "an error that CiA 301 does not name");
}

// Found by fuzzing: eight bytes that are asked for are not eight bytes of zeros.
void remote_frames_carry_nothing(void**) {
  assert_false(emergency_of({0x084, 8, {}, true}, 4).has_value());
  assert_false(nmt_command_for({0x000, 2, {}, true}, 4).has_value());
  const PdoPlan plan{.identifier = 0x184};
  assert_true(unpack(plan, {0x184, 8, {}}, {}));
  assert_false(unpack(plan, {0x184, 8, {}, true}, {}));
}

void aborts_of_transfers_have_words(void**) {
  assert_string_equal(describe_sdo_abort(sdo_abort::too_long), "the value is too long");
  assert_string_equal(describe_sdo_abort(0x08000024), "there is no data");
  assert_string_equal(describe_sdo_abort(0x12345678), "a reason of the device's own");
}

PdoPlan command_plan() {
  PdoPlan plan{.direction = PdoDirection::received_by_node, .identifier = receive_pdo_identifier(1, 5)};
  plan.add({0x6040, 0}, 16);
  plan.add({0x607A, 0}, 32);
  plan.add({0x6060, 0}, 8);
  return plan;
}

void pdos_are_packed_in_order_least_byte_first(void**) {
  const PdoPlan plan = command_plan();
  assert_int_equal(plan.bytes(), 7);
  const std::uint64_t values[] = {0x000F, static_cast<std::uint64_t>(-2), 8};
  const Message message = pack(plan, values);
  assert_true(message == (Message{0x205, 7, {0x0F, 0x00, 0xFE, 0xFF, 0xFF, 0xFF, 0x08}}));
  std::uint64_t back[3] = {};
  assert_true(unpack(plan, message, back));
  assert_int_equal(back[0], 0x000F);
  assert_int_equal(with_sign(back[1], 32), -2);
  assert_int_equal(back[2], 8);
}

void odd_widths_share_bytes(void**) {
  PdoPlan plan{.identifier = 0x200};
  assert_true(plan.add({0x2000, 1}, 1));
  assert_true(plan.add({0x2000, 2}, 3));
  assert_true(plan.add({0x2000, 3}, 12));
  const std::uint64_t values[] = {1, 0xFFFD, 0xABC};
  const Message message = pack(plan, values);
  assert_int_equal(message.size, 2);
  assert_int_equal(message.data[0], 0xCB);
  assert_int_equal(message.data[1], 0xAB);
  std::uint64_t back[3] = {};
  assert_true(unpack(plan, message, back));
  assert_int_equal(back[1], 5);
  assert_int_equal(with_sign(back[1], 3), -3);
  assert_int_equal(back[2], 0xABC);
}

void pdos_that_are_too_short_change_nothing(void**) {
  const PdoPlan plan = command_plan();
  std::uint64_t values[3] = {1, 2, 3};
  assert_false(unpack(plan, {0x205, 6, {9, 9, 9, 9, 9, 9}}, values));
  assert_false(unpack(plan, {0x206, 8, {}}, values));
  assert_int_equal(values[0], 1);
  assert_true(unpack(plan, {0x205, 8, {9}}, values));
  assert_int_equal(values[0], 9);
}

void a_pdo_holds_eight_bytes(void**) {
  PdoPlan plan;
  assert_true(plan.add({0x607A, 0}, 32));
  assert_false(plan.add({0x607A, 0}, 33));
  assert_false(plan.add({0x607A, 0}, 0));
  assert_true(plan.add({0x60FF, 0}, 32));
  assert_false(plan.add({0x6040, 0}, 1));
  const std::uint64_t values[] = {0xFFFFFFFF, 0x1};
  assert_int_equal(pack(plan, values).data[7], 0);
  assert_int_equal(pack(plan, values).data[4], 1);
}

void pdos_are_configured_in_the_prescribed_order(void**) {
  PdoPlan plan{.direction = PdoDirection::sent_by_node,
               .number = 2,
               .identifier = transmit_pdo_identifier(2, 5),
               .transmission = 1,
               .event_timer = 20};
  plan.add({0x6041, 0}, 16);
  plan.add({0x6064, 0}, 32);
  Configuration list;
  list.configure_pdo(plan);
  struct Expected {
    ObjectAddress object;
    std::uint8_t size;
    std::uint32_t value;
  };
  const Expected expected[] = {
      {{0x1801, 1}, 4, 0xC0000285}, {{0x1A01, 0}, 1, 0},          {{0x1A01, 1}, 4, 0x60410010},
      {{0x1A01, 2}, 4, 0x60640020}, {{0x1A01, 0}, 1, 2},          {{0x1801, 2}, 1, 1},
      {{0x1801, 5}, 2, 20},         {{0x1801, 1}, 4, 0x40000285},
  };
  assert_int_equal(list.size(), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    assert_true(list[i].object == expected[i].object);
    assert_int_equal(list[i].size, expected[i].size);
    assert_int_equal(list[i].value, expected[i].value);
  }
  assert_true(list.is_complete());
}

void a_list_that_is_too_long_says_so(void**) {
  Configuration list;
  for (std::size_t i = 0; i < Configuration::capacity; ++i) list.write({0x2000, 0}, 1, 0);
  assert_true(list.is_complete());
  list.write({0x2000, 0}, 1, 0);
  assert_false(list.is_complete());
  assert_int_equal(list.size(), Configuration::capacity);
}

void a_full_outbox_refuses_and_counts(void**) {
  Outbox outbox;
  for (std::uint16_t i = 0; i < Outbox::capacity; ++i) assert_true(outbox.push({i, 0, {}}));
  assert_false(outbox.push({}));
  assert_int_equal(outbox.refused(), 1);
  outbox.pop();
  assert_true(outbox.push({0x7FF, 0, {}}));
  for (std::uint16_t i = 1; i < Outbox::capacity; ++i) {
    assert_int_equal(outbox.front().identifier, i);
    outbox.pop();
  }
  assert_int_equal(outbox.front().identifier, 0x7FF);
  outbox.clear();
  assert_true(outbox.is_empty());
}

}  // namespace
}  // namespace flexrf::canopen

int main() {
  using namespace flexrf::canopen;
  const CMUnitTest tests[] = {
      cmocka_unit_test(identifiers_are_the_predefined_ones),
      cmocka_unit_test(nmt_commands_reach_their_node_or_all),
      cmocka_unit_test(heartbeats_tell_the_state_without_the_toggle_bit),
      cmocka_unit_test(guarding_asks_by_a_remote_frame_and_answers_toggle),
      cmocka_unit_test(silence_counts_from_the_first_heartbeat_on),
      cmocka_unit_test(our_heartbeat_comes_once_a_period_without_bursts),
      cmocka_unit_test(emergencies_are_decoded_and_named),
      cmocka_unit_test(remote_frames_carry_nothing),
      cmocka_unit_test(aborts_of_transfers_have_words),
      cmocka_unit_test(pdos_are_packed_in_order_least_byte_first),
      cmocka_unit_test(odd_widths_share_bytes),
      cmocka_unit_test(pdos_that_are_too_short_change_nothing),
      cmocka_unit_test(a_pdo_holds_eight_bytes),
      cmocka_unit_test(pdos_are_configured_in_the_prescribed_order),
      cmocka_unit_test(a_list_that_is_too_long_says_so),
      cmocka_unit_test(a_full_outbox_refuses_and_counts),
  };
  return cmocka_run_group_tests_name("canopen messages", tests, nullptr, nullptr);
}
