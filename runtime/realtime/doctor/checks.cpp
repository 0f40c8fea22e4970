#include "runtime/realtime/doctor/checks.hpp"

#include <linux/capability.h>

#include <cstdlib>
#include <cstring>

#include "runtime/realtime/machine_file.hpp"

namespace flexrf::doctor {

namespace {

constexpr int usual_priority_limit = 49;
/// What an application of ordinary size locks, bytes.
constexpr std::uint64_t usual_locked = 256ULL << 20;
/// Idle states that take longer to leave delay a wake-up by more than it takes itself.
constexpr std::int64_t longest_idle_exit_us = 10;

/// The machine, and which of its CPUs real time has.
struct Machine {
  const SystemFiles& system;
  CpuSet online;
  CpuSet realtime;
  CpuSet rest;
};

Finding good(const char* check, std::string found) {
  return {Verdict::ok, check, std::move(found), "", ""};
}

std::string cpus_text(const CpuSet& cpus) {
  return CpuText(cpus).text;
}

CpuSet cpus_in(const SystemFiles& system, const std::string& path) {
  const auto text = system.text(path);
  if (!text) return {};
  const auto cpus = CpuSet::parse(*text);
  return cpus ? *cpus : CpuSet{};
}

bool holds_capability(const SystemFiles& system, unsigned capability) {
  const std::string status = system.text("/proc/self/status").value_or("");
  const std::size_t at = status.find("\nCapEff:");
  if (at == std::string::npos) return false;
  return ((std::strtoull(status.c_str() + at + std::strlen("\nCapEff:"), nullptr, 16) >> capability) & 1) !=
         0;
}

/// The soft limit of that name in force; UINT64_MAX: unlimited.
std::uint64_t limit_of(const SystemFiles& system, const std::string& name) {
  const std::string limits = "\n" + system.text("/proc/self/limits").value_or("");
  const std::size_t at = limits.find("\n" + name);
  if (at == std::string::npos) return 0;
  const char* value = limits.c_str() + at + 1 + name.size();
  while (*value == ' ') ++value;
  return std::strncmp(value, "unlimited", 9) == 0 ? UINT64_MAX : std::strtoull(value, nullptr, 10);
}

constexpr const char* limits_file = "/etc/security/limits.d/90-flexrf.conf";
constexpr const char* group_commands =
    "groupadd --force flexrf && usermod --append --groups flexrf \"$USER\" && echo '@flexrf - ";

std::string limits_remedy(const std::string& line) {
  return group_commands + line + "' >> " + limits_file + "   (as root, then log in again)";
}

Finding check_priority(const Machine& machine) {
  if (holds_capability(machine.system, CAP_SYS_NICE)) return good("priority", "CAP_SYS_NICE is held");
  const std::uint64_t limit = limit_of(machine.system, "Max realtime priority");
  if (limit >= usual_priority_limit)
    return good("priority", "real-time priorities up to " + std::to_string(limit) + " are allowed");
  return {limit == 0 ? Verdict::missing : Verdict::warn, "priority",
          "RLIMIT_RTPRIO is " + std::to_string(limit) + " and CAP_SYS_NICE is not held",
          limit == 0 ? "no thread can be real-time" : "threads with a higher priority cannot start",
          limits_remedy("rtprio " + std::to_string(usual_priority_limit))};
}

Finding check_memory_lock(const Machine& machine) {
  if (holds_capability(machine.system, CAP_IPC_LOCK)) return good("memory lock", "CAP_IPC_LOCK is held");
  const std::uint64_t limit = limit_of(machine.system, "Max locked memory");
  if (limit >= usual_locked) return good("memory lock", "enough memory may be locked");
  return {Verdict::missing, "memory lock",
          "RLIMIT_MEMLOCK is " + std::to_string(limit / 1024) + " KiB and CAP_IPC_LOCK is not held",
          "memory cannot be locked: a page fault may stop a real-time thread for milliseconds",
          limits_remedy("memlock unlimited")};
}

Finding check_kernel(const Machine& machine) {
  const std::string release =
      machine.system.text("/proc/sys/kernel/osrelease").value_or("of unknown release");
  const bool is_realtime =
      machine.system.text("/sys/kernel/realtime").value_or("0") == "1" ||
      machine.system.text("/proc/version").value_or("").find("PREEMPT_RT") != std::string::npos;
  if (is_realtime) return good("kernel", release + " is PREEMPT_RT");
  return {Verdict::warn, "kernel", release + " is not PREEMPT_RT",
          "a thread is delayed by milliseconds now and then",
          "apt-get install linux-image-rt-amd64 && systemctl reboot"};
}

Finding check_throttling(const Machine& machine) {
  const auto runtime = machine.system.number("/proc/sys/kernel/sched_rt_runtime_us");
  const auto period = machine.system.number("/proc/sys/kernel/sched_rt_period_us");
  if (!runtime || *runtime < 0 || (period && *runtime >= *period))
    return good("throttling", "real-time threads are not throttled");
  return {Verdict::warn, "throttling",
          "real-time threads run at most " + std::to_string(*runtime) + " us in each " +
              std::to_string(period.value_or(1'000'000)) + " us",
          "a thread that runs long is stopped until the period ends, motion or not",
          "sysctl -w kernel.sched_rt_runtime_us=-1 && "
          "echo 'kernel.sched_rt_runtime_us = -1' > /etc/sysctl.d/90-flexrf.conf"};
}

Finding check_cpus(const Machine& machine) {
  const std::string realtime = cpus_text(machine.realtime);
  if (machine.online.count() < 2)
    return {Verdict::warn, "cpus", "there is one CPU", "real time shares it with everything else",
            "a machine with two CPUs or more"};
  const CpuSet isolated = cpus_in(machine.system, "/sys/devices/system/cpu/isolated");
  if (machine.realtime.without(isolated).is_empty())
    return good("cpus", "real time has CPU " + realtime + ", set apart by the kernel");
  return {
      Verdict::warn, "cpus", "real time has CPU " + realtime + ", not set apart",
      "other programs and the kernel's own work run there too",
      "on the kernel's command line (GRUB_CMDLINE_LINUX in /etc/default/grub, then update-grub): isolcpus=" +
          realtime + " nohz_full=" + realtime + " rcu_nocbs=" + realtime};
}

Finding check_interrupts(const Machine& machine) {
  std::string stray;
  for (const std::string& interrupt : machine.system.numbered("/proc/irq", "")) {
    CpuSet cpus = cpus_in(machine.system, "/proc/irq/" + interrupt + "/effective_affinity_list");
    if (cpus.is_empty()) cpus = cpus_in(machine.system, "/proc/irq/" + interrupt + "/smp_affinity_list");
    if (!cpus.common_with(machine.realtime).is_empty()) stray += (stray.empty() ? "" : " ") + interrupt;
  }
  if (stray.empty()) return good("interrupts", "none is served on the CPUs of real time");
  return {Verdict::warn, "interrupts", "served on the CPUs of real time: " + stray,
          "each delays the thread it interrupts; those of the cell's own devices may belong there",
          "for n in " + stray + "; do echo " + cpus_text(machine.rest) +
              " > /proc/irq/$n/smp_affinity_list; done; systemctl disable --now irqbalance"};
}

Finding check_governor(const Machine& machine) {
  std::string slow;
  for (const std::string& cpu : machine.system.numbered("/sys/devices/system/cpu", "cpu")) {
    if (!machine.realtime.contains(std::atoi(cpu.c_str() + 3))) continue;
    const auto governor = machine.system.text("/sys/devices/system/cpu/" + cpu + "/cpufreq/scaling_governor");
    if (governor && *governor != "performance") slow += (slow.empty() ? "" : ", ") + cpu + " " + *governor;
  }
  if (slow.empty()) return good("governor", "no governor lowers the clock of real time's CPUs");
  return {Verdict::warn, "governor", slow,
          "the clock follows the load: the first microseconds of a step are slow",
          "for g in /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor; do echo performance > $g; done"};
}

Finding check_idle_states(const Machine& machine) {
  std::string deep;
  for (const std::string& cpu : machine.system.numbered("/sys/devices/system/cpu", "cpu")) {
    if (!machine.realtime.contains(std::atoi(cpu.c_str() + 3))) continue;
    const std::string folder = "/sys/devices/system/cpu/" + cpu + "/cpuidle";
    for (const std::string& state : machine.system.numbered(folder, "state")) {
      const std::string path = folder + "/" + state;
      const std::int64_t exit = machine.system.number(path + "/latency").value_or(0);
      if (exit <= longest_idle_exit_us || machine.system.number(path + "/disable").value_or(0) != 0) continue;
      deep += (deep.empty() ? "" : ", ") + cpu + " " + machine.system.text(path + "/name").value_or(state) +
              " " + std::to_string(exit) + " us";
    }
  }
  if (deep.empty()) return good("idle states", "none takes longer than 10 us to leave");
  return {Verdict::warn, "idle states", "slow to leave: " + deep, "a sleeping CPU wakes late",
          "cpupower idle-set --disable-by-latency " + std::to_string(longest_idle_exit_us + 1)};
}

Finding check_latency_request(const Machine& machine) {
  if (machine.system.may_write("/dev/cpu_dma_latency"))
    return good("latency request", "/dev/cpu_dma_latency may be written to");
  return {Verdict::warn, "latency request", "/dev/cpu_dma_latency may not be written to",
          "an application cannot keep the CPUs from deep idle states while it runs",
          "echo 'KERNEL==\"cpu_dma_latency\", GROUP=\"flexrf\", MODE=\"0660\"' > "
          "/etc/udev/rules.d/90-flexrf.rules && udevadm trigger"};
}

Finding check_clock(const Machine& machine) {
  const std::string source =
      machine.system.text("/sys/devices/system/clocksource/clocksource0/current_clocksource")
          .value_or("not known");
  for (const char* const fast : {"tsc", "kvm-clock", "arch_sys_counter", "hyperv_clocksource_tsc_page"})
    if (source == fast) return good("clock", source);
  return {Verdict::warn, "clock", "clock source " + source,
          "each look at the clock costs a microsecond in place of 20 ns",
          "on the kernel's command line: clocksource=tsc tsc=reliable (if the board's is stable)"};
}

Finding check_swap(const Machine& machine) {
  const std::string swaps = machine.system.text("/proc/swaps").value_or("");
  if (swaps.find('\n') == std::string::npos) return good("swap", "off");
  return {Verdict::warn, "swap", "on",
          "a cell's memory is locked, but the kernel's work of swapping others delays it",
          "swapoff --all, and remove the swap lines from /etc/fstab"};
}

Finding check_threads_per_core(const Machine& machine) {
  if (machine.system.number("/sys/devices/system/cpu/smt/active").value_or(0) == 0)
    return good("hyper-threading", "off");
  return {Verdict::warn, "hyper-threading", "on",
          "two CPUs share one core: what runs on the sibling slows real time down",
          "echo off > /sys/devices/system/cpu/smt/control, or nosmt on the kernel's command line"};
}

Finding check_huge_pages(const Machine& machine) {
  const std::string mode = machine.system.text("/sys/kernel/mm/transparent_hugepage/enabled").value_or("");
  if (mode.find("[always]") == std::string::npos)
    return good("huge pages", "not made behind a program's back");
  return {Verdict::warn, "huge pages", "always transparent",
          "the kernel moves memory together, also that of real-time threads",
          "echo madvise > /sys/kernel/mm/transparent_hugepage/enabled"};
}

Finding check_timer_slack(const Machine& machine) {
  const std::int64_t slack = machine.system.number("/proc/self/timerslack_ns").value_or(50'000);
  if (slack <= 50'000)
    return good("timer slack", std::to_string(slack) + " ns, for threads that are not real-time");
  return {Verdict::warn, "timer slack", std::to_string(slack) + " ns",
          "threads that are not real-time wake up to that much late",
          "TimerSlackNSec=50us in the systemd unit that starts the cell"};
}

Finding check_machine_file(const Result<MachineFile>& machine, const std::string& path, bool is_there) {
  if (!machine)
    return {Verdict::warn, "machine file", machine.status().cause(), "applications refuse to start",
            "correct " + path};
  return good("machine file", (is_there ? path : std::string("none, defaults")) + ": control on CPU " +
                                  cpus_text(machine->cpus_of(CpuRole::control)) + ", io on " +
                                  cpus_text(machine->cpus_of(CpuRole::io)) + ", any on " +
                                  cpus_text(machine->cpus_of(CpuRole::any)));
}

}  // namespace

const char* name_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::warn:
      return "warn";
    case Verdict::missing:
      return "missing";
  }
  return "unknown";
}

std::vector<Finding> examine(const SystemFiles& system, const std::string& machine_file) {
  CpuSet online = cpus_in(system, "/sys/devices/system/cpu/online");
  if (online.is_empty()) online = CpuSet::of(0);
  const CpuSet isolated = cpus_in(system, "/sys/devices/system/cpu/isolated");
  const auto contents = system.text(machine_file);
  const MachineFile defaults = MachineFile::by_default(online, isolated);
  const Result<MachineFile> roles =
      contents ? MachineFile::parse(*contents, machine_file.c_str(), online, isolated)
               : Result<MachineFile>(defaults);
  const MachineFile& valid = roles ? *roles : defaults;
  Machine machine{system, online, {}, {}};
  for (const CpuRole role : {CpuRole::control, CpuRole::io, CpuRole::any})
    machine.realtime = machine.realtime.united_with(valid.cpus_of(role));
  machine.rest = valid.rest(machine.realtime);

  std::vector<Finding> findings;
  findings.push_back(check_priority(machine));
  findings.push_back(check_memory_lock(machine));
  findings.push_back(check_kernel(machine));
  findings.push_back(check_throttling(machine));
  findings.push_back(check_machine_file(roles, machine_file, contents.has_value()));
  for (const auto check :
       {check_cpus, check_interrupts, check_governor, check_idle_states, check_latency_request, check_clock,
        check_swap, check_threads_per_core, check_huge_pages, check_timer_slack})
    findings.push_back(check(machine));
  return findings;
}

}  // namespace flexrf::doctor
