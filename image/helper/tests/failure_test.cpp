// Why a version failed: the record of a start, what the version after the fallback makes of it, and the
// journal's lines.
#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "image/boot/blocks.hpp"
#include "image/helper/failure_lines.hpp"
#include "image/helper/start_record.hpp"
#include "image/helper/state_answer.hpp"
#include "image/helper/system.hpp"
#include "image/helper/tests/bench.hpp"

namespace flexrf::helper::failure_test {
namespace {

constexpr const char* fault = "the panel says: device arm is in fault";
constexpr const char* nothing_known =
    "it stopped before its services ran: the kernel, the disk or the root failed, or the power was cut";

/// A PC whose slot A is confirmed, and whose slot B got a new version that is on trial.
struct Disk {
  Disk() {
    pc.claim();
    pc.choose({"confirm", "A"});
    Pc::write(pc.files.update.folder + "/version-a", "version=old\n");
    install("new");
  }

  void install(const std::string& version) {
    pc.choose({"set-primary", "B"});
    pc.choose({"mark-whole", "B", pc.files.command_line});
    Pc::write(pc.files.update.folder + "/version-b", "version=" + version + '\n');
  }
  boot::Choice choice() const { return *read_facts(pc.files, seconds{1}).choice; }
  /// Starts a slot as GRUB does when it has counted this number of starts of the primary.
  void starts(char slot, const std::string& why, unsigned attempts) {
    ++boots;
    boot_id = std::to_string(boots) + std::string(31, '0');
    Pc::write(pc.files.boot_id,
              boot_id.substr(0, 8) + '-' + boot_id.substr(8, 4) + '-' + boot_id.substr(12) + '\n');
    Pc::write(pc.files.choice + "/attempts.env",
              boot::block_of(boot::Attempts{choice().trial, attempts, boot::Slot::a, {}}));
    std::string trial = std::to_string(choice().trial);
    trial.insert(0, 10 - trial.size(), '0');
    Pc::write(pc.files.command_line,
              std::string{"rauc.slot="} + slot + " flexrf.boot=" + why + " flexrf.trial=" + trial + '\n');
    Pc::write(pc.files.version,
              text_of_file(pc.files.update.folder + (slot == 'A' ? "/version-a" : "/version-b")));
    fs::remove_all(pc.files.notices);  // in memory
    helper.reset();
    pc.now += minutes{5};
  }
  void is_in_fault() { pc.panel = {fault, true, false}; }
  void is_well() { pc.panel = {"", true, false}; }
  void is_silent() { pc.panel = {"the panel cannot be reached: Connection refused", false, true}; }
  void runs(int looks) {
    if (!helper) helper = std::make_unique<Helper>(pc.files, Limits{}, pc.surroundings, pc.word, pc.now);
    pc.run(*helper, looks);
  }
  StartRecord record(boot::Slot slot = boot::Slot::b) const {
    return read_start_record(pc.files.update, slot);
  }
  std::optional<Failure> shown() const {
    return failure_to_show(pc.files.update, read_facts(pc.files, seconds{1}));
  }
  /// The answer to `state` of a helper that has just started.
  std::string state() const {
    OfThisMoment moment;
    moment.failure = shown();
    return state_answer(pc.files, read_facts(pc.files, seconds{1}), moment);
  }
  Answer dismiss(boot::Slot slot) {
    Request asked = request(Verb::dismiss_failure);
    asked.slot = slot;
    return Verbs(pc.files, pc.surroundings, pc.word, [this] { return pc.now; }).perform(asked, "a test");
  }
  /// Three starts of slot B on trial that come to nothing, and then slot A.
  void falls_back() {
    for (const unsigned start : {1U, 2U, 3U}) {
      starts('B', "trial", start);
      is_in_fault();
      runs(20);
    }
    starts('A', "fallback", 3);
    is_well();
    runs(1);
  }

  Pc pc;
  std::unique_ptr<Helper> helper;
  std::string boot_id;
  int boots = 0;
};

void a_start_on_trial_is_recorded_until_the_version_confirms_itself() {
  Disk disk;
  disk.starts('B', "trial", 1);
  disk.is_silent();
  disk.runs(1);
  StartRecord record = disk.record();
  CHECK_EQUAL(record.trial, disk.choice().trial);
  CHECK_EQUAL(record.start, 1U);
  CHECK(record.began > 1'700'000'000);
  CHECK(record.boots == std::vector<std::string>{disk.boot_id});
  CHECK_CONTAINS(record.reason, "its application had not answered yet");
  disk.runs(10);
  CHECK_EQUAL(disk.record().reason,
              "its application did not answer: the panel cannot be reached: Connection refused");
  disk.is_in_fault();
  disk.runs(11);
  CHECK_EQUAL(disk.record().reason, fault);
  disk.is_well();
  disk.runs(60);
  CHECK_EQUAL(disk.record().reason,
              "it was well, but not yet for 60 s: the PC was restarted or switched off");
  CHECK(disk.pc.has(start_record_file(disk.pc.files.update, boot::Slot::b)));
  disk.runs(1);
  CHECK(disk.pc.says("B=whole,confirmed"));
  CHECK(!disk.pc.has(start_record_file(disk.pc.files.update, boot::Slot::b)));
  disk.is_in_fault();
  disk.runs(100);
  CHECK(!disk.pc.has(start_record_file(disk.pc.files.update, boot::Slot::b)));
}

void a_record_is_written_when_its_reason_changes_and_not_each_second() {
  Disk disk;
  disk.starts('B', "trial", 1);
  disk.is_in_fault();
  disk.runs(30);
  const std::string file = start_record_file(disk.pc.files.update, boot::Slot::b);
  fs::remove(file);
  disk.runs(100);
  CHECK(!disk.pc.has(file));  // nobody wrote it again
  // A reason that counts is written every ten seconds.
  int writes = 0;
  for (int i = 0; i < 100; ++i) {
    disk.pc.panel.why_not_healthy = "try " + std::to_string(i);
    disk.runs(1);
    if (disk.pc.has(file)) ++writes;
    fs::remove(file);
  }
  CHECK_EQUAL(writes, 10);
}

void a_helper_that_is_restarted_continues_the_record_of_the_boot() {
  Disk disk;
  disk.starts('B', "trial", 2);
  disk.is_in_fault();
  disk.runs(20);
  StartRecord before = disk.record();
  before.began = 1'800'000'000;
  CHECK(write_start_record(disk.pc.files.update, boot::Slot::b, before));
  disk.helper.reset();
  disk.is_silent();
  disk.runs(1);
  StartRecord after = disk.record();
  CHECK_EQUAL(after.began, 1'800'000'000U);
  CHECK(after.boots == before.boots);
  CHECK_CONTAINS(after.reason, "did not answer");
  // A power cut between the writing and the new name leaves the record as it was.
  Pc::write(start_record_file(disk.pc.files.update, boot::Slot::b) + ".new", "trial=99\nstart=");
  CHECK(disk.record() == after);
  disk.starts('B', "trial", 3);
  disk.runs(1);
  CHECK_EQUAL(disk.record().start, 3U);
  CHECK(disk.record().boots == (std::vector<std::string>{after.boots.at(0), disk.boot_id}));
}

void after_a_fallback_the_state_tells_which_start_failed_and_why() {
  Disk disk;
  disk.falls_back();
  const std::optional<Failure> failure = disk.shown();
  CHECK(failure.has_value());
  CHECK(failure->slot == boot::Slot::b);
  CHECK_EQUAL(failure->version, "new");
  CHECK_EQUAL(failure->starts, 3U);
  CHECK_EQUAL(failure->last.start, 3U);
  CHECK_EQUAL(failure->last.boots.size(), 3U);
  CHECK_CONTAINS(disk.state(), R"("last_failure":{"slot":"B","version":"new","starts":3,"start":3,"began":)");
  CHECK_CONTAINS(disk.state(), R"("reason":"the panel says: device arm is in fault","lines":[])");
  CHECK(!disk.pc.has(start_record_file(disk.pc.files.update, boot::Slot::b)));
  // A confirms itself in B's place, and tells it still, also after a restart.
  disk.runs(100);
  CHECK(disk.pc.says("primary=A"));
  CHECK(disk.shown().has_value());
  disk.starts('A', "confirmed", 1);
  disk.runs(100);
  CHECK(disk.shown().has_value());
}

void the_version_that_gave_up_its_turn_says_so() {
  Disk disk;
  disk.starts('B', "trial", 1);
  disk.is_in_fault();
  disk.runs(601);
  CHECK_EQUAL(disk.pc.asked_systemd("reboot"), 1);
  const std::string given_up =
      std::string{"it was not well for long enough within 10 min, and gave up its turn; at last: "} + fault;
  CHECK_EQUAL(disk.record().reason, given_up);
  // The answers of the panel while the PC shuts down do not replace the reason.
  disk.is_silent();
  disk.runs(20);
  disk.helper.reset();
  disk.runs(20);
  CHECK_EQUAL(disk.record().reason, given_up);
  disk.starts('A', "fallback", 1);
  disk.runs(1);
  CHECK_EQUAL(reason_of(*disk.shown()), given_up);
}

void a_start_of_which_nothing_is_known_says_so() {
  Disk disk;
  disk.starts('A', "fallback", 3);  // the kernel of B panicked three times
  disk.runs(1);
  CHECK_EQUAL(disk.shown()->last.start, 0U);
  CHECK_EQUAL(disk.shown()->starts, 3U);
  CHECK_EQUAL(reason_of(*disk.shown()), nothing_known);
  // The first start reached its services, and the others did not.
  Disk mixed;
  mixed.starts('B', "trial", 1);
  mixed.is_in_fault();
  mixed.runs(20);
  mixed.starts('A', "fallback", 3);
  mixed.runs(1);
  CHECK_EQUAL(mixed.shown()->last.start, 1U);
  CHECK_EQUAL(mixed.shown()->starts, 3U);
  CHECK_EQUAL(reason_of(*mixed.shown()), fault);
}

void the_record_of_another_trial_is_not_blamed() {
  Disk disk;
  disk.starts('B', "trial", 1);
  disk.is_in_fault();
  disk.runs(20);
  // An admin chooses A, and B again: three starts without a trace.
  disk.pc.choose({"set-primary", "A"});
  disk.runs(20);
  disk.starts('A', "confirmed", 1);
  disk.is_well();
  disk.runs(100);
  disk.pc.choose({"set-primary", "B"});
  disk.starts('A', "fallback", 3);
  disk.runs(1);
  CHECK_EQUAL(reason_of(*disk.shown()), nothing_known);
  // With a record of this trial it counts, and so do its boots alone.
  disk.pc.choose({"set-primary", "B"});
  disk.starts('B', "trial", 1);
  disk.is_in_fault();
  disk.runs(20);
  CHECK(disk.record().boots == std::vector<std::string>{disk.boot_id});
  disk.starts('A', "fallback", 1);
  disk.runs(1);
  CHECK_EQUAL(reason_of(*disk.shown()), fault);
}

void a_confirmed_version_is_recorded_until_it_has_come_up() {
  Disk disk;
  disk.pc.choose({"set-primary", "A"});
  disk.starts('A', "confirmed", 1);
  disk.is_silent();
  disk.runs(20);
  CHECK_CONTAINS(disk.record(boot::Slot::a).reason, "its application did not answer");
  disk.is_in_fault();  // another version would not mend a device
  disk.runs(61);
  CHECK(disk.pc.says("attempts=0"));
  const std::string file = start_record_file(disk.pc.files.update, boot::Slot::a);
  CHECK(!disk.pc.has(file));
  disk.is_silent();
  disk.runs(100);
  CHECK(!disk.pc.has(file));
  // The power goes in its first minute, three times: the boots before it came up are not of this row.
  for (const unsigned start : {1U, 2U, 3U}) {
    disk.starts('A', "confirmed", start);
    disk.is_well();
    disk.runs(20);
  }
  CHECK_EQUAL(disk.record(boot::Slot::a).boots.size(), 3U);
  disk.starts('B', "fallback", 3);
  disk.runs(1);
  CHECK(disk.shown()->slot == boot::Slot::a);
  CHECK_CONTAINS(reason_of(*disk.shown()), "it was well, but not yet for 60 s");
}

void an_earlier_row_of_starts_is_not_continued() {
  Disk disk;
  disk.pc.choose({"set-primary", "A"});
  // The mark that it came up is on the disk, and its record, too: the power went in between.
  disk.starts('A', "confirmed", 2);
  disk.is_in_fault();
  disk.is_silent();
  disk.runs(20);
  disk.starts('A', "confirmed", 1);
  disk.runs(20);
  CHECK_EQUAL(disk.record(boot::Slot::a).start, 1U);
  CHECK(disk.record(boot::Slot::a).boots == std::vector<std::string>{disk.boot_id});
}

void a_confirmation_that_cannot_be_written_leaves_no_record_behind() {
  Disk disk;
  disk.starts('B', "trial", 1);
  disk.is_well();
  disk.runs(59);
  const std::string file = start_record_file(disk.pc.files.update, boot::Slot::b);
  CHECK(disk.pc.has(file));
  // As a power cut between the two: the record is gone before the mark is there.
  const std::string copy = disk.pc.files.choice + "/choice0.env";
  fs::remove(copy);
  fs::create_directory(copy);
  disk.runs(2);
  CHECK(!disk.pc.says("B=whole,confirmed"));
  CHECK(!disk.pc.has(file));
  // Nothing is written while it is tried again each second.
  const auto written = fs::last_write_time(disk.pc.files.update.folder);
  disk.runs(10);
  CHECK(fs::last_write_time(disk.pc.files.update.folder) == written);
  disk.is_in_fault();
  disk.runs(1);
  CHECK_EQUAL(disk.record().reason, fault);
}

void starts_that_nobody_counts_are_not_recorded() {
  for (const char* const why : {"manual", "unknown", "fallback", "only"}) {
    Disk disk;
    disk.starts('B', why, 1);
    disk.is_in_fault();
    disk.runs(700);
    CHECK(!disk.pc.has(start_record_file(disk.pc.files.update, boot::Slot::b)));
  }
}

void a_version_that_was_never_written_completely_did_not_fail() {
  Disk disk;
  disk.pc.choose({"unmark-whole", "B"});
  disk.starts('A', "fallback", 0);
  disk.runs(1);
  CHECK_CONTAINS(text_of_file(disk.pc.files.notices + "/fallback"), "is not whole");
  CHECK(!disk.shown().has_value());
}

void a_failure_is_shown_until_an_admin_dismisses_it() {
  Disk disk;
  disk.falls_back();
  CHECK_EQUAL(refusal(disk.dismiss(boot::Slot::a)), "409 no failure of slot A is shown");
  CHECK_EQUAL(refusal(disk.dismiss(boot::Slot::b)), "200 ");
  CHECK_CONTAINS(disk.pc.said.back(), "dismiss-failure by 'anna' from a test, slot B: accepted");
  CHECK(disk.state().find("last_failure") == std::string::npos);
  CHECK_EQUAL(refusal(disk.dismiss(boot::Slot::b)), "409 no failure of slot B is shown");
  // Another boot of the same fallback, or another helper in it, does not bring it back.
  disk.helper.reset();
  disk.runs(1);
  disk.starts('A', "fallback", 3);
  disk.runs(1);
  CHECK(!disk.shown().has_value());
  // Another failure does.
  disk.pc.choose({"set-primary", "B"});
  disk.falls_back();
  CHECK(disk.shown().has_value());
}

void a_failure_ends_with_another_version_or_when_the_version_comes_up() {
  Disk disk;
  disk.falls_back();
  Pc::write(disk.pc.files.update.folder + "/version-b", "version=newer\n");
  CHECK(!disk.shown().has_value());
  Pc::write(disk.pc.files.update.folder + "/version-b", "version=new\n");
  CHECK(disk.shown().has_value());
  disk.runs(100);
  disk.pc.choose({"unmark-whole", "B"});  // an update begins to write over it
  CHECK(!disk.shown().has_value());
  disk.install("new");
  CHECK(disk.shown().has_value());
  // An admin chose it back. It tells of itself while it is on trial, and is exonerated.
  disk.starts('B', "trial", 1);
  disk.runs(20);
  CHECK(disk.shown()->slot == boot::Slot::b);
  disk.runs(60);
  CHECK(disk.pc.says("B=whole,confirmed"));
  CHECK(!disk.shown().has_value());
}

void a_fallback_is_told_as_it_was_by_a_helper_that_is_restarted() {
  Disk disk;
  disk.falls_back();
  const std::string notice = text_of_file(disk.pc.files.notices + "/fallback");
  CHECK_CONTAINS(notice, "slot B, version new, was started three times and did not come up");
  disk.runs(100);
  disk.helper.reset();  // A is the primary now, and has no attempts
  disk.runs(1);
  CHECK_EQUAL(text_of_file(disk.pc.files.notices + "/fallback"), notice);
  CHECK_EQUAL(disk.shown()->starts, 3U);
}

void a_damaged_record_is_none() {
  Disk disk;
  disk.starts('B', "trial", 2);
  Pc::write(start_record_file(disk.pc.files.update, boot::Slot::b),
            std::string("trial=x\0\xff\nstart=9\nboots=--root=/ _PID=1\nreason=", 48));
  CHECK(disk.record().boots.empty());
  disk.is_in_fault();
  disk.runs(20);
  CHECK_EQUAL(disk.record().start, 2U);
  fs::remove_all(disk.pc.files.update.folder);
  disk.starts('B', "trial", 3);
  disk.runs(20);
  CHECK_EQUAL(std::count_if(disk.pc.said.begin(), disk.pc.said.end(),
                            [](const std::string& line) {
                              return line.find("could not be noted") != std::string::npos;
                            }),
              1);
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all.append(all.empty() ? "" : " ").append(word);
  return all;
}

void lines_are_few_short_and_printable() {
  CHECK_EQUAL(joined(journal_arguments({"a1", "b2"})),
              "--quiet --no-pager --no-hostname --output=short-monotonic --lines=20 --unit=flexrf.service "
              "_BOOT_ID=a1 _BOOT_ID=b2");
  CHECK(last_lines("").empty());
  CHECK(last_lines("one\n\ntwo") == (std::vector<std::string>{"one", "two"}));
  CHECK_EQUAL(last_lines("\033[2J\xe2\x80\xae x\n").at(0), "?[2J??? x");
  std::string many;
  for (int i = 0; i < 100; ++i) many += std::to_string(i) + std::string(1000, 'x') + '\n';
  const std::vector<std::string> lines = last_lines(many);
  CHECK_EQUAL(lines.size(), most_journal_lines);
  CHECK(lines.back().starts_with("99x"));
  CHECK_EQUAL(lines.back().size(), longest_journal_line);
}

FailureLines::Answer await(FailureLines& reader, const std::vector<std::string>& boots, Time now) {
  while (true) {
    FailureLines::Answer answer = reader.of(boots, now);
    if (answer.why_none != "The journal is being read.") return answer;
    std::this_thread::sleep_for(milliseconds{1});
  }
}

void the_journal_is_read_when_it_is_asked_for_and_once() {
  std::atomic<int> reads = 0;
  std::atomic<bool> fails = false;
  std::atomic<bool> hangs = true;
  FailureLines reader([&](const std::vector<std::string>& arguments) -> Result<std::string> {
    ++reads;
    while (hangs) std::this_thread::sleep_for(milliseconds{1});
    if (fails) return Status::error(StatusCode::timeout, "it took too long");
    return arguments.back() == "_BOOT_ID=c" ? "" : arguments.back() + '\n';
  });
  const Time now{seconds{10}};
  CHECK_EQUAL(reader.of({}, now).why_none, "No start left a line: none came as far as its services.");
  CHECK_EQUAL(reads.load(), 0);
  // Nobody waits for a journal that takes its time.
  CHECK_EQUAL(reader.of({"a"}, now).why_none, "The journal is being read.");
  hangs = false;
  CHECK_EQUAL(await(reader, {"a"}, now).lines.at(0), "_BOOT_ID=a");
  for (int i = 0; i < 10; ++i) CHECK_EQUAL(await(reader, {"a"}, now + minutes{i}).why_none, "");
  CHECK_EQUAL(reads.load(), 1);
  CHECK_CONTAINS(await(reader, {"c"}, now).why_none, "The journal has no line of these starts any more");
  fails = true;
  CHECK_CONTAINS(await(reader, {"a", "b"}, now).why_none, "cannot be read: it took too long");
  CHECK_CONTAINS(await(reader, {"a", "b"}, now + seconds{59}).why_none, "cannot be read");
  CHECK_EQUAL(reads.load(), 3);
  fails = false;
  CHECK_EQUAL(await(reader, {"a", "b"}, now + seconds{60}).lines.at(0), "_BOOT_ID=b");
}

void a_program_that_hangs_or_says_too_much_is_ended() {
  const auto shell = [](const std::string& script, std::size_t most = 1000) {
    return output_of("/bin/sh", {"-c", script}, milliseconds{300}, most);
  };
  CHECK_EQUAL(*shell("echo one; echo two"), "one\ntwo\n");
  const Time begun = MonotonicClock::now();
  CHECK(shell("exec sleep 60").status().code() == StatusCode::timeout);
  CHECK(MonotonicClock::now() - begun < seconds{30});
  CHECK(shell("exec yes").status().code() == StatusCode::out_of_range);
  CHECK_CONTAINS(std::string{shell("exit 3").status().cause()}, "/bin/sh ended with 3");
  CHECK_CONTAINS(std::string{output_of("/nowhere", {}, seconds{1}, 10).status().cause()}, "cannot be run");
}

}  // namespace
}  // namespace flexrf::helper::failure_test

int main() {
  using namespace flexrf::helper::failure_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_start_on_trial_is_recorded_until_the_version_confirms_itself),
      CONTAINED_TEST(a_record_is_written_when_its_reason_changes_and_not_each_second),
      CONTAINED_TEST(a_helper_that_is_restarted_continues_the_record_of_the_boot),
      CONTAINED_TEST(after_a_fallback_the_state_tells_which_start_failed_and_why),
      CONTAINED_TEST(the_version_that_gave_up_its_turn_says_so),
      CONTAINED_TEST(a_start_of_which_nothing_is_known_says_so),
      CONTAINED_TEST(the_record_of_another_trial_is_not_blamed),
      CONTAINED_TEST(a_confirmed_version_is_recorded_until_it_has_come_up),
      CONTAINED_TEST(an_earlier_row_of_starts_is_not_continued),
      CONTAINED_TEST(a_confirmation_that_cannot_be_written_leaves_no_record_behind),
      CONTAINED_TEST(starts_that_nobody_counts_are_not_recorded),
      CONTAINED_TEST(a_version_that_was_never_written_completely_did_not_fail),
      CONTAINED_TEST(a_failure_is_shown_until_an_admin_dismisses_it),
      CONTAINED_TEST(a_failure_ends_with_another_version_or_when_the_version_comes_up),
      CONTAINED_TEST(a_fallback_is_told_as_it_was_by_a_helper_that_is_restarted),
      CONTAINED_TEST(a_damaged_record_is_none),
      CONTAINED_TEST(lines_are_few_short_and_printable),
      CONTAINED_TEST(the_journal_is_read_when_it_is_asked_for_and_once),
      CONTAINED_TEST(a_program_that_hangs_or_says_too_much_is_ended),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
