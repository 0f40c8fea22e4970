// What goes wrong between a module and its chip: what the operator reads, what lines and outputs are
// meanwhile, and that all comes back once the cause is gone, and how soon. On a simulated bus in virtual
// time.
#include <cstdio>
#include <optional>
#include <utility>

#include "hal/can/mock/mock_can_bus.hpp"
#include "hal/canopen/cia401.hpp"
#include "hal/canopen/sdo_abort.hpp"
#include "hal/canopen/tests/data_sheet.hpp"
#include "hal/canopen/tests/listed_objects.hpp"
#include "hal/gpio/chip/canopen/simulator/module_on_can.hpp"
#include "hal/gpio/lines/canopen/tests/io_world.hpp"
#include "places.hpp"
#include "tests/recovery.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
namespace module = canopen::cia401::objects;

using World = IoWorld<ModuleOnCan>;

constexpr DigitalLineSettings input{};
constexpr DigitalLineSettings stop_button{.emergency_stop = true};
constexpr DigitalLineSettings output{.direction = LineDirection::output};
constexpr DigitalLineSettings safely_on{.direction = LineDirection::output, .safe_value = true};

// The lines of most cases: an input, an emergency stop, and two outputs.
constexpr std::size_t contact = 0;
constexpr std::size_t button = 1;
constexpr std::size_t valve = 2;
constexpr std::size_t brake = 3;
// And where they are on the module.
constexpr unsigned contact_at = 0;
constexpr unsigned button_at = 7;
constexpr unsigned valve_at = 0;
constexpr unsigned brake_at = 1;

constexpr SimulatedCia401Module::Options small{.node = World::node};

bool says(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

bool reads(World& world, std::string_view part) {
  return world.until([&] { return says(world.told().trouble_view(), part); });
}

bool has_lines(World& world) {
  return world.begin().is_ok() && world.add(input, "DI1").is_ok() && world.add(stop_button, "DI8").is_ok() &&
         world.add(output, "DO1").is_ok() && world.add(safely_on, "DO2").is_ok();
}

bool are_lines_known(World& world) {
  for (const std::size_t line : {contact, button, valve, brake}) {
    if (!world.line(line).state()) return false;
  }
  return true;
}

bool are_lines_away(World& world) {
  for (const std::size_t line : {contact, button, valve, brake}) {
    if (world.line(line).state()) return false;
  }
  return world.line(button).demands_safe_state();
}

bool is_up(World& world) {
  return world.until([&] { return are_lines_known(world); }) && world.told().present &&
         world.told().trouble_view().empty();
}

bool is_safe(World& world) {
  return !world.far_end().sees_high(valve_at) && world.far_end().sees_high(brake_at);
}

// Contacts closed, and both outputs the opposite of safe.
bool goes_to_work(World& world) {
  world.far_end().drive(contact_at, true);
  world.far_end().drive(button_at, true);
  if (!is_up(world) || !is_safe(world)) return false;
  world.command(valve, true);
  world.command(brake, false);
  return world.far_end().sees_high(valve_at) && !world.far_end().sees_high(brake_at) &&
         world.until([&] { return world.is_on(contact) && !world.line(button).demands_safe_state(); });
}

bool works(World& world) {
  return has_lines(world) && goes_to_work(world);
}

// The cause is gone: the lines are there, what was commanded is not, and commands are followed.
bool comes_back(World& world, const char* from) {
  const Time begin = world.now();
  if (!world.until([&] { return are_lines_known(world); })) return false;
  if (!is_back_in_time(from, world.now() - begin) || !is_safe(world)) return false;
  world.run(std::chrono::milliseconds(300));
  if (!is_safe(world) || world.is_on(valve) || !world.is_on(brake)) return false;
  world.command(valve, true);
  return world.far_end().sees_high(valve_at) && world.told().trouble_view().empty() &&
         world.chip().fault().is_ok();
}

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)(World&)>
void judged(void**) {
  bool good = false;
  {
    const auto world = std::make_unique<World>(small);
    good = Run(*world);
    if (!good) std::printf("the chip: '%s'\n", std::string(world->told().trouble_view()).c_str());
  }
  assert_true(good);
}

// ---- lost, and back

bool cable_out_and_in_again(World& world) {
  if (!works(world)) return false;
  const std::uint32_t losses = world.told().losses;
  world.far_end().set_plugged(false);
  if (!reads(world, "node 5") || !world.until([&] { return are_lines_away(world); })) return false;
  // It no longer hears us, and has been told what to do then.
  if (!world.until([&] { return is_safe(world); }, std::chrono::milliseconds(300))) return false;
  world.command(valve, true);  // to nobody
  if (world.told().present || world.told().losses != losses + 4) return false;
  world.far_end().set_plugged(true);
  return comes_back(world, "a cable that was out");
}

bool heartbeat_of_the_module_lost(World& world) {
  if (!works(world)) return false;
  world.far_end().module().silence_heartbeat(true);
  if (!reads(world, "no heartbeat of node 5 for 250 ms") || !are_lines_away(world)) return false;
  world.far_end().module().silence_heartbeat(false);
  return comes_back(world, "a lost heartbeat of the module");
}

bool our_heartbeat_lost(World& world) {
  if (!works(world)) return false;
  world.stall(std::chrono::milliseconds(600));
  if (!is_safe(world) || world.far_end().module().nmt_state() != canopen::NmtState::stopped) return false;
  return world.until([&] { return are_lines_away(world); }) && comes_back(world, "a lost heartbeat of ours");
}

bool bus_off(World& world) {
  if (!works(world)) return false;
  world.bus().station().corrupt_next(std::numeric_limits<unsigned>::max());
  if (!world.until([&] { return world.bus().state() == CanBusState::bus_off; })) return false;
  world.receive();
  if (!are_lines_away(world) || !says(world.told().trouble_view(), "its bus is not usable")) return false;
  if (!world.until([&] { return is_safe(world); }, std::chrono::milliseconds(400))) return false;
  world.bus().station().corrupt_next(0);
  return comes_back(world, "being off the bus");
}

bool adapter_gone_and_back(World& world) {
  if (!works(world)) return false;
  world.bus().pretend(CanBusState::gone);
  if (!world.until([&] { return are_lines_away(world); }, World::cycle * 2)) return false;
  if (!world.until([&] { return is_safe(world); }, std::chrono::milliseconds(400))) return false;
  world.bus().pretend(CanBusState::error_active);
  return comes_back(world, "an adapter that was gone");
}

// For less than the module takes to notice.
bool adapter_gone_for_a_moment(World& world) {
  if (!works(world)) return false;
  world.bus().pretend(CanBusState::down);
  world.step();
  if (!are_lines_away(world)) return false;
  world.bus().pretend(CanBusState::error_active);
  return comes_back(world, "a moment without the bus");
}

bool module_that_resets(World& world) {
  if (!works(world)) return false;
  world.far_end().reset_itself();
  return world.until([&] { return are_lines_away(world); }) && reads(world, "node 5 reset itself") &&
         comes_back(world, "a reset of the module");
}

bool module_that_leaves_operation(World& world) {
  if (!works(world)) return false;
  world.far_end().module().enter(canopen::NmtState::pre_operational);
  return reads(world, "left operation by itself: it is pre-operational") && are_lines_away(world) &&
         comes_back(world, "leaving operation");
}

bool module_that_is_switched_on_late(World& world) {
  world.far_end().module().power_off();
  if (!has_lines(world)) return false;
  world.run(std::chrono::seconds(3));
  if (!are_lines_away(world) || !says(world.told().trouble_view(), "node 5 does not say boot-up"))
    return false;
  if (!world.chip().fault().is_ok() || !world.line(valve).fault().is_ok()) return false;
  world.far_end().power_on();
  return comes_back(world, "being switched on late");
}

// ---- inputs that are not known

bool inputs_that_are_not_told_yet(World& world) {
  world.far_end().module().silence_inputs(true);
  world.far_end().drive(contact_at, true);
  if (!has_lines(world)) return false;
  if (!world.until([&] { return world.line(valve).state().has_value(); })) return false;
  if (world.line(contact).state() || !world.line(button).demands_safe_state() || world.told().present)
    return false;
  if (!says(world.told().trouble_view(), "has not told its inputs yet")) return false;
  if (!reads(world, "does not tell its inputs (TPDO 1): is its event timer")) return false;
  world.far_end().module().silence_inputs(false);
  // What was before anybody looked is no edge.
  return comes_back(world, "inputs that were not told") && world.is_on(contact) &&
         !world.line(contact).read_edge();
}

bool inputs_that_are_no_longer_told(World& world) {
  if (!works(world)) return false;
  while (world.line(contact).read_edge()) {
  }
  world.far_end().module().silence_inputs(true);
  if (!reads(world, "does not tell its inputs") || world.line(contact).state()) return false;
  // It is told its outputs all the same.
  if (!world.is_on(valve) || !world.line(button).demands_safe_state()) return false;
  world.far_end().drive(contact_at, false);
  world.far_end().module().silence_inputs(false);
  return world.until([&] { return are_lines_known(world); }) && !world.is_on(contact) &&
         !world.line(contact).read_edge() && world.told().trouble_view().empty();
}

bool truncated_and_foreign_frames(World& world) {
  const auto talk_garbage = [&world] {
    ModuleOnCan& far_end = world.far_end();
    const std::uint16_t told = canopen::transmit_pdo_identifier(1, World::node);
    far_end.say_instead({told, 0, {}});
    far_end.say_instead({.identifier = told, .size = 1, .remote = true});
    far_end.say_instead({canopen::identifier_of(canopen::heartbeat_base, World::node), 0, {}});
    far_end.say_instead({canopen::identifier_of(canopen::emergency_base, World::node), 2, {0x10, 0x23}});
    far_end.say_instead({canopen::identifier_of(canopen::sdo_answer_base, World::node), 8, {0xFF, 0xFF}});
    far_end.say_instead({0x7FF, 8, {1, 2, 3}});
  };
  if (!has_lines(world)) return false;
  for (int i = 0; i < 5; ++i) {  // also while it is brought up
    world.run(std::chrono::milliseconds(10));
    talk_garbage();
  }
  if (!goes_to_work(world)) return false;
  talk_garbage();
  world.run(std::chrono::milliseconds(500));
  return are_lines_known(world) && world.is_on(contact) && world.told().trouble_view().empty();
}

// ---- what the module is, and has

bool another_profile(World& world) {
  world.far_end().module().objects().set_first(canopen::objects::device_type, 0x00020192);
  if (!has_lines(world)) return false;
  if (!reads(world,
             "its device profile is 00000192 and not 00000191; is the number set right on the device?"))
    return false;
  if (!says(world.told().trouble_view(), "put it right") || !are_lines_away(world)) return false;
  world.run(std::chrono::seconds(3));
  if (!are_lines_away(world)) return false;
  world.far_end().module().objects().set_first(canopen::objects::device_type, 0x00030191);
  world.far_end().power_on();
  return comes_back(world, "another device than was declared");
}

bool another_vendor(World& world) {
  world.configuration().vendor = 0x124;
  return has_lines(world) && reads(world, "its vendor is 00000123 and not 00000124") && are_lines_away(world);
}

bool fewer_inputs_than_are_configured(World& world) {
  world.configuration().input_bytes = 2;
  return has_lines(world) && reads(world, "`input_bytes = 1`");
}

bool fewer_outputs_than_are_configured(World& world) {
  world.configuration().output_bytes = 2;
  return has_lines(world) && reads(world, "`output_bytes = 1`");
}

// Which is what needs no column.
bool module_with_nothing_that_is_optional(World& world) {
  ModuleObjects& objects = world.far_end().module().objects();
  for (const int index : {0x6002, 0x6005, 0x6006, 0x6202, 0x6208}) {
    objects.lack_all(static_cast<std::uint16_t>(index));
  }
  objects.lack(canopen::objects::error_behaviour);
  return works(world);
}

bool module_without_error_values(World& world) {
  world.far_end().module().objects().lack_all(0x6206);
  world.far_end().module().objects().lack_all(0x6207);
  if (!has_lines(world) || !reads(world, "`tells_error_values = false`") || !are_lines_away(world))
    return false;
  world.configuration().tells_error_values = false;
  return world.begin().is_ok() && is_up(world);
}

bool module_without_an_event_timer(World& world) {
  world.far_end().module().objects().lack({0x1800, 5});
  if (!has_lines(world) || !reads(world, "`refresh = 0`") || !are_lines_away(world)) return false;
  world.configuration().refresh = 0;
  if (!world.begin().is_ok() || !is_up(world)) return false;
  world.far_end().drive(contact_at, true);
  if (!world.until([&] { return world.is_on(contact); }, World::cycle * 4)) return false;
  world.far_end().module().silence_inputs(true);
  if (!reads(world, "does not tell its inputs (TPDO 1): does it hear SYNC?")) return false;
  world.far_end().module().silence_inputs(false);
  return world.until([&] { return are_lines_known(world); });
}

bool module_without_a_heartbeat(World& world) {
  world.far_end().module().objects().lack(canopen::objects::producer_heartbeat);
  if (!has_lines(world) || !reads(world, "`guarded = true`")) return false;
  world.configuration().guarded = true;
  if (!world.begin().is_ok() || !is_up(world)) return false;
  world.far_end().module().silence_heartbeat(true);
  return reads(world, "no answer to guarding of node 5");
}

bool module_that_does_not_look_for_us(World& world) {
  world.far_end().module().objects().lack(canopen::objects::consumer_heartbeat);
  if (!has_lines(world) || !reads(world, "`supervises_us = false`")) return false;
  world.configuration().supervises_us = false;
  return world.begin().is_ok() && is_up(world);
}

bool module_that_refuses_bit_30(World& world) {
  world.far_end().module().objects().refuse_bit_30();
  if (!has_lines(world) || !reads(world, "`forbids_remote = false`")) return false;
  world.configuration().forbids_remote = false;
  return world.begin().is_ok() && is_up(world);
}

bool mapping_that_is_fixed_as_it_is_needed(World& world) {
  world.far_end().module().objects().fix_mapping();
  return works(world);
}

bool mapping_that_is_fixed_otherwise(World& world) {
  world.far_end().module().objects().set_first({0x1A00, 0}, 0);
  world.far_end().module().objects().fix_mapping();
  return has_lines(world) && reads(world, "has a fixed PDO mapping, and object 1A00:");
}

bool object_that_is_refused(World& world) {
  world.far_end().module().objects().refuse(module::error_value(1), canopen::sdo_abort::out_of_range);
  return has_lines(world) && reads(world, "6207:01") && says(world.told().trouble_view(), "06090030");
}

// ---- what it says

bool emergency_that_comes_and_goes(World& world) {
  if (!works(world)) return false;
  world.far_end().trip(0x2310);
  if (!reads(world, "node 5 says: current at the device's output (2310)")) return false;
  // It works on.
  if (!world.told().present || !are_lines_known(world) || !world.is_on(valve)) return false;
  world.far_end().trip(0);
  return world.until([&] { return world.told().trouble_view().empty(); }) && world.is_on(valve);
}

// ---- outputs

bool outputs_are_safe_before_they_are_commanded(World& world) {
  if (!has_lines(world)) return false;
  if (!world.until([&] { return world.line(valve).state().has_value(); })) return false;
  if (!is_safe(world) || world.is_on(valve) || !world.is_on(brake)) return false;
  // What it is told by SDO, before it is started.
  return (world.far_end().module().objects().get(module::error_value(1)) & 3U) == 2 &&
         world.far_end().module().objects().get(module::error_mode(1)) == 0xFF &&
         world.far_end().module().objects().get(canopen::objects::error_behaviour) == 2;
}

// Neither its own outputs of before, nor those of another master.
bool outputs_of_before_are_not_followed_again(World& world) {
  world.far_end().module().objects().set_first(module::output(1), 0x55);
  if (!has_lines(world)) return false;
  bool followed = false;
  const bool came = world.until([&] {
    const bool operational = world.far_end().module().nmt_state() == canopen::NmtState::operational;
    followed = followed || (operational && !is_safe(world));
    return world.told().present;
  });
  return came && !followed && is_safe(world);
}

bool confirms_that_it_is_safe(World& world) {
  const auto are_safe = [&] {
    const bool first = world.line(valve).make_safe();
    return world.line(brake).make_safe() && first;
  };
  return world.until(are_safe, std::chrono::milliseconds(100));
}

// The module ignores its output PDO, while its heartbeat and its inputs come.
// [gpio-chip-7]
bool outputs_that_are_not_taken_are_not_confirmed(World& world) {
  constexpr std::int64_t not_in_use = 0x80000000;
  if (!works(world)) return false;
  auto& objects = world.far_end().module().objects();
  const auto before = static_cast<std::int64_t>(objects.get({0x1400, 1}));
  objects.set({0x1400, 1}, not_in_use);
  for (const std::size_t line : {valve, brake}) world.line(line).set_inhibited(true);
  if (confirms_that_it_is_safe(world) || is_safe(world)) return false;
  objects.set({0x1400, 1}, before);
  return confirms_that_it_is_safe(world) && is_safe(world);
}

bool outputs_are_safe_while_nothing_may_move(World& world) {
  if (!works(world)) return false;
  for (const std::size_t line : {valve, brake}) {
    world.line(line).set_inhibited(true);
    if (world.line(line).make_safe()) return false;  // it has not left yet
  }
  world.send();
  world.let_arrive();
  if (!is_safe(world) || world.line(valve).make_safe()) return false;  // it has not said so yet
  if (!confirms_that_it_is_safe(world)) return false;
  world.command(valve, true);
  world.command(brake, false);
  if (!is_safe(world)) return false;
  for (const std::size_t line : {valve, brake}) world.line(line).set_inhibited(false);
  world.step();
  world.let_arrive();
  if (!is_safe(world)) return false;
  world.command(valve, true);
  return world.far_end().sees_high(valve_at);
}

bool outputs_are_safe_once_nobody_has_them(World& world) {
  if (!works(world)) return false;
  world.line(valve).stop();
  world.line(brake).stop();
  world.step();
  world.let_arrive();
  return is_safe(world) && world.told().lines == 4 - 2;
}

// It is brought up anew, and told.
bool safe_value_that_is_changed_while_it_runs(World& world) {
  if (!works(world)) return false;
  world.line(brake).stop();
  if (!world.add(output, "DO2").is_ok()) return false;
  world.step();
  if (world.line(contact).state()) return false;
  if (!world.until([&] { return world.line(contact).state() && world.line(4).state(); })) return false;
  if (world.far_end().sees_high(brake_at) || world.far_end().sees_high(valve_at)) return false;
  return (world.far_end().module().objects().get(module::error_value(1)) & 3U) == 0;
}

// Each value is on the wire, however short.
bool outputs_that_change_in_each_cycle(World& world) {
  if (!works(world)) return false;
  int changes = 0;
  for (int i = 0; i < 20; ++i) {
    const bool before = world.far_end().sees_high(valve_at);
    world.command(valve, i % 2 != 0);
    if (world.far_end().sees_high(valve_at) != before) ++changes;
  }
  return changes == 20;
}

bool lines_of_the_last_byte(World& world) {
  const auto other =
      std::make_unique<World>(SimulatedCia401Module::Options{.node = World::node,
                                                             .input_bytes = canopen::cia401::most_bytes,
                                                             .output_bytes = canopen::cia401::most_bytes});
  static_cast<void>(world);
  other->configuration().input_bytes = other->configuration().output_bytes = canopen::cia401::most_bytes;
  if (!other->begin() || !other->add(input, "DI64") || !other->add(output, "DO64") ||
      !other->add(input, "DI9"))
    return false;
  if (!other->until([&] { return other->told().present && other->line(1).state(); })) return false;
  other->far_end().drive(63, true);
  if (!other->until([&] { return other->is_on(0); }) || other->is_on(2)) return false;
  const auto edge = other->line(0).read_edge();
  if (!edge || !edge->on || other->line(2).read_edge()) return false;
  other->command(1, true);
  return other->far_end().module().outputs() == std::uint64_t{1} << 63;
}

// ---- what makes no sense

bool lines_that_it_does_not_have(World& world) {
  if (!world.begin()) return false;
  for (const char* name : {"DI9", "DI0", "DI01", "DI", "DO1x", "di1", "VALVE"}) {
    const Status status = world.add(input, name);
    if (status.code() != StatusCode::not_found || !says(status.cause(), "it has 8 inputs")) return false;
  }
  const Status direction = world.add(output, "DI1");
  if (direction.code() != StatusCode::invalid_argument || !says(direction.cause(), "is an input"))
    return false;
  const Status bias = world.add({.bias = LineBias::pull_up}, "DI1");
  if (bias.code() != StatusCode::invalid_argument || !says(bias.cause(), "has no bias")) return false;
  if (!world.add(input, "DI1").is_ok()) return false;
  return world.add(input, "DI1").code() == StatusCode::busy;
}

bool plans_that_make_no_sense(World& world) {
  const auto is_refused = [&world](std::string_view why) {
    const Status status = world.begin();
    return status.code() == StatusCode::invalid_argument && says(status.cause(), why);
  };
  world.configuration().input_bytes = world.configuration().output_bytes = 0;
  if (!is_refused("set input_bytes and output_bytes")) return false;
  world.configuration().input_bytes = 1;
  world.configuration().heartbeat_limit = 0.05;
  if (!is_refused("at least twice its period")) return false;
  world.configuration().heartbeat_limit = 0.25;
  world.configuration().master = World::node;
  if (!is_refused("not the same")) return false;
  // Lines of a chip that is not there.
  const Status status = world.add(input, "DI1");
  return status.code() == StatusCode::unavailable && says(status.cause(), "is stopped");
}

// ---- a process that dies

/// A bus that can say last words, and the module at its other end.
class BusWithLastWords final : public MockCanBusDriver {
 public:
  Status initialise() override {
    restart();
    enter(CanBusState::error_active);
    return {};
  }
  void receive(const Tick& tick) noexcept override {
    if (!begin_delivery()) return;
    far_end.advance(tick.now, said_);
    for (; !said_.is_empty(); said_.pop()) {
      CanFrame frame = canopen::to_frame(said_.front());
      frame.time = tick.now;
      deliver(frame);
    }
    end_delivery();
  }
  void send(const Tick& tick) noexcept override {
    CanSendQueue& frames = waiting();
    for (std::size_t i = 0; i < frames.size(); ++i) hear(frames[i], tick.now);
    frames.drop_first(frames.size());
  }
  int claim_last_word() override { return place; }
  void release_last_word(int claimed) override {
    if (claimed == place) words.reset();
  }
  void prepare_last_word(int claimed, const CanFrame& word, const CanFrame& all) noexcept override {
    if (claimed == place) words = {word, all};
  }
  void hear(const CanFrame& frame, Time now) { far_end.receive(canopen::to_message(frame), now, said_); }

  SimulatedCia401Module far_end{small};
  std::optional<std::pair<CanFrame, CanFrame>> words;

 private:
  static constexpr int place = 7;

  canopen::Outbox said_;
};

bool outputs_are_safe_when_the_process_dies() {
  DeviceBench<BusWithLastWords> bus{nullptr};
  DeviceBench<CanopenGpioChip> chip{nullptr, {}, &bus.driver()};
  DeviceBench<CanopenDigitalIo> brake_line{nullptr, {}, &chip.driver()};
  chip.configuration().node = World::node;
  configure_line(brake_line, safely_on, "DO2");
  if (!bus.driver().initialise() || !chip.driver().initialise() || !brake_line.driver().initialise())
    return false;
  bus.driver().far_end.power_on(bus.now());
  const bool was_silent = !bus.driver().words;
  for (int i = 0; i < 1000; ++i) {
    bus.receive(World::cycle);
    chip.receive(World::cycle);
    brake_line.receive(World::cycle);
    brake_line.driver().command(false);
    brake_line.send();
    chip.send();
    bus.send();
  }
  if (!was_silent || bus.driver().far_end.outputs() != 0 || !bus.driver().words) return false;
  const auto [word, all] = *bus.driver().words;
  if (all.identifier != canopen::sync_identifier || all.length != 0) return false;
  bus.driver().hear(word, bus.now());
  const bool safe = bus.driver().far_end.outputs() == 2;
  chip.driver().stop();
  return safe && !bus.driver().words;
}

void last_word(void**) {
  const bool good = outputs_are_safe_when_the_process_dies();
  assert_true(good);
}

// ---- what the driver asks for is what its list says

bool asks_for_what_is_listed(std::uint8_t bytes, double refresh, bool guarded) {
  const std::vector<ListedObject> rows = read_listed_objects(place::object_list);
  SdoListener listener{World::node, rows};
  const auto world = std::make_unique<World>(
      SimulatedCia401Module::Options{.node = World::node, .input_bytes = bytes, .output_bytes = bytes});
  world->configuration().vendor = 0x123;
  world->configuration().product = 0x456;
  world->configuration().input_bytes = world->configuration().output_bytes = bytes;
  world->configuration().refresh = refresh;
  world->configuration().guarded = guarded;
  world->bus().wire()->attach(listener);
  const bool up = world->begin().is_ok() && world->until([&] { return world->told().present; });
  world->bus().wire()->detach(listener);
  return up && listener.asked() > 20 && listener.missing() == 0;
}

template <std::uint8_t Bytes, bool HasAll>
void listed(void**) {
  const bool good = asks_for_what_is_listed(Bytes, HasAll ? 0.1 : 0.0, !HasAll);
  assert_true(good);
}

void data_sheet(void**) {
  ModuleObjects objects{World::node, 1, 1};
  const bool good = is_as_data_sheet_says(objects, place::data_sheet, 40);
  assert_true(good);
}

}  // namespace

int main() {
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest faults[] = {
      CASE(cable_out_and_in_again),
      CASE(heartbeat_of_the_module_lost),
      CASE(our_heartbeat_lost),
      CASE(bus_off),
      CASE(adapter_gone_and_back),
      CASE(adapter_gone_for_a_moment),
      CASE(module_that_resets),
      CASE(module_that_leaves_operation),
      CASE(module_that_is_switched_on_late),
      CASE(inputs_that_are_not_told_yet),
      CASE(inputs_that_are_no_longer_told),
      CASE(truncated_and_foreign_frames),
      CASE(another_profile),
      CASE(another_vendor),
      CASE(fewer_inputs_than_are_configured),
      CASE(fewer_outputs_than_are_configured),
      CASE(module_with_nothing_that_is_optional),
      CASE(module_without_error_values),
      CASE(module_without_an_event_timer),
      CASE(module_without_a_heartbeat),
      CASE(module_that_does_not_look_for_us),
      CASE(module_that_refuses_bit_30),
      CASE(mapping_that_is_fixed_as_it_is_needed),
      CASE(mapping_that_is_fixed_otherwise),
      CASE(object_that_is_refused),
      CASE(emergency_that_comes_and_goes),
      CASE(outputs_are_safe_before_they_are_commanded),
      CASE(outputs_of_before_are_not_followed_again),
      CASE(outputs_that_are_not_taken_are_not_confirmed),
      CASE(outputs_are_safe_while_nothing_may_move),
      CASE(outputs_are_safe_once_nobody_has_them),
      CASE(safe_value_that_is_changed_while_it_runs),
      CASE(outputs_that_change_in_each_cycle),
      CASE(lines_of_the_last_byte),
      CASE(lines_that_it_does_not_have),
      CASE(plans_that_make_no_sense),
  };
#undef CASE
  const CMUnitTest lists[] = {
      {"a process that dies says safe values at last", last_word, nullptr, nullptr, nullptr},
      {"it asks for what its list of objects says, with one byte", listed<1, true>, nullptr, nullptr,
       nullptr},
      {"and with as many bytes as there can be", listed<8, true>, nullptr, nullptr, nullptr},
      {"and guarded, with SYNC", listed<2, false>, nullptr, nullptr, nullptr},
      {"the simulated module is as its data sheet says", data_sheet, nullptr, nullptr, nullptr},
  };
  int failed = cmocka_run_group_tests_name("faults of a CANopen IO module", faults, nullptr, nullptr);
  failed += cmocka_run_group_tests_name("the chip of a CANopen IO module", lists, nullptr, nullptr);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
