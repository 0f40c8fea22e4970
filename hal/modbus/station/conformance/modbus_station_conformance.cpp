#include "hal/modbus/station/conformance/modbus_station_conformance.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "hal/modbus/station/conformance/station_order_cases.hpp"
#include "tests/conformance.hpp"

namespace flexrf {
namespace {

// By the world's clock, for what must happen sooner or later: a loaded machine takes long.
constexpr Duration patience = std::chrono::seconds(30);
// Where time is counted: how long it may take until a station works again. It has been away for so long that
// it is tried as seldom as ever.
constexpr Duration recovery_limit = std::chrono::seconds(2);
constexpr Duration long_away = std::chrono::seconds(5);

MakeModbusStationWorld make_world = nullptr;

template <Verdict (*Run)(ModbusStationWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

enum Place : std::size_t {
  pressure,
  level,
  flow,
  ready,
  speed,
  ramp,
  lamp,
  counter,
  energy,
  open_door,
  closed_door,
  clutch,
  brake,
  places
};

constexpr ModbusRegister registers[places] = {
    {"pressure", 0, ModbusArea::holding_register, ModbusType::i16, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::fast, 0.01, "bar", 0},
    {"level", 1, ModbusArea::holding_register, ModbusType::u32, ModbusWordOrder::cdab, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "mm", 0},
    {"flow", 3, ModbusArea::input_register, ModbusType::f32, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::normal, 1, "l/s", 0},
    {"ready", 4, ModbusArea::discrete_input, ModbusType::boolean, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "", 0},
    {"speed", 10, ModbusArea::holding_register, ModbusType::i16, ModbusWordOrder::abcd,
     ModbusAccess::read_write, ModbusPollGroup::fast, 0.1, "rad/s", 0},
    {"ramp", 11, ModbusArea::holding_register, ModbusType::f32, ModbusWordOrder::dcba, ModbusAccess::write,
     ModbusPollGroup::fast, 1, "s", 2.5},
    {"lamp", 7, ModbusArea::coil, ModbusType::boolean, ModbusWordOrder::abcd, ModbusAccess::read_write,
     ModbusPollGroup::fast, 1, "", 1},
    {"counter", 20, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::slow, 1, "", 0},
    {"energy", 30, ModbusArea::input_register, ModbusType::i64, ModbusWordOrder::cdab, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "J", 0},
    {"open_door", 34, ModbusArea::input_register, ModbusType::boolean, ModbusWordOrder::abcd,
     ModbusAccess::read, ModbusPollGroup::fast, 1, "", 0, 3},
    {"closed_door", 34, ModbusArea::input_register, ModbusType::boolean, ModbusWordOrder::abcd,
     ModbusAccess::read, ModbusPollGroup::fast, 1, "", 0, 14},
    {"clutch", 13, ModbusArea::holding_register, ModbusType::boolean, ModbusWordOrder::abcd,
     ModbusAccess::read_write, ModbusPollGroup::fast, 1, "", 0, 0},
    {"brake", 13, ModbusArea::holding_register, ModbusType::boolean, ModbusWordOrder::abcd,
     ModbusAccess::read_write, ModbusPollGroup::fast, 1, "", 1, 9},
};
constexpr ModbusRegisterMap map{registers};

template <class Condition>
bool until(ModbusStationWorld& world, const Condition& is_so) {
  for (const Time start = world.now(); world.now() - start < patience;) {
    world.receive();
    const bool so = is_so();
    world.send();
    if (so) return true;
  }
  return false;
}

bool holds(ModbusStationWorld& world, std::size_t index, double value) {
  return std::abs(world.held(index) - value) < 1e-4;
}
bool reads(ModbusStationWorld& world, std::size_t index, double value) {
  const ModbusValue got = world.station().read(index);
  return got && std::abs(got.value - value) < 1e-4;
}
const ModbusStationFeedback& feedback(ModbusStationWorld& world) {
  return *static_cast<const ModbusStationFeedback*>(world.station().parameter_memory().feedback);
}

std::uint64_t failures(const ModbusStationFeedback& of) {
  return of.timeouts + of.exceptions + of.bad_replies + of.lost;
}

// Running, permitted to move, and reading.
bool starts_well(ModbusStationWorld& world) {
  if (!world.start(map)) return false;
  world.station().set_inhibited(false);
  world.put(pressure, 1.25);
  return until(world, [&] { return reads(world, pressure, 1.25) && holds(world, lamp, 1); });
}

// [modbus-station-1]
Verdict nothing_is_known_before_the_first_answer(ModbusStationWorld& world) {
  if (!world.start(map)) return Verdict::failed;
  const ModbusValue value = world.station().read(pressure);
  return verdict(!value && value.reason == NullReason::nothing_yet);
}

Verdict every_kind_of_register_is_read(ModbusStationWorld& world) {
  if (!world.start(map)) return Verdict::failed;
  world.put(pressure, -1.25);
  world.put(level, 70000);
  world.put(flow, 0.5);
  world.put(ready, 1);
  world.put(counter, 7);
  world.put(energy, -5e12);
  world.put(open_door, 0);
  world.put(closed_door, 1);
  return verdict(until(world, [&] {
    return reads(world, pressure, -1.25) && reads(world, level, 70000) && reads(world, flow, 0.5) &&
           reads(world, ready, 1) && reads(world, counter, 7) && reads(world, energy, -5e12) &&
           reads(world, open_door, 0) && reads(world, closed_door, 1);
  }));
}

Verdict values_carry_their_age(ModbusStationWorld& world) {
  if (!starts_well(world)) return Verdict::failed;
  const ModbusValue value = world.station().read(pressure);
  return verdict(value && value.age >= Duration{} && value.age < patience);
}

// [modbus-station-3]
Verdict what_is_set_is_written_and_read_back(ModbusStationWorld& world) {
  if (!starts_well(world)) return Verdict::failed;
  world.station().set(speed, -3.4);
  world.station().set(ramp, 1.5);
  world.station().set(lamp, 0);
  return verdict(until(world, [&] {
    return holds(world, speed, -3.4) && holds(world, ramp, 1.5) && holds(world, lamp, 0) &&
           reads(world, speed, -3.4) && reads(world, lamp, 0);
  }));
}

// [register-map-6]
Verdict bits_of_a_register_are_written_together(ModbusStationWorld& world) {
  if (!starts_well(world)) return Verdict::failed;
  if (!until(world, [&] { return holds(world, clutch, 0) && holds(world, brake, 1); }))
    return Verdict::failed;
  world.station().set(clutch, 1);
  if (!until(world, [&] { return reads(world, clutch, 1) && reads(world, brake, 1); }))
    return Verdict::failed;
  world.station().set(brake, 0);
  return verdict(until(world, [&] { return reads(world, clutch, 1) && reads(world, brake, 0); }));
}

// [modbus-station-6]
Verdict safe_values_are_written_while_it_may_not_move(ModbusStationWorld& world) {
  if (!world.start(map)) return Verdict::failed;
  world.station().set(speed, 5);  // not remembered
  if (!until(world, [&] { return holds(world, ramp, 2.5) && holds(world, lamp, 1); })) return Verdict::failed;
  world.station().set_inhibited(false);
  world.put(pressure, 2);
  // By the time this is read, what it had remembered would be written.
  if (!until(world, [&] { return reads(world, pressure, 2); })) return Verdict::failed;
  world.put(pressure, 3);
  return verdict(until(world, [&] { return reads(world, pressure, 3); }) && holds(world, speed, 0));
}

// [modbus-station-7]
Verdict made_safe_it_says_so_when_the_station_has_the_values(ModbusStationWorld& world) {
  if (!starts_well(world)) return Verdict::failed;
  world.station().set(speed, 4);
  world.station().set(ramp, 1);
  if (!until(world, [&] { return holds(world, speed, 4) && holds(world, ramp, 1); })) return Verdict::failed;
  for (const Time start = world.now(); world.now() - start < patience;) {
    world.receive();
    if (world.station().make_safe()) return verdict(holds(world, speed, 0) && holds(world, ramp, 2.5));
  }
  return Verdict::failed;
}

// [modbus-station-5]
Verdict not_a_number_puts_it_in_fault_with_safe_values(ModbusStationWorld& world) {
  if (!starts_well(world)) return Verdict::failed;
  world.station().set(speed, 4);
  if (!until(world, [&] { return holds(world, speed, 4); })) return Verdict::failed;
  world.station().set(speed, std::numeric_limits<double>::quiet_NaN());
  if (world.station().fault().is_ok()) return Verdict::failed;
  return verdict(until(world, [&] { return holds(world, speed, 0); }));
}

// [modbus-station-8]
Verdict what_is_no_input_is_never_known(ModbusStationWorld& world) {
  if (!starts_well(world)) return Verdict::failed;
  for (const std::size_t index : {std::size_t{ramp}, std::size_t{places}, ~std::size_t{0}}) {
    const ModbusValue value = world.station().read(index);
    if (value || value.reason != NullReason::not_registered) return Verdict::failed;
  }
  return Verdict::passed;
}

// [modbus-station-2]
Verdict unknown_names_are_refused_with_the_nearest(ModbusStationWorld& world) {
  if (!world.start(map)) return Verdict::failed;
  const auto found = world.station().input("level");
  const auto misspelt = world.station().input("presure");
  const auto not_written = world.station().output("pressure");
  return verdict(found && *found == level && !misspelt &&
                 std::strstr(misspelt.status().cause(), "`pressure`") != nullptr && !not_written &&
                 std::strstr(not_written.status().cause(), "not written") != nullptr);
}

// Up to just after a try, where one is counted: what ends its cause then is found latest.
void stay_away(ModbusStationWorld& world) {
  const Time start = world.now();
  std::uint64_t tried = failures(feedback(world));
  const auto passed = [&](Duration time) { return world.now() - start >= time; };
  static_cast<void>(until(world, [&] {
    if (!passed(long_away)) tried = failures(feedback(world));
    return passed(long_away + recovery_limit) || failures(feedback(world)) > tried;
  }));
}

// The value is no longer valid, for this reason; what happened is counted and said; once the cause is gone it
// reads and writes again.
Verdict is_noticed_and_survived(ModbusStationWorld& world, ModbusFarEnd behaviour, NullReason reason) {
  world.set_response_timeout(0.4);
  if (!starts_well(world)) return Verdict::failed;
  world.station().set(speed, 2);
  // Without an answer that was too late by then: the machine's failures are not the far end's.
  if (!until(world, [&] {
        return holds(world, speed, 2) && reads(world, pressure, 1.25) && feedback(world).online;
      }))
    return Verdict::failed;
  const std::uint64_t failed_before = failures(feedback(world));
  if (!world.make(behaviour)) return Verdict::skipped;
  const bool stays_online = behaviour == ModbusFarEnd::refuses;
  if (!until(world, [&] {
        return world.station().read(pressure).reason == reason && feedback(world).online == stays_online;
      }))
    return Verdict::failed;
  const bool said = failures(feedback(world)) > failed_before && !feedback(world).last_error_view().empty();
  if (world.has_counted_time()) stay_away(world);
  if (!world.make(ModbusFarEnd::well)) return Verdict::failed;
  const Time gone = world.now();
  world.put(pressure, 9);
  const bool back = until(
      world, [&] { return reads(world, pressure, 9) && holds(world, speed, 2) && feedback(world).online; });
  print_message("works again after %.3f s\n", seconds(world.now() - gone));
  return verdict(said && back && (!world.has_counted_time() || world.now() - gone <= recovery_limit));
}

// [modbus-station-1]
template <ModbusFarEnd Behaviour, NullReason Reason = NullReason::writer_stopped>
Verdict survives(ModbusStationWorld& world) {
  return is_noticed_and_survived(world, Behaviour, Reason);
}

// 120 registers in three blocks, of the group that is read once.
Verdict a_hundred_and_twenty_registers_in_three_blocks_take_three_requests(ModbusStationWorld& world) {
  static std::array<ModbusRegister, 120> many{};  // outlives the world
  for (std::size_t i = 0; i < many.size(); ++i) {
    many[i].name = "value";
    many[i].address = static_cast<std::uint16_t>(i + 1000 * (i / 40));
    many[i].poll_group = ModbusPollGroup::slow;
  }
  static const ModbusRegisterMap of_many{many};
  if (!world.start(of_many)) return Verdict::failed;
  if (world.requests() < 0) return Verdict::skipped;
  for (const std::size_t i : {0, 39, 40, 119}) world.put(i, static_cast<double>(i + 1));
  const bool read = until(world, [&] {
    return reads(world, 0, 1) && reads(world, 39, 40) && reads(world, 40, 41) && reads(world, 119, 120);
  });
  return verdict(read && world.requests() == 3 && failures(feedback(world)) == 0);
}

// Scaled by a power of ten that another register tells; 0x8000 and the like say that there is no value.
enum OddPlace : std::size_t { exponent, power, heat, gas, odd_places };
constexpr ModbusRegister odd_registers[odd_places] = {
    {.name = "exponent", .address = 40, .type = ModbusType::i16, .missing = 0x8000},
    {.name = "power",
     .address = 41,
     .type = ModbusType::i16,
     .unit = "W",
     .missing = 0x8000,
     .scale_register = exponent},
    {.name = "heat",
     .address = 42,
     .type = ModbusType::u16,
     .scale = 0.1,
     .unit = "degC",
     .offset = -40,
     .missing = 0xFFFF},
    {.name = "gas", .address = 43, .type = ModbusType::f32, .unit = "l/s", .missing = 0x7FC00000}};
constexpr ModbusRegisterMap odd_map{odd_registers};

// [modbus-station-9]
Verdict what_the_station_has_no_value_of_is_told_so(ModbusStationWorld& world) {
  if (!world.start(odd_map)) return Verdict::failed;
  world.put(exponent, -2);
  world.put(power, 12.34);
  world.put(heat, -12.3);
  world.put(gas, 0.5);
  const bool known = until(world, [&] {
    return reads(world, power, 12.34) && reads(world, heat, -12.3) && reads(world, gas, 0.5);
  });
  const auto is_missing = [&](std::size_t index) {
    const ModbusValue got = world.station().read(index);
    return !got && got.reason == NullReason::not_available && got.value == 0;
  };
  for (const std::size_t index : {heat, gas, exponent}) world.put(index, std::nan(""));
  const bool missing = until(world, [&] {
    return is_missing(heat) && is_missing(gas) && is_missing(exponent) && is_missing(power);
  });
  world.put(exponent, 11);  // more than a power of ten that anybody means
  const bool refused = until(world, [&] { return reads(world, exponent, 11) && is_missing(power); });
  world.put(exponent, 1);
  world.put(power, 250);
  world.put(heat, 0);
  const bool back =
      until(world, [&] { return reads(world, power, 250) && reads(world, heat, 0) && is_missing(gas); });
  return verdict(known && missing && refused && back);
}

constexpr ModbusRegister text_registers[] = {
    {.name = "maker", .address = 60, .type = ModbusType::text, .length = 8},
    {.name = "model",
     .address = 68,
     .type = ModbusType::text,
     .word_order = ModbusWordOrder::badc,
     .poll_group = ModbusPollGroup::once,
     .length = 2},
    {.name = "count", .address = 70, .type = ModbusType::u16}};
constexpr ModbusRegisterMap text_map{text_registers};

// [modbus-station-11]
Verdict texts_are_read(ModbusStationWorld& world) {
  constexpr std::size_t maker = 0, model = 1, count = 2;
  if (!world.start(text_map)) return Verdict::failed;
  if (world.station().read_text(maker).reason != NullReason::nothing_yet) return Verdict::failed;
  world.put_text(maker, "Pump & Co  ");
  world.put_text(model, "P-75");
  world.put(count, 3);
  const auto tells = [&](std::size_t index, std::string_view text) {
    const ModbusText got = world.station().read_text(index);
    return got && got.text() == text;
  };
  const bool told = until(
      world, [&] { return tells(maker, "Pump & Co") && tells(model, "P-75") && reads(world, count, 3); });
  const bool refused = world.station().read(maker).reason == NullReason::wrong_type &&
                       world.station().read_text(count).reason == NullReason::wrong_type &&
                       world.station().read_text(7).reason == NullReason::not_registered;
  return verdict(told && refused);
}

constexpr ModbusRegister kept_registers[] = {
    {.name = "serial", .address = 50, .type = ModbusType::u16, .poll_group = ModbusPollGroup::once},
    {.name = "count", .address = 51, .type = ModbusType::u16}};
constexpr ModbusRegisterMap kept_map{kept_registers};

// [modbus-station-10]
Verdict what_is_read_once_does_not_age(ModbusStationWorld& world) {
  constexpr std::size_t serial = 0, count = 1;
  if (!world.start(kept_map)) return Verdict::failed;
  world.put(serial, 7);
  world.put(count, 1);
  if (!until(world, [&] { return reads(world, serial, 7) && reads(world, count, 1); }))
    return Verdict::failed;
  world.put(serial, 8);
  world.put(count, 2);
  const Time start = world.now();
  return verdict(until(world, [&] {
    return reads(world, count, 2) && reads(world, serial, 7) && world.now() - start > std::chrono::seconds(1);
  }));
}

// [modbus-station-12]
void orders_judged(void**) {
  conclude(no_order_of_events_writes_what_nobody_set(make_world));
}

CMUnitTest test(const char* name, CMUnitTestFunction run) {
  return {name, run, nullptr, nullptr, nullptr};
}

}  // namespace

int run_modbus_station_conformance(const char* driver, MakeModbusStationWorld make) {
  make_world = make;
  using enum ModbusFarEnd;
  const CMUnitTest tests[] = {
      test("nothing is known before the first answer", judged<nothing_is_known_before_the_first_answer>),
      test("every kind of register is read", judged<every_kind_of_register_is_read>),
      test("what the station has no value of is told so",
           judged<what_the_station_has_no_value_of_is_told_so>),
      test("texts are read", judged<texts_are_read>),
      test("what is read once does not age", judged<what_is_read_once_does_not_age>),
      test("values carry their age", judged<values_carry_their_age>),
      test("what is set is written and read back", judged<what_is_set_is_written_and_read_back>),
      test("bits of a register are written together", judged<bits_of_a_register_are_written_together>),
      test("safe values are written while it may not move",
           judged<safe_values_are_written_while_it_may_not_move>),
      test("made safe, it says so when the station has the values",
           judged<made_safe_it_says_so_when_the_station_has_the_values>),
      test("not a number puts it in fault, with safe values",
           judged<not_a_number_puts_it_in_fault_with_safe_values>),
      test("what is no input is never known", judged<what_is_no_input_is_never_known>),
      test("unknown names are refused with the nearest", judged<unknown_names_are_refused_with_the_nearest>),
      test("120 registers in three blocks take three requests",
           judged<a_hundred_and_twenty_registers_in_three_blocks_take_three_requests>),
      test("silent peer", judged<survives<silent>>),
      test("peer that answers too late", judged<survives<slow>>),
      test("exception replies", judged<survives<refuses, NullReason::writer_faulted>>),
      test("garbage for an answer", judged<survives<damaged>>),
      test("answers that end early", judged<survives<truncated>>),
      test("answers of another unit", judged<survives<other_unit>>),
      test("connection cut and back", judged<survives<cut>>),
      test("connection cut and back, far end switched off meanwhile", judged<survives<disconnected>>),
      test("no order of events writes what nobody set", orders_judged),
  };
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
