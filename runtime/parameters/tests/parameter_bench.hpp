// A component's runtime parameters with their slot, and requests to them: what the tests of both share.
#pragma once

#include <optional>

#include "runtime/parameters/parameter_store.hpp"
#include "runtime/parameters/tests/sample_component.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::test {

inline constexpr Time start_time{std::chrono::seconds{100}};

// Static, because a failing assertion jumps over destructors; begin() makes it anew for each test.
struct Cell {
  sample::SampleComponent component;
  Slot<sample::Runtime, 1> slot;
  ParameterScratch scratch{};
  RuntimeParameters parameters;
  std::uint8_t held = SlotControl::none;

  /// The values in force as a reader of the slot sees them.
  const sample::Runtime& seen() {
    slot.control().take(held);
    return *reinterpret_cast<const sample::Runtime*>(slot.control().payload(held));
  }
  std::uint64_t seen_sequence() {
    slot.control().take(held);
    return held == SlotControl::none ? 0 : slot.control().header(held).sequence;
  }
};

inline std::optional<Cell> cell_of_this_test;

inline Cell& begin() {
  Cell* const cell = &cell_of_this_test.emplace();
  cell->component.set_name("cell");
  assert_true(cell->parameters
                  .connect(cell->component, &cell->slot.control(), &sample::default_runtime, cell->scratch)
                  .is_ok());
  assert_true(cell->parameters.adopt(&sample::default_runtime, start_time).is_ok());
  return *cell;
}

inline ParameterRequest request_of(RequestKind kind, std::uint64_t correlation = 0) {
  ParameterRequest request;
  request.kind = kind;
  request.correlation = correlation;
  return request;
}

template <class T>
ParameterRequest set_to(std::uint16_t parameter, const T& value, std::uint32_t offset = 0) {
  ParameterRequest request = request_of(RequestKind::set, 42);
  request.add(parameter, offset, &value, sizeof(value));
  return request;
}

inline ParameterRequest lease_request(RequestKind kind, std::uint64_t lease, std::uint64_t sequence,
                                      std::uint32_t element = 0) {
  ParameterRequest request = request_of(kind);
  request.requester = 1;
  request.lease = lease;
  request.lease_sequence = sequence;
  request.add_name(sample::jog, element);
  return request;
}

inline void expect_refused(const ParameterAnswer& answer, std::uint16_t parameter, const char* reason) {
  assert_int_equal(answer.kind, AnswerKind::refused);
  assert_string_equal(answer.reason, reason);
  assert_int_equal(answer.parameter, parameter);
}

}  // namespace flexrf::test
