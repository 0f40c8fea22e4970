// What config-gen believes about the runtime's sizes and limits, against what the compiler says: a difference
// does not compile.
#include "config-gen/model/footprint.hpp"

#include <array>
#include <cstddef>

#include "config-gen/model/limits.hpp"
#include "hal/driver/helper_thread.hpp"
#include "runtime/blackboard/history.hpp"
#include "runtime/blackboard/job_queue.hpp"
#include "runtime/blackboard/queue_ring.hpp"
#include "runtime/blackboard/slot.hpp"
#include "runtime/executive/trigger.hpp"
#include "runtime/parameters/parameter_store.hpp"
#include "runtime/realtime/thread_setup.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

static_assert(config_gen::cache_line == cache_line);
static_assert(config_gen::page == page);
static_assert(config_gen::large_payload == large_payload);
static_assert(config_gen::max_runtime_size == max_runtime_size);
static_assert(config_gen::max_holds == max_holds);
static_assert(config_gen::max_trigger_sources == Trigger::max_sources);

static_assert(config_gen::item_header == sizeof(ItemHeader));
static_assert(config_gen::slot_control == sizeof(SlotControl));
static_assert(config_gen::history_control == sizeof(History));
static_assert(config_gen::ring_control == sizeof(QueueRing));
static_assert(config_gen::ring_set == sizeof(RingSet));
static_assert(config_gen::job_control == sizeof(JobQueue));
static_assert(config_gen::job_sink == sizeof(JobSink));
static_assert(config_gen::job_cell == sizeof(JobQueue::Cell));
static_assert(config_gen::helper_stack == HelperThread::stack_size);

// A payload of `Size` bytes, aligned as a struct of doubles or of bytes.
template <std::size_t Size, std::size_t Alignment>
struct Payload {
  alignas(Alignment) std::array<std::byte, Size> bytes;
};

template <std::size_t Size, std::size_t Alignment, std::size_t Count>
constexpr bool is_as_believed() {
  using T = Payload<Size, Alignment>;
  static_assert(sizeof(T) == Size);
  static_assert(sizeof(SlotMemory<T, Count>) == config_gen::slot_memory(Size, Count));
  static_assert(sizeof(HistoryMemory<T, Count>) == config_gen::history_memory(Size, Count));
  static_assert(sizeof(QueueRingMemory<T, Count>) == config_gen::ring_memory(Size, Count));
  static_assert(sizeof(JobQueueMemory<T, Count>) == config_gen::job_memory(Size, Count));
  return true;
}

// A type that is as large as its slot says.
struct Sized {
  std::uint32_t elements_;
  using SlotElement = std::uint16_t;
  static constexpr std::size_t elements_begin_ = 4096;
};
template <std::size_t Elements, std::size_t Count>
constexpr bool is_sized_as_believed() {
  return sizeof(SizedSlotMemory<Sized, Count, Elements>) ==
         config_gen::slot_memory(4096 + 2 * Elements, Count);
}

template <std::size_t Size, std::size_t Alignment>
constexpr bool is_as_believed() {
  return is_as_believed<Size, Alignment, 3>() && is_as_believed<Size, Alignment, 16>() &&
         is_as_believed<Size, Alignment, 21>();
}

void sizes_are_as_config_gen_believes(void**) {
  static_assert(is_as_believed<1, 1>() && is_as_believed<7, 1>() && is_as_believed<45, 1>());
  static_assert(is_as_believed<8, 8>() && is_as_believed<48, 8>() && is_as_believed<56, 8>());
  static_assert(is_as_believed<4088, 8>() && is_as_believed<4096, 8>() && is_as_believed<4097, 1>());
  static_assert(is_as_believed<921'600, 8>());
  static_assert(is_sized_as_believed<1, 3>() && is_sized_as_believed<2048, 5>() &&
                is_sized_as_believed<100'000, 16>());
}

// What the system adds for the registers of its CPU differs from machine to machine, so there is room.
void the_least_stack_is_enough(void**) {
  assert_true(config_gen::min_stack >= minimal_stack_size());
}

}  // namespace
}  // namespace flexrf

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(flexrf::sizes_are_as_config_gen_believes),
                              cmocka_unit_test(flexrf::the_least_stack_is_enough)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
