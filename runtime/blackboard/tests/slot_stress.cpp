// A slot's writer and readers at full rate, all combinations of readers, loans and holds: nothing torn,
// nothing backward, the last item not lost. For the thread sanitizer above all.
#include <algorithm>
#include <random>
#include <vector>

#include "runtime/blackboard/ports.hpp"
#include "runtime/blackboard/stress.hpp"
#include "runtime/blackboard/test_types.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using test::Complaint;
using Item = test::Block<12>;

Item& item(SlotControl& slot, std::uint8_t buffer) {
  return *static_cast<Item*>(static_cast<void*>(slot.payload(buffer)));
}

/// Publishes items 1 ... count by way of up to `loans` loans in any order, some of them abandoned.
void write(SlotControl& slot, std::size_t loans, std::uint64_t count, Complaint& complaint) {
  std::mt19937 random{7};
  std::vector<std::uint8_t> out;
  for (std::uint64_t number = 1; number <= count;) {
    const bool last = random() % 8 == 0;
    const std::uint8_t buffer = last ? slot.loan_last() : slot.loan();
    if (buffer != SlotControl::none) {
      complaint.unless(out.size() < loans, "more loans out than there are");
      if (last) {
        complaint.unless(item(slot, buffer).is_whole() && item(slot, buffer).words[0] == number - 1,
                         "loan_last() is not the last item");
      }
      item(slot, buffer).fill(~std::uint64_t{0});
      out.push_back(buffer);
    } else {
      complaint.unless(out.size() == loans, "no buffer free");
    }
    if (out.empty()) return;
    if (out.size() < loans && random() % 2 == 0) continue;
    const std::size_t which = random() % out.size();
    if (random() % 8 == 0) {
      slot.abandon(out[which]);
    } else {
      item(slot, out[which]).fill(number);
      slot.publish(out[which], Time{Duration{static_cast<std::int64_t>(number)}});
      ++number;
    }
    out.erase(out.begin() + static_cast<std::ptrdiff_t>(which));
  }
  for (const std::uint8_t buffer : out) slot.abandon(buffer);
}

bool is_item(const ItemHeader& header, const void* payload) {
  const auto& value = *static_cast<const Item*>(payload);
  return value.is_whole() && value.words[0] == header.sequence &&
         header.sampled_at == Time{Duration{static_cast<std::int64_t>(header.sequence)}};
}

void read(SlotControl& slot, bool holds, std::uint64_t count, Complaint& complaint) {
  SlotReader reader{&slot};
  std::mt19937 random{11};
  std::uint64_t seen = 0;
  std::uint64_t kept = 0;
  while (seen < count) {
    const ItemHeader* header = reader.newest();
    if (header == nullptr) continue;
    complaint.unless(is_item(*header, reader.payload()), "torn read");
    complaint.unless(header->sequence >= seen, "backward read");
    complaint.unless(slot.published() + 1 >= header->sequence, "read what was not published");
    seen = header->sequence;
    if (!holds) continue;
    if (random() % 4 == 0) {
      reader.keep();
      kept = seen;
    }
    if (kept == 0) continue;
    complaint.unless(reader.kept()->sequence == kept && is_item(*reader.kept(), reader.kept_payload()),
                     "a kept item changed");
  }
}

template <std::size_t Readers, std::size_t Loans, std::size_t Holds>
const char* run() {
  static Slot<Item, Readers, Loans, Holds> slot;
  Complaint complaint;
  const std::uint64_t count = test::items(10'000);
  test::Start start{Readers + 1};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < Readers; ++i) {
    threads.emplace_back([&, i] {
      start.wait();
      read(slot.control(), i < Holds, count, complaint);
    });
  }
  start.wait();
  write(slot.control(), Loans, count, complaint);
  for (std::thread& thread : threads) thread.join();
  return complaint.text();
}

// [board-1]
template <std::size_t Readers>
void readers(void**) {
  const char* const complaints[] = {run<Readers, 1, 0>(), run<Readers, 1, 1>(), run<Readers, 1, 2>(),
                                    run<Readers, 2, 0>(), run<Readers, 2, 1>(), run<Readers, 2, 2>(),
                                    run<Readers, 3, 0>(), run<Readers, 3, 1>(), run<Readers, 3, 2>()};
  for (const char* complaint : complaints) {
    if (complaint != nullptr) fail_msg("%s", complaint);
  }
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(readers<1>), cmocka_unit_test(readers<2>), cmocka_unit_test(readers<3>),
      cmocka_unit_test(readers<4>), cmocka_unit_test(readers<8>),
  };
  return cmocka_run_group_tests_name("slot stress", tests, nullptr, nullptr);
}
