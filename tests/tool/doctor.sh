#!/usr/bin/env bash
# The doctor's findings on machines made of files.
source "$(dirname "$0")/stand_in.sh"
shopt -s extglob

machine=$work/machine
file() {  # file PATH CONTENT
  mkdir -p "$machine$(dirname "$1")"
  printf '%b\n' "$2" >"$machine$1"
}
examine() {  # examine: sets status and output
  output=$(bash "$tree/cmake/tool/doctor.sh" "$machine" 2>&1)
  status=$?
}

for cpu in 0 1; do
  file "/sys/devices/system/cpu/cpu$cpu/cpufreq/scaling_governor" performance
  file "/sys/devices/system/cpu/cpu$cpu/cpuidle/state1/name" C6
  file "/sys/devices/system/cpu/cpu$cpu/cpuidle/state1/latency" 133
  file "/sys/devices/system/cpu/cpu$cpu/cpuidle/state1/disable" 1
done
file /sys/devices/system/cpu/isolated 1
file /sys/kernel/realtime 1
file /sys/devices/system/clocksource/clocksource0/current_clocksource tsc
file /proc/sys/kernel/osrelease 6.1.0-rt
file /proc/sys/kernel/sched_rt_runtime_us -1
file /proc/sys/kernel/sched_rt_period_us 1000000
file /proc/irq/9/effective_affinity_list 0
file /proc/self/status 'CapEff:\t0000000000804000' # CAP_SYS_NICE and CAP_IPC_LOCK
examine
expect "exit code of a good machine" "$status" 0
expect "findings on a good machine" "$output" "*Nothing is lacking."
expect "findings on a good machine" "$output" "!(*LACKS*)"

lacking() {  # lacking WHAT PATH CONTENT: the machine with one file changed lacks this, and no right
  local before
  before=$(<"$machine$2")
  file "$2" "$3"
  examine
  expect "exit code" "$status" 0
  expect "finding when $2 is '$3'" "$output" "*LACKS *$1*Lacking: 1."
  file "$2" "$before"
}
lacking "is not PREEMPT_RT" /sys/kernel/realtime 0
lacking "950000 us in each 1000000 us" /proc/sys/kernel/sched_rt_runtime_us 950000
lacking "CPU 1 (powersave)" /sys/devices/system/cpu/cpu1/cpufreq/scaling_governor powersave
lacking "1 C6 133 us" /sys/devices/system/cpu/cpu1/cpuidle/state1/disable 0
lacking "CPUs of real time: 9" /proc/irq/9/effective_affinity_list 0-1
lacking "no CPU is set apart" /sys/devices/system/cpu/isolated ''
lacking "hpet is slow" /sys/devices/system/clocksource/clocksource0/current_clocksource hpet

file /sys/devices/system/cpu/cpu0/cpufreq/scaling_governor powersave
examine
expect "a slow CPU that real time does not use" "$output" "!(*LACKS*)"

file /proc/self/status 'CapEff:\t0000000000000000'
ulimit -S -l 64 2>/dev/null
ulimit -S -r 0 2>/dev/null
examine
expect "exit code without rights" "$status" 3
expect "findings without rights" "$output" "*LACKS *real-time priorities*rtprio 49*LACKS *lock only 64 KiB*memlock*Lacking: 2."
finish
