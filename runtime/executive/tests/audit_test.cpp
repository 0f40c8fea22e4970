// The audit: who did what, in memory, in its file and after a restart; and that nobody waits for it.
#include "runtime/executive/audit.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::audit_test {
namespace {

using Cell = ProducerAndConsumer;

class AuditFolder {
 public:
  AuditFolder() {
    char name[] = "/tmp/flexrf-audit-XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path_ = name;
  }
  ~AuditFolder() { std::filesystem::remove_all(path_); }
  std::string operator/(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

std::string contents_of(const std::string& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::size_t count_of(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

Options audited(const std::string& file) {
  Options options = on_the_wall_clock();
  options.audit_file = file;
  return options;
}

/// A cell that runs, and a person who changes its producer.
struct Audited {
  explicit Audited(const std::string& file) : running(cell, audited(file)) {
    requester = running.add_requester();
    running.start();
    CHECK(wait_until([this] { return running.control().mode() == Mode::running; }));
  }
  flexrf::Cell& inside() { return running.executive().cell(); }

  ParameterRequest request(RequestKind kind) {
    ParameterRequest made;
    made.kind = kind;
    made.component = Cell::producer;
    made.requester = requester;
    made.correlation = ++correlation;
    made.set_who("ann (192.168.0.7)");
    return made;
  }
  ParameterAnswer set_gain(double gain, std::string_view who = "ann (192.168.0.7)") {
    ParameterRequest made = request(RequestKind::set);
    made.set_who(who);
    made.add(0, 0, &gain, sizeof(gain));
    return running.ask(made);
  }
  /// An act: what was changed before it is told by then.
  void log_out() {
    inside().audit().note("ann (192.168.0.7)", "logged out");
    CHECK(is_told("logged out"));
  }
  std::string told() {
    std::string all;
    running.executive().audit().visit(
        0, [&all](std::uint64_t, std::string_view entry) { all += std::string{entry} + "\n"; });
    return all;
  }
  bool is_told(std::string_view part) {
    return wait_until([&] { return told().find(part) != std::string::npos; });
  }

  Cell cell;
  RunningCell running;
  std::uint16_t requester = 0;
  std::uint64_t correlation = 0;
};

void a_change_is_told_with_its_old_and_its_new_value() {
  AuditFolder folder;
  const std::string file = folder / "audit";
  {
    Audited audited(file);
    CHECK_EQUAL(audited.set_gain(2.5).kind, AnswerKind::accepted);
    CHECK_EQUAL(audited.set_gain(99).kind, AnswerKind::refused);
    CHECK(audited.is_told(
        R"j("who":"ann (192.168.0.7)","did":"changed","what":"producer.gain","before":1,"after":2.5)j"));
    CHECK(audited.told().find(":99") == std::string::npos);
    CHECK(audited.told().starts_with(R"j({"at":"2)j"));
    CHECK_EQUAL(audited.running.finish().exit_code, 0);
  }
  const std::string text = contents_of(file);
  CHECK_CONTAINS(text, R"j("what":"producer.gain","before":1,"after":2.5)j");
  CHECK(text.ends_with("}\n"));
  struct stat status {};
  CHECK_EQUAL(stat(file.c_str(), &status), 0);
  CHECK_EQUAL(status.st_mode & 0777U, 0600U);
  // The next run knows it, and goes on.
  Audited again(file);
  CHECK_CONTAINS(again.told(), "\"after\":2.5");
}

void a_drag_is_one_entry_and_one_there_and_back_none() {
  AuditFolder folder;
  Audited audited(folder / "audit");
  for (int i = 1; i <= 20; ++i) CHECK_EQUAL(audited.set_gain(1 + 0.1 * i).kind, AnswerKind::accepted);
  CHECK(audited.is_told(R"j("before":1,"after":3})j"));
  CHECK_EQUAL(count_of(audited.told(), "producer.gain"), 1U);
  CHECK_EQUAL(audited.set_gain(4).kind, AnswerKind::accepted);
  CHECK_EQUAL(audited.set_gain(3).kind, AnswerKind::accepted);
  audited.log_out();
  CHECK_EQUAL(count_of(audited.told(), "producer.gain"), 1U);
}

void presses_and_both_ends_of_a_hold_are_told() {
  AuditFolder folder;
  Audited audited(folder / "audit");
  ParameterRequest press = audited.request(RequestKind::press);
  press.add_presses(1, 2);
  CHECK_EQUAL(audited.running.ask(press).kind, AnswerKind::accepted);
  CHECK(audited.is_told(R"j("did":"pressed","what":"producer.kick","count":2)j"));
  CHECK(wait_until([&] {  // on a loaded machine a press may come too late
    ParameterRequest hold = audited.request(RequestKind::hold);
    hold.add_name(2);
    hold.lease = new_lease_number();
    hold.lease_sequence = 1;
    return audited.running.ask(hold).kind == AnswerKind::accepted;
  }));
  CHECK(audited.is_told(R"j("did":"held","what":"producer.move")j"));
  CHECK(audited.is_told(
      R"j("who":"ann (192.168.0.7)","did":"let go (nobody asked for it any more)","what":"producer.move")j"));
}

void who_stopped_is_known_until_the_stop_is_cleared() {
  AuditFolder folder;
  Audited audited(folder / "audit");
  Audit& audit = audited.running.executive().audit();
  audited.inside().stop_motion("ann (192.168.0.7)");
  audited.inside().stop_motion("bob (127.0.0.1)");
  CHECK(wait_until([&] { return audit.stopped_by().has_value(); }));
  CHECK(audited.is_told(R"j("who":"bob (127.0.0.1)","did":"stopped motion")j"));
  CHECK_EQUAL(std::string{audit.stopped_by()->who}, "ann (192.168.0.7)");
  CHECK(audit.stopped_by()->at > 1'600'000'000'000);
  audited.inside().clear_stop_motion("bob (127.0.0.1)");
  CHECK(wait_until([&] { return !audit.stopped_by().has_value(); }));
  // Its threads see the stop first.
  CHECK(wait_until([&] { return audited.inside().start_motion("bob (127.0.0.1)").is_ok(); }));
  CHECK(audited.is_told("gave Start"));
}

void what_is_done_again_and_again_is_counted() {
  AuditFolder folder;
  Audited audited(folder / "audit");
  for (int i = 0; i < 200; ++i)
    audited.inside().audit().note("somebody (10.0.0.9)", "did not get in", "'root'");
  CHECK(audited.is_told(R"j("count":199)j"));
  CHECK_EQUAL(count_of(audited.told(), "did not get in"), 2U);
}

void configuration_and_actions_are_told() {
  AuditFolder folder;
  Audited audited(folder / "audit");
  Executive& executive = audited.running.executive();
  std::atomic<int> done{0};
  executive.act(
      ComponentAction::stop, Cell::producer, [&](const Status&) { ++done; }, "eric (127.0.0.1)");
  executive.act(
      ComponentAction::start, 999, [&](const Status&) { ++done; }, "eric (127.0.0.1)");
  executive.reconfigure(
      {{Cell::producer, "offset", "7.5"}}, [&](const ReconfigureResult&) { ++done; }, "eric (127.0.0.1)");
  executive.reconfigure(
      {{Cell::producer, "offset", "much"}}, [&](const ReconfigureResult&) { ++done; }, "eric (127.0.0.1)");
  CHECK(wait_until([&] { return done == 4; }));
  CHECK(audited.is_told(R"j("who":"eric (127.0.0.1)","did":"stopped","what":"producer")j"));
  CHECK(audited.is_told("tried to start a component"));
  CHECK(audited.is_told(R"j("did":"changed","what":"producer.offset","before":0.5,"after":7.5)j"));
  CHECK(audited.is_told("tried to change the configuration"));
}

/// Of ordinary size; then nothing more can be written, as on a full disk.
// [exec-79]
void a_full_disk_stops_nobody() {
  AuditFolder folder;
  const std::string file = folder / "audit";
  Audited audited(file);
  CHECK_EQUAL(audited.set_gain(2).kind, AnswerKind::accepted);
  CHECK(wait_until([&] { return !contents_of(file).empty(); }));
  const std::string before = contents_of(file);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit former{};
  CHECK_EQUAL(getrlimit(RLIMIT_FSIZE, &former), 0);
  const rlimit full{before.size() + 10, former.rlim_max};
  CHECK_EQUAL(setrlimit(RLIMIT_FSIZE, &full), 0);
  audited.log_out();
  CHECK_EQUAL(audited.set_gain(3).kind, AnswerKind::accepted);
  CHECK(audited.is_told(R"j("after":3})j"));
  CHECK_EQUAL(contents_of(file), before);  // nothing in part
  // There is room again: what was kept comes.
  CHECK_EQUAL(setrlimit(RLIMIT_FSIZE, &former), 0);
  CHECK(wait_until([&] { return contents_of(file).find("logged out") != std::string::npos; }));
  CHECK_EQUAL(audited.running.finish().exit_code, 0);
}

/// As above, for longer than what is kept has room.
void what_a_full_disk_costs_is_counted() {
  AuditFolder folder;
  const std::string file = folder / "audit";
  Audited audited(file);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit former{};
  CHECK_EQUAL(getrlimit(RLIMIT_FSIZE, &former), 0);
  const rlimit full{0, former.rlim_max};
  CHECK_EQUAL(setrlimit(RLIMIT_FSIZE, &full), 0);
  const std::string padding(140, '.');
  for (int batch = 0; batch < 6; ++batch) {
    for (int i = 0; i < 100; ++i)
      audited.inside().audit().note("ann (192.168.0.7)", "did this",
                                    std::to_string(100 * batch + i) + padding);
    CHECK(audited.is_told("\"" + std::to_string(100 * batch + 99) + "."));
  }
  CHECK_EQUAL(setrlimit(RLIMIT_FSIZE, &former), 0);
  CHECK(audited.is_told("lost entries: they could not be written for too long"));
  const std::string text = contents_of(file);
  CHECK(text.find("\"0.") == std::string::npos);
  CHECK_CONTAINS(text, "\"599.");
  CHECK_EQUAL(audited.running.finish().exit_code, 0);
  const std::vector<Status> failures = audited.running.executive().say_last({});
  // The audit's comes first; the log of this test may have met the same end.
  CHECK(!failures.empty());
  const std::string cause = failures.front().cause();
  CHECK_EQUAL(
      cause.substr(cause.find(' ')),
      std::string{" entries of the audit are not written down: for a time its file could not be written"});
  // All that is there, and all that is not: the six hundred and the entry that tells of the loss.
  CHECK_EQUAL(count_of(contents_of(file), "\n") + std::stoul(cause), 601U);
}

void nothing_is_kept_of_whom_nobody_asked() {
  AuditFolder folder;
  Audited audited(folder / "audit");
  CHECK_EQUAL(audited.set_gain(5, "").kind, AnswerKind::accepted);
  audited.log_out();
  CHECK_EQUAL(count_of(audited.told(), "gain"), 0U);
}

// ---- the file

void old_lines_are_set_aside_and_never_more_than_a_few_files() {
  AuditFolder folder;
  AuditFile file(folder / "audit");
  std::string lines(AuditFile::largest / 2, 'x');
  lines.back() = '\n';
  for (int i = 0; i < 12; ++i) CHECK(file.append(lines).is_ok());
  CHECK_EQUAL(std::filesystem::file_size(folder / "audit"), AuditFile::largest);
  for (const char* name : {"audit.1", "audit.2", "audit.3"})
    CHECK_EQUAL(std::filesystem::file_size(folder / name), AuditFile::largest);
  CHECK(!std::filesystem::exists(folder / "audit.4"));
}

void a_torn_line_does_not_take_the_next_one_along() {
  AuditFolder folder;
  std::ofstream(folder / "audit") << "{\"at\":1}\n{\"at\":";
  AuditFile file(folder / "audit");
  CHECK_EQUAL(file.last_lines(10).size(), 1U);
  CHECK(file.append("{\"at\":2}\n").is_ok());
  const std::vector<std::string> lines = file.last_lines(10);
  CHECK_EQUAL(lines.size(), 3U);
  CHECK_EQUAL(lines.back(), "{\"at\":2}");
  CHECK_EQUAL(file.last_lines(1).front(), "{\"at\":2}");
}

void what_cannot_be_written_is_told_at_the_start() {
  AuditFolder folder;
  const auto refusal = [](const std::string& path) {
    ProducerAndConsumer cell;
    Options options = audited(path);
    Executive executive(cell.application(), options);
    const Status status = executive.prepare();
    CHECK(!status);
    return std::string{status.cause()};
  };
  CHECK_CONTAINS(refusal(folder / "missing/audit"), "there is no such folder; make it");
  std::filesystem::create_directory(folder / "folder");
  CHECK_CONTAINS(refusal(folder / "folder"), "this is no ordinary file");
  CHECK_EQUAL(mkfifo((folder / "fifo").c_str(), 0600), 0);
  CHECK_CONTAINS(refusal(folder / "fifo"), "this is no ordinary file");
}

}  // namespace
}  // namespace flexrf::fixture::audit_test

int main() {
  using namespace flexrf::fixture::audit_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_change_is_told_with_its_old_and_its_new_value),
      CONTAINED_TEST(a_drag_is_one_entry_and_one_there_and_back_none),
      CONTAINED_TEST(presses_and_both_ends_of_a_hold_are_told),
      CONTAINED_TEST(who_stopped_is_known_until_the_stop_is_cleared),
      CONTAINED_TEST(what_is_done_again_and_again_is_counted),
      CONTAINED_TEST(configuration_and_actions_are_told),
      CONTAINED_TEST(a_full_disk_stops_nobody),
      CONTAINED_TEST(what_a_full_disk_costs_is_counted),
      CONTAINED_TEST(nothing_is_kept_of_whom_nobody_asked),
      CONTAINED_TEST(old_lines_are_set_aside_and_never_more_than_a_few_files),
      CONTAINED_TEST(a_torn_line_does_not_take_the_next_one_along),
      CONTAINED_TEST(what_cannot_be_written_is_told_at_the_start),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
