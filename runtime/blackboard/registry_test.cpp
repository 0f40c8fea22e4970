#include "runtime/blackboard/registry.hpp"

#include "runtime/blackboard/test_types.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using test::Block;
using test::Sample;

struct Board {
  Slot<Sample, 2> pose;
  Slot<Block<4>, 1> image;
  SlotReader observer{&pose.control()};
  RegistryEntry entries[2] = {{"pose", &pose.control(), &observer}, {"image", &image.control(), nullptr}};
  Registry registry{entries};
  std::uint64_t seen = 0;

  void publish(std::uint32_t number) {
    const std::uint8_t buffer = pose.control().loan();
    const Sample value{number, 0, 0};
    std::memcpy(pose.control().payload(buffer), &value, sizeof(value));
    pose.control().publish(buffer, Time{Duration{number}});
  }
  Observation read(const char* name) { return registry.read(name, &test::sample_type, seen); }
};

void slots_are_found_by_name_and_type(void**) {
  Board board;
  NullReason reason{};
  assert_ptr_equal(board.registry.find("pose", test::sample_type, reason), &board.pose.control());
  assert_int_equal(reason, NullReason::none);
  assert_null(board.registry.find("pos", test::sample_type, reason));
  assert_int_equal(reason, NullReason::not_registered);
  assert_null(board.registry.find("image", test::sample_type, reason));
  assert_int_equal(reason, NullReason::wrong_type);
  assert_ptr_equal(board.registry.find("image"), &board.entries[1]);
  assert_null(board.registry.find(""));
}

void the_observer_reads_any_slot_with_the_reason_when_there_is_nothing(void**) {
  Board board;
  assert_int_equal(board.read("nowhere").reason, NullReason::not_registered);
  assert_int_equal(board.read("image").reason, NullReason::wrong_type);
  assert_ptr_equal(board.read("image").type, &test::block_type<4>);
  assert_int_equal(board.registry.read("image", nullptr, board.seen).reason, NullReason::not_registered);
  assert_int_equal(board.read("pose").reason, NullReason::nothing_yet);
  assert_null(board.read("pose").value);

  board.publish(5);
  Observation observation = board.read("pose");
  assert_int_equal(observation.reason, NullReason::none);
  assert_int_equal(observation.freshness, Freshness::new_item);
  assert_int_equal(static_cast<const Sample*>(observation.value)->number, 5);
  assert_int_equal(observation.header.sequence, 1);
  assert_int_equal(nanoseconds(observation.header.sampled_at), 5);
  assert_ptr_equal(observation.type, &test::sample_type);
  assert_int_equal(board.read("pose").freshness, Freshness::old_item);
  for (std::uint32_t number = 6; number < 20; ++number) {
    board.publish(number);
    observation = board.read("pose");
    assert_int_equal(observation.freshness, Freshness::new_item);
    assert_int_equal(static_cast<const Sample*>(observation.value)->number, number);
  }

  board.pose.control().set_writer_state(WriterState::faulted);
  observation = board.read("pose");
  assert_int_equal(observation.reason, NullReason::writer_faulted);
  assert_int_equal(observation.freshness, Freshness::null);
  assert_null(observation.value);
}

void a_thousand_slots_are_found(void**) {
  static Slot<Sample, 1> slots[1000];
  static char names[1000][16];
  static RegistryEntry entries[1000];
  for (int i = 0; i < 1000; ++i) {
    snprintf(names[i], sizeof(names[i]), "s%d", i);
    entries[i] = {names[i], &slots[i].control(), nullptr};
  }
  const Registry registry{entries};
  for (int i = 0; i < 1000; ++i) assert_ptr_equal(registry.find(names[i])->slot, &slots[i].control());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(slots_are_found_by_name_and_type),
      cmocka_unit_test(the_observer_reads_any_slot_with_the_reason_when_there_is_nothing),
      cmocka_unit_test(a_thousand_slots_are_found),
  };
  return cmocka_run_group_tests_name("registry", tests, nullptr, nullptr);
}
