// Disk usage of the data partition, and removal of archived journal files by an admin.
#include <atomic>
#include <string>
#include <thread>

#include "image/helper/data_use.hpp"
#include "image/helper/state_answer.hpp"
#include "image/helper/tests/bench.hpp"

namespace flexrf::helper::data_test {
namespace {

constexpr std::uint64_t kibibyte = 1024;

/// A folder like /data.
struct Data {
  Data() {
    for (const char* const one : {"flexrf", "journal", "journal/0123", "update", "network"})
      fs::create_directory(bench.pc.files.data + '/' + one);
    add("flexrf/config-a.xml", 8);
    add("flexrf/config-b.xml.previous", 4);
    add("flexrf/audit", 16);
    add("flexrf/audit.1", 16);
    add("flexrf/panel.key", 4);
    add("journal/0123/system.journal", 64);
    add("journal/0123/system@00ff-01-02.journal", 128);
    add("journal/0123/system@00ff-03.journal~", 32);
    add("update/bundle", 256);
    add("machine-id", 4);
  }
  std::string path(const std::string& name) const { return bench.pc.files.data + '/' + name; }
  void add(const std::string& name, std::size_t kibibytes) const {
    Pc::write(path(name), std::string(kibibytes * kibibyte, 'x'));
  }
  Request asks_for(const std::string& what) const {
    Request asked = request(Verb::make_room);
    asked.what = what;
    return asked;
  }
  Bench bench;
};

void each_part_is_told_apart() {
  const Data data;
  const auto use = measure_data(data.bench.pc.files.data);
  CHECK(use.has_value());
  CHECK(use->size > 0 && use->used <= use->size && use->free <= use->size);
  CHECK(use->is_complete);
  // Folders take some, too, on some file systems.
  const auto check_about = [](std::uint64_t bytes, std::uint64_t kibibytes) {
    CHECK(bytes >= kibibytes * kibibyte && bytes <= (kibibytes + 16) * kibibyte);
  };
  check_about(use->configuration, 12);
  check_about(use->audit, 32);
  check_about(use->journal, 224);
  check_about(use->old_logs, 160);
  check_about(use->updates, 256);
  check_about(use->other, 8);
  CHECK(!measure_data(data.path("nowhere")).has_value());
}

void it_stops_after_so_many_entries_and_follows_no_link() {
  const Data data;
  fs::create_directory_symlink("/proc", data.path("flexrf/elsewhere"));
  CHECK(measure_data(data.bench.pc.files.data)->is_complete);
  for (int i = 0; i < 30; ++i) data.add("network/" + std::to_string(i), 0);
  const auto use = measure_data(data.bench.pc.files.data, 20);
  CHECK(!use->is_complete);
}

void names_tell_which_logs_are_closed() {
  for (const char* const old :
       {"system@00ff-01-02.journal", "user-1000@1-2-3.journal", "system@1-2.journal~"})
    CHECK(is_old_log(old));
  for (const char* const other : {"system.journal", "user-1000.journal", "config-a.xml",
                                  "system@1.journal.gz", "panel-users", "audit.1", "", "journal~"})
    CHECK(!is_old_log(other));
}

void an_admin_removes_old_logs_and_nothing_else() {
  Data data;
  Request wrong = data.asks_for("logs");
  wrong.password = "a wrong password";
  CHECK_CONTAINS(refusal(data.bench.ask(wrong)), "403");
  data.bench.pc.now += minutes{1};
  CHECK_CONTAINS(refusal(data.bench.ask(data.asks_for("configuration"))),
                 "400 'what' is 'configuration'; old logs can be removed: logs");
  CHECK(data.bench.pc.has(data.path("journal/0123/system@00ff-01-02.journal")));
  fs::create_symlink(data.path("flexrf/panel.key"), data.path("journal/link@1-2.journal"));
  data.add("flexrf/mine@1-2.journal", 4);

  const Answer done = data.bench.ask(data.asks_for("logs"));
  CHECK_EQUAL(refusal(done), "200 ");
  CHECK(done.freed.value_or(0) >= 160 * kibibyte);
  CHECK_CONTAINS(done.text(), R"({"ok":true,"freed":)");
  CHECK_CONTAINS(data.bench.pc.said.back(), "make-room by 'anna' from uid 990, process 7, 'logs': accepted");
  CHECK(!data.bench.pc.has(data.path("journal/0123/system@00ff-01-02.journal")));
  CHECK(!data.bench.pc.has(data.path("journal/0123/system@00ff-03.journal~")));
  for (const char* const kept : {"journal/0123/system.journal", "flexrf/panel.key", "flexrf/audit.1",
                                 "flexrf/config-a.xml", "flexrf/mine@1-2.journal", "update/bundle"})
    CHECK(data.bench.pc.has(data.path(kept)));
  CHECK_EQUAL(refusal(data.bench.ask(data.asks_for("logs"))), "409 there are no old logs to remove");
  fs::remove_all(data.path("journal"));
  CHECK_CONTAINS(refusal(data.bench.ask(data.asks_for("logs"))), "503 cannot read");
}

void the_state_tells_what_fills_the_partition() {
  const Data data;
  OfThisMoment moment;
  const auto state = [&] {
    return state_answer(data.bench.pc.files, read_facts(data.bench.pc.files, seconds{1}), moment);
  };
  CHECK(state().find("\"data\"") == std::string::npos);  // nothing was measured yet
  moment.data = DataUse{1000, 900, 50, 1, 2, 300, 200, 400, 5, false};
  CHECK_CONTAINS(
      state(),
      R"("data":{"size":1000,"used":900,"free":50,"configuration":1,"audit":2,"journal":300,"old_logs":200,"updates":400,"other":5,"complete":false})");
}

void it_is_measured_once_a_minute_by_a_thread_of_its_own() {
  std::atomic<int> count = 0;
  std::atomic<bool> hangs = true;
  DataWatch watch([&] {
    ++count;
    while (hangs) std::this_thread::sleep_for(milliseconds{1});
    DataUse use;
    use.size = static_cast<std::uint64_t>(count.load());
    return std::optional{use};
  });
  const auto await = [&](std::uint64_t size, Time now) {
    while (watch.use(now).value_or(DataUse{}).size != size) std::this_thread::sleep_for(milliseconds{1});
  };
  const Time now{seconds{10}};
  CHECK(!watch.use(now).has_value());  // nobody waits for a disk that takes its time
  hangs = false;
  await(1, now);
  await(1, now + seconds{59});
  CHECK_EQUAL(count.load(), 1);
  await(2, now + seconds{60});
  CHECK_EQUAL(count.load(), 2);
  watch.measure_again();
  await(3, now + seconds{61});
  CHECK_EQUAL(count.load(), 3);
}

}  // namespace
}  // namespace flexrf::helper::data_test

int main() {
  using namespace flexrf::helper::data_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(each_part_is_told_apart),
      CONTAINED_TEST(it_stops_after_so_many_entries_and_follows_no_link),
      CONTAINED_TEST(names_tell_which_logs_are_closed),
      CONTAINED_TEST(an_admin_removes_old_logs_and_nothing_else),
      CONTAINED_TEST(the_state_tells_what_fills_the_partition),
      CONTAINED_TEST(it_is_measured_once_a_minute_by_a_thread_of_its_own),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
