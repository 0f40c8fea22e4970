// Whose turn it is, on a link whose stations are a script and whose clock is the test's.
#include "hal/modbus/link/interface/modbus_master.hpp"

#include <cstdlib>
#include <vector>

#include "hal/modbus/link/interface/modbus_exchange.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf {
namespace {

constexpr Duration response_timeout = std::chrono::milliseconds(300);
constexpr Duration answer_time = std::chrono::milliseconds(2);
constexpr Duration cycle = std::chrono::milliseconds(10);
constexpr Duration shortest_pause = std::chrono::milliseconds(50);
constexpr Duration longest_pause = std::chrono::seconds(1);

constexpr ModbusRegister registers[] = {
    {"level", 0, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "", 0},
    {"speed", 10, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::write,
     ModbusPollGroup::fast, 1, "", 0},
};
constexpr ModbusRegisterMap map{registers};

class ScriptedLine final : public ModbusTransport {
 public:
  struct Station {
    ModbusOutcome outcome = ModbusOutcome::answered;
    ModbusOutcome read_outcome = ModbusOutcome::answered;
    ModbusOutcome write_outcome = ModbusOutcome::answered;
    bool knows_single = true;
    bool knows_multiple = true;
    bool refuses = false;  // whatever is written, for another reason
    int reads = 0;
    int writes = 0;  // asked of it; `taken`: that it answered
    int taken = 0;
    std::uint16_t written = 0;
  };
  Station& station(std::size_t unit_id) { return stations_[unit_id]; }
  int failures() const { return failures_; }
  int resynchronisations() const { return resynchronisations_; }
  void pass(Duration time) { now_ += time; }
  void set_times(Duration answer, Duration wait) {
    answer_time_ = answer;
    wait_ = wait;
  }

  Status open() noexcept override {
    open_ = true;
    return {};
  }
  void close() noexcept override { open_ = false; }
  bool is_open() const noexcept override { return open_; }
  ModbusReply read(std::uint8_t unit_id, const ModbusBlock& /*block*/,
                   std::uint16_t* words) noexcept override {
    Station& asked = stations_[unit_id];
    ++asked.reads;
    words[0] = unit_id;
    return answer(asked.outcome != ModbusOutcome::answered ? asked.outcome : asked.read_outcome);
  }
  ModbusReply write(std::uint8_t unit_id, const ModbusBlock& block, const std::uint16_t* words,
                    bool multiple) noexcept override {
    Station& asked = stations_[unit_id];
    ++asked.writes;
    const bool is_known = multiple || block.count > 1 ? asked.knows_multiple : asked.knows_single;
    if (asked.outcome == ModbusOutcome::answered && (!is_known || asked.refuses)) {
      now_ += answer_time_;
      return {ModbusOutcome::exception, "as the script has it", is_known ? std::uint8_t{4} : std::uint8_t{1}};
    }
    if (asked.outcome != ModbusOutcome::answered) return answer(asked.outcome);
    if (asked.write_outcome == ModbusOutcome::answered) {
      asked.written = words[0];
      ++asked.taken;
    }
    return answer(asked.write_outcome);
  }
  Duration longest_wait(const ModbusBlock& /*block*/, bool /*writes*/) const noexcept override {
    return wait_;
  }
  void resynchronise() noexcept override { ++resynchronisations_; }
  Time now() const noexcept override { return now_; }

 private:
  ModbusReply answer(ModbusOutcome outcome) noexcept {
    now_ += outcome == ModbusOutcome::timeout ? wait_ : answer_time_;
    if (outcome != ModbusOutcome::answered) ++failures_;
    return {outcome, "as the script has it", 0};
  }

  std::array<Station, 256> stations_{};
  int failures_ = 0;
  int resynchronisations_ = 0;
  Duration answer_time_ = answer_time;
  Duration wait_ = response_timeout;
  Time now_{std::chrono::seconds(1)};
  bool open_ = false;
};

/// `count` stations, unit 1 the first; each is read in every cycle.
struct Line {
  explicit Line(std::size_t count, const ModbusRegisterMap& stations = map, Duration longest_step = {}) {
    CHECK(master.start("line", line, {shortest_pause, longest_pause}, longest_step));
    for (std::size_t unit = 1; unit <= count; ++unit) {
      const Result<ModbusExchange*> exchange = master.attach(setup_of(unit, stations));
      CHECK(exchange);
      exchanges.push_back(*exchange);
    }
  }
  ~Line() { master.stop(); }

  static ModbusStationSetup setup_of(std::size_t unit, const ModbusRegisterMap& stations) {
    ModbusStationSetup setup;
    setup.name = "station";
    setup.map = &stations;
    setup.unit_id = static_cast<std::uint8_t>(unit);
    return setup;
  }

  void make(std::size_t first, std::size_t last, ModbusOutcome outcome) {
    for (std::size_t unit = first; unit <= last; ++unit) line.station(unit).outcome = outcome;
  }
  void command(std::size_t unit, std::uint16_t value, std::uint64_t sequence, bool safe) {
    ModbusCommand command{};
    command.words[0] = value;
    command.sequence = sequence;
    command.safe = safe;
    exchanges[unit - 1]->commands.publish(command, line.now());
  }
  const ModbusImage& image(std::size_t unit) {
    CHECK(exchanges[unit - 1]->images.newest() != nullptr);
    return *static_cast<const ModbusImage*>(exchanges[unit - 1]->images.payload());
  }
  void turn() {
    const int failed = line.failures();
    master.serve();
    CHECK(line.failures() - failed <= 1);
    line.pass(cycle);
  }

  ScriptedLine line;
  ModbusMaster master;
  std::vector<ModbusExchange*> exchanges;
};

// More silent ones than there are time-outs in the longest pause: one of them is always due again.
// [modbus-link-1] [modbus-master-2]
void silent_stations_do_not_keep_the_last_one_from_its_turn() {
  constexpr std::size_t count = 12;
  Line world(count);
  world.make(1, count - 1, ModbusOutcome::timeout);
  // Nobody knows yet who is silent: each may cost one turn.
  for (std::size_t turn = 0; turn < count; ++turn) world.turn();
  CHECK(world.line.station(count).reads >= 1);
  for (int turn = 0; turn < 100; ++turn) {
    const int reads = world.line.station(count).reads;
    world.turn();
    CHECK_EQUAL(world.line.station(count).reads, reads + 1);
  }
  CHECK(world.image(count).online);
}

void what_is_written_has_its_turn_likewise() {
  constexpr std::size_t count = 12;
  Line world(count);
  world.make(1, count - 1, ModbusOutcome::timeout);
  for (std::size_t unit = 1; unit <= count; ++unit) world.command(unit, 7, 1, false);
  for (std::size_t turn = 0; turn < count; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(count).written, 7);
  world.command(count, 0, 2, true);
  world.turn();
  CHECK_EQUAL(world.line.station(count).written, 0);
  CHECK_EQUAL(world.image(count).written, 2U);
}

// [modbus-link-2]
void a_line_is_safe_when_each_station_that_is_written_to_has_said_so() {
  Line world(2);
  for (const std::size_t unit : {1, 2}) world.command(unit, 7, 1, false);
  world.turn();
  CHECK(!world.master.is_safe());
  world.make(2, 2, ModbusOutcome::timeout);
  for (const std::size_t unit : {1, 2}) world.command(unit, 0, 2, true);
  for (int turn = 0; turn < 10; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(1).written, 0);
  CHECK(!world.master.is_safe());
  world.make(2, 2, ModbusOutcome::answered);
  for (int turn = 0; turn < 200 && world.line.station(2).written != 0; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(2).written, 0);
  CHECK(world.master.is_safe());
}

// Also where the one that failed may be asked again at once.
// [modbus-master-3]
void the_next_turn_begins_behind_who_failed() {
  constexpr std::size_t count = 3;
  Line world(count);
  CHECK(world.master.start("line", world.line, {}, Duration{}));
  world.make(1, count, ModbusOutcome::timeout);
  for (int round = 1; round <= 4; ++round) {
    for (std::size_t turn = 0; turn < count; ++turn) world.turn();
    for (std::size_t unit = 1; unit <= count; ++unit) CHECK_EQUAL(world.line.station(unit).reads, round);
  }
}

// Also while others do not come back, each of the silent ones is asked again.
void every_silent_station_is_asked_again_and_found() {
  constexpr std::size_t count = 12;
  Line world(count);
  world.make(1, count, ModbusOutcome::timeout);
  for (int turn = 0; turn < 100; ++turn) world.turn();
  for (std::size_t unit = 1; unit <= count; ++unit) {
    const int reads = world.line.station(unit).reads;
    for (std::size_t turn = 0; turn < 2 * count; ++turn) world.turn();
    CHECK(world.line.station(unit).reads > reads);
  }
  for (const std::size_t unit : {std::size_t{1}, std::size_t{6}, count}) {
    world.make(unit, unit, ModbusOutcome::answered);
    for (std::size_t turn = 0; turn < 2 * count; ++turn) world.turn();
    CHECK(world.image(unit).online);
  }
}

// Those that answer and fail by turns end as many turns as there are of them.
void stations_that_fail_now_and_then_do_not_starve_the_last_one() {
  constexpr std::size_t count = 8;
  Line world(count);
  for (int round = 0; round < 20; ++round) {
    world.make(1, count - 1, round % 2 == 0 ? ModbusOutcome::timeout : ModbusOutcome::answered);
    const int reads = world.line.station(count).reads;
    for (std::size_t turn = 0; turn < count; ++turn) world.turn();
    CHECK(world.line.station(count).reads > reads);
  }
}

// Gateways answer for a station that they do not reach; the next answer is none of its.
void who_is_not_reached_behind_a_gateway_is_not_online() {
  Line world(2);
  world.turn();
  CHECK(world.image(1).online && world.image(2).online);
  world.make(1, 1, ModbusOutcome::unreachable);
  for (int turn = 0; turn < 20; ++turn) world.turn();
  CHECK(!world.image(1).online);
  CHECK(world.image(1).timeouts > 1);
  CHECK_EQUAL(world.image(1).exceptions, 0U);
  CHECK(world.line.station(1).reads < 10);  // it is left alone for a while
  CHECK(world.image(2).online);
  CHECK_EQUAL(world.line.station(2).reads, 20);  // in all turns but that in which the other was first lost
  CHECK_EQUAL(world.line.resynchronisations(), 0);
  world.make(1, 1, ModbusOutcome::answered);
  for (int turn = 0; turn < 100; ++turn) world.turn();
  CHECK(world.image(1).online);
}

constexpr ModbusRegister scattered[] = {
    {"a", 0, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "", 0},
    {"b", 10, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "", 0},
    {"c", 20, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "", 0},
    {"speed", 30, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::write,
     ModbusPollGroup::fast, 1, "", 0},
};
constexpr ModbusRegisterMap scattered_map{scattered};

// A slow line with more to do than a step may take: each turn ends in time, and nothing has to wait for ever,
// also not behind what is written anew in each turn, or for who answers while another does not.
// [modbus-master-4]
void turns_end_in_time_and_go_on_where_they_ended() {
  constexpr Duration longest_step = std::chrono::milliseconds(500);
  constexpr std::size_t count = 3;
  Line world(count, scattered_map, longest_step);
  world.line.set_times(std::chrono::milliseconds(120), std::chrono::milliseconds(200));
  world.make(2, 2, ModbusOutcome::timeout);
  for (std::uint64_t turn = 1; turn <= 60; ++turn) {
    for (std::size_t unit = 1; unit <= count; ++unit)
      world.command(unit, static_cast<std::uint16_t>(turn), turn, false);
    const Time began = world.line.now();
    world.master.serve();
    CHECK(world.line.now() - began <= longest_step);
    world.line.pass(cycle);
  }
  for (const std::size_t unit : {std::size_t{1}, count}) {
    CHECK(world.line.station(unit).reads >= 30);
    CHECK(world.line.station(unit).writes >= 10);
    CHECK(world.image(unit).online);
    for (std::size_t block = 0; block < 3; ++block)
      CHECK(world.line.now() - Time{Duration{world.image(unit).sampled_at[block]}} < std::chrono::seconds(3));
  }
  CHECK(world.line.station(2).reads + world.line.station(2).writes >= 5);
}

// [modbus-master-1]
void what_a_step_cannot_wait_for_is_refused_with_the_least_that_can() {
  Line world(0, map, std::chrono::milliseconds(500));
  world.line.set_times(answer_time, std::chrono::milliseconds(460));
  const Result<ModbusExchange*> refused = world.master.attach(Line::setup_of(7, map));
  CHECK(!refused);
  CHECK_EQUAL(std::string(refused.status().cause()),
              std::string("reading holding_register 0 to 0 of unit 7 may take 0.46 s, its response_timeout "
                          "and its time on the "
                          "line, and a step of the thread of `line` 0.45 s: give it io_thread = { "
                          "hang_timeout = \"512 ms\" } or "
                          "more"));
  world.line.set_times(answer_time, std::chrono::milliseconds(450));
  CHECK(world.master.attach(Line::setup_of(7, map)));
  // Reconfigured, with its station on it.
  world.line.set_times(answer_time, std::chrono::milliseconds(460));
  CHECK(!world.master.start("line", world.line, {shortest_pause, longest_pause},
                            std::chrono::milliseconds(500)));
  CHECK(world.master.start("line", world.line, {shortest_pause, longest_pause},
                           std::chrono::milliseconds(512)));
}

// Many stations know but one of the functions that write a register.
// [modbus-master-6]
void single_values_are_written_by_the_functions_that_a_station_knows() {
  for (const bool knows_single : {false, true}) {
    Line world(1);
    world.line.station(1).knows_single = knows_single;
    world.line.station(1).knows_multiple = !knows_single;
    world.command(1, 7, 1, false);
    for (int turn = 0; turn < 20; ++turn) world.turn();
    CHECK_EQUAL(world.line.station(1).written, 7);
    CHECK_EQUAL(world.image(1).written, 1U);
    // It is remembered, also after it was not heard.
    const std::uint64_t exceptions = world.image(1).exceptions;
    CHECK_EQUAL(exceptions, knows_single ? 0U : 1U);
    world.make(1, 1, ModbusOutcome::timeout);
    for (int turn = 0; turn < 20; ++turn) world.turn();
    world.make(1, 1, ModbusOutcome::answered);
    world.command(1, 0, 2, true);
    for (int turn = 0; turn < 200; ++turn) world.turn();
    CHECK_EQUAL(world.line.station(1).written, 0);
    CHECK_EQUAL(world.image(1).exceptions, exceptions);
    CHECK(world.master.is_safe());
  }
}

// A refusal for any other reason is none of the function's.
void another_refusal_does_not_change_the_function() {
  Line world(1);
  world.line.station(1).refuses = true;
  world.command(1, 7, 1, false);
  for (int turn = 0; turn < 50; ++turn) world.turn();
  CHECK_EQUAL(world.image(1).written, 0U);
  world.line.station(1).refuses = false;
  const std::uint64_t exceptions = world.image(1).exceptions;
  world.line.station(1).knows_multiple = false;
  for (int turn = 0; turn < 50; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(1).written, 7);
  CHECK_EQUAL(world.image(1).exceptions, exceptions);
}

// [modbus-master-5]
void readings_go_on_while_writing_fails_and_safe_values_do_not_wait() {
  Line world(1);
  world.command(1, 7, 1, false);
  for (int turn = 0; turn < 5; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(1).written, 7);
  world.line.station(1).write_outcome = ModbusOutcome::timeout;
  world.command(1, 8, 2, false);
  for (int turn = 0; turn < 50; ++turn) {
    const int reads = world.line.station(1).reads;
    for (int two = 0; two < 2; ++two) world.turn();
    CHECK(world.line.station(1).reads > reads);
    CHECK(world.image(1).online);
  }
  CHECK(world.image(1).timeouts > 2);
  const int writes = world.line.station(1).writes;
  CHECK(writes < 30);  // they have their pauses
  CHECK(!world.master.is_safe());
  // Right after one that failed.
  while (world.line.station(1).writes == writes) world.turn();
  world.line.station(1).write_outcome = ModbusOutcome::answered;
  world.command(1, 0, 3, true);
  for (int two = 0; two < 2; ++two) world.turn();
  CHECK_EQUAL(world.line.station(1).written, 0);
  CHECK(world.master.is_safe());
}

// [modbus-master-5]
void safe_values_reach_a_station_whose_readings_fail() {
  Line world(1);
  world.command(1, 7, 1, false);
  for (int turn = 0; turn < 5; ++turn) world.turn();
  world.line.station(1).read_outcome = ModbusOutcome::timeout;
  for (int turn = 0; turn < 50; ++turn) world.turn();
  world.command(1, 0, 2, true);
  for (int turn = 0; turn < 200; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(1).written, 0);
}

// Both are tried, in turn, and each costs the others one time-out.
void a_station_that_answers_nothing_is_read_and_written_in_turn() {
  Line world(1);
  world.make(1, 1, ModbusOutcome::timeout);
  world.command(1, 7, 1, false);
  for (int turn = 0; turn < 400; ++turn) world.turn();
  const ScriptedLine::Station& station = world.line.station(1);
  CHECK(station.reads >= 3 && station.writes >= 3);
  CHECK(std::abs(station.reads - station.writes) <= 2);
  world.make(1, 1, ModbusOutcome::answered);
  for (int turn = 0; turn < 200; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(1).written, 7);
}

// It may have been switched off when it did not answer: what it was told before would move it.
void who_listens_first_is_not_told_again_what_was_not_answered() {
  Line world(0);
  ModbusStationSetup setup = Line::setup_of(1, map);
  setup.listens_first = true;
  const Result<ModbusExchange*> exchange = world.master.attach(setup);
  CHECK(exchange);
  world.exchanges.push_back(*exchange);
  for (int turn = 0; turn < 5; ++turn) world.turn();
  world.line.station(1).write_outcome = ModbusOutcome::timeout;
  world.command(1, 7, 1, false);
  for (int turn = 0; turn < 10; ++turn) world.turn();
  CHECK(world.line.station(1).writes >= 1);
  world.line.station(1).write_outcome = ModbusOutcome::answered;
  const int writes = world.line.station(1).writes;
  for (int turn = 0; turn < 200; ++turn) world.turn();
  CHECK(world.image(1).online);
  CHECK_EQUAL(world.line.station(1).writes, writes);
  world.command(1, 8, 2, false);
  for (int turn = 0; turn < 5; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(1).written, 8);
}

constexpr ModbusRegister wearing[] = {
    {"level", 0, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::read,
     ModbusPollGroup::fast, 1, "", 0},
    {"setting", 10, ModbusArea::holding_register, ModbusType::u16, ModbusWordOrder::abcd, ModbusAccess::write,
     ModbusPollGroup::fast, 1, "", 0, ModbusRegister::whole, false},
};
constexpr ModbusRegisterMap wearing_map{wearing};

// [modbus-master-7]
void what_wears_is_written_at_changes_alone() {
  Line world(0);
  for (const ModbusRegisterMap* one : {&map, &wearing_map}) {
    ModbusStationSetup setup = Line::setup_of(world.exchanges.size() + 1, *one);
    setup.refresh_period = std::chrono::milliseconds(50);
    const Result<ModbusExchange*> exchange = world.master.attach(setup);
    CHECK(exchange);
    world.exchanges.push_back(*exchange);
  }
  for (const std::size_t unit : {1, 2}) world.command(unit, 7, 1, false);
  for (int turn = 0; turn < 100; ++turn) world.turn();
  CHECK(world.line.station(1).taken > 10);
  CHECK_EQUAL(world.line.station(2).taken, 1);
  world.command(2, 8, 2, false);
  for (int turn = 0; turn < 100; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(2).taken, 2);
  // It may have been switched off meanwhile.
  world.make(2, 2, ModbusOutcome::timeout);
  for (int turn = 0; turn < 10; ++turn) world.turn();
  world.make(2, 2, ModbusOutcome::answered);
  for (int turn = 0; turn < 200; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(2).taken, 3);
}

constexpr ModbusRegister kept[] = {{.name = "events",
                                    .address = 3,
                                    .area = ModbusArea::holding_register,
                                    .type = ModbusType::u16,
                                    .poll_group = ModbusPollGroup::once}};
constexpr ModbusRegisterMap kept_map{kept};

// [modbus-master-10]
void what_reading_changes_is_read_once() {
  Line world(0);
  const Result<ModbusExchange*> exchange = world.master.attach(Line::setup_of(1, kept_map));
  CHECK(exchange);
  world.exchanges.push_back(*exchange);
  world.make(1, 1, ModbusOutcome::timeout);
  for (int turn = 0; turn < 100; ++turn) world.turn();
  CHECK(world.line.station(1).reads > 1);  // which nobody has answered
  world.make(1, 1, ModbusOutcome::answered);
  for (int turn = 0; turn < 200; ++turn) world.turn();
  const int reads = world.line.station(1).reads;
  CHECK(world.image(1).sampled_at[0] != 0);
  for (int turn = 0; turn < 1000; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(1).reads, reads);
  // Nor when it was gone meanwhile.
  world.make(1, 1, ModbusOutcome::timeout);
  for (int turn = 0; turn < 10; ++turn) world.turn();
  world.make(1, 1, ModbusOutcome::answered);
  for (int turn = 0; turn < 200; ++turn) world.turn();
  CHECK_EQUAL(world.line.station(1).reads, reads);
}

// [modbus-master-9]
void a_unit_has_one_station() {
  Line world(2);
  const Result<ModbusExchange*> refused = world.master.attach(Line::setup_of(2, map));
  CHECK(!refused);
  CHECK_CONTAINS(refused.status().cause(), "unit 2 on this link is that of `station` already");
  ModbusMaster::detach(*world.exchanges[1]);
  CHECK(world.master.attach(Line::setup_of(2, map)));
}

// [modbus-master-8]
void nobody_is_asked_right_after_connecting() {
  Line world(1);
  constexpr Duration pause = std::chrono::milliseconds(200);
  CHECK(world.master.start("line", world.line, {shortest_pause, longest_pause, pause}, Duration{}));
  const Time began = world.line.now();
  while (world.line.station(1).reads == 0) world.turn();
  CHECK(world.line.now() - began >= pause);
  CHECK(world.line.now() - began < 2 * pause);
  world.make(1, 1, ModbusOutcome::lost);
  world.turn();
  world.make(1, 1, ModbusOutcome::answered);
  while (!world.line.is_open()) world.turn();
  const Time again = world.line.now();
  const int reads = world.line.station(1).reads;
  while (world.line.station(1).reads == reads) world.turn();
  CHECK(world.line.now() - again >= pause - cycle);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(silent_stations_do_not_keep_the_last_one_from_its_turn),
      CONTAINED_TEST(what_is_written_has_its_turn_likewise),
      CONTAINED_TEST(a_line_is_safe_when_each_station_that_is_written_to_has_said_so),
      CONTAINED_TEST(the_next_turn_begins_behind_who_failed),
      CONTAINED_TEST(every_silent_station_is_asked_again_and_found),
      CONTAINED_TEST(stations_that_fail_now_and_then_do_not_starve_the_last_one),
      CONTAINED_TEST(who_is_not_reached_behind_a_gateway_is_not_online),
      CONTAINED_TEST(turns_end_in_time_and_go_on_where_they_ended),
      CONTAINED_TEST(what_a_step_cannot_wait_for_is_refused_with_the_least_that_can),
      CONTAINED_TEST(single_values_are_written_by_the_functions_that_a_station_knows),
      CONTAINED_TEST(another_refusal_does_not_change_the_function),
      CONTAINED_TEST(readings_go_on_while_writing_fails_and_safe_values_do_not_wait),
      CONTAINED_TEST(safe_values_reach_a_station_whose_readings_fail),
      CONTAINED_TEST(a_station_that_answers_nothing_is_read_and_written_in_turn),
      CONTAINED_TEST(who_listens_first_is_not_told_again_what_was_not_answered),
      CONTAINED_TEST(what_wears_is_written_at_changes_alone),
      CONTAINED_TEST(what_reading_changes_is_read_once),
      CONTAINED_TEST(a_unit_has_one_station),
      CONTAINED_TEST(nobody_is_asked_right_after_connecting),
  };
  return cmocka_run_group_tests_name("Modbus master", tests, nullptr, nullptr);
}
