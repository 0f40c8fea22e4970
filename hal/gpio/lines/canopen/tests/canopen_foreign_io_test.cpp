// The drivers of line and chip against modules that somebody else wrote from the standards alone, with what
// is optional in them and what vendors do differently. On a simulated bus in virtual time.
#include <cstdio>

#include "hal/gpio/lines/canopen/tests/foreign_module.hpp"
#include "hal/gpio/lines/canopen/tests/io_world.hpp"
#include "tests/recovery.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;

using Settings = ForeignModule::Settings;
using Columns = CanopenGpioChip::Configuration;

/// With a plug.
class ForeignFarEnd final : public CanNode {
 public:
  ForeignFarEnd(const Settings& settings, Time /*now*/) : module_{settings} {}

  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    if (plugged_) node_.on_frame(frame, port);
  }
  Time next_event() const noexcept override { return node_.next_event(); }
  void on_time(Time now, CanPort& port) noexcept override {
    Unplugged nowhere;
    node_.on_time(now, plugged_ ? port : nowhere);
  }

  ForeignModule& module() { return module_; }
  void set_plugged(bool on) { plugged_ = on; }

 private:
  struct Unplugged final : CanPort {
    bool send(const CanFrame& /*frame*/) noexcept override { return true; }
  };

  ForeignModule module_;
  ForeignModuleNode node_{module_};
  bool plugged_ = true;
};

using World = IoWorld<ForeignFarEnd>;

struct Variant {
  const char* name;
  void (*module)(Settings&);
  void (*table)(Columns&) = nullptr;
  bool hears_us = true;         // it notices that we are gone
  bool has_safe_values = true;  // an output can be on in the safe state
};

constexpr Variant variants[] = {
    {"as most of them are", [](Settings&) {}},
    {"changes are told from the start", [](Settings& module) { module.enables_interrupts = true; }},
    {"silent until changes are to be told", [](Settings& module) { module.is_silent_without_them = true; }},
    {"no PDO at the start", [](Settings& module) { module.sends_tpdo_at_start = false; }},
    {"starts itself", [](Settings& module) { module.starts_itself = true; }},
    {"fixed mapping", [](Settings& module) { module.has_fixed_mapping = true; }},
    {"identifiers are locked in operation",
     [](Settings& module) { module.locks_cob_ids = module.starts_itself = true; }},
    {"identifiers that are out of use stay as they are",
     [](Settings& module) { module.keeps_disabled_cob_ids = true; }},
    {"nobody may ask for its PDO", [](Settings& module) { module.refuses_remote_requests = true; }},
    {"slow answers", [](Settings& module) { module.sdo_answer_time = milliseconds{15}; }},
    {"slow to boot", [](Settings& module) { module.boot_time = milliseconds{600}; }},
    {"a heartbeat of its own from the start", [](Settings& module) { module.heartbeat_milliseconds = 50; }},
    {"several heartbeats to look for", [](Settings& module) { module.heartbeat_consumers = 4; }},
    {"an emergency without an error at boot",
     [](Settings& module) { module.says_no_error_after_boot = true; }},
    {"its outputs stay through a reset", [](Settings& module) { module.keeps_outputs_on_reset = true; }},
    {"its outputs stay while it is paused or stopped",
     [](Settings& module) { module.keeps_outputs_when_paused = module.keeps_outputs_when_stopped = true; }},
    {"its outputs return", [](Settings& module) { module.returns_to_old_outputs = true; }},
    {"filters its inputs", [](Settings& module) { module.has_input_filter = true; }},
    {"nothing that is optional",
     [](Settings& module) {
       module.has_error_behaviour = module.has_interrupt_masks = module.has_polarity =
           module.has_output_filter = false;
     }},
    {"as many lines as there can be", [](Settings& module) { module.input_bytes = module.output_bytes = 8; },
     [](Columns& table) { table.input_bytes = table.output_bytes = 8; }},
    {"no error values", [](Settings& module) { module.has_error_values = false; },
     [](Columns& table) { table.tells_error_values = false; }, true, false},
    {"does not look for us", [](Settings& module) { module.heartbeat_consumers = 0; },
     [](Columns& table) { table.supervises_us = false; }, false},
    {"an event timer that is not so fast", [](Settings& module) { module.least_event_timer = 200; },
     [](Columns& table) { table.refresh = 0.2; }},
    {"its inputs are told with SYNC", [](Settings&) {}, [](Columns& table) { table.refresh = 0; }},
};

bool begins(World& world, const Variant& variant) {
  if (variant.table != nullptr) variant.table(world.configuration());
  if (variant.table == nullptr || world.configuration().input_bytes == 1)
    world.configuration().input_bytes = 2;
  return world.begin().is_ok() && world.add({.emergency_stop = true}, "DI10").is_ok() &&
         world.add({.direction = LineDirection::output}, "DO1").is_ok() &&
         world.add({.direction = LineDirection::output, .safe_value = variant.has_safe_values}, "DO2")
             .is_ok();
}

constexpr std::size_t button = 0;
constexpr std::size_t valve = 1;
constexpr std::size_t brake = 2;

bool is_up(World& world) {
  return world.until([&] { return world.told().present && world.line(brake).state().has_value(); });
}

std::uint64_t safe_outputs(const Variant& variant) {
  return variant.has_safe_values ? 2 : 0;
}

bool works(World& world, const Variant& variant) {
  world.far_end().module().set_input(10, true);
  if (!is_up(world) || world.far_end().module().outputs() != safe_outputs(variant)) return false;
  if (!world.until([&] { return !world.line(button).demands_safe_state(); })) return false;
  world.command(valve, true);
  world.command(brake, !variant.has_safe_values);
  const std::uint64_t commanded = variant.has_safe_values ? 1 : 3;
  if (world.far_end().module().outputs() != commanded) return false;
  world.far_end().module().set_input(10, false);
  if (!world.until([&] { return world.line(button).demands_safe_state(); }, milliseconds{400})) return false;
  const auto edge = world.line(button).read_edge();
  world.far_end().module().set_input(10, true);
  return edge && !edge->on && world.until([&] { return !world.line(button).demands_safe_state(); }) &&
         world.told().trouble_view().empty();
}

bool is_lost_safely_and_comes_back(World& world, const Variant& variant) {
  world.far_end().set_plugged(false);
  if (!world.until([&] { return !world.line(valve).state() && !world.line(button).state(); })) return false;
  if (!world.line(button).demands_safe_state()) return false;
  world.run(milliseconds{100});
  if (variant.hears_us && world.far_end().module().outputs() != safe_outputs(variant)) return false;
  world.far_end().set_plugged(true);
  const Time begin = world.now();
  // Never again as they were before, not even for a moment in operation.
  bool followed = false;
  const bool back = world.until([&] {
    const bool operational = world.far_end().module().state() == ForeignModule::State::operational;
    const bool was_lost = world.line(valve).state().has_value() || variant.hears_us;
    followed =
        followed || (operational && was_lost && world.far_end().module().outputs() != safe_outputs(variant));
    return world.told().present && world.line(brake).state().has_value();
  });
  if (!back || followed || !is_back_in_time(variant.name, world.now() - begin)) return false;
  world.run(milliseconds{200});
  if (world.far_end().module().outputs() != safe_outputs(variant) || world.is_on(valve)) return false;
  world.command(valve, true);
  return (world.far_end().module().outputs() & 1U) != 0;
}

bool is_driven(const Variant& variant) {
  Settings settings{.node = World::node};
  variant.module(settings);
  const auto world = std::make_unique<World>(settings);
  const bool good =
      begins(*world, variant) && works(*world, variant) && is_lost_safely_and_comes_back(*world, variant);
  if (!good) std::printf("%s: '%s'\n", variant.name, std::string(world->told().trouble_view()).c_str());
  return good;
}

void every_variant(void**) {
  bool good = true;
  for (const Variant& variant : variants) good = is_driven(variant) && good;
  assert_true(good);
}

// What such a module needs in the table is what the operator reads.
struct Hint {
  void (*module)(Settings&);
  const char* column;
};

constexpr Hint hints[] = {
    {[](Settings& module) { module.heartbeat_consumers = 0; }, "`supervises_us = false`"},
    {[](Settings& module) { module.has_error_values = false; }, "`tells_error_values = false`"},
    {[](Settings& module) { module.least_event_timer = 200; }, "`refresh = 0`"},
    {[](Settings& module) {
       module.least_event_timer = 500;
       module.raises_event_timer = true;
     },
     "is its event timer slower than `refresh`?"},
    {[](Settings& module) { module.input_bytes = 1; }, "`input_bytes = 1`"},
};

void every_hint(void**) {
  bool good = true;
  for (const Hint& hint : hints) {
    Settings settings{.node = World::node};
    hint.module(settings);
    const auto world = std::make_unique<World>(settings);
    const bool told = begins(*world, variants[0]) && world->until([&] {
      return world->told().trouble_view().find(hint.column) != std::string_view::npos;
    });
    if (!told)
      std::printf("not told: %s; but: '%s'\n", hint.column,
                  std::string(world->told().trouble_view()).c_str());
    good = good && told;
  }
  assert_true(good);
}

// What is wrong in it is told, and that it no longer is.
bool emergency_of_a_lost_heartbeat() {
  const auto world = std::make_unique<World>(Settings{.node = World::node, .has_error_behaviour = false});
  if (!begins(*world, variants[0]) || !works(*world, variants[0])) return false;
  world->stall(milliseconds{600});
  return world->until([&] { return !world->line(valve).state(); }) && is_up(*world) &&
         world->until([&] { return world->told().trouble_view().empty(); });
}

void heartbeat(void**) {
  const bool good = emergency_of_a_lost_heartbeat();
  assert_true(good);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      {"every variant is driven, lost safely, and back", every_variant, nullptr, nullptr, nullptr},
      {"what a variant needs in the table is told", every_hint, nullptr, nullptr, nullptr},
      {"an emergency of a heartbeat that was lost", heartbeat, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests_name("a foreign CANopen IO module", tests, nullptr, nullptr);
}
