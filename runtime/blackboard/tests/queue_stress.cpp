// Queues, job queues and histories with all their threads at full rate: every item whole, in order, and
// accounted for.
#include <vector>

#include "runtime/blackboard/history.hpp"
#include "runtime/blackboard/job_queue.hpp"
#include "runtime/blackboard/queue_ring.hpp"
#include "runtime/blackboard/stress.hpp"
#include "runtime/blackboard/test_types.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using test::Complaint;

Time at(std::uint64_t number) {
  return Time{Duration{static_cast<std::int64_t>(number)}};
}

// ---- one writer, one reader

using Item = test::Block<5>;

void push_items(QueueRing& ring, std::uint64_t count) {
  Item item;
  for (std::uint64_t number = 1; number <= count; ++number) {
    item.fill(number);
    ring.push(&item, at(number));
    if (number % 2048 == 0) std::this_thread::yield();
  }
}

/// Pops until the writer is done and the ring is empty; how many there were.
std::uint64_t pop_items(QueueRing& ring, const std::atomic<bool>& done, Complaint& complaint) {
  Item item;
  ItemHeader header{};
  std::uint64_t last = 0;
  std::uint64_t count = 0;
  for (;;) {
    const bool was_done = done;
    if (!ring.pop(&item, header)) {
      if (was_done && ring.is_empty()) return count;
      std::this_thread::yield();
      continue;
    }
    ++count;
    complaint.unless(
        item.is_whole() && item.words[0] == header.sequence && header.sampled_at == at(header.sequence),
        "torn item");
    complaint.unless(header.sequence > last, "item out of order or twice");
    last = header.sequence;
  }
}

template <std::size_t Capacity>
const char* run_ring(DropPolicy policy) {
  static QueueRingMemory<Item, Capacity> memory;
  QueueRing ring{&test::block_type<5>, memory.view(), policy};
  ring.start_position_at(~std::uint64_t{0} - 1000);
  Complaint complaint;
  const std::uint64_t count = test::items(40'000);
  std::atomic<bool> done{false};
  std::uint64_t popped = 0;
  std::thread reader{[&] { popped = pop_items(ring, done, complaint); }};
  push_items(ring, count);
  done = true;
  reader.join();
  const QueueCounters counters = ring.counters();
  complaint.unless(counters.popped == popped, "items popped were miscounted");
  complaint.unless(popped + counters.dropped == count, "an item is neither popped nor dropped");
  complaint.unless(counters.pushed == (policy == DropPolicy::drop_oldest ? count : popped),
                   "items pushed were miscounted");
  return complaint.text();
}

// [board-25] [board-27]
void rings(void**) {
  for (const DropPolicy policy : {DropPolicy::drop_newest, DropPolicy::drop_oldest}) {
    const char* const complaints[] = {run_ring<1>(policy), run_ring<3>(policy), run_ring<64>(policy)};
    for (const char* complaint : complaints) {
      if (complaint != nullptr) fail_msg("%s", complaint);
    }
  }
}

// ---- several writers, several readers

/// words[0]: writer and number; words[1] the same, to see a torn one; words[2]: score.
using Job = test::Block<3>;
constexpr std::uint64_t job_writers = 3;
constexpr std::uint64_t job_readers = 3;

struct Seen {
  std::vector<std::atomic<std::uint8_t>> popped[job_writers];
};

void push_jobs(JobSink& sink, std::uint64_t writer, std::uint64_t count) {
  for (std::uint64_t number = 1; number <= count; ++number) {
    const std::uint64_t name = writer << 32 | number;
    const Job job{{name, name, number * 7919 % 101}};
    sink.push(&job, at(number));
    if (number % 2048 == 0) std::this_thread::yield();
  }
}

void pop_jobs(JobQueue& queue, bool in_order, const std::atomic<bool>& done, Seen& seen,
              Complaint& complaint) {
  std::uint64_t last[job_writers] = {};
  for (;;) {
    const bool was_done = done;
    Job job{};
    ItemHeader header{};
    if (!queue.pop(&job, header)) {
      if (was_done && queue.is_empty()) return;
      std::this_thread::yield();
      continue;
    }
    const std::uint64_t writer = job.words[0] >> 32;
    const std::uint64_t number = job.words[0] & 0xFFFFFFFF;
    if (job.words[0] != job.words[1] || writer >= job_writers || number != header.sequence ||
        header.sampled_at != at(number)) {
      complaint.make("torn job");
      continue;
    }
    complaint.unless(seen.popped[writer][number].fetch_add(1) == 0, "a job was handed out twice");
    complaint.unless(!in_order || number > last[writer], "a job overtook one of the same writer");
    last[writer] = number;
  }
}

const char* run_jobs(DropPolicy policy, JobOrder order) {
  static JobQueueMemory<Job, 5> memory;
  JobQueue queue{&test::block_type<3>, memory.view(), policy, order};
  JobSink sinks[job_writers] = {JobSink{&queue}, JobSink{&queue}, JobSink{&queue}};
  Complaint complaint;
  Seen seen;
  const std::uint64_t count = test::items(8'000);
  for (auto& popped : seen.popped) popped = std::vector<std::atomic<std::uint8_t>>(count + 1);
  std::atomic<bool> done{false};
  std::vector<std::thread> readers;
  std::vector<std::thread> writers;
  for (std::uint64_t i = 0; i < job_readers; ++i) {
    readers.emplace_back([&] { pop_jobs(queue, !order.by_score, done, seen, complaint); });
  }
  for (std::uint64_t i = 0; i < job_writers; ++i) {
    writers.emplace_back([&, i] { push_jobs(sinks[i], i, count); });
  }
  for (std::thread& thread : writers) thread.join();
  done = true;
  for (std::thread& thread : readers) thread.join();
  std::uint64_t accepted = 0;
  for (std::uint64_t i = 0; i < job_writers; ++i) {
    const QueueCounters counters = sinks[i].counters();
    std::uint64_t popped = 0;
    for (const auto& times : seen.popped[i]) popped += times;
    complaint.unless(counters.popped == popped, "jobs popped were miscounted");
    complaint.unless(popped + counters.dropped == count, "a job is neither popped nor dropped");
    accepted += counters.pushed;
  }
  complaint.unless(queue.arrivals() == accepted, "jobs pushed were miscounted");
  return complaint.text();
}

// [board-25] [board-27] [board-31] [board-43]
void jobs(void**) {
  const JobOrder by_score{true, Scalar::u64, 16};
  const char* const complaints[] = {run_jobs(DropPolicy::drop_newest, {}),
                                    run_jobs(DropPolicy::drop_oldest, {}),
                                    run_jobs(DropPolicy::drop_newest, by_score)};
  for (const char* complaint : complaints) {
    if (complaint != nullptr) fail_msg("%s", complaint);
  }
}

// ---- history

void ask(const History& history, const std::atomic<bool>& done, std::atomic<std::uint64_t>& found,
         Complaint& complaint) {
  ItemHeader headers[8];
  Item values[8];
  std::uint64_t newest = 0;
  while (!done) {
    const NullReason reason = history.at(at(newest + 1), headers[0], values);
    if (reason == NullReason::none) {
      ++found;
      complaint.unless(values[0].is_whole() && values[0].words[0] == headers[0].sequence, "torn entry");
      complaint.unless(headers[0].sequence <= newest + 1, "an entry that is younger than asked for");
    } else {
      complaint.unless(newest == 0 || reason == NullReason::no_longer_kept, "a reason that is not true");
    }
    const std::size_t count = history.between(at(0), at(~std::uint64_t{0} >> 1), headers, values);
    for (std::size_t i = 0; i < count; ++i) {
      complaint.unless(values[i].is_whole() && values[i].words[0] == headers[i].sequence, "torn entry");
      complaint.unless(headers[i].sequence > (i == 0 ? 0 : headers[i - 1].sequence), "entries out of order");
      newest = headers[i].sequence;
    }
    found += count;
  }
}

/// Appends, until both readers have found something in what is being written: one may get its CPU late. Where
/// nothing can be found, this does not end.
const char* run_history() {
  static HistoryMemory<Item, 8> memory;
  History history{&test::block_type<5>, memory.words, 8};
  Complaint complaint;
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> found[2] = {};
  std::vector<std::thread> readers;
  for (std::atomic<std::uint64_t>& mine : found)
    readers.emplace_back([&] { ask(history, done, mine, complaint); });
  Item item;
  const std::uint64_t count = test::items(100'000);
  for (std::uint64_t number = 1; number <= count || found[0] == 0 || found[1] == 0; ++number) {
    item.fill(number);
    history.append({number, at(number)}, &item);
    if (number % 2048 == 0) std::this_thread::yield();
  }
  done = true;
  for (std::thread& thread : readers) thread.join();
  return complaint.text();
}

// [board-2]
void histories(void**) {
  const char* complaint = run_history();
  if (complaint != nullptr) fail_msg("%s", complaint);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {cmocka_unit_test(rings), cmocka_unit_test(jobs), cmocka_unit_test(histories)};
  return cmocka_run_group_tests_name("queue stress", tests, nullptr, nullptr);
}
