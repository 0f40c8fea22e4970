// How many requests a register map takes.
#include "hal/modbus/link/interface/modbus_plan.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf {
namespace {

ModbusRegister at(int address, ModbusArea area = ModbusArea::holding_register,
                  ModbusType type = ModbusType::u16) {
  ModbusRegister entry;
  entry.name = "value";
  entry.address = static_cast<std::uint16_t>(address);
  entry.area = area;
  entry.type = type;
  return entry;
}

// 0 when the plan is refused.
std::size_t reads_of(const std::vector<ModbusRegister>& registers) {
  ModbusPlan plan;
  if (!plan_requests({registers}, 125, plan)) return 0;
  return plan.reads.size();
}

// [modbus-plan-1]
void a_hundred_and_twenty_registers_in_three_blocks_take_three_requests(void**) {
  std::size_t reads = 0;
  {
    std::vector<ModbusRegister> registers;
    for (const int start : {0, 1000, 2000})
      for (int i = 0; i < 40; ++i) registers.push_back(at(start + i));
    reads = reads_of(registers);
  }
  assert_int_equal(reads, 3);
}

std::size_t requests_of(ModbusAccess access, int count) {
  std::vector<ModbusRegister> registers;
  for (int i = 0; i < count; ++i) {
    registers.push_back(at(i));
    registers.back().access = access;
  }
  ModbusPlan plan;
  if (!plan_requests({registers}, 125, plan)) return 0;
  return access == ModbusAccess::read ? plan.reads.size() : plan.writes.size();
}

// [modbus-plan-2]
void less_fits_into_what_is_written(void**) {
  assert_int_equal(requests_of(ModbusAccess::read, 125), 1);
  assert_int_equal(requests_of(ModbusAccess::write, 123), 1);
  assert_int_equal(requests_of(ModbusAccess::write, 124), 2);
}

// [modbus-plan-2]
void the_protocol_s_limits_are_kept(void**) {
  std::size_t fits = 0, over = 0, pairs = 0;
  {
    std::vector<ModbusRegister> registers;
    for (int i = 0; i < 125; ++i) registers.push_back(at(i));
    fits = reads_of(registers);
    registers.push_back(at(125));
    over = reads_of(registers);
    registers.clear();
    for (int i = 0; i < 63; ++i)
      registers.push_back(at(2 * i, ModbusArea::holding_register, ModbusType::f32));
    pairs = reads_of(registers);  // 126 registers; no value is cut in two
  }
  assert_int_equal(fits, 1);
  assert_int_equal(over, 2);
  assert_int_equal(pairs, 2);
}

// [modbus-plan-1] [modbus-plan-3]
void areas_groups_and_gaps_are_apart_and_the_list_s_order_is_free(void**) {
  std::size_t reads = 0, contiguous = 0;
  {
    std::vector<ModbusRegister> registers = {at(2), at(0), at(1)};
    contiguous = reads_of(registers);
    registers.push_back(at(3, ModbusArea::input_register));
    registers.push_back(at(5));
    registers.push_back(at(3));
    registers.back().poll_group = ModbusPollGroup::slow;
    reads = reads_of(registers);
  }
  assert_int_equal(contiguous, 1);
  assert_int_equal(reads, 4);
}

ModbusRegister bit_of(int address, int bit, ModbusAccess access) {
  ModbusRegister entry = at(address, ModbusArea::holding_register, ModbusType::boolean);
  entry.bit = static_cast<std::uint8_t>(bit);
  entry.access = access;
  return entry;
}

// [register-map-6]
void bits_of_a_register_share_its_word(void**) {
  ModbusPlace places[5];
  std::size_t reads = 0, writes = 0, registers_read = 0, registers_written = 0;
  {
    const std::vector<ModbusRegister> registers = {
        bit_of(7, 3, ModbusAccess::write), bit_of(7, 0, ModbusAccess::read_write), at(8),
        bit_of(7, 15, ModbusAccess::read), bit_of(6, 0, ModbusAccess::write)};
    ModbusPlan plan;
    if (plan_requests({registers}, 125, plan)) {
      std::copy(plan.places.begin(), plan.places.end(), places);
      reads = plan.reads.size();
      writes = plan.writes.size();
      registers_read = plan.reads[0].count;
      registers_written = plan.writes[0].count;
    }
  }
  assert_int_equal(reads, 1);
  assert_int_equal(registers_read, 2);
  assert_int_equal(writes, 1);
  assert_int_equal(registers_written, 2);
  assert_int_equal(places[1].input, places[3].input);
  assert_int_equal(places[1].read, places[3].read);
  assert_int_equal(places[2].input, places[1].input + 1);
  assert_int_equal(places[0].output, places[1].output);
  assert_int_equal(places[0].output, places[4].output + 1);
  assert_int_equal(places[0].input, ModbusPlace::none);
  assert_int_equal(places[3].output, ModbusPlace::none);
}

void written_and_read_lie_in_their_own_words(void**) {
  ModbusPlace place;
  std::size_t reads = 0, writes = 0;
  {
    std::vector<ModbusRegister> registers = {at(0), at(1), at(2)};
    registers[1].access = ModbusAccess::read_write;
    registers[2].access = ModbusAccess::write;
    ModbusPlan plan;
    if (plan_requests({registers}, 125, plan)) {
      place = plan.places[1];
      reads = plan.reads.size();
      writes = plan.writes.size();
    }
  }
  assert_int_equal(reads, 1);
  assert_int_equal(writes, 1);
  assert_int_equal(place.input, 1);
  assert_int_equal(place.output, 0);
}

// [modbus-plan-4]
void scattered_registers_are_refused_with_a_hint(void**) {
  char cause[Status::cause_capacity] = "";
  {
    std::vector<ModbusRegister> registers;
    for (int i = 0; i < 65; ++i) registers.push_back(at(2 * i));
    ModbusPlan plan;
    const Status status = plan_requests({registers}, 125, plan);
    std::memcpy(cause, status.cause(), sizeof(cause));
  }
  assert_non_null(std::strstr(cause, "takes 65 requests, at most 64"));
  assert_non_null(std::strstr(cause, "list the registers between"));
}

std::vector<ModbusRegister> written(int count) {
  std::vector<ModbusRegister> registers;
  for (int i = 0; i < count; ++i) {
    registers.push_back(at(i));
    registers.back().access = ModbusAccess::read_write;
  }
  return registers;
}

// [modbus-plan-5]
void a_request_has_no_more_registers_than_the_station_takes() {
  const std::vector<ModbusRegister> registers = written(10);
  ModbusPlan plan;
  CHECK(plan_requests({registers}, 4, plan));
  CHECK_EQUAL(plan.reads.size(), 3U);
  CHECK_EQUAL(plan.writes.size(), 3U);
  CHECK_EQUAL(plan.reads[2].count, 2);
  const std::vector<ModbusRegister> coils = {at(0, ModbusArea::coil, ModbusType::boolean),
                                             at(1, ModbusArea::coil, ModbusType::boolean)};
  CHECK(plan_requests({coils}, 1, plan));
  CHECK_EQUAL(plan.reads.size(), 1U);
  const std::vector<ModbusRegister> wide = {at(0, ModbusArea::holding_register, ModbusType::i32)};
  const Status refused = plan_requests({wide}, 1, plan);
  CHECK_EQUAL(refused.code(), StatusCode::invalid_argument);
  CHECK_CONTAINS(refused.cause(), "`value` has 2 registers, and a request may have 1");
  CHECK_CONTAINS(refused.cause(), "raise most_registers");
}

// [modbus-plan-6]
void what_is_written_at_changes_alone_goes_by_itself() {
  std::vector<ModbusRegister> registers = written(4);
  registers[2].refreshed = false;
  ModbusPlan plan;
  CHECK(plan_requests({registers}, 125, plan));
  CHECK_EQUAL(plan.reads.size(), 1U);
  CHECK_EQUAL(plan.writes.size(), 3U);
  CHECK(plan.writes[0].refreshed && !plan.writes[1].refreshed && plan.writes[2].refreshed);
  CHECK_EQUAL(plan.writes[1].address, 2);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_hundred_and_twenty_registers_in_three_blocks_take_three_requests),
      cmocka_unit_test(less_fits_into_what_is_written),
      cmocka_unit_test(the_protocol_s_limits_are_kept),
      cmocka_unit_test(areas_groups_and_gaps_are_apart_and_the_list_s_order_is_free),
      cmocka_unit_test(bits_of_a_register_share_its_word),
      cmocka_unit_test(written_and_read_lie_in_their_own_words),
      cmocka_unit_test(scattered_registers_are_refused_with_a_hint),
      CONTAINED_TEST(a_request_has_no_more_registers_than_the_station_takes),
      CONTAINED_TEST(what_is_written_at_changes_alone_goes_by_itself)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
