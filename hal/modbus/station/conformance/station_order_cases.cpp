// Whatever happens to a station, in whatever order: while it can be reached, it holds what was set since the
// last Start, or its safe values, and what was said to be safe is so.
#include "hal/modbus/station/conformance/station_order_cases.hpp"

#include <array>
#include <cmath>
#include <span>

#include "tests/event_orders.hpp"

namespace flexrf {
namespace {

enum class Happening : std::uint8_t {
  stop,
  start,
  silent,
  refuses,
  switched_off,
  well,
  set,
  set_otherwise,
  written_by_others,
  made_safe,
  idle,
  count
};
constexpr std::array<const char*, events_of<Happening>> names{
    "stop", "start", "silent",        "refuses",           "switched off",
    "well", "set",   "set otherwise", "written by others", "made safe",
    "idle"};

constexpr std::size_t speed_index = 0, lamp_index = 1;
constexpr ModbusRegister two_outputs[] = {{.name = "speed",
                                           .address = 10,
                                           .type = ModbusType::i16,
                                           .access = ModbusAccess::read_write,
                                           .poll_group = ModbusPollGroup::fast},
                                          {.name = "lamp",
                                           .address = 7,
                                           .area = ModbusArea::coil,
                                           .type = ModbusType::boolean,
                                           .access = ModbusAccess::read_write,
                                           .poll_group = ModbusPollGroup::fast,
                                           .safe_value = 1}};
constexpr ModbusRegisterMap map_of_outputs{two_outputs};

// Until the station is asked again after the longest pause, and everything is written again.
constexpr Duration recovery = std::chrono::milliseconds(2500);
constexpr Duration moment = std::chrono::milliseconds(60);
constexpr int most_safe_cycles = 1000;

struct Outputs {
  double speed = 0;
  double lamp = 1;
  bool operator==(const Outputs&) const = default;
};
constexpr Outputs safe{};

/// A world, and what a person does in it.
class Operator {
 public:
  explicit Operator(ModbusStationWorld& world) : world_(world) {
    world_.set_response_timeout(0.01);
    if (!world_.start(map_of_outputs)) violation_ = "it does not start";
    pass(moment);
  }

  void does(Happening happening) {
    switch (happening) {
      case Happening::stop:
        permit(false);
        break;
      case Happening::start:
        permit(false);
        pass(Duration{});
        permit(true);
        break;
      case Happening::silent:
        make(ModbusFarEnd::silent);
        break;
      case Happening::refuses:
        make(ModbusFarEnd::refuses);
        break;
      case Happening::switched_off:
        make(ModbusFarEnd::disconnected);
        break;
      case Happening::well:
        make(ModbusFarEnd::well);
        pass(recovery);
        break;
      case Happening::set:
        set({.speed = 5, .lamp = 0});
        break;
      case Happening::set_otherwise:
        set({.speed = -3, .lamp = 1});
        break;
      case Happening::written_by_others:
        world_.put(speed_index, 9);
        pass(recovery);  // what holds is written again
        break;
      case Happening::made_safe:
        make_safe();
        break;
      default:
        break;
    }
    pass(moment);
    look();
  }

  const char* violation() const { return violation_; }
  int written_as_set() const { return written_as_set_; }

 private:
  Outputs held() { return {world_.held(speed_index), world_.held(lamp_index)}; }

  void permit(bool on) {
    may_act_ = on;
    wanted_ = safe;
    world_.station().set_inhibited(!on);
  }
  void set(Outputs outputs) {
    world_.receive();
    world_.station().set(speed_index, outputs.speed);
    world_.station().set(lamp_index, outputs.lamp);
    world_.send();
    if (may_act_) wanted_ = outputs;
  }
  void make(ModbusFarEnd behaviour) {
    is_well_ = world_.make(behaviour) && behaviour == ModbusFarEnd::well;
    pass(moment);
  }
  void make_safe() {
    may_act_ = false;
    wanted_ = safe;
    for (int i = 0; i < most_safe_cycles; ++i) {
      world_.receive();
      const bool said = world_.station().make_safe();
      if (said && held() != safe) violation_ = "it said that it is safe, and was not";
      world_.send();
      if (said) return;
    }
    if (is_well_) violation_ = "it could be reached, and did not become safe";
  }
  void pass(Duration duration) {
    const Time begin = world_.now();
    do {
      world_.receive();
      world_.send();
    } while (world_.now() - begin < duration);
  }
  void look() {
    if (!is_well_) return;
    if (held() != wanted_)
      violation_ = wanted_ == safe ? "it holds what nobody has set since the last Start"
                                   : "it does not hold what was set";
    if (held() == wanted_ && wanted_ != safe) ++written_as_set_;
  }

  ModbusStationWorld& world_;
  Outputs wanted_;
  bool may_act_ = false;
  bool is_well_ = true;
  const char* violation_ = nullptr;
  int written_as_set_ = 0;
};

}  // namespace

Verdict no_order_of_events_writes_what_nobody_set(MakeModbusStationWorld make) {
  if (!make()->has_virtual_time()) return Verdict::skipped;
  return verdict(hold_in_orders<Happening, 3, 4>(names, 500, 5'000, [&](std::span<const Happening> order) {
    const auto world = make();
    Operator person(*world);
    for (const Happening happening : {Happening::start, Happening::set}) person.does(happening);
    for (const Happening happening : order) person.does(happening);
    person.does(Happening::idle);
    return OrderOutcome{person.violation(), person.written_as_set()};
  }));
}

}  // namespace flexrf
