// What a running application writes when its disk is full or read-only: values, audit, report, log. It goes
// on, says so at once and by its exit code, leaves what was there as it was, and makes up for it when there
// is room again.
#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/full_disk.hpp"
#include "tests/applications/process.hpp"
#include "web-ui/server/tests/client.hpp"

namespace flexrf::whole {
namespace {

using nlohmann::json;

std::string why_no_mounts;

/// In place of a test that this machine does not permit.
template <void (*body)()>
void mounted(void** state) {
  if (!why_no_mounts.empty()) {
    print_message("a disk cannot be mounted here, which root may: %s\n", why_no_mounts.c_str());
    skip();
  }
  fixture::contained<body>(state);
}

bool is_saved(const std::string& file, const std::string& text) {
  return wait_until([&] { return contents_of(file).find(text) != std::string::npos; });
}

/// A person before the panel, who holds control.
class Operator {
 public:
  explicit Operator(Process& process, const std::string& errors) {
    const std::string word = "Panel: http://127.0.0.1:";
    process.wait_for_error(word);
    CHECK(wait_until([&] { return contents_of(errors).find("/?token=") != std::string::npos; }));
    const std::string said = contents_of(errors);
    const std::size_t at = said.find(word) + word.size();
    const std::size_t path = said.find('/', at);
    port_ = static_cast<std::uint16_t>(std::stoi(said.substr(at, path - at)));
    const std::string page = send("GET " + said.substr(path, said.find('\n', path) - path), "");
    const std::size_t cookie = page.find("Set-Cookie: ");
    CHECK(cookie != std::string::npos);
    cookie_ = page.substr(cookie + 12, page.find(';', cookie) - cookie - 12);
    CHECK_EQUAL(ask("POST", "control/take").status, 200U);
    // The page answers before the units have begun.
    CHECK(wait_until([&] { return ask("GET", "components/jog").body.at("life") == "running"; }));
  }

  struct Answer {
    unsigned status;
    json body;
  };
  Answer ask(const std::string& method, const std::string& path, const json& body = json::object()) {
    const std::string reply = send(method + " /api/v1/" + path, method == "GET" ? "" : body.dump());
    return {panel::status_of(reply), json::parse(panel::body_of_text(reply), nullptr, false)};
  }
  void set_step(double step) {
    CHECK_EQUAL(ask("PUT", "components/jog/parameters", {{"step", step}}).status, 200U);
  }
  void check_not_saved(const std::string& cause) {
    const Answer refused = ask("POST", "save-values");
    CHECK_EQUAL(refused.status, 507U);
    CHECK_CONTAINS(refused.body.at("detail").get<std::string>(), cause);
    const json values = ask("GET", "state").body.at("values");
    CHECK_CONTAINS(values.at("failure").get<std::string>(), cause);
    CHECK(values.at("unsaved") == true);
  }
  json position() { return ask("GET", "slots/tool_pose").body.at("value").at("position"); }

 private:
  std::string send(const std::string& request, const std::string& body) {
    panel::Client client;
    CHECK(client.connect(port_));
    std::string text = request + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) + "\r\n";
    if (!cookie_.empty()) text += "Cookie: " + cookie_ + "\r\n";
    if (!body.empty())
      text += "Content-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) + "\r\n";
    CHECK(client.send(text + "Connection: close\r\n\r\n" + body));
    return client.reply();
  }

  std::uint16_t port_ = 0;
  std::string cookie_;
};

/// What somebody sees who jogs the arm meanwhile.
void check_it_moves(Process& process, Operator& person) {
  const json before = person.position();
  process.type("d");
  CHECK(wait_until([&] { return person.position() != before; }));
  CHECK(person.ask("GET", "components/robot").body.at("life") == "running");
}

// [stop-61] [stop-62] [stop-63]
void a_disk_that_fills_up_disturbs_nobody_and_is_made_up_for() {
  const Folder folder;
  SmallDisk disk(folder);
  const std::string file = disk / "cell.xml";
  const std::string audit = disk / "cell.xml.audit";
  write_file(disk / "report", "of the run before\n");
  Process process(folder, {place::keyboard, "--config", "disk/cell.xml", "--report", "disk/report", "--panel",
                           "127.0.0.1:0", "--no-realtime", "--standstill-limit", "10min"});
  Operator person(process, folder / "errors");
  person.set_step(0.02);
  CHECK(is_saved(file, ">0.02</step>"));
  CHECK(is_saved(audit, "\"after\":0.02"));
  const std::string saved = contents_of(file);

  disk.fill({"cell.xml.audit"});
  person.set_step(0.03);
  person.check_not_saved("No space left on device; make room there");
  process.wait_for_error("error keyboard: the values were not saved: cannot write '");
  process.wait_for_error(
      "error audit: who did what is not written down: --audit disk/cell.xml.audit: No space");
  check_it_moves(process, person);
  CHECK_EQUAL(contents_of(file), saved);
  disk.make_room();
  // Nobody asks again.
  CHECK(is_saved(file, ">0.03</step>"));
  CHECK(is_saved(audit, "\"after\":0.03"));
  process.wait_for_error("the values are saved again");
  process.wait_for_error("who did what is written down again");

  disk.make_read_only();
  person.set_step(0.04);
  person.check_not_saved("Read-only file system; mount it for writing");
  check_it_moves(process, person);
  disk.make_writable();
  CHECK(is_saved(file, ">0.04</step>"));
  CHECK(is_saved(audit, "\"after\":0.04"));

  disk.fill({"cell.xml.audit"});
  person.set_step(0.05);
  person.check_not_saved("No space left on device");
  process.send(SIGTERM);
  const Ending ending = process.wait();
  CHECK_EQUAL(ending.exit_code, 1);
  CHECK_CONTAINS(ending.output, "Values not saved: cannot write '");
  CHECK_CONTAINS(ending.output, "Faults: none");
  CHECK_CONTAINS(ending.errors, "of the audit are not written down: --audit disk/cell.xml.audit: No space");
  CHECK_CONTAINS(ending.errors, "--report disk/report: cannot write '");
  CHECK_EQUAL(contents_of(disk / "report"), std::string{"of the run before\n"});
  CHECK_CONTAINS(contents_of(file), ">0.04</step>");
  // What is left beside them is of nobody's use.
  for (const char* const name : {"cell.xml.new", "cell.xml.previous.new", "report.new"})
    CHECK(access((disk / name).c_str(), F_OK) != 0);
}

std::vector<std::string> words_of_tuned(const std::vector<std::string>& more) {
  std::vector<std::string> all{place::tuned, "--no-realtime", "--standstill-limit", "10min"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Standard error as a service's file: what comes after a line that was cut off stands on a line of its own.
// [stop-58] [stop-60]
void a_log_that_finds_no_room_says_how_much_is_missing() {
  const Folder folder;
  SmallDisk disk(folder);
  const std::string log = disk / "log";
  // Some bytes of its block are left.
  write_file(log, std::string(4096 - 41, '-') + "\n");
  disk.fill();
  Process process(folder, words_of_tuned({}), Input::pipe,
                  [&log] { dup2(open(log.c_str(), O_WRONLY | O_APPEND), STDERR_FILENO); });
  CHECK(wait_until([&] { return contents_of(log).size() == 4096; }));
  disk.make_room();
  process.send(SIGUSR1);
  CHECK(is_saved(log, "has no meaning here"));
  // After the first line that is written again, which on a busy machine is another one.
  const std::string missing = "lines were not written here";
  // The rest of a line that was cut off may have found room after all: then nothing is missing yet.
  CHECK(wait_until(
      [&] {
        if (contents_of(log).find(missing) != std::string::npos) return true;
        disk.fill({"log"});
        process.send(SIGUSR1);
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
        disk.make_room();
        process.send(SIGUSR1);
        return false;
      },
      std::chrono::seconds{1}));
  const std::string text = contents_of(log);
  const std::size_t at = text.find(missing);
  CHECK_EQUAL(text[text.rfind('\n', at) + 1], '[');
  process.end_input();
  CHECK_EQUAL(process.wait().exit_code, 1);
  CHECK_CONTAINS(contents_of(log), "tuned: standard error: No space left on device; make room there (");
}

void a_folder_that_is_read_only_is_told_at_the_start_and_nothing_is_lost() {
  const Folder folder;
  SmallDisk disk(folder);
  const std::string file = disk / "cell.xml";
  CHECK_EQUAL(run(folder, words_of_tuned({"--config", "disk/cell.xml"}), "g").exit_code, 0);
  const std::string saved = contents_of(file);
  CHECK_CONTAINS(saved, "<gain>3</gain>");
  write_file(disk / "report", "of the run before\n");
  disk.make_read_only();

  const Ending quiet = run(folder, words_of_tuned({"--config", "disk/cell.xml", "--report", "report"}));
  CHECK_EQUAL(quiet.exit_code, 0);
  CHECK_CONTAINS(quiet.errors, "its folder '");
  CHECK_CONTAINS(quiet.errors, "what is set is not kept");
  CHECK_CONTAINS(quiet.errors, "who did what is not written down: --audit disk/cell.xml.audit: ");
  CHECK_EQUAL(Report(folder / "report").last("tuner.values").at("gain"), 3.0);

  const Ending changed = run(folder, words_of_tuned({"--config", "disk/cell.xml"}), "d");
  CHECK_EQUAL(changed.exit_code, 1);
  CHECK_CONTAINS(changed.errors, "error tuned: the values were not saved: cannot create '");
  CHECK_CONTAINS(changed.errors, "Read-only file system; mount it for writing, or name a file elsewhere");
  CHECK_EQUAL(contents_of(file), saved);

  // What somebody names in so many words is refused.
  for (const char* const name : {"disk/report", "disk/new"}) {
    const Ending refused = run(folder, words_of_tuned({"--report", name}));
    CHECK_EQUAL(refused.exit_code, 1);
    CHECK_CONTAINS(refused.errors, std::string{"tuned: --report "} + name + ": ");
    CHECK_CONTAINS(refused.errors, "Read-only file system");
  }
  const Ending refused = run(folder, words_of_tuned({"--audit", "disk/audit"}));
  CHECK_EQUAL(refused.exit_code, 1);
  CHECK_CONTAINS(refused.errors, "--audit disk/audit: nothing can be written into this folder");
  CHECK_EQUAL(contents_of(disk / "report"), std::string{"of the run before\n"});
}

}  // namespace
}  // namespace flexrf::whole

#define MOUNTED_TEST(body) \
  { #body, flexrf::whole::mounted < flexrf::whole::body>, nullptr, nullptr, nullptr }

int main() {
  using namespace flexrf::whole;
  why_no_mounts = prepare_mounts();
  const CMUnitTest tests[] = {
      MOUNTED_TEST(a_disk_that_fills_up_disturbs_nobody_and_is_made_up_for),
      MOUNTED_TEST(a_log_that_finds_no_room_says_how_much_is_missing),
      MOUNTED_TEST(a_folder_that_is_read_only_is_told_at_the_start_and_nothing_is_lost),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
