# Sourced by flexrf: what a power cut leaves of an industrial PC's disk (docs/image.md). The writes of a first boot, a claim, a
# confirmation and 50 saves of the configuration are recorded; disks are made of the recording as the power may have left them, and are
# looked at without booting, some of them booted.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

power_saves=50
cut_points=40 cut_boots=1
[[ ${FLEXRF_LONG-} ]] && cut_points=300 cut_boots=30

start_recorded_pc() {  # start_recorded_pc NAME DISK: by BIOS; what it writes is in NAME.log, and the disk as it was in NAME.base
  cp --sparse=always "$2" "$pc_folder/$1.base" && : >"$pc_folder/$1.log" || return
  # shellcheck disable=SC2054 # the commas are QEMU's
  pc_disk=(-blockdev "driver=file,node-name=disk-file,filename=${2//,/,,},discard=ignore"
    -blockdev driver=raw,node-name=disk,file=disk-file,discard=ignore
    -blockdev "driver=file,node-name=log-file,filename=${pc_folder//,/,,}/$1.log"
    -blockdev driver=blklogwrites,node-name=recorded,file=disk,log=log-file,log-sector-size=512,log-super-update-interval=1
    -device virtio-blk-pci,drive=recorded,discard=off,write-zeroes=off)
  start_pc "$1" bios "$2" -no-reboot
}

# Each value is another one, so that a file tells which of the saves it is.
save_often() {
  local k status
  local -a requests=()
  ask_panel api/v1/control/take -b "$pc_folder/cookies" -o "$pc_folder/taken.json" -X POST || return
  for ((k = 1; k <= power_saves; ++k)); do
    requests+=(--next -s -S -k --max-time 60 -b "$pc_folder/cookies" -o /dev/null -w '%{http_code}\n' -X PUT -H 'Content-Type: application/json'
      -d "{\"speed\": 0.$((500 + k))}" "https://localhost:$pc_port/api/v1/components/pick/parameters"
      --next -s -S -k --max-time 60 -b "$pc_folder/cookies" -o /dev/null -w '%{http_code}\n' -X POST "https://localhost:$pc_port/api/v1/save-values")
  done
  status=$(curl "${requests[@]:1}" | sort | uniq -c)
  [[ $status =~ ^\ *$((2 * power_saves))\ 200$ ]] || { printf 'saves were answered: %s; %s\n' "$status" "$(<"$pc_folder/taken.json")" && return 1; }
}

power_cut() { "$root/build/release/image/power_cut/flexrf-power-cut" "$1" --log "$pc_folder/bios.log" --base "$pc_folder/bios.base" "${@:2}"; }

partition_of() {  # partition_of DISK NAME: its first sector and how many it has
  PATH=$PATH:/usr/sbin:/sbin sfdisk -q -J "$1" 2>/dev/null |
    jq -r --arg name "$2" '.partitiontable.partitions[] | select(.name == $name) | "\(.start) \(.size)"'
}

take_partition() {  # take_partition DISK NAME OUTPUT
  local first size
  read -r first size < <(partition_of "$1" "$2") || { echo "the table of partitions has no $2" && return 1; }
  dd if="$1" of="$3" bs=1M skip=$((first / 2048)) count=$(((size + 2047) / 2048)) conv=sparse status=none
}

file_of_data() { debugfs -R "cat $2" "$1" 2>/dev/null; } # file_of_data IMAGE PATH

check_data() {  # check_data WORK: who the PC is, who may log in, what was saved: each as before or as after
  local work=$1 speed PATH=$PATH
  take_partition "$work/cut" data "$work/data" || return
  PATH=$PATH:/usr/sbin:/sbin
  e2fsck -p "$work/data" >"$work/fsck" 2>&1
  if (($? > 1)) || ! e2fsck -f -n "$work/data" >>"$work/fsck" 2>&1; then
    cat "$work/fsck"
    return 1
  fi
  file_of_data "$work/data" flexrf/panel.key >"$work/key"
  file_of_data "$work/data" flexrf/panel.crt >"$work/certificate"
  if [[ -s $work/key && $(openssl pkey -in "$work/key" -pubout 2>&1) != "$(openssl x509 -in "$work/certificate" -noout -pubkey 2>&1)" ]]; then
    echo "the panel's key is there and is not that of its certificate"
    return 1
  fi
  file_of_data "$work/data" flexrf/panel-users >"$work/users"
  chmod 600 "$work/users"
  if [[ -s $work/users && $("$root/build/release/web-ui/server/access/flexrf-password" --list "$work/users" 2>&1) != "anna "*" admin" ]]; then
    echo "who may log in is neither nobody nor anna:"
    cat "$work/users"
    return 1
  fi
  # That there are none is the same as none of these files.
  if debugfs -R 'stat flexrf/panel-users' "$work/data" 2>/dev/null | grep -q '^Inode' && [[ ! -s $work/users ]]; then
    echo "who may log in is a file without anybody"
    return 1
  fi
  file_of_data "$work/data" flexrf/config.xml >"$work/config.xml"
  [[ -s $work/config.xml ]] || return 0
  speed=$(sed -n 's|.*<speed>0\.\([0-9]*\)</speed>.*|\1|p' "$work/config.xml")
  if ! "$root/build/release/apps/pick-station/pick-station" --virtual-time 100ms --config "$work/config.xml" >"$work/loaded" 2>&1 </dev/null ||
    [[ ! $speed =~ ^5[0-9]{0,2}$ ]]; then
    echo "the configuration does not load, or is none that was saved (speed 0.$speed):"
    tail -n 3 "$work/loaded"
    return 1
  fi
}

check_boot() {  # check_boot WORK: GRUB starts A, the only slot that has a version, also after the repair
  local work=$1 name said
  take_partition "$work/cut" esp "$work/esp" || return
  mkdir -p "$work/choice"
  for name in choice0.env choice1.env attempts.env; do
    rm -f "$work/choice/$name"
    mcopy -n -i "$work/esp" "::flexrf/$name" "$work/choice/" 2>"$work/mcopy" || { cat "$work/mcopy" && return 1; }
  done
  if ! said=$("$root/build/release/image/boot/boot_choice_what_boots" "$work/choice" "$root/image/boot/grub.cfg") ||
    [[ $(tail -n 1 <<<"$said") != A\ @(only|confirmed) ]]; then
    printf 'what boots: %s\n' "$said"
    return 1
  fi
}

# A disk like this is in the PC when somebody switches it on again.
boots_again() {  # boots_again WORK
  pc_disk=()
  mv "$1/cut" "$pc_folder/cut.img" && start_pc cut bios "$pc_folder/cut.img" -no-reboot || return
  # Claimed or not: either the cell runs, or its page is there for whoever comes.
  await_line 'the cell runs|Nobody has claimed this PC' && panel_answers
  local status=$?
  stop_pc
  rm -f "$pc_folder/cut.img"
  return "$status"
}

what_a_power_cut_leaves() {
  local point work=$pc_folder/cut wrong=0 looked=0 boots=0 points every
  build release flexrf-power-cut flexrf-password boot_choice_what_boots || return
  power_cut describe || return
  points=$(power_cut points --count "$cut_points" --seed 1) || return
  every=$(($(wc -l <<<"$points") / cut_boots))
  for point in $points; do
    rm -rf "$work" && mkdir -p "$work" || return
    if ! power_cut build --point "$point" --seed "$point" --output "$work/cut" || ! check_data "$work" || ! check_boot "$work"; then
      echo "at point $point, seed $point (flexrf-power-cut build --point $point --seed $point)"
      wrong=$((wrong + 1))
    elif ((++looked % every == every / 2 && boots < cut_boots)); then
      boots=$((boots + 1))
      boots_again "$work" || { echo "booted at point $point" && wrong=$((wrong + 1)); }
    fi
  done
  printf '%d points, %d wrong, %d booted\n' "$(wc -l <<<"$points")" "$wrong" "$boots"
  ((wrong == 0 && boots == cut_boots))
}
