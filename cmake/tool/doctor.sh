#!/usr/bin/env bash
# doctor.sh [SYSTEM_ROOT]: says what this machine lacks for real time, and how to mend it. Changes nothing. Exit code 3 if
# a right is missing without which no thread of an application becomes real-time; all else costs latency only.
# SYSTEM_ROOT stands in for / in tests.
set -u -o pipefail
system=${1-}
lacking=0 rights=0

good() { printf '  ok     %s\n' "$1"; }

lacks() {  # lacks WHAT REMEDY: costs latency
  printf '  LACKS  %s\n         %s\n' "$1" "$2"
  lacking=$((lacking + 1))
}

lacks_right() {  # lacks_right WHAT REMEDY: real time is refused
  lacks "$@"
  rights=$((rights + 1))
}

content() { cat "$system$1" 2>/dev/null; }

# Real time runs on every CPU but the first, unless some were set apart at boot.
real_time_cpus() {
  local isolated cpu
  isolated=$(content /sys/devices/system/cpu/isolated)
  if [[ $isolated ]]; then
    expand "$isolated"
  else
    for cpu in "$system"/sys/devices/system/cpu/cpu[0-9]*; do
      [[ -d $cpu && ${cpu##*/cpu} != 0 ]] && printf '%s\n' "${cpu##*/cpu}"
    done | sort -n
  fi
}

expand() {  # expand 1-3,7: one number per line
  local range
  for range in ${1//,/ }; do seq "${range%-*}" "${range#*-}"; done
}

check_kernel() {
  if [[ $(content /sys/kernel/realtime) == 1 || $(content /proc/version) == *PREEMPT_RT* ]]; then
    good "kernel $(content /proc/sys/kernel/osrelease) is PREEMPT_RT"
  else
    lacks "kernel $(content /proc/sys/kernel/osrelease) is not PREEMPT_RT: it delays a thread by milliseconds now and then" \
      "apt-get install linux-image-rt-amd64, then boot it"
  fi
}

check_throttling() {
  local runtime period
  runtime=$(content /proc/sys/kernel/sched_rt_runtime_us)
  period=$(content /proc/sys/kernel/sched_rt_period_us)
  if [[ $runtime == -1 ]]; then
    good "real-time threads are not throttled"
  elif [[ $runtime ]]; then
    lacks "real-time threads are stopped after $runtime us in each $period us" \
      "sysctl kernel.sched_rt_runtime_us=-1 (to stay: a file in /etc/sysctl.d)"
  fi
}

check_cpus() {
  local -a cpus
  mapfile -t cpus < <(real_time_cpus)
  if ((${#cpus[@]} == 0)); then
    lacks "one CPU: real time shares it with everything else" "two CPUs or more"
  elif [[ $(content /sys/devices/system/cpu/isolated) ]]; then
    good "CPUs set apart for real time: $(content /sys/devices/system/cpu/isolated)"
  else
    lacks "no CPU is set apart: other programs run on the CPUs of real time, ${cpus[*]}" \
      "kernel command line: isolcpus=${cpus[-1]} nohz_full=${cpus[-1]} rcu_nocbs=${cpus[-1]}"
  fi
}

check_governor() {
  local cpu governor
  local -a slow=()
  for cpu in $(real_time_cpus); do
    governor=$(content "/sys/devices/system/cpu/cpu$cpu/cpufreq/scaling_governor")
    [[ $governor && $governor != performance ]] && slow+=("$cpu ($governor)")
  done
  if ((${#slow[@]})); then
    lacks "the clock frequency follows the load on CPU ${slow[*]}" \
      "echo performance > /sys/devices/system/cpu/cpuN/cpufreq/scaling_governor"
  else
    good "no governor slows the CPUs of real time"
  fi
}

check_idle_states() {
  local cpu state latency
  local -a deep=()
  for cpu in $(real_time_cpus); do
    for state in "$system/sys/devices/system/cpu/cpu$cpu"/cpuidle/state*; do
      [[ -d $state ]] || continue
      latency=$(<"$state/latency")
      # 10 us: more than a wake-up itself takes.
      ((latency > 10)) && [[ $(<"$state/disable") == 0 ]] && deep+=("$cpu $(<"$state/name") ${latency} us")
    done
  done
  if ((${#deep[@]})); then
    lacks "idle states that are slow to leave: CPU $(printf '%s; ' "${deep[@]}")" \
      "echo 1 > /sys/devices/system/cpu/cpuN/cpuidle/stateM/disable, or cpupower idle-set -D 10"
  else
    good "no idle state takes longer than 10 us to leave"
  fi
}

check_interrupts() {
  local interrupt cpu allowed
  local -a stray=()
  for interrupt in "$system"/proc/irq/[0-9]*; do
    allowed=$(cat "$interrupt/effective_affinity_list" 2>/dev/null) || continue
    [[ $allowed ]] || continue
    for cpu in $(real_time_cpus); do
      expand "$allowed" | grep -q -x "$cpu" && stray+=("${interrupt##*/}") && break
    done
  done
  if ((${#stray[@]})); then
    lacks "interrupts are served on the CPUs of real time: ${stray[*]}" \
      "echo 0 > /proc/irq/N/smp_affinity_list for those the cell does not need there (and no irqbalance)"
  else
    good "interrupts stay off the CPUs of real time"
  fi
}

has_capability() {  # has_capability BIT: of this shell, hence of what it starts
  local effective
  effective=$(sed -n 's/^CapEff:\t*//p' "$system/proc/self/status" 2>/dev/null)
  (((16#${effective:-0} >> $1) & 1))
}

check_limits() {
  local user
  user=$(id -un)
  # 23 and 14: CAP_SYS_NICE and CAP_IPC_LOCK of capabilities(7).
  if has_capability 23 || [[ $(ulimit -r) == unlimited ]] || (($(ulimit -r) >= 49)); then
    good "$user may use real-time priorities up to 49"
  else
    lacks_right "$user may not use real-time priorities (limit $(ulimit -r), wanted 49)" \
      "echo '$user - rtprio 49' > /etc/security/limits.d/flexrf.conf, then log in again"
  fi
  if has_capability 14 || [[ $(ulimit -l) == unlimited ]]; then
    good "$user may lock memory"
  else
    lacks_right "$user may lock only $(ulimit -l) KiB of memory" \
      "echo '$user - memlock unlimited' >> /etc/security/limits.d/flexrf.conf, then log in again"
  fi
}

check_clock() {
  local source
  source=$(content /sys/devices/system/clocksource/clocksource0/current_clocksource)
  case $source in
    tsc | kvm-clock | arch_sys_counter | '') good "clock source ${source:-not known}" ;;
    *) lacks "clock source $source is slow to read" "kernel command line: clocksource=tsc (if the board's is stable)" ;;
  esac
}

echo "What this machine has for real time:"
check_limits
check_kernel
check_throttling
check_cpus
check_governor
check_idle_states
check_interrupts
check_clock
if ((lacking == 0)); then echo "Nothing is lacking."; else echo "Lacking: $lacking."; fi
((rights == 0)) || exit 3
