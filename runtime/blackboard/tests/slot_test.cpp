// What a slot promises to one thread at a time; slot_stress.cpp sets threads against each other.
#include "runtime/blackboard/slot.hpp"

#include <algorithm>
#include <random>

#include "runtime/blackboard/history.hpp"
#include "runtime/blackboard/ports.hpp"
#include "runtime/blackboard/sized_slot.hpp"
#include "runtime/blackboard/test_types.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using test::Block;
using test::Cloud;
using test::Sample;

Time at(std::int64_t ns) {
  return Time{Duration{ns}};
}

Sample& sample(SlotControl& slot, std::uint8_t buffer) {
  return *static_cast<Sample*>(static_cast<void*>(slot.payload(buffer)));
}

void publish(SlotControl& slot, std::uint32_t number, Time sampled_at = at(1)) {
  const std::uint8_t buffer = slot.loan();
  assert_int_not_equal(buffer, SlotControl::none);
  sample(slot, buffer) = {number, 0.5, 1};
  slot.publish(buffer, sampled_at);
}

template <class SlotType>
void check_reads(SlotType& slot) {
  SlotControl& control = slot.control();
  std::uint8_t held = SlotControl::none;
  assert_false(control.has_newer(held));
  assert_false(control.take(held));
  assert_int_equal(held, SlotControl::none);

  publish(control, 7, at(40));
  assert_int_equal(control.published(), 1);
  assert_true(control.has_newer(held));
  assert_true(control.take(held));
  assert_int_equal(sample(control, held).number, 7);
  assert_int_equal(control.header(held).sequence, 1);
  assert_int_equal(nanoseconds(control.header(held).sampled_at), 40);
  assert_false(control.has_newer(held));
  assert_false(control.take(held));
  assert_int_equal(sample(control, held).number, 7);

  for (std::uint32_t number = 8; number < 20; ++number) publish(control, number);
  assert_int_equal(sample(control, held).number, 7);
  assert_true(control.take(held));
  assert_int_equal(sample(control, held).number, 19);
  assert_int_equal(control.header(held).sequence, 13);

  // Given back, the same item can be taken again.
  control.give(held);
  control.take(held);
  assert_int_equal(sample(control, held).number, 19);
}

// [board-1]
void reader_gets_the_latest_complete_value_or_nothing(void**) {
  Slot<Sample, 1> triple;
  Slot<Sample, 1, 2> two_loans;
  Slot<Sample, 8> eight_readers;
  check_reads(triple);
  check_reads(two_loans);
  check_reads(eight_readers);
}

// [board-24]
void one_reader_and_one_loan_make_a_triple_buffer(void**) {
  assert_int_equal((Slot<Sample, 1>::buffers), 3);
  assert_int_equal((Slot<Sample, 4, 2>::buffers), 7);
  assert_int_equal((Slot<Sample, 4, 2, 1>::buffers), 8);
}

// [board-7]
void loans_are_published_or_abandoned_in_any_order(void**) {
  int order[] = {0, 1, 2};
  do {
    for (unsigned abandoned = 0; abandoned < 8; ++abandoned) {
      Slot<Sample, 2, 3> slot;
      SlotControl& control = slot.control();
      std::uint8_t held = SlotControl::none;
      std::uint8_t loans[3];
      for (std::uint32_t i = 0; i < 3; ++i) {
        loans[i] = control.loan();
        assert_int_not_equal(loans[i], SlotControl::none);
        sample(control, loans[i]).number = i;
      }
      assert_int_equal(control.loan(), SlotControl::none);
      std::uint64_t sequence = 0;
      std::uint32_t last = 0;
      for (const int i : order) {
        if ((abandoned >> i & 1U) != 0) {
          control.abandon(loans[i]);
          continue;
        }
        control.publish(loans[i], at(i));
        last = static_cast<std::uint32_t>(i);
        ++sequence;
        control.take(held);
        assert_int_equal(sample(control, held).number, last);
        assert_int_equal(control.header(held).sequence, sequence);
      }
      assert_int_equal(control.published(), sequence);
      for (std::uint8_t& loan : loans) {
        loan = control.loan();
        assert_int_not_equal(loan, SlotControl::none);
        if (held != SlotControl::none) assert_int_not_equal(loan, held);
      }
      if (held != SlotControl::none) assert_int_equal(sample(control, held).number, last);
    }
  } while (std::next_permutation(std::begin(order), std::end(order)));
}

// [board-9]
void abandoned_loan_changes_nothing(void**) {
  Slot<Sample, 1> slot;
  SlotControl& control = slot.control();
  std::uint8_t held = SlotControl::none;
  publish(control, 1);
  for (int i = 0; i < 5; ++i) {
    const std::uint8_t buffer = control.loan();
    sample(control, buffer).number = 99;
    control.abandon(buffer);
  }
  assert_true(control.take(held));
  assert_int_equal(sample(control, held).number, 1);
  assert_int_equal(control.published(), 1);
  publish(control, 2);
  assert_true(control.take(held));
  assert_int_equal(control.header(held).sequence, 2);
}

template <class SlotType>
void check_loan_last(SlotType& slot) {
  SlotControl& control = slot.control();
  std::uint8_t held = SlotControl::none;
  std::uint8_t buffer = control.loan_last();
  assert_int_equal(sample(control, buffer).number, 0);
  sample(control, buffer) = {5, 2.5, 1};
  control.publish(buffer, at(1));
  control.take(held);
  for (std::uint32_t i = 6; i < 12; ++i) {
    buffer = control.loan_last();
    assert_int_equal(sample(control, buffer).number, i - 1);
    assert_true(sample(control, buffer).value == 2.5);
    sample(control, buffer).number = 99;
    control.abandon(buffer);
    buffer = control.loan_last();
    assert_int_equal(sample(control, buffer).number, i - 1);
    sample(control, buffer).number = i;
    control.publish(buffer, at(1));
    if (i % 2 == 0) control.take(held);
  }
}

// [board-6]
void loan_last_starts_as_the_last_value(void**) {
  Slot<Sample, 1> triple;
  Slot<Sample, 2, 2> two_loans;
  Slot<Sample, 1> deferred;
  check_loan_last(triple);
  check_loan_last(two_loans);
  deferred.control().set_deferred(true);
  check_loan_last(deferred);
}

/// Random operations against what a slot should do: no buffer that is held or out on loan is ever handed out.
template <std::size_t Readers, std::size_t Loans, std::size_t Holds>
void check_random_walk(unsigned seed) {
  Slot<Sample, Readers, Loans, Holds> slot;
  SlotControl& control = slot.control();
  std::mt19937 random{seed};
  SlotReader readers[Readers];
  for (SlotReader& reader : readers) reader = SlotReader{&control};
  std::uint8_t loans[Loans];
  std::fill(std::begin(loans), std::end(loans), SlotControl::none);
  std::uint32_t latest = 0;
  std::uint32_t kept = 0;
  std::uint32_t seen[Readers] = {};
  std::uint32_t number = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t which = random() % Loans;
    const std::size_t who = random() % Readers;
    switch (random() % 5) {
      case 0:
        if (loans[which] == SlotControl::none) {
          loans[which] = random() % 2 == 0 ? control.loan() : control.loan_last();
          assert_int_not_equal(loans[which], SlotControl::none);
          sample(control, loans[which]).number = ~0U;
        }
        break;
      case 1:
        if (loans[which] != SlotControl::none) {
          sample(control, loans[which]).number = ++number;
          latest = number;
          control.publish(loans[which], at(i));
          loans[which] = SlotControl::none;
        }
        break;
      case 2:
        if (loans[which] != SlotControl::none && random() % 4 == 0) {
          control.abandon(loans[which]);
          loans[which] = SlotControl::none;
        }
        break;
      case 3:
        if (readers[who].newest() != nullptr) seen[who] = latest;
        break;
      case 4:
        // The first reader is the one that may hold.
        if (Holds > 0 && seen[0] != 0) {
          readers[0].keep();
          kept = seen[0];
        }
        break;
      default:
        break;
    }
    for (std::size_t reader = 0; reader < Readers; ++reader) {
      if (seen[reader] == 0) continue;
      assert_int_equal(static_cast<const Sample*>(readers[reader].payload())->number, seen[reader]);
    }
    if (kept != 0) assert_int_equal(static_cast<const Sample*>(readers[0].kept_payload())->number, kept);
  }
  assert_true(number > 1000);
}

template <std::size_t Readers, std::size_t Loans>
void check_random_walks() {
  check_random_walk<Readers, Loans, 0>(1);
  check_random_walk<Readers, Loans, 1>(2);
  check_random_walk<Readers, Loans, 2>(3);
}

// [board-1] [board-16]
void held_and_loaned_buffers_are_never_handed_out(void**) {
  check_random_walks<1, 1>();
  check_random_walks<1, 2>();
  check_random_walks<2, 1>();
  check_random_walks<3, 3>();
  check_random_walks<8, 2>();
}

void more_readers_than_declared_end_in_no_loan_not_in_a_loop(void**) {
  Slot<Sample, 2> slot;
  SlotControl& control = slot.control();
  std::uint8_t held[3] = {SlotControl::none, SlotControl::none, SlotControl::none};
  for (std::uint8_t& reader : held) {
    publish(control, 1);
    assert_true(control.take(reader));
  }
  publish(control, 2);
  assert_int_equal(control.loan(), SlotControl::none);
  control.give(held[0]);
  assert_int_not_equal(control.loan(), SlotControl::none);
}

template <class SlotType>
void check_sequence_wrap(SlotType& slot) {
  SlotControl& control = slot.control();
  StepContext context{1, at(100)};
  SlotReader reader{&control};
  Input<Sample> input;
  input.connect(&context, InputBinding{&reader, 1, {}, nullptr});
  control.start_sequence_at(~std::uint64_t{0} - 2);
  publish(control, 1);
  assert_int_equal(input.latest().sequence(), ~std::uint64_t{0} - 1);
  publish(control, 2);
  publish(control, 3);  // 1: 0 means never
  publish(control, 4);
  context.step = 2;
  assert_int_equal(input.latest().sequence(), 2);
  assert_true(input.latest().is_new());
  assert_int_equal(input.latest().missed(), 2);
  publish(control, 5);
  context.step = 3;
  assert_int_equal(input.latest().missed(), 0);
  assert_int_equal(input.missed(), 2);
  assert_int_equal(input.read(), 3);
  assert_int_equal(control.published(), 3);
}

// [board-14]
void sequences_wrap_around(void**) {
  Slot<Sample, 1> triple;
  Slot<Sample, 3> counted;
  check_sequence_wrap(triple);
  check_sequence_wrap(counted);
}

void counts_of_takes_wrap_around(void**) {
  static SlotMemory<Sample, 4> memory;
  for (int i = 0; i < 4; ++i) {
    memory.taken[i] = 0xFFFFFFFE;
    memory.given[i] = 0xFFFFFFFE;
  }
  SlotControl control{&test::sample_type, memory.view(1, false)};
  std::uint8_t held[2] = {SlotControl::none, SlotControl::none};
  for (std::uint32_t number = 1; number < 50; ++number) {
    publish(control, number);
    for (int again = 0; again < 3; ++again) {
      for (std::uint8_t& reader : held) {
        control.take(reader);
        assert_int_equal(sample(control, reader).number, number);
        if (again < 2) control.give(reader);
      }
    }
  }
}

// [board-39] [board-40] [exec-57]
void publication_waits_for_commit_in_virtual_time(void**) {
  Doorbell bell;
  Doorbell* const bells[] = {&bell};
  Slot<Sample, 1> slot{bells};
  SlotControl& control = slot.control();
  std::uint8_t held = SlotControl::none;
  control.set_deferred(true);
  const std::uint32_t silence = bell.listen();
  control.commit();
  publish(control, 1);
  assert_false(control.take(held));
  assert_int_equal(control.published(), 0);
  assert_int_equal(bell.listen(), silence);
  control.commit();
  assert_int_not_equal(bell.listen(), silence);
  assert_int_equal(control.published(), 1);
  assert_true(control.take(held));
  control.commit();
  assert_int_equal(control.published(), 1);

  publish(control, 2);
  publish(control, 3);
  assert_true(control.take(held));
  assert_int_equal(sample(control, held).number, 2);
  control.commit();
  assert_true(control.take(held));
  assert_int_equal(sample(control, held).number, 3);

  Slot<Sample, 2, 2> loans;
  loans.control().set_deferred(true);
  held = SlotControl::none;
  const std::uint8_t one = loans.control().loan();
  const std::uint8_t two = loans.control().loan();
  loans.control().publish(two, at(1));
  loans.control().publish(one, at(2));
  loans.control().commit();
  assert_true(loans.control().take(held));
  assert_int_equal(held, one);
  assert_int_equal(loans.control().header(held).sequence, 2);
}

void publishing_rings_every_doorbell(void**) {
  Doorbell one;
  Doorbell two;
  Doorbell* const bells[] = {&one, &two};
  Slot<Sample, 1> slot{bells};
  const std::uint32_t before = one.listen();
  publish(slot.control(), 1);
  assert_int_not_equal(one.listen(), before);
  assert_int_not_equal(two.listen(), before);
}

std::uint64_t digest_after(std::uint32_t number, Time sampled_at, std::uint8_t padding, int times, bool on) {
  Slot<Sample, 1> slot;
  SlotControl& control = slot.control();
  control.set_digested(on);
  for (int i = 0; i < times; ++i) {
    const std::uint8_t buffer = control.loan();
    std::memset(control.payload(buffer), padding, sizeof(Sample));
    sample(control, buffer).number = number;
    sample(control, buffer).value = 1.5;
    sample(control, buffer).flag = 1;
    control.publish(buffer, sampled_at);
  }
  return control.digest();
}

// [exec-55]
void digest_covers_time_sequence_and_fields(void**) {
  const std::uint64_t digest = digest_after(1, at(1), 0, 2, true);
  assert_int_equal(digest, digest_after(1, at(1), 0, 2, true));
  assert_int_equal(digest, digest_after(1, at(1), 0xFF, 2, true));
  assert_int_not_equal(digest, digest_after(2, at(1), 0, 2, true));
  assert_int_not_equal(digest, digest_after(1, at(2), 0, 2, true));
  assert_int_not_equal(digest, digest_after(1, at(1), 0, 1, true));
  assert_int_equal(digest_after(1, at(1), 0, 2, false), 0);
}

void large_payload_is_page_aligned_and_apart_from_headers(void**) {
  static Slot<Block<1024>, 1> large;
  const auto header = reinterpret_cast<std::uintptr_t>(&large.control().header(0));
  const auto first = reinterpret_cast<std::uintptr_t>(large.control().payload(0));
  for (std::uint8_t buffer = 0; buffer < 3; ++buffer) {
    assert_int_equal(reinterpret_cast<std::uintptr_t>(large.control().payload(buffer)) % page, 0);
  }
  assert_true(header < first || header >= first + 3 * sizeof(Block<1024>));
  static Slot<Block<2>, 1> small;
  assert_int_equal(reinterpret_cast<std::uintptr_t>(small.control().payload(1)) % cache_line, 0);
  assert_ptr_equal(small.control().payload(1) + sizeof(Block<2>), &small.control().header(1));
}

// [board-5]
void loans_are_poisoned_in_checked_builds(void**) {
#if FLEXRF_CHECKED
  Slot<Sample, 1> slot;
  publish(slot.control(), 1);
  assert_int_equal(sample(slot.control(), slot.control().loan()).number, 0xA5A5A5A5);
#else
  skip();
#endif
}

void a_slot_feeds_its_history(void**) {
  static HistoryMemory<Sample, 4> memory;
  History history{&test::sample_type, memory.words, 4};
  Slot<Sample, 1> slot{{}, &history};
  for (std::uint32_t number = 1; number < 7; ++number) publish(slot.control(), number, at(number * 10));
  ItemHeader header{};
  Sample value{};
  assert_int_equal(history.at(at(45), header, &value), NullReason::none);
  assert_int_equal(value.number, 4);
  assert_int_equal(header.sequence, 4);
}

Cloud& cloud(SlotControl& control, std::uint8_t buffer) {
  return *reinterpret_cast<Cloud*>(control.payload(buffer));
}

// Whatever a loan begins as, it knows how many elements it has, and each is its own.
void check_items_of(SlotControl& control, std::size_t elements) {
  const std::uint8_t empty = control.loan_last();
  assert_int_equal(cloud(control, empty).points().size(), elements);
  assert_int_equal(cloud(control, empty).points().back(), 0);
  control.abandon(empty);
  for (std::uint64_t number = 1; number < 8; ++number) {
    const std::uint8_t buffer = control.loan();
    assert_int_equal(cloud(control, buffer).points().size(), elements);
    assert_int_equal(reinterpret_cast<std::uintptr_t>(cloud(control, buffer).points().data()) % page, 0);
    for (std::uint64_t& point : cloud(control, buffer).points()) point = number;
    cloud(control, buffer).count = static_cast<std::uint32_t>(number);
    control.publish(buffer, Time{Duration{static_cast<std::int64_t>(number)}});
    std::uint8_t held = SlotControl::none;
    const std::uint8_t again = control.loan_last();
    assert_int_equal(cloud(control, again).points().size(), elements);
    assert_int_equal(cloud(control, again).points().back(), number);
    for (std::uint64_t& point : cloud(control, again).points()) point = 99;
    control.abandon(again);
    control.take(held);
    assert_int_equal(cloud(control, held).count, number);
    for (const std::uint64_t point : cloud(control, held).points()) assert_int_equal(point, number);
    control.give(held);
  }
}

// [board-10]
void items_are_as_large_as_their_slot_says(void**) {
  Slot<Cloud, 2> usual;
  SizedSlot<Cloud, 2> large{1000};
  SizedSlot<Cloud, 2> small{1};
  check_items_of(usual.control(), 8);
  check_items_of(large.control(), 1000);
  check_items_of(small.control(), 1);
  assert_int_equal(large.control().type()->size, 4096 + 8000);
  assert_int_equal(large.control().type()->significant.back().size, 8000);
  SizedItem<Cloud> alone{20};
  assert_int_equal(alone->points().size(), 20);
  assert_int_equal(alone->points()[19], 0);
}

std::uint64_t digest_with(std::size_t elements, std::size_t changed) {
  SizedSlot<Cloud, 1> slot{elements};
  slot.control().set_digested(true);
  const std::uint8_t buffer = slot.control().loan_last();
  if (changed < elements) cloud(slot.control(), buffer).points()[changed] = 1;
  slot.control().publish(buffer, Time{});
  return slot.control().digest();
}

void a_digest_covers_all_elements_of_the_slot(void**) {
  assert_int_equal(digest_with(100, 100), digest_with(100, 100));
  assert_int_not_equal(digest_with(100, 100), digest_with(100, 99));
  assert_int_not_equal(digest_with(100, 0), digest_with(100, 99));
}

void a_thousand_slots_are_independent(void**) {
  static Slot<Sample, 1> slots[1000];
  std::uint8_t held[1000];
  std::fill(std::begin(held), std::end(held), SlotControl::none);
  for (std::uint32_t round = 0; round < 3; ++round) {
    for (std::uint32_t i = 0; i < 1000; ++i) publish(slots[i].control(), round * 1000 + i);
    for (std::uint32_t i = 0; i < 1000; ++i) {
      assert_true(slots[i].control().take(held[i]));
      assert_int_equal(sample(slots[i].control(), held[i]).number, round * 1000 + i);
    }
  }
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(reader_gets_the_latest_complete_value_or_nothing),
      cmocka_unit_test(one_reader_and_one_loan_make_a_triple_buffer),
      cmocka_unit_test(loans_are_published_or_abandoned_in_any_order),
      cmocka_unit_test(abandoned_loan_changes_nothing),
      cmocka_unit_test(loan_last_starts_as_the_last_value),
      cmocka_unit_test(held_and_loaned_buffers_are_never_handed_out),
      cmocka_unit_test(more_readers_than_declared_end_in_no_loan_not_in_a_loop),
      cmocka_unit_test(sequences_wrap_around),
      cmocka_unit_test(counts_of_takes_wrap_around),
      cmocka_unit_test(publication_waits_for_commit_in_virtual_time),
      cmocka_unit_test(publishing_rings_every_doorbell),
      cmocka_unit_test(digest_covers_time_sequence_and_fields),
      cmocka_unit_test(large_payload_is_page_aligned_and_apart_from_headers),
      cmocka_unit_test(loans_are_poisoned_in_checked_builds),
      cmocka_unit_test(a_slot_feeds_its_history),
      cmocka_unit_test(items_are_as_large_as_their_slot_says),
      cmocka_unit_test(a_digest_covers_all_elements_of_the_slot),
      cmocka_unit_test(a_thousand_slots_are_independent),
  };
  return cmocka_run_group_tests_name("slot", tests, nullptr, nullptr);
}
