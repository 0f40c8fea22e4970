// flexrf-helper's socket as the application, or who took it over, meets it: whoever is stuck, rude or foreign
// keeps neither the word about motion nor anybody else waiting.
#include <fcntl.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/applications/helper_client.hpp"

namespace flexrf::whole {
namespace {

const json anna = {{"user", "anna"}, {"password", right_password}};

json with(json request, const json& members) {
  request.update(members);
  return request;
}

void leave_result(const Pc& pc, const std::string& name, const std::string& lines) {
  write_file(pc.folder / "results/new", lines);
  std::filesystem::rename(pc.folder / "results/new", pc.folder / ("results/" + name));
}

/// The word follows what the files say: the look goes on.
void check_that_it_looks(const Pc& pc) {
  leave_result(pc, "install", "state=running\npercent=1\n");
  CHECK(wait_until([&] { return pc.word() == "an update is being installed\n"; }));
  std::filesystem::remove(pc.folder / "results/install");
  CHECK(wait_until([&] { return pc.word() != "an update is being installed\n"; }));
}

std::string asked_of_systemd(const Pc& pc) {
  return contents_of(pc.folder / "systemd-was-asked");
}

/// OpenSSL's own server with the panel's key: `health` is what it answers.
std::vector<std::string> panel(const Pc& pc, const std::string& health) {
  std::filesystem::create_directories(pc.folder / "api/v1");
  write_file(pc.folder / "api/v1/health", health);
  return {"openssl", "s_server", "-quiet",    "-accept", "127.0.0.1:" + pc.port,
          "-WWW",    "-cert",    "panel.crt", "-key",    "panel.key"};
}

void an_update_goes_through() {
  const Pc pc;
  const Process cell(pc.folder, panel(pc, R"({"healthy":true,"why_not":"","may_move":false})"));
  Process helper(pc.folder, pc.helper("1"));
  helper.wait_for_error("motion is permitted");
  const Client client(pc);
  json state = client.ask({}, "state");
  CHECK_EQUAL(state.at("version"), "v1");
  CHECK_EQUAL(state.at("update").at("phase"), "none");
  std::string bundle;
  for (unsigned i = 0; i < 200'000; ++i) bundle += static_cast<char>(i * i >> 7);
  const json begun = client.ask(with(anna, {{"size", bundle.size()}}), "upload");
  CHECK(begun.at("ok").get<bool>());
  const std::string token = begun.at("upload");
  std::size_t received = 0;
  while (received < bundle.size())
    received = client.part(token, received, bundle.substr(received, 61'440)).at("received");
  CHECK(contents_of(pc.folder / "update/bundle") == bundle);
  CHECK_EQUAL(asked_of_systemd(pc), "start --no-block flexrf-update@verify.service\n");
  CHECK_EQUAL(client.ask({}, "state").at("update").at("phase"), "verifying");
  leave_result(pc, "verify", "state=done\npercent=100\napplication=keyboard\nversion=v2\nbuilt=2000\n");
  state = client.ask({}, "state");
  CHECK_EQUAL(state.at("update").at("phase"), "verified");
  CHECK_EQUAL(state.at("update").at("version"), "v2");
  CHECK(client.ask(with(anna, {{"older", false}, {"other_drivers", false}}), "install").at("ok").get<bool>());
  CHECK_CONTAINS(asked_of_systemd(pc), "start --no-block flexrf-update@install.service\n");
  CHECK_EQUAL(pc.word(), "an update is being installed\n");
  // Who kills the helper now moves nothing by it.
  helper.send(SIGKILL);
  helper.wait();
  leave_result(pc, "install", "state=done\npercent=100\n");
  Process again(pc.folder, pc.helper("1"));
  again.wait_for_error("an update was installed: the PC has to be restarted");
  const Client next(pc);
  CHECK_EQUAL(next.ask({}, "state").at("update").at("phase"), "installed");
  CHECK(next.ask(anna, "restart").at("ok").get<bool>());
  CHECK_CONTAINS(asked_of_systemd(pc), "reboot\n");
  again.wait_for_error("restart by 'anna' from uid " + std::to_string(getuid()) + ", process " +
                       std::to_string(getpid()) + ": accepted");
}

void a_cell_that_may_move_is_not_disturbed() {
  const Pc pc;
  // What the panel does not say, as one of long ago, is that it may move.
  const Process cell(pc.folder, panel(pc, R"({"healthy":true,"why_not":""})"));
  Process helper(pc.folder, pc.helper("1"));
  helper.wait_for_error("motion is permitted");
  const Client client(pc);
  json answer = client.ask(anna, "restart");
  CHECK_EQUAL(answer.at("status"), 409);
  CHECK_CONTAINS(answer.at("why").get<std::string>(), "the cell may move; stop motion first");
  CHECK_EQUAL(pc.word(), "permitted\n");
  CHECK_EQUAL(asked_of_systemd(pc), "");
}

void stuck_clients_keep_nobody_waiting() {
  const Pc pc;
  Process helper(pc.folder, pc.helper("80000"));
  std::vector<std::unique_ptr<Client>> silent;
  for (int i = 0; i < 6; ++i) silent.push_back(std::make_unique<Client>(pc));
  // One that asks and asks and takes no answer, until the helper has had enough of it.
  const Client greedy(pc);
  CHECK(wait_until([&] { return !greedy.sends(R"({"verb":"state"})") && errno == EPIPE; }));
  check_that_it_looks(pc);
  const Client client(pc);
  CHECK(client.ask({}, "state").at("ok").get<bool>());
  helper.send(SIGTERM);
  CHECK_EQUAL(helper.wait().exit_code, 0);
}

void a_ninth_connection_is_told_so() {
  const Pc pc;
  Process helper(pc.folder, pc.helper());
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 8; ++i) {
    clients.push_back(std::make_unique<Client>(pc));
    CHECK(clients.back()->ask({}, "state").at("ok").get<bool>());
  }
  {
    const Client ninth(pc);
    const auto answer = ninth.receive();
    CHECK(answer.has_value());
    CHECK_EQUAL(answer->at("status"), 503);
    CHECK_CONTAINS(answer->at("why").get<std::string>(), "there are 8 connections already");
    CHECK(!ninth.receive().has_value());
  }
  CHECK(clients.front()->ask({}, "state").at("ok").get<bool>());
  clients.pop_back();
  CHECK(wait_until([&] {
    const Client another(pc);
    return another.sends(R"({"verb":"state"})") &&
           another.receive().value_or(json::object()).value("ok", false);
  }));
}

void what_is_no_message_is_refused_and_the_next_one_answered() {
  const Pc pc;
  Process helper(pc.folder, pc.helper());
  const Client client(pc);
  CHECK_EQUAL(client.ask("{\"verb\":\"sta").at("status"), 400);
  CHECK_EQUAL(client.ask("te\"}").at("status"), 400);
  CHECK_EQUAL(client.ask(std::string(2000, ' ')).at("status"), 413);
  CHECK_EQUAL(client.ask(std::string(150'000, 'x')).at("status"), 413);
  CHECK_EQUAL(client.ask(std::string(1, '\0')).at("status"), 400);
  CHECK_CONTAINS(client.ask({}, "netwerk").at("why").get<std::string>(), "there is no verb 'netwerk'");
  CHECK_EQUAL(client.part("0123456789abcdef0123456789abcdef", 0, "x").at("status"), 404);
  CHECK_EQUAL(client.part("0123456789abcdef0123456789abcdef", 0, std::string(61'441, 'x')).at("status"), 413);
  CHECK(client.ask({}, "state").at("ok").get<bool>());
  check_that_it_looks(pc);
}

void clients_that_close_at_once_leave_no_trace() {
  const Pc pc;
  Process helper(pc.folder, pc.helper());
  for (int i = 0; i < 300; ++i) const Client gone(pc);
  const std::string question = with(anna, {{"password", "a wrong password"}, {"verb", "restart"}}).dump();
  for (int i = 0; i < 40; ++i) {
    const Client gone(pc);
    // Those that are refused because the places of others before are not free yet are closed already.
    gone.sends(question);
  }
  CHECK(wait_until([&] {
    const Client client(pc);
    return client.sends(R"({"verb":"state"})") &&
           client.receive().value_or(json::object()).value("ok", false);
  }));
  check_that_it_looks(pc);
  CHECK(!helper.has_ended());
}

void wrong_passwords_are_slowed_and_nobody_waits_for_them() {
  const Pc pc;
  Process helper(pc.folder, pc.helper());
  const Client client(pc);
  const Client other(pc);
  int wrong = 0;
  int early = 0;
  for (int i = 0; i < 10; ++i) {
    CHECK(client.sends(with(anna, {{"password", "a wrong password"}, {"verb", "restart"}}).dump()));
    CHECK(other.ask({}, "state").at("ok").get<bool>());
    const auto answer = client.receive();
    CHECK(answer.has_value());
    wrong += answer->at("status") == 403 ? 1 : 0;
    early += answer->at("status") == 429 && answer->at("retry_after") >= 1 ? 1 : 0;
  }
  CHECK_EQUAL(wrong + early, 10);
  CHECK(wrong >= 4);
  CHECK(early >= 1);
  helper.wait_for_error("restart by 'anna' from uid");
  helper.wait_for_error("refused: user or password is wrong");
  helper.wait_for_error("refused: too many wrong passwords");
  CHECK_EQUAL(asked_of_systemd(pc), "");
  check_that_it_looks(pc);
}

void a_helper_that_is_killed_forgets_the_upload() {
  const Pc pc;
  std::string token;
  {
    Process helper(pc.folder, pc.helper());
    const Client client(pc);
    token = client.ask(with(anna, {{"size", 100}}), "upload").at("upload");
    CHECK_EQUAL(client.part(token, 0, std::string(60, 'x')).at("received"), 60);
    CHECK(std::filesystem::exists(pc.folder / "update/bundle.part"));
    helper.send(SIGKILL);
    helper.wait();
    CHECK(!client.receive().has_value());
  }
  Process helper(pc.folder, pc.helper());
  const Client client(pc);
  CHECK_EQUAL(client.part(token, 60, std::string(40, 'x')).at("status"), 404);
  CHECK(!std::filesystem::exists(pc.folder / "update/bundle.part"));
  CHECK(!std::filesystem::exists(pc.folder / "update/bundle"));
  CHECK_EQUAL(client.ask({}, "state").at("update").at("phase"), "none");
  CHECK(client.ask(with(anna, {{"size", 100}}), "upload").at("ok").get<bool>());
}

/// What another user's process is answered; "" where it cannot even connect. `has_group`: of the socket.
std::string as_nobody(const Pc& pc, bool has_group) {
  int ends[2];
  CHECK(pipe2(ends, O_CLOEXEC) == 0);
  const sockaddr_un address = address_of_socket(pc);
  const pid_t child = fork();
  CHECK(child >= 0);
  if (child == 0) {
    const int socket = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    if (!has_group && setresgid(65534, 65534, 65534) != 0) _exit(1);
    if (setresuid(65534, 65534, 65534) != 0) _exit(1);
    if (connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
      _exit(errno == EACCES ? 0 : 1);
    const char question[] = R"({"verb":"state"})";
    ::send(socket, question, sizeof(question) - 1, MSG_NOSIGNAL);
    char answer[4096];
    const ssize_t size = recv(socket, answer, sizeof(answer), 0);
    _exit(size > 0 && write(ends[1], answer, static_cast<std::size_t>(size)) == size ? 0 : 1);
  }
  ::close(ends[1]);
  std::string said(4096, '\0');
  const ssize_t size = read(ends[0], said.data(), said.size());
  ::close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  CHECK_EQUAL(status, 0);
  return said.substr(0, size > 0 ? static_cast<std::size_t>(size) : 0);
}

void another_users_process_is_refused() {
  if (getuid() != 0) return;  // only root can be somebody else
  const Pc pc;
  using std::filesystem::perms;
  std::filesystem::permissions(pc.folder.path(), perms::owner_all | perms::group_exec | perms::others_exec);
  {
    Process helper(pc.folder, pc.helper());
    const Client client(pc);
    CHECK_EQUAL(as_nobody(pc, false), "");
    CHECK_CONTAINS(as_nobody(pc, true),
                   R"("status":403,"why":"only root and the application's user may ask this)");
    helper.wait_for_error("a connection of uid 65534, process");
    CHECK(client.ask({}, "state").at("ok").get<bool>());
  }
  Process helper(pc.folder, pc.helper("2", "nobody"));
  const Client client(pc);
  CHECK_CONTAINS(as_nobody(pc, true), R"({"ok":true,"application":"keyboard")");
}

void a_socket_that_cannot_be_made_is_made_when_it_can() {
  const Pc pc;
  std::filesystem::create_directory(pc.folder / "socket");
  Process helper(pc.folder, pc.helper());
  helper.wait_for_error("the socket socket cannot be made, so nobody can ask anything");
  check_that_it_looks(pc);
  std::filesystem::remove(pc.folder / "socket");
  const Client client(pc);
  CHECK(client.ask({}, "state").at("ok").get<bool>());
}

/// The journal's program is the test's: it answers with its own arguments.
void after_a_fallback_the_journal_is_read_and_old_logs_can_go() {
  const Pc pc;
  using std::filesystem::create_directories;
  write_file(pc.folder / "journalctl", "#!/bin/sh\nsleep 1\necho \"[    1.000000] cell[7]: $*\"\n");
  std::filesystem::permissions(pc.folder / "journalctl", std::filesystem::perms::owner_all);
  create_directories(pc.folder / "data/journal/0123");
  write_file(pc.folder / "data/journal/0123/system@00ff-1-2.journal", std::string(100'000, 'x'));
  write_file(pc.folder / "data/journal/0123/system.journal", "in use");
  CHECK_EQUAL(run(pc.folder, {place::choice, "--folder", "choice", "mark-whole", "B", "cmdline"}).exit_code,
              0);
  write_file(pc.folder / "update/version-b", "version=v2\n");
  const std::string boot(32, 'a');
  write_file(pc.folder / "update/last-failure-b",
             "trial=5\nstart=2\nbegan=1800000000\nreason=unit robot is in fault\nboots=" + boot +
                 "\nversion=v2\nstarts=3\n");
  Process helper(pc.folder, pc.helper());
  const Client client(pc);
  json state = client.ask({}, "state");
  CHECK_EQUAL(state.at("last_failure").at("reason"), "unit robot is in fault");
  CHECK_EQUAL(state.at("last_failure").at("why_no_lines"), "The journal is being read.");
  CHECK(wait_until([&] {
    state = client.ask({}, "state");
    return !state.at("last_failure").at("lines").empty() && state.contains("data");
  }));
  CHECK_CONTAINS(state.at("last_failure").at("lines").at(0).get<std::string>(),
                 "cell[7]: --quiet --no-pager --no-hostname --output=short-monotonic --lines=20 "
                 "--unit=flexrf.service _BOOT_ID=" +
                     boot);
  CHECK(state.at("data").at("old_logs") >= 100'000);
  CHECK(client.ask(with(anna, {{"what", "logs"}}), "make-room").at("freed") >= 100'000);
  CHECK(!std::filesystem::exists(pc.folder / "data/journal/0123/system@00ff-1-2.journal"));
  CHECK(std::filesystem::exists(pc.folder / "data/journal/0123/system.journal"));
  CHECK(wait_until([&] { return client.ask({}, "state").at("data").at("old_logs") == 0; }));
  CHECK(client.ask(with(anna, {{"slot", "B"}}), "dismiss-failure").at("ok").get<bool>());
  CHECK(!client.ask({}, "state").contains("last_failure"));
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(an_update_goes_through),
      CONTAINED_TEST(a_cell_that_may_move_is_not_disturbed),
      CONTAINED_TEST(stuck_clients_keep_nobody_waiting),
      CONTAINED_TEST(a_ninth_connection_is_told_so),
      CONTAINED_TEST(what_is_no_message_is_refused_and_the_next_one_answered),
      CONTAINED_TEST(clients_that_close_at_once_leave_no_trace),
      CONTAINED_TEST(wrong_passwords_are_slowed_and_nobody_waits_for_them),
      CONTAINED_TEST(a_helper_that_is_killed_forgets_the_upload),
      CONTAINED_TEST(another_users_process_is_refused),
      CONTAINED_TEST(a_socket_that_cannot_be_made_is_made_when_it_can),
      CONTAINED_TEST(after_a_fallback_the_journal_is_read_and_old_logs_can_go),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
