#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "places.hpp"
#include "runtime/realtime/doctor/checks.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::doctor {
namespace {

struct File {
  const char* path;
  const char* text;
};

// Static: a failing assertion jumps over destructors.
std::string root;
std::vector<Finding> findings;
std::string output;

// A machine with all that a cell needs: four CPUs, the last two set apart.
const File well[] = {
    {"/proc/self/status", "Name:\tdoctor\nCapEff:\t0000000000000000\n"},
    {"/proc/self/limits",
     "Limit                     Soft Limit           Hard Limit           Units     \n"
     "Max locked memory         unlimited            unlimited            bytes     \n"
     "Max realtime priority     49                   49                   \n"},
    {"/proc/self/timerslack_ns", "50000\n"},
    {"/proc/version", "Linux version 6.1.0-18-rt-amd64 (debian) #1 SMP PREEMPT_RT Debian\n"},
    {"/proc/sys/kernel/osrelease", "6.1.0-18-rt-amd64\n"},
    {"/proc/sys/kernel/sched_rt_runtime_us", "-1\n"},
    {"/proc/sys/kernel/sched_rt_period_us", "1000000\n"},
    {"/proc/swaps", "Filename\tType\tSize\tUsed\tPriority\n"},
    {"/proc/irq/9/effective_affinity_list", "0\n"},
    {"/proc/irq/17/effective_affinity_list", "0-1\n"},
    {"/proc/irq/default_smp_affinity", "f\n"},
    {"/sys/devices/system/cpu/online", "0-3\n"},
    {"/sys/devices/system/cpu/isolated", "2-3\n"},
    {"/sys/devices/system/cpu/smt/active", "0\n"},
    {"/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n"},  // not one of real time's
    {"/sys/devices/system/cpu/cpu3/cpufreq/scaling_governor", "performance\n"},
    {"/sys/devices/system/cpu/cpu3/cpuidle/state1/name", "C1\n"},
    {"/sys/devices/system/cpu/cpu3/cpuidle/state1/latency", "2\n"},
    {"/sys/devices/system/cpu/cpu3/cpuidle/state1/disable", "0\n"},
    {"/sys/devices/system/cpu/cpu3/cpuidle/state2/name", "C6\n"},
    {"/sys/devices/system/cpu/cpu3/cpuidle/state2/latency", "133\n"},
    {"/sys/devices/system/cpu/cpu3/cpuidle/state2/disable", "1\n"},
    {"/sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc\n"},
    {"/sys/kernel/mm/transparent_hugepage/enabled", "always [madvise] never\n"},
    {"/dev/cpu_dma_latency", ""},
};

// One thing after the other that is not so, and what is then said of it.
struct Ailment {
  File file;
  Verdict verdict;
  const char* check;
  const char* found;
  const char* remedy;  ///< part of it
};
const Ailment ailments[] = {
    {{"/proc/self/limits",
      "Max locked memory         8388608              8388608              bytes\n"
      "Max realtime priority     0                    0\n"},
     Verdict::missing,
     "priority",
     "RLIMIT_RTPRIO is 0 and CAP_SYS_NICE is not held",
     "'@flexrf - rtprio 49' >> /etc/security/limits.d/90-flexrf.conf"},
    {{"/proc/self/limits",
      "Max locked memory         8388608              8388608              bytes\n"
      "Max realtime priority     20                   49\n"},
     Verdict::warn,
     "priority",
     "RLIMIT_RTPRIO is 20 and CAP_SYS_NICE is not held",
     "rtprio 49"},
    {{"/proc/self/limits",
      "Max locked memory         8388608              8388608              bytes\n"
      "Max realtime priority     49                   49\n"},
     Verdict::missing,
     "memory lock",
     "RLIMIT_MEMLOCK is 8192 KiB and CAP_IPC_LOCK is not held",
     "'@flexrf - memlock unlimited' >> /etc/security/limits.d/90-flexrf.conf"},
    {{"/proc/version", "Linux version 6.1.0-18-amd64 (debian) #1 SMP PREEMPT_DYNAMIC Debian\n"},
     Verdict::warn,
     "kernel",
     "6.1.0-18-rt-amd64 is not PREEMPT_RT",
     "apt-get install linux-image-rt-amd64"},
    {{"/proc/sys/kernel/sched_rt_runtime_us", "950000\n"},
     Verdict::warn,
     "throttling",
     "real-time threads run at most 950000 us in each 1000000 us",
     "sysctl -w kernel.sched_rt_runtime_us=-1"},
    {{"/etc/flexrf/machine.conf", "control = 9\n"},
     Verdict::warn,
     "machine file",
     "/etc/flexrf/machine.conf:1: CPU 9 is not there or not allowed to this process, which has 0-3",
     "correct /etc/flexrf/machine.conf"},
    {{"/sys/devices/system/cpu/isolated", "\n"},
     Verdict::warn,
     "cpus",
     "real time has CPU 2-3, not set apart",
     "isolcpus=2-3 nohz_full=2-3 rcu_nocbs=2-3"},
    {{"/proc/irq/17/effective_affinity_list", "3\n"},
     Verdict::warn,
     "interrupts",
     "served on the CPUs of real time: 17",
     "for n in 17; do echo 0-1 > /proc/irq/$n/smp_affinity_list; done"},
    {{"/sys/devices/system/cpu/cpu3/cpufreq/scaling_governor", "powersave\n"},
     Verdict::warn,
     "governor",
     "cpu3 powersave",
     "echo performance > $g"},
    {{"/sys/devices/system/cpu/cpu3/cpuidle/state2/disable", "0\n"},
     Verdict::warn,
     "idle states",
     "slow to leave: cpu3 C6 133 us",
     "cpupower idle-set --disable-by-latency 11"},
    {{"/sys/devices/system/clocksource/clocksource0/current_clocksource", "acpi_pm\n"},
     Verdict::warn,
     "clock",
     "clock source acpi_pm",
     "clocksource=tsc"},
    {{"/proc/swaps", "Filename\tType\tSize\tUsed\tPriority\n/dev/sda2\tpartition\t999\t0\t-2\n"},
     Verdict::warn,
     "swap",
     "on",
     "swapoff --all"},
    {{"/sys/devices/system/cpu/smt/active", "1\n"},
     Verdict::warn,
     "hyper-threading",
     "on",
     "echo off > /sys/devices/system/cpu/smt/control"},
    {{"/sys/kernel/mm/transparent_hugepage/enabled", "[always] madvise never\n"},
     Verdict::warn,
     "huge pages",
     "always transparent",
     "echo madvise > /sys/kernel/mm/transparent_hugepage/enabled"},
    {{"/proc/self/timerslack_ns", "5000000\n"},
     Verdict::warn,
     "timer slack",
     "5000000 ns",
     "TimerSlackNSec=50us"},
};

void put(const File& file) {
  const std::filesystem::path path = root + file.path;
  std::filesystem::create_directories(path.parent_path());
  std::FILE* const stream = std::fopen(path.c_str(), "w");
  std::fputs(file.text, stream);
  std::fclose(stream);
}

int make_machine(void**) {
  char folder[] = "/tmp/flexrf-doctor-XXXXXX";
  if (mkdtemp(folder) == nullptr) return 1;
  root = folder;
  for (const File& file : well) put(file);
  return 0;
}

int remove_machine(void**) {
  std::filesystem::remove_all(root);
  return 0;
}

void look() {
  findings = examine(SystemFiles(root), "/etc/flexrf/machine.conf");
}

const Finding* finding_of(const std::string& check) {
  for (const Finding& finding : findings)
    if (finding.check == check) return &finding;
  return nullptr;
}

// [exec-80]
void nothing_lacks_on_a_machine_that_is_well(void**) {
  look();
  assert_int_equal(findings.size(), 15);
  for (const Finding& finding : findings) {
    assert_string_equal(name_of(finding.verdict), "ok");
    assert_true(finding.meaning.empty() && finding.remedy.empty());
    assert_false(finding.found.empty());
  }
  assert_string_equal(finding_of("cpus")->found.c_str(), "real time has CPU 2-3, set apart by the kernel");
  assert_string_equal(finding_of("machine file")->found.c_str(),
                      "none, defaults: control on CPU 3, io on 2, any on 2-3");
}

void each_ailment_is_named_with_its_remedy(void**) {
  for (const Ailment& ailment : ailments) {
    make_machine(nullptr);
    put(ailment.file);
    look();
    remove_machine(nullptr);
    const Finding* const finding = finding_of(ailment.check);
    assert_non_null(finding);
    assert_string_equal(finding->found.c_str(), ailment.found);
    assert_string_equal(name_of(finding->verdict), name_of(ailment.verdict));
    assert_non_null(strstr(finding->remedy.c_str(), ailment.remedy));
    assert_false(finding->meaning.empty());
  }
}

void capabilities_stand_in_for_limits(void**) {
  make_machine(nullptr);
  put({"/proc/self/limits", "Max locked memory 0 0 bytes\nMax realtime priority 0 0\n"});
  put({"/proc/self/status", "Name:\tdoctor\nCapEff:\t0000000000804000\n"});
  look();
  remove_machine(nullptr);
  assert_string_equal(name_of(finding_of("priority")->verdict), "ok");
  assert_string_equal(name_of(finding_of("memory lock")->verdict), "ok");
}

void an_empty_machine_is_looked_at_too(void**) {
  findings = examine(SystemFiles("/nowhere"), "/etc/flexrf/machine.conf");
  assert_string_equal(name_of(finding_of("priority")->verdict), "missing");
  assert_string_equal(finding_of("cpus")->found.c_str(), "there is one CPU");
}

/// Runs the executable; its standard output is then in `output`. @returns exit code.
int run(const std::string& arguments) {
  output.clear();
  std::FILE* const pipe = popen((std::string(place::doctor) + " " + arguments + " 2>&1").c_str(), "r");
  char buffer[4096];
  std::size_t size = 0;
  while ((size = std::fread(buffer, 1, sizeof(buffer), pipe)) > 0) output.append(buffer, size);
  const int result = pclose(pipe);
  return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

void exit_codes_and_forms(void**) {
  make_machine(nullptr);
  const int well_code = run("--root " + root);
  const bool well_said = output.ends_with("Nothing is lacking.\n");
  put({"/proc/swaps", "Filename\n/dev/sda2\n"});
  const int warned_code = run("--root " + root);
  const bool warned_said = output.find("warn     swap: on\n           means: ") != std::string::npos &&
                           output.find("\n           mend:  swapoff --all") != std::string::npos &&
                           output.ends_with("Lacking: 1 of 15.\n");
  put({"/proc/self/limits", ""});
  const int missing_code = run("--json --root " + root);
  const bool json_said = output.starts_with("[\n") &&
                         output.find("\"verdict\": \"missing\"") != std::string::npos &&
                         output.ends_with("]\n");
  remove_machine(nullptr);
  assert_int_equal(well_code, 0);
  assert_true(well_said);
  assert_int_equal(warned_code, 0);
  assert_true(warned_said);
  assert_int_equal(missing_code, 3);
  assert_true(json_said);
  assert_int_equal(run("--rooot x"), 1);
  assert_true(output.starts_with("flexrf-doctor: unexpected '--rooot'\n"));
  assert_int_equal(run("--root"), 1);
}

}  // namespace
}  // namespace flexrf::doctor

int main() {
  using namespace flexrf::doctor;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(nothing_lacks_on_a_machine_that_is_well, make_machine, remove_machine),
      cmocka_unit_test(each_ailment_is_named_with_its_remedy),
      cmocka_unit_test(capabilities_stand_in_for_limits),
      cmocka_unit_test(an_empty_machine_is_looked_at_too),
      cmocka_unit_test(exit_codes_and_forms),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
