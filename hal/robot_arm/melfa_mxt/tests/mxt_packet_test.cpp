#include "hal/robot_arm/melfa_mxt/mxt_packet.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf::melfa;

// Where each field lies, byte by byte.
void fields_lie_where_the_protocol_has_them(void**) {
  Packet packet;
  packet.command = commands::end;
  packet.send_content = 0x0102;
  packet.reply_contents = {0x1112, 0x2122, 0x3132, 0x4142};
  packet.send_signals = 0x5152;
  packet.reply_signals = 0x5354;
  packet.first_signal = 0x5556;
  packet.signal_mask = 0x5758;
  packet.signals = 0x595A;
  packet.timeouts = 0x5B5C;
  packet.counter = 0x61626364;
  for (std::size_t group = 0; group < groups; ++group) {
    packet.data[group].front() = 0xA0A1A2A3;
    packet.data[group].back() = 0xB0B1B2B3;
  }
  const PacketBytes bytes = pack(packet);
  const auto u16 = [&bytes](std::size_t at) { return bytes[at] + 256 * bytes[at + 1]; };
  const auto is = [&bytes](std::size_t at, std::uint8_t low) {
    return bytes[at] == low && bytes[at + 1] == low - 1 && bytes[at + 2] == low - 2 &&
           bytes[at + 3] == low - 3;
  };
  assert_int_equal(u16(0), 255);
  assert_int_equal(u16(2), 0x0102);
  assert_int_equal(u16(4), 0x1112);
  assert_int_equal(u16(6), 0);
  assert_int_equal(u16(48), 0x5152);
  assert_int_equal(u16(50), 0x5354);
  assert_int_equal(u16(52), 0x5556);
  assert_int_equal(u16(54), 0x5758);
  assert_int_equal(u16(56), 0x595A);
  assert_int_equal(u16(58), 0x5B5C);
  assert_true(is(60, 0x64));
  assert_int_equal(u16(64), 0x2122);
  assert_int_equal(u16(66), 0);
  assert_int_equal(u16(108), 0x3132);
  assert_int_equal(u16(110), 0);
  assert_int_equal(u16(152), 0x4142);
  assert_int_equal(u16(154), 0);
  for (const std::size_t at : {8, 68, 112, 156}) {
    assert_true(is(at, 0xA3));
    assert_true(is(at + 36, 0xB3));
  }
}

void a_joint_is_a_little_endian_single(void**) {
  Packet packet;
  packet.data[0] = words_of({1.0F, -2.0F});
  const PacketBytes bytes = pack(packet);
  const std::uint8_t wanted[] = {0x00, 0x00, 0x80, 0x3F, 0x00, 0x00, 0x00, 0xC0};
  assert_memory_equal(&bytes[8], wanted, sizeof(wanted));
}

void whatever_arrives_is_packed_as_it_came_but_for_reserved_bytes(void**) {
  std::mt19937 random(1);
  for (int run = 0; run < 2000; ++run) {
    PacketBytes bytes{};
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    for (const std::size_t at : {6, 66, 110, 154}) bytes[at] = bytes[at + 1] = 0;
    const auto packet = unpack(bytes);
    assert_true(packet.has_value());
    assert_true(pack(*packet) == bytes);
    assert_true(unpack(pack(*packet)) == packet);
  }
}

void another_length_is_no_packet(void**) {
  std::array<std::uint8_t, 400> bytes{};
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    assert_true(unpack(std::span(bytes).first(length)).has_value() == (length == packet_bytes));
  }
}

void joints_are_found_in_the_group_that_holds_them(void**) {
  const Joints joints{0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F};
  for (std::size_t group = 0; group < groups; ++group) {
    Packet reply;
    reply.reply_contents[group] = contents::measured_joints;
    reply.data[group] = words_of(joints);
    assert_true(joints_told(reply, contents::measured_joints) == joints);
    assert_false(joints_told(reply, contents::joints).has_value());
  }
}

void joints_that_are_no_numbers_are_not_told(void**) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Packet reply;
    reply.reply_contents[0] = contents::joints;
    reply.data[0] = words_of({0, 0, bad});
    assert_false(joints_told(reply, contents::joints).has_value());
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(fields_lie_where_the_protocol_has_them),
      cmocka_unit_test(a_joint_is_a_little_endian_single),
      cmocka_unit_test(whatever_arrives_is_packed_as_it_came_but_for_reserved_bytes),
      cmocka_unit_test(another_length_is_no_packet),
      cmocka_unit_test(joints_are_found_in_the_group_that_holds_them),
      cmocka_unit_test(joints_that_are_no_numbers_are_not_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
