#!/usr/bin/env bash
# kernel_options.sh DESCRIPTOR MACHINE_FILE: the kernel's command line of a version, behind what GRUB says of the slot. The CPUs that the
# roles of the application's real-time threads have, by the machine's role map, are theirs alone.
set -eu -o pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
descriptor=$1 machine=$2

cpus_of() { sed -n -E 's/ *(#.*)?$//; s/^ *'"$1"' *= *"?([0-9,-]+)"?$/\1/p' "$machine"; } # cpus_of ROLE

numbers_of() {  # numbers_of LIST: 0-2,5 as 0 1 2 5, one a line
  local part
  for part in ${1//,/ }; do seq "${part%-*}" "${part#*-}"; done
}

role_cpus() {
  local role cpus
  for role in $(jq -r -f "$here/of_tables.jq" "$descriptor" | sed -n 's/^role //p'); do
    cpus=$(cpus_of "$role")
    if [[ ! $cpus ]]; then
      echo "$machine: real-time threads of this application have the role '$role', and there is no line for it" >&2
      echo "hint: $role = 1" >&2
      exit 1
    fi
    numbers_of "$cpus"
  done
}

claimed=$(role_cpus | sort -n -u)
rest=$(cpus_of rest)
# Without a line for the rest: which CPUs this PC has above those of real time is not known here, those below are there.
[[ $rest ]] || rest=$(comm -13 <(sort <<<"$claimed") <(seq 0 "$(tail -n 1 <<<"${claimed:-0}")" | sort) | sort -n | paste -s -d ,)
if [[ $claimed && ! $rest ]]; then
  echo "$machine: real time has every CPU that is named, and nothing is left for all others" >&2
  echo "hint: rest = 0" >&2
  exit 1
fi
options="console=tty0"
# A serial line that the cell has is not the kernel's to write to.
jq -r -f "$here/of_tables.jq" "$descriptor" | grep -q -x 'file /dev/ttyS0' || options+=" console=ttyS0,115200"
# gpt: where the power went while the table of partitions grew, the copy at the disk's end counts.
options+=" quiet panic=10 gpt"
if [[ $claimed ]]; then
  list=$(paste -s -d , <<<"$claimed")
  options+=" isolcpus=managed_irq,domain,$list nohz_full=$list rcu_nocbs=$list irqaffinity=$rest"
fi
# Processors that sleep deeply, or at a low clock, wake late.
options+=" processor.max_cstate=1 intel_idle.max_cstate=1 cpufreq.default_governor=performance"
options+=" skew_tick=1 nmi_watchdog=0 transparent_hugepage=madvise"
printf '%s\n' "$options"
