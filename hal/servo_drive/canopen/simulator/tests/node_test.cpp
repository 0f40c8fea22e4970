// A node brought up by its master, against the simulated drive: what each fault looks like, and that it ends.
#include <cstring>

#include "hal/canopen/sdo_abort.hpp"
#include "hal/servo_drive/canopen/simulator/tests/drive_bench.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using canopen::NodeState;
namespace axis = canopen::cia402::objects;

constexpr int bring_up_ms = 500;   // of a drive that boots at once
constexpr int recovery_ms = 2000;  // once a cause is gone

bool says(const Status& status, const char* words) {
  return std::strstr(status.cause(), words) != nullptr;
}

void a_node_is_identified_configured_and_started(void**) {
  DriveBench bench;
  bench.drive.power_on(bench.now());
  bench.begin();
  assert_true(bench.began().is_ok());
  assert_true(bench.node.state() == NodeState::awaited);
  assert_true(bench.run_until_operational(bring_up_ms));
  assert_true(bench.node.problem().is_ok());
  assert_true(bench.drive.nmt_state() == canopen::NmtState::operational);
  const DriveObjects& objects = bench.drive.objects();
  const auto commanded = objects.pdo(canopen::PdoDirection::received_by_node, 1);
  assert_true(commanded.has_value());
  assert_int_equal(commanded->identifier, 0x205);
  assert_int_equal(commanded->transmission, 1);
  assert_true(commanded->entries == command_pdo().entries);
  assert_true(objects.pdo(canopen::PdoDirection::sent_by_node, 1)->entries == state_pdo().entries);
  assert_int_equal(objects.get(canopen::objects::producer_heartbeat), 100);
  assert_int_equal(objects.get(canopen::objects::consumer_heartbeat), (127 << 16) | 250);
  assert_int_equal(objects.get(axis::period_value), cycle_ms);
  bench.run(5000);
  assert_true(bench.node.is_operational());
  assert_int_equal(bench.node.times_operational(), 1);
  assert_int_equal(bench.node.emergencies(), 0);
}

void a_node_that_is_off_is_told_and_comes_up_when_it_boots(void**) {
  DriveBench bench;
  bench.begin();
  bench.run(10000);
  assert_true(bench.node.state() == NodeState::awaited);
  assert_true(bench.node.problem().code() == StatusCode::timeout);
  assert_true(says(bench.node.problem(), "node 5 does not say boot-up"));
  bench.drive.power_on(bench.now());
  assert_true(bench.run_until_operational(recovery_ms));
  assert_true(bench.node.problem().is_ok());
}

void a_lost_heartbeat_is_told_and_the_node_comes_back(void**) {
  DriveBench bench;
  bench.drive.power_on(bench.now());
  bench.begin();
  assert_true(bench.run_until_operational(bring_up_ms));
  bench.drive.silence_heartbeat(true);
  bench.run(300);
  assert_false(bench.node.is_operational());
  assert_int_equal(bench.node.silences(), 1);
  assert_true(says(bench.node.problem(), "no heartbeat of node 5"));
  bench.run(5000);
  assert_false(bench.node.is_operational());
  assert_true(says(bench.node.problem(), "is not operational after"));
  bench.drive.silence_heartbeat(false);
  assert_true(bench.run_until_operational(recovery_ms));
  assert_int_equal(bench.node.times_operational(), 2);
}

void a_cable_out_and_in_again_costs_one_bring_up(void**) {
  DriveBench bench;
  bench.drive.power_on(bench.now());
  bench.begin();
  assert_true(bench.run_until_operational(bring_up_ms));
  bench.cable = false;
  bench.run(4500);
  assert_true(bench.node.state() == NodeState::awaited);
  assert_true(says(bench.node.problem(), "no heartbeat of node 5"));
  bench.cable = true;
  assert_true(bench.run_until_operational(recovery_ms));
  assert_int_equal(bench.node.times_operational(), 2);
  assert_int_equal(bench.node.silences(), 1);
}

void a_boot_up_that_nobody_hears_is_asked_for_again(void**) {
  DriveBench bench;
  bench.drive.power_on(bench.now());
  bench.cable = false;
  bench.begin();
  bench.run(100);
  assert_true(bench.drive.nmt_state() == canopen::NmtState::pre_operational);
  assert_true(bench.node.state() == NodeState::awaited);
  bench.cable = true;
  assert_true(bench.run_until_operational(recovery_ms));
}

void a_node_that_stops_answering_while_configuring_is_tried_again(void**) {
  canopen::Node node;
  canopen::Outbox outbox;
  Time now{std::chrono::seconds(1)};
  assert_true(node.begin(node_plan(), now, outbox).is_ok());
  assert_true(outbox.front() == canopen::nmt_message(canopen::NmtCommand::reset_communication, drive_node));
  outbox.clear();
  node.receive(canopen::heartbeat_message(canopen::NmtState::boot_up, drive_node), now, outbox);
  assert_true(node.state() == NodeState::configuring);
  assert_true(outbox.front() == (canopen::Message{0x000, 2, {0x80, 0x05}}));
  outbox.pop();
  assert_true(outbox.front() == (canopen::Message{0x605, 8, {0x40, 0x00, 0x10}}));
  outbox.clear();
  now += milliseconds(501);
  node.advance(now, outbox);
  assert_true(node.state() == NodeState::awaited);
  assert_true(says(node.problem(), "node 5 did not answer within 500 ms while reading object 1000:00"));
}

void a_node_that_resets_is_configured_anew(void**) {
  DriveBench bench;
  bench.drive.power_on(bench.now());
  bench.begin();
  assert_true(bench.run_until_operational(bring_up_ms));
  bench.drive.reset_itself(bench.now());
  assert_false(bench.drive.objects().pdo(canopen::PdoDirection::received_by_node, 1).has_value());
  for (int ms = 0; bench.node.is_operational() && ms < recovery_ms; ++ms) bench.run(1);
  assert_int_equal(bench.node.resets(), 1);
  assert_true(says(bench.node.problem(), "node 5 reset itself"));
  assert_true(bench.run_until_operational(bring_up_ms));
  assert_true(bench.drive.objects().pdo(canopen::PdoDirection::received_by_node, 1).has_value());
  assert_int_equal(bench.node.times_operational(), 2);
}

void a_foreign_node_is_refused_until_another_one_boots(void**) {
  DriveBench bench;
  bench.drive.objects().set_first(canopen::objects::vendor, 0x999);
  bench.drive.power_on(bench.now());
  bench.begin();
  bench.run(5000);
  assert_true(bench.node.state() == NodeState::refused);
  assert_true(bench.drive.nmt_state() == canopen::NmtState::pre_operational);
  assert_true(bench.node.problem().code() == StatusCode::device_fault);
  assert_true(says(bench.node.problem(), "its vendor is 00000999 and not 00000123"));
  bench.drive.objects().set_first(canopen::objects::vendor, 0x123);
  bench.drive.power_on(bench.now());
  assert_true(bench.run_until_operational(recovery_ms));
}

void a_node_of_another_profile_is_refused(void**) {
  DriveBench bench;
  bench.drive.objects().set_first(canopen::objects::device_type, 0x000F0191);
  bench.drive.power_on(bench.now());
  bench.begin();
  bench.run(500);
  assert_true(bench.node.state() == NodeState::refused);
  assert_true(says(bench.node.problem(), "its device profile is 00000191 and not 00000192"));
}

void an_abort_is_told_in_words_and_not_tried_for_ever(void**) {
  DriveBench bench;
  bench.drive.objects().refuse(axis::period_value, canopen::sdo_abort::out_of_range);
  bench.drive.power_on(bench.now());
  bench.begin();
  bench.run(5000);
  assert_true(bench.node.state() == NodeState::refused);
  assert_true(says(bench.node.problem(), "writing object 60C2:01 of node 5 was aborted by the node"));
  assert_true(says(bench.node.problem(), "out of its range"));
  bench.drive.objects().refuse({}, 0);
  bench.begin();
  assert_true(bench.run_until_operational(bring_up_ms));
}

void fix_as_planned(DriveObjects& objects, std::uint32_t third) {
  for (const canopen::PdoPlan& plan : {command_pdo(), velocity_pdo(), state_pdo()}) {
    objects.set_first(plan.mapping(0), plan.count);
    for (std::uint8_t i = 0; i < plan.count; ++i) {
      objects.set_first(plan.mapping(static_cast<std::uint8_t>(i + 1)),
                        canopen::mapping_word(plan.entries[i]));
    }
  }
  if (third != 0) objects.set_first(command_pdo().mapping(3), third);
  objects.fix_mapping();
}

void a_fixed_mapping_that_fits_is_used(void**) {
  DriveBench bench;
  fix_as_planned(bench.drive.objects(), 0);
  bench.drive.power_on(bench.now());
  bench.begin();
  assert_true(bench.run_until_operational(bring_up_ms));
  assert_int_equal(bench.drive.objects().pdo(canopen::PdoDirection::received_by_node, 1)->transmission, 1);
}

void a_fixed_mapping_that_does_not_fit_is_told(void**) {
  DriveBench bench;
  fix_as_planned(bench.drive.objects(), 0x60980008);
  bench.drive.power_on(bench.now());
  bench.begin();
  bench.run(1000);
  assert_true(bench.node.state() == NodeState::refused);
  assert_true(
      says(bench.node.problem(), "fixed PDO mapping, and object 1600:03 is 60980008, where 60600008"));
}

void emergencies_are_kept_until_they_end(void**) {
  DriveBench bench;
  bench.drive.power_on(bench.now());
  bench.begin();
  assert_true(bench.run_until_operational(bring_up_ms));
  bench.drive.trip(0x2310, false, bench.said_by_hand);
  bench.run(1);
  assert_true(bench.node.is_operational());
  assert_int_equal(bench.node.emergencies(), 1);
  assert_int_equal(bench.node.emergency()->code, 0x2310);
  bench.said_by_hand.push(canopen::emergency_message({}, drive_node));
  bench.run(1);
  assert_int_equal(bench.node.emergencies(), 2);
  assert_false(bench.node.emergency().has_value());
}

void a_node_that_leaves_operation_is_started_anew(void**) {
  DriveBench bench;
  bench.drive.power_on(bench.now());
  bench.begin();
  assert_true(bench.run_until_operational(bring_up_ms));
  bench.send(canopen::nmt_message(canopen::NmtCommand::enter_pre_operational, drive_node));
  for (int ms = 0; bench.node.is_operational() && ms < 200; ++ms) bench.run(1);
  assert_true(says(bench.node.problem(), "node 5 left operation by itself: it is pre-operational"));
  assert_true(bench.run_until_operational(recovery_ms));
}

void an_ended_node_is_left_alone(void**) {
  DriveBench bench;
  bench.drive.power_on(bench.now());
  bench.begin();
  assert_true(bench.run_until_operational(bring_up_ms));
  canopen::Outbox outbox;
  bench.node.end(outbox);
  assert_int_equal(outbox.size(), 1);
  bench.send(outbox.front());
  assert_true(bench.drive.nmt_state() == canopen::NmtState::pre_operational);
  bench.run(5000);
  assert_true(bench.node.state() == NodeState::off);
  assert_true(bench.drive.nmt_state() == canopen::NmtState::pre_operational);
}

void plans_that_make_no_sense_are_refused(void**) {
  canopen::Node node;
  canopen::Outbox outbox;
  const auto refused = [&node, &outbox](const canopen::NodePlan& plan, const char* words) {
    const Status status = node.begin(plan, Time{}, outbox);
    return status.code() == StatusCode::invalid_argument && says(status, words) && outbox.is_empty();
  };
  assert_true(refused({.node = 0}, "numbers from 1 to 127"));
  assert_true(refused({.node = 128}, "numbers from 1 to 127"));
  assert_true(refused({.node = 127}, "not the same"));
  assert_true(refused({.heartbeat_period = milliseconds(70000), .heartbeat_limit = milliseconds(200000)},
                      "65.535 s"));
  assert_true(refused({.heartbeat_period = milliseconds(100), .heartbeat_limit = milliseconds(100)},
                      "twice its period"));
  canopen::NodePlan long_plan;
  for (int i = 0; i < 200; ++i) long_plan.configuration.write({0x2000, 0}, 1, 0);
  assert_true(refused(long_plan, "more than 96 objects"));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_node_is_identified_configured_and_started),
      cmocka_unit_test(a_node_that_is_off_is_told_and_comes_up_when_it_boots),
      cmocka_unit_test(a_lost_heartbeat_is_told_and_the_node_comes_back),
      cmocka_unit_test(a_cable_out_and_in_again_costs_one_bring_up),
      cmocka_unit_test(a_boot_up_that_nobody_hears_is_asked_for_again),
      cmocka_unit_test(a_node_that_stops_answering_while_configuring_is_tried_again),
      cmocka_unit_test(a_node_that_resets_is_configured_anew),
      cmocka_unit_test(a_foreign_node_is_refused_until_another_one_boots),
      cmocka_unit_test(a_node_of_another_profile_is_refused),
      cmocka_unit_test(an_abort_is_told_in_words_and_not_tried_for_ever),
      cmocka_unit_test(a_fixed_mapping_that_fits_is_used),
      cmocka_unit_test(a_fixed_mapping_that_does_not_fit_is_told),
      cmocka_unit_test(emergencies_are_kept_until_they_end),
      cmocka_unit_test(a_node_that_leaves_operation_is_started_anew),
      cmocka_unit_test(an_ended_node_is_left_alone),
      cmocka_unit_test(plans_that_make_no_sense_are_refused),
  };
  return cmocka_run_group_tests_name("canopen node", tests, nullptr, nullptr);
}
