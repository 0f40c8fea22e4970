// Contacts that bounce, wires, and what is configured wrongly.
#include "hal/gpio/chip/simulated/simulated_gpio_chip.hpp"

#include <algorithm>
#include <vector>

#include "hal/gpio/lines/conformance/virtual_world.hpp"
#include "hal/gpio/lines/simulated/simulated_digital_io.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr Duration cycle = std::chrono::milliseconds(1);

/// A chip and two lines on it, without inhibition.
struct Rig {
  DeviceBench<SimulatedGpioChip> chip{nullptr};
  DeviceBench<SimulatedDigitalIo> valve{nullptr, {}, &chip.driver()};
  DeviceBench<SimulatedDigitalIo> reed{nullptr, {}, &chip.driver()};

  bool start(Duration debounce = {}) {
    configure_line(valve, {.direction = LineDirection::output}, "VALVE");
    configure_line(reed, {.debounce = debounce}, "REED");
    return chip.driver().initialise().is_ok() && valve.driver().initialise().is_ok() &&
           reed.driver().initialise().is_ok();
  }
  void receive() {
    chip.receive(cycle);
    valve.receive(cycle);
    reed.receive(cycle);
  }
  bool reed_is_on() {
    const auto state = reed.driver().state();
    return state && state->on;
  }
};

std::vector<DigitalEdge> bounces(std::uint64_t seed, bool* flickered) {
  Rig rig;
  rig.chip.environment().seed = seed;
  rig.chip.configuration().bounce = 0.005;
  std::vector<DigitalEdge> edges;
  if (!rig.start(std::chrono::milliseconds(10))) return edges;
  rig.receive();
  rig.chip.driver().line("REED").drive(true);
  bool was_on = false;
  for (int i = 0; i < 30; ++i) {
    rig.receive();
    while (const auto edge = rig.reed.driver().read_edge()) edges.push_back(*edge);
    *flickered = *flickered || (was_on && !rig.reed_is_on());
    was_on = rig.reed_is_on();
  }
  if (!was_on) edges.clear();
  return edges;
}

void a_contact_bounces_as_its_seed_says(void**) {
  bool same = false;
  bool other = true;
  bool flickered = false;
  bool ordered = true;
  std::size_t count = 0;
  {
    const auto equal = [](const std::vector<DigitalEdge>& a, const std::vector<DigitalEdge>& b) {
      return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                                [](auto x, auto y) { return x.on == y.on && x.at == y.at; });
    };
    const std::vector<DigitalEdge> edges = bounces(7, &flickered);
    count = edges.size();
    for (std::size_t i = 1; i < edges.size(); ++i)
      ordered = ordered && edges[i].on != edges[i - 1].on && edges[i].at >= edges[i - 1].at;
    same = equal(edges, bounces(7, &flickered));
    other = equal(edges, bounces(8, &flickered));
  }
  assert_true(count >= 3);
  assert_true(ordered);
  assert_true(same);
  assert_false(other);
  assert_false(flickered);  // debounced
}

// [gpio-chip-6]
void an_input_follows_its_wire_after_its_delay(void**) {
  int after = -1;
  bool before = true;
  bool is_known = false;
  {
    Rig rig;
    set_text(rig.chip.configuration().wires, "VALVE>REED");
    rig.chip.configuration().wire_delay = 0.01;
    if (rig.start()) {
      rig.receive();
      before = rig.reed_is_on();
      rig.valve.driver().command(true);
      rig.valve.send();
      for (int i = 1; i < 30 && after < 0; ++i) {
        rig.receive();
        const Time next = rig.reed.driver().next_event();
        if (i == 1) is_known = next == rig.reed.now() + 10 * cycle;
        if (rig.reed_is_on()) after = i;
      }
    }
  }
  assert_false(before);
  assert_true(is_known);
  assert_int_equal(after, 11);  // seen by the reed in the first cycle, 10 ms later there
}

void inputs_that_are_high_from_the_start(void**) {
  bool on = false;
  {
    Rig rig;
    set_text(rig.chip.configuration().high, "OTHER REED");
    if (rig.start()) {
      rig.receive();
      on = rig.reed_is_on();
    }
  }
  assert_true(on);
}

void a_wire_that_is_none_is_told(void**) {
  StatusCode code = StatusCode::ok;
  {
    Rig rig;
    set_text(rig.chip.configuration().wires, "VALVE REED");
    code = rig.chip.driver().initialise().code();
  }
  assert_int_equal(code, StatusCode::invalid_argument);
}

// [digital-io-6]
void edges_go_to_the_queue_where_one_is_connected(void**) {
  bool read = false;
  int count = 0;
  bool in_order = true;
  {
    QueueBench<DigitalEdge> queue;
    DeviceBench<SimulatedGpioChip> chip{nullptr};
    DeviceBench<SimulatedDigitalIo> reed{nullptr, queue.sinks(), &chip.driver()};
    configure_line(reed, {}, "REED");
    if (chip.driver().initialise() && reed.driver().initialise()) {
      for (int i = 0; i < 4; ++i) {
        chip.receive(cycle);
        reed.receive(cycle);
        read = read || reed.driver().read_edge();
        chip.driver().line("REED").drive(i % 2 == 0);
      }
      while (const auto edge = queue.pop()) in_order = in_order && edge->on == (count++ % 2 == 0);
    }
  }
  assert_int_equal(count, 3);
  assert_true(in_order);
  assert_false(read);
}

// [digital-io-8]
void edges_that_a_full_queue_has_no_room_for_are_not_forgotten(void**) {
  int count = 0;
  bool asked = true;
  bool rests = false;
  {
    QueueBench<DigitalEdge, 2> queue;
    DeviceBench<SimulatedGpioChip> chip{nullptr};
    DeviceBench<SimulatedDigitalIo> reed{nullptr, queue.sinks(), &chip.driver()};
    configure_line(reed, {}, "REED");
    const auto receive = [&](Duration elapsed) {
      chip.receive(elapsed);
      reed.receive(elapsed);
    };
    if (chip.driver().initialise() && reed.driver().initialise()) {
      receive(cycle);
      for (int i = 0; i < 6; ++i) {
        chip.driver().line("REED").drive(i % 2 == 0);
        receive(cycle);
      }
      // Nothing changes any more: from here on the line is called when it asks.
      for (int i = 0; i < 2; ++i) {
        const Time next = reed.driver().next_event();
        asked = asked && next > reed.now() && next <= reed.now() + std::chrono::milliseconds(5);
        if (!asked) break;
        while (queue.pop()) ++count;
        receive(next - reed.now());
      }
      while (queue.pop()) ++count;
      rests = reed.driver().next_event() == Time::max();
    }
  }
  assert_true(asked);
  assert_int_equal(count, 6);
  assert_true(rests);
}

// [gpio-chip-5]
void a_line_is_one_devices(void**) {
  StatusCode code = StatusCode::ok;
  {
    Rig rig;
    configure_line(rig.valve, {}, "SAME");
    configure_line(rig.reed, {}, "SAME");
    if (rig.valve.driver().initialise()) code = rig.reed.driver().initialise().code();
  }
  assert_int_equal(code, StatusCode::busy);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_contact_bounces_as_its_seed_says),
      cmocka_unit_test(an_input_follows_its_wire_after_its_delay),
      cmocka_unit_test(inputs_that_are_high_from_the_start),
      cmocka_unit_test(a_wire_that_is_none_is_told),
      cmocka_unit_test(edges_go_to_the_queue_where_one_is_connected),
      cmocka_unit_test(edges_that_a_full_queue_has_no_room_for_are_not_forgotten),
      cmocka_unit_test(a_line_is_one_devices),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
