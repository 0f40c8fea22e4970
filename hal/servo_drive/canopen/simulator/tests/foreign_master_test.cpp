// The simulated drive as a stranger's master meets it: frames written down from CiA 301 and CiA 402, byte by
// byte, without a line of the master's.
#include <cstring>
#include <vector>

#include "hal/servo_drive/canopen/simulator/simulated_cia402_drive.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using canopen::Message;

constexpr std::uint8_t node = 5;

struct Bench {
  Bench() {
    drive.power_on(now);
    run(30);
  }
  void send(const Message& frame) {
    drive.receive(frame, now, said);
    collect();
  }
  void run(int ms) {
    for (int i = 0; i < ms; ++i) {
      now += std::chrono::milliseconds(1);
      drive.advance(now, said);
      collect();
    }
  }
  // SYNC each 10 ms.
  void run_with_sync(int ms) {
    for (int i = 0; i < ms; i += 10) {
      send({0x080, 0, {}});
      run(10);
    }
  }
  // The answer's command byte, and its value or abort code.
  std::uint8_t ask(std::uint16_t index, std::uint8_t subindex) {
    return request({0x605, 8, {0x40, low(index), high(index), subindex}});
  }
  std::uint8_t tell(std::uint16_t index, std::uint8_t subindex, unsigned bytes, std::uint32_t number) {
    Message frame{0x605, 8, {0, low(index), high(index), subindex}};
    frame.data[0] = static_cast<std::uint8_t>(0x23 | (4 - bytes) << 2);
    for (unsigned i = 0; i < bytes; ++i) frame.data[4 + i] = static_cast<std::uint8_t>(number >> (8 * i));
    return request(frame);
  }
  bool holds(std::uint16_t index, std::uint8_t subindex, std::uint8_t command, std::uint32_t number) {
    const std::uint8_t answered = ask(index, subindex);
    if (answered == command && value == number) return true;
    print_message("%04X:%02X: %02X %08lX\n", unsigned{index}, unsigned{subindex}, unsigned{answered},
                  static_cast<unsigned long>(value));
    return false;
  }
  // All by SDO, in pre-operational, so that each acts as it is written.
  bool is_enabled_in_profile_position() {
    tell(0x6060, 0, 1, 1);
    for (const std::uint32_t word : {0x06U, 0x07U, 0x0FU}) {
      tell(0x6040, 0, 2, word);
      run(60);
    }
    tell(0x6040, 0, 2, 0x0F);
    ask(0x6041, 0);
    return (value & 0x6F) == 0x27;
  }
  bool goes_to(std::int32_t target, std::uint16_t bits) {
    tell(0x607A, 0, 4, static_cast<std::uint32_t>(target));
    tell(0x6040, 0, 2, 0x1FU | bits);
    tell(0x6040, 0, 2, 0x0FU | bits);
    run(2000);
    ask(0x6041, 0);
    const bool reached = (value & 0x0400) != 0;
    ask(0x6064, 0);
    return reached;
  }
  std::int32_t position() {
    ask(0x6064, 0);
    return static_cast<std::int32_t>(value);
  }
  std::vector<Message> frames_of(std::uint16_t identifier) const {
    std::vector<Message> found;
    for (const Message& frame : frames) {
      if (frame.identifier == identifier) found.push_back(frame);
    }
    return found;
  }
  // TPDO 1: statusword and actual position.
  void map_state_pdo(std::uint8_t transmission, std::uint16_t inhibit = 0, std::uint16_t event_timer = 0) {
    tell(0x1800, 1, 4, 0xC0000185);
    tell(0x1A00, 0, 1, 0);
    tell(0x1A00, 1, 4, 0x60410010);
    tell(0x1A00, 2, 4, 0x60640020);
    tell(0x1A00, 0, 1, 2);
    tell(0x1800, 2, 1, transmission);
    tell(0x1800, 3, 2, inhibit);
    tell(0x1800, 5, 2, event_timer);
    tell(0x1800, 1, 4, 0x40000185);
  }
  void start() {
    send({0x000, 2, {0x01, node}});
    frames.clear();
  }

  Time now{std::chrono::seconds(1)};
  SimulatedCia402Drive drive{{.node = node}};
  canopen::Outbox said;
  std::vector<Message> frames;  // that it said
  std::uint32_t value = 0;

 private:
  static std::uint8_t low(std::uint16_t index) { return static_cast<std::uint8_t>(index & 0xFF); }
  static std::uint8_t high(std::uint16_t index) { return static_cast<std::uint8_t>(index >> 8); }

  std::uint8_t request(const Message& frame) {
    send(frame);
    const std::vector<Message> answers = frames_of(0x585);
    if (answers.empty()) return 0;
    const auto& data = answers.back().data;
    value = std::uint32_t{data[4]} | std::uint32_t{data[5]} << 8 | std::uint32_t{data[6]} << 16 |
            std::uint32_t{data[7]} << 24;
    return data[0];
  }
  void collect() {
    for (; !said.is_empty(); said.pop()) frames.push_back(said.front());
  }
};

// What it answers to reading, and to writing a byte: each with its command byte, and value or abort code.
void objects_answer_as_what_they_are(void**) {
  struct Answer {
    std::uint16_t index;
    std::uint8_t subindex;
    std::uint8_t command;
    std::uint32_t number;
  };
  constexpr Answer read[] = {
      // Records tell their highest subindex.
      {0x1016, 0, 0x4F, 1},
      {0x1018, 0, 0x4F, 2},
      {0x1400, 0, 0x4F, 5},
      {0x1801, 0, 0x4F, 5},
      {0x6099, 0, 0x4F, 2},
      {0x60C2, 0, 0x4F, 2},
      // What is missing is a subindex, or the object.
      {0x1018, 5, 0x80, 0x06090011},
      {0x6040, 1, 0x80, 0x06090011},
      {0x2000, 0, 0x80, 0x06020000},
      {0x2000, 3, 0x80, 0x06020000},
  };
  constexpr Answer written[] = {{0x1018, 0, 0x80, 0x06010002}, {0x60C2, 9, 0x80, 0x06090011}};
  Bench bench;
  for (const Answer& wanted : read)
    assert_true(bench.holds(wanted.index, wanted.subindex, wanted.command, wanted.number));
  for (const Answer& wanted : written) {
    assert_int_equal(bench.tell(wanted.index, wanted.subindex, 1, 3), wanted.command);
    assert_int_equal(bench.value, wanted.number);
  }
}

void sync_has_the_identifier_that_it_is_given(void**) {
  Bench bench;
  assert_true(bench.holds(0x1005, 0, 0x43, 0x80));
  bench.map_state_pdo(1);
  assert_int_equal(bench.tell(0x1005, 0, 4, 0x90), 0x60);
  bench.start();
  bench.run_with_sync(50);
  assert_int_equal(bench.frames_of(0x185).size(), 0);
  bench.send({0x090, 0, {}});
  assert_int_equal(bench.frames_of(0x185).size(), 1);
}

void a_pdo_comes_with_each_so_many_syncs(void**) {
  Bench bench;
  bench.map_state_pdo(3);
  bench.start();
  bench.run_with_sync(300);
  assert_int_equal(bench.frames_of(0x185).size(), 10);
}

void a_pdo_of_type_0_comes_with_the_sync_behind_a_change(void**) {
  Bench bench;
  bench.map_state_pdo(0);
  bench.start();
  bench.run_with_sync(100);
  assert_int_equal(bench.frames_of(0x185).size(), 1);
  bench.tell(0x6040, 0, 2, 0x06);
  bench.run(50);
  assert_int_equal(bench.frames_of(0x185).size(), 1);
  bench.run_with_sync(50);
  const auto frames = bench.frames_of(0x185);
  assert_int_equal(frames.size(), 2);
  assert_int_equal(frames[1].data[0] & 0x6F, 0x21);
}

void a_pdo_of_type_255_comes_with_its_event_timer_and_a_change(void**) {
  Bench bench;
  bench.map_state_pdo(255, 0, 20);
  bench.start();
  bench.run(200);
  const std::size_t by_time = bench.frames_of(0x185).size();
  assert_in_range(by_time, 10, 11);
  bench.tell(0x6040, 0, 2, 0x06);
  bench.run(1);
  assert_int_equal(bench.frames_of(0x185).size(), by_time + 1);
  // Without the timer: changes alone, and no two within 5 ms.
  Bench other;
  other.map_state_pdo(254, 50, 0);
  other.start();
  other.run(200);
  assert_int_equal(other.frames_of(0x185).size(), 1);
  assert_true(other.is_enabled_in_profile_position());
  other.frames.clear();
  other.goes_to(10000, 0);
  assert_in_range(other.frames_of(0x185).size(), 20, 400);
}

void targets_may_be_relative_to_the_last_one(void**) {
  Bench bench;
  assert_true(bench.is_enabled_in_profile_position());
  assert_int_equal(bench.position(), 1000);
  assert_true(bench.goes_to(500, 0x40));
  assert_int_equal(bench.position(), 1500);
  assert_true(bench.goes_to(-700, 0x40));
  assert_int_equal(bench.position(), 800);
  assert_true(bench.goes_to(500, 0));
  assert_int_equal(bench.position(), 500);
}

// Sub mode, period, points by SDO; bit 4 of the controlword enables interpolation, bit 12 of the statusword
// says that it is active.
void interpolation_is_enabled_beside_the_operation(void**) {
  Bench bench;
  bench.ask(0x6502, 0);
  assert_int_equal(bench.value & 1U << 6, 1U << 6);
  assert_int_equal(bench.tell(0x60C0, 0, 2, 0), 0x60);
  assert_true(bench.holds(0x60C1, 0, 0x4F, 1));
  assert_int_equal(bench.tell(0x60C2, 1, 1, 20), 0x60);
  assert_int_equal(bench.tell(0x6060, 0, 1, 7), 0x60);
  for (const std::uint32_t word : {0x06U, 0x07U, 0x0FU}) {
    bench.tell(0x6040, 0, 2, word);
    bench.run(60);
  }
  bench.tell(0x6040, 0, 2, 0x0F);
  bench.run(10);
  assert_true(bench.holds(0x6061, 0, 0x4F, 7));
  bench.ask(0x6041, 0);
  assert_int_equal(bench.value & 0x106F, 0x0027);
  bench.tell(0x60C1, 1, 4, 1200);
  bench.run(100);
  assert_int_equal(bench.position(), 1000);
  bench.tell(0x6040, 0, 2, 0x1F);
  bench.run(100);
  assert_int_equal(bench.position(), 1200);
  bench.ask(0x6041, 0);
  assert_int_equal(bench.value & 0x106F, 0x1027);
  bench.tell(0x60C1, 1, 4, 1300);
  bench.run(10);
  assert_int_equal(bench.position(), 1250);
  bench.tell(0x6040, 0, 2, 0x0F);
  bench.run(100);
  bench.ask(0x6041, 0);
  assert_int_equal(bench.value & 0x106F, 0x0027);
}

void a_fault_is_in_the_error_register_until_it_is_reset(void**) {
  Bench bench;
  assert_true(bench.holds(0x1001, 0, 0x4F, 0));
  bench.drive.trip(0x2310, false, bench.said);
  bench.run(100);
  assert_true(bench.holds(0x1001, 0, 0x4F, 1));
  assert_int_equal(bench.frames_of(0x085).size(), 1);
  bench.tell(0x6040, 0, 2, 0x80);
  bench.run(10);
  assert_true(bench.holds(0x1001, 0, 0x4F, 0));
  const auto emergencies = bench.frames_of(0x085);
  assert_int_equal(emergencies.size(), 2);
  constexpr std::uint8_t over_current[] = {0x10, 0x23, 0x01, 0, 0, 0, 0, 0};
  constexpr std::uint8_t none_left[] = {0, 0, 0, 0, 0, 0, 0, 0};
  assert_memory_equal(emergencies[0].data.data(), over_current, 8);
  assert_memory_equal(emergencies[1].data.data(), none_left, 8);
}

void a_lost_heartbeat_is_in_the_error_register_until_it_is_enabled_anew(void**) {
  Bench bench;
  bench.tell(0x1016, 1, 4, 127 << 16 | 100);
  bench.send({0x77F, 1, {0x05}});
  bench.run(200);
  assert_true(bench.holds(0x1001, 0, 0x4F, 0x11));
  bench.send({0x77F, 1, {0x05}});
  bench.tell(0x6040, 0, 2, 0x06);
  assert_true(bench.holds(0x1001, 0, 0x4F, 0));
  const auto emergencies = bench.frames_of(0x085);
  assert_int_equal(emergencies.size(), 2);
  assert_int_equal(emergencies[0].data[0] | emergencies[0].data[1] << 8, 0x8130);
  assert_int_equal(emergencies[1].data[0] | emergencies[1].data[1] << 8, 0x0000);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(objects_answer_as_what_they_are),
      cmocka_unit_test(sync_has_the_identifier_that_it_is_given),
      cmocka_unit_test(a_pdo_comes_with_each_so_many_syncs),
      cmocka_unit_test(a_pdo_of_type_0_comes_with_the_sync_behind_a_change),
      cmocka_unit_test(a_pdo_of_type_255_comes_with_its_event_timer_and_a_change),
      cmocka_unit_test(targets_may_be_relative_to_the_last_one),
      cmocka_unit_test(interpolation_is_enabled_beside_the_operation),
      cmocka_unit_test(a_fault_is_in_the_error_register_until_it_is_reset),
      cmocka_unit_test(a_lost_heartbeat_is_in_the_error_register_until_it_is_enabled_anew),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
