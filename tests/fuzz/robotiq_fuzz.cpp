// Registers of a Robotiq gripper, and what its driver makes of any order of them.
#include <cmath>

#include "hal/gripper/robotiq/robotiq_control.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace flexrf::fuzz {
namespace {

using namespace robotiq;

void check_words(const Words& words, const Told& told) {
  const Words again = encode(told);
  // Reserved bits apart.
  const Told same = decode(again);
  expect(same.activate == told.activate && same.go == told.go && same.found == told.found &&
         same.fault == told.fault && same.requested == told.requested && same.position == told.position &&
         same.current == told.current);
  expect(describe_fault(told.fault) != nullptr);
  const Action action = action_in(words);
  expect(action_in(encode(action)) == action);
}

void command(Control& control, Source& source) {
  switch (source.byte() % 5) {
    case 0:
      return control.activate();
    case 1:
      return control.halt();
    case 2:
      return control.command({.opening = source.byte() / 1000.0});
    case 3:
      return control.command({.opening = source.byte() / 1000.0, .speed = 1e6, .force = 1e-6});
    default:
      return;
  }
}

}  // namespace

std::vector<Bytes> seeds() {
  Bytes activates;
  Bytes grips;
  const Told active{.activate = true, .activation = Activation::active};
  const Told gripped{.activate = true,
                     .go = true,
                     .activation = Activation::active,
                     .found = Found::while_closing,
                     .requested = 255,
                     .position = 130};
  const auto append = [](Bytes& bytes, const Told& told, std::uint8_t what) {
    bytes.push_back(1);
    for (const std::uint16_t word : encode(told)) {
      bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
      bytes.push_back(static_cast<std::uint8_t>(word >> 8));
    }
    bytes.push_back(what);
    if (what >= 2) bytes.push_back(0);
  };
  append(activates, {}, 0);
  append(activates, {}, 4);
  append(activates, active, 2);
  append(grips, active, 2);
  append(grips, gripped, 4);
  return {activates, grips};
}

void take(std::span<const std::uint8_t> bytes) {
  Source source(bytes);
  Control control;
  control.begin({});
  Time now{std::chrono::seconds(1)};
  while (!source.is_empty()) {
    const std::uint8_t how = source.byte();
    now += std::chrono::milliseconds(10 * how);
    std::optional<Told> told;
    if (how % 8 != 0) {
      const Words words{source.word(), source.word(), source.word()};
      told = decode(words);
      check_words(words, *told);
    }
    control.receive(told, how % 2 != 0, now, "silent");
    command(control, source);
    expect(!control.state() || !control.state()->opening || std::isfinite(*control.state()->opening));
    static_cast<void>(control.take_anew());
  }
}

}  // namespace flexrf::fuzz
