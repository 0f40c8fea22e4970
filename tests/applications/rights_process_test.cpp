// A start without the rights that real time needs.
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {
namespace {

/// As another user, who may lock little and has no priorities: whoever builds may be root.
std::vector<std::string> as_nobody(const Folder& folder, const std::string& application,
                                   const std::vector<std::string>& words) {
  // The user must get at the executable, and may write the folder.
  const std::string copy = folder / "application";
  std::filesystem::copy_file(application, copy, std::filesystem::copy_options::overwrite_existing);
  CHECK(chmod(folder.path().c_str(), 0777) == 0);
  std::vector<std::string> all{"bash", "-c", "ulimit -r 0; ulimit -l 64; exec \"$0\" \"$@\""};
  if (geteuid() == 0)
    all.insert(all.end(), {"setpriv", "--reuid=nobody", "--regid=nogroup", "--clear-groups"});
  all.push_back(copy);
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

void check_tells_what_is_missing(const Ending& ending, const std::string& copy) {
  CHECK_CONTAINS(ending.errors, "Missing right: real-time priority ");
  CHECK_CONTAINS(ending.errors, "RLIMIT_RTPRIO is 0 and the process does not hold CAP_SYS_NICE.");
  CHECK_CONTAINS(ending.errors, " of locked memory for user ");
  CHECK_CONTAINS(ending.errors, "RLIMIT_MEMLOCK is 64 KiB and the process does not hold CAP_IPC_LOCK.");
  CHECK_CONTAINS(ending.errors, "/etc/security/limits.d/90-flexrf.conf");
  CHECK_CONTAINS(ending.errors, "rtprio 49");
  CHECK_CONTAINS(ending.errors, "memlock unlimited");
  CHECK_CONTAINS(ending.errors, "setcap cap_sys_nice,cap_ipc_lock=ep " + copy);
}

void without_rights_and_real_actuators_it_goes_on() {
  const Folder folder;
  const Ending ending =
      run(folder,
          as_nobody(folder, place::keyboard,
                    {"--panel", "off", "--standstill-limit", "10min", "--report", "report"}),
          "w");
  check_tells_what_is_missing(ending, folder / "application");
  CHECK_CONTAINS(ending.errors, "Going on without real time: no real actuator is chosen.");
  CHECK_EQUAL(ending.exit_code, 0);
  CHECK(!Report(folder / "report")["run"].at("realtime").get<bool>());
}

// [stop-74]
void without_rights_a_real_actuator_is_refused() {
  const Folder folder;
  const Ending ending = run(folder, as_nobody(folder, place::crowd, {"--hardware", "press=real"}));
  check_tells_what_is_missing(ending, folder / "application");
  CHECK_CONTAINS(ending.errors,
                 "crowd: missing right: SCHED_FIFO priority 20 (RLIMIT_RTPRIO 0, no CAP_SYS_NICE)");
  CHECK_EQUAL(ending.exit_code, 3);
  CHECK_EQUAL(ending.output, "");
}

void a_real_actuator_is_refused_with_no_realtime() {
  const Folder folder;
  const Ending ending = run(folder, {place::crowd, "--hardware", "press=real", "--no-realtime"});
  CHECK_CONTAINS(ending.errors, "--no-realtime is refused: a real actuator is chosen");
  CHECK_EQUAL(ending.exit_code, 1);
}

/// A kind of hardware that was asked for is what all devices get, or none: never another one in silence.
void a_kind_of_hardware_is_for_all_devices() {
  const Folder folder;
  const Ending ending = run(folder, {place::crowd, "--hardware", "real"});
  CHECK_EQUAL(ending.exit_code, 1);
  CHECK_CONTAINS(ending.errors,
                 "--hardware real: these devices have no such driver: drive; name one for each, as "
                 "`--hardware real,DEVICE=DRIVER`, or say in its table `instead = { real = \"DRIVER\" }`");
  // Whoever names them gets what is named, and is told what moves.
  const Ending named = run(folder, {place::crowd, "--hardware", "real,drive=simulated", "--no-realtime"});
  CHECK_CONTAINS(named.errors, "a real actuator is chosen (press)");
}

/// Whoever starts it, in whatever environment: there is one press.
// [stop-67] [stop-69]
void a_real_actuator_is_run_once_on_the_machine() {
  if (geteuid() != 0) skip();  // only root may take the place as another user, too
  const Folder folder;
  const Folder elsewhere;
  Process first(folder, {place::crowd, "--hardware", "press=real"});
  const std::string holder = "process " + std::to_string(first.id());
  CHECK(wait_until([&] { return contents_of("/run/flexrf/flexrf-crowd.lock").starts_with(holder + " "); }));
  const Ending second = run(elsewhere, {place::crowd, "--hardware", "press=real"});
  CHECK_EQUAL(second.exit_code, 2);
  CHECK_CONTAINS(second.errors, "cell crowd is run already by " + holder);
  CHECK_CONTAINS(second.errors, "lock file /run/flexrf/flexrf-crowd.lock");
  const Ending nobodys =
      run(elsewhere,
          {"setpriv", "--reuid=nobody", "--regid=nogroup", "--clear-groups", "--inh-caps=+sys_nice,+ipc_lock",
           "--ambient-caps=+sys_nice,+ipc_lock", place::crowd, "--hardware", "press=real"});
  CHECK_EQUAL(nobodys.exit_code, 3);
  CHECK_CONTAINS(nobodys.errors,
                 "its lock file belongs into /run/flexrf: Permission denied; make it by `sudo install");
  // What moves nothing real is another's business, and says where its lock is.
  Process simulated(elsewhere, {place::crowd});
  simulated.wait_for_error("no real actuator is chosen: this cell runs once per user (lock file " +
                           elsewhere.path() + "/flexrf-crowd.lock)");
  for (Process* const process : {&first, &simulated}) {
    process->send(SIGTERM);
    CHECK_EQUAL(process->wait().exit_code, 128 + SIGTERM);
  }
}

/// Both are always in a step.
// [exec-82]
void free_threads_leave_their_processor_to_others() {
  const Folder folder;
  Process process(folder, {place::crowd});
  const auto is_running = [&process](const std::string& name) {
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(process.id()) + "/task")) {
      if (contents_of(task.path() / "comm") == name + "\n") return true;
    }
    return false;
  };
  CHECK(wait_until([&] { return is_running("walking") && is_running("gathering"); }));
  constexpr int turns = 100;
  std::vector<std::thread> others;
  std::atomic<int> taken{0};
  const unsigned processors = std::thread::hardware_concurrency();
  for (unsigned processor = 0; processor < processors; ++processor) {
    others.emplace_back([processor, &taken] {
      cpu_set_t mine;
      CPU_ZERO(&mine);
      CPU_SET(processor, &mine);
      sched_setaffinity(0, sizeof(mine), &mine);  // where it is not allowed, it is elsewhere
      for (int turn = 0; turn < turns; ++turn) {
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
        ++taken;
      }
    });
  }
  const bool all = wait_until([&] { return taken == static_cast<int>(processors) * turns; });
  process.send(SIGTERM);
  for (std::thread& other : others) other.join();
  CHECK(all);
  CHECK_EQUAL(process.wait().exit_code, 128 + SIGTERM);
}

/// Those that are always there, too.
// [exec-70]
void who_is_not_real_time_keeps_off_its_cpus() {
  if (geteuid() != 0) skip();                           // without the rights nobody is real-time
  if (std::thread::hardware_concurrency() < 2) skip();  // there is one for all
  const Folder folder;
  Process process(folder, {place::keyboard, "--panel", "127.0.0.1:0", "--standstill-limit", "10min"});
  process.wait_for_error("autostart");
  cpu_set_t claimed;
  CPU_ZERO(&claimed);
  std::vector<cpu_set_t> others;
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process.id()) + "/task")) {
    const pid_t thread = std::stoi(task.path().filename());
    cpu_set_t cpus;
    CHECK(sched_getaffinity(thread, sizeof(cpus), &cpus) == 0);
    if (sched_getscheduler(thread) == SCHED_FIFO) {
      CPU_OR(&claimed, &claimed, &cpus);
    } else {
      others.push_back(cpus);
    }
  }
  CHECK(CPU_COUNT(&claimed) > 0);
  // The supervising, the output's, the lifecycle's, the panel's.
  CHECK(others.size() >= 4);
  for (const cpu_set_t& cpus : others) {
    cpu_set_t both;
    CPU_AND(&both, &cpus, &claimed);
    CHECK_EQUAL(CPU_COUNT(&both), 0);
  }
  process.end_input();
  CHECK_EQUAL(process.wait().exit_code, 0);
}

// [exec-69]
void a_machine_file_that_makes_no_sense_keeps_it_from_starting() {
  if (geteuid() != 0) skip();  // only root may have an /etc of its own
  for (const char* const line : {"control = somewhere", "control = 1000"}) {
    const Folder folder;
    const Ending ending =
        run(folder,
            {"unshare", "-m", "bash", "-c",
             "mount -t tmpfs tmpfs /etc && mkdir /etc/flexrf && echo \"$1\" > /etc/flexrf/machine.conf && "
             "exec \"$0\" --panel off --no-realtime --standstill-limit 10min",
             place::keyboard, std::string{"# roles\n"} + line});
    CHECK_CONTAINS(ending.errors, "/etc/flexrf/machine.conf:2: ");
    CHECK_EQUAL(ending.exit_code, 2);
    CHECK_EQUAL(ending.errors.find("autostart"), std::string::npos);
  }
}

/// Enough for the table's budget, too little for all that is mapped: this is known before anything starts.
void a_limit_between_budget_and_need_is_noticed() {
  if (geteuid() != 0) skip();  // only root can keep the priorities and give up the capability
  const Folder folder;
  const Ending ending = run(folder,
                            {"bash", "-c", "ulimit -l 8192; exec \"$0\" \"$@\"", "setpriv",
                             "--bounding-set=-ipc_lock", "--inh-caps=-ipc_lock", place::keyboard, "--panel",
                             "off", "--standstill-limit", "10min", "--report", "report"},
                            "w");
  CHECK_CONTAINS(ending.errors, "RLIMIT_MEMLOCK is 8192 KiB and the process does not hold CAP_IPC_LOCK.");
  CHECK_CONTAINS(ending.errors, "Going on without real time");
  CHECK_EQUAL(ending.exit_code, 0);
}

/// It starts, or says why it does not: the panel's library throws where it gets no descriptor.
// [stop-104]
void too_few_open_files_are_told() {
  for (const int files : {5, 6, 7, 8, 10, 12, 16, 20}) {
    const Folder folder;
    const Ending ending =
        run(folder, {"prlimit", "--nofile=" + std::to_string(files), place::keyboard, "--panel",
                     "127.0.0.1:0", "--no-realtime", "--standstill-limit", "10min"});
    CHECK_EQUAL(ending.signal, 0);
    CHECK_EQUAL(ending.errors.find("terminate called"), std::string::npos);
    // 127: no program could be loaded, says the system.
    if (ending.exit_code != 0 && ending.exit_code != 127)
      CHECK_CONTAINS(ending.errors, "Too many open files");
  }
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(without_rights_and_real_actuators_it_goes_on),
      CONTAINED_TEST(without_rights_a_real_actuator_is_refused),
      CONTAINED_TEST(a_real_actuator_is_refused_with_no_realtime),
      CONTAINED_TEST(a_kind_of_hardware_is_for_all_devices),
      CONTAINED_TEST(a_real_actuator_is_run_once_on_the_machine),
      CONTAINED_TEST(free_threads_leave_their_processor_to_others),
      CONTAINED_TEST(who_is_not_real_time_keeps_off_its_cpus),
      CONTAINED_TEST(a_machine_file_that_makes_no_sense_keeps_it_from_starting),
      CONTAINED_TEST(a_limit_between_budget_and_need_is_noticed),
      CONTAINED_TEST(too_few_open_files_are_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
