# Sourced by flexrf: what a power cut leaves of an industrial PC's disk (docs/image.md). The writes of a first boot, a claim, a
# confirmation and 50 saves of the configuration are recorded; disks are made of the recording as the power may have left them, and are
# looked at without booting, some of them booted. What the PC had promised by then, as by the answer to a save, has to be there.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

power_saves=50

# Partitions that only an update writes; a recording of anything else does without their contents.
punch_versions() {  # punch_versions DISK: what the slots hold becomes a hole, which takes no time to copy
  local name first size
  for name in boot-a boot-b root-a root-b; do
    read -r first size < <(partition_of "$1" "$name") || return
    fallocate --punch-hole --offset $((first * 512)) --length $((size * 512)) "$1" || return
  done
}

fill_versions() {  # fill_versions DISK FROM: the holes get the contents of slot A as another disk has them
  local name first size
  for name in boot-a root-a; do
    read -r first size < <(partition_of "$1" "$name") || return
    dd if="$2" of="$1" bs=1M skip=$((first / 2048)) seek=$((first / 2048)) count=$((size / 2048)) conv=notrunc,sparse status=none || return
  done
}

disk_of_log() {  # disk_of_log NAME DISK [append]: sets pc_disk to a disk whose writes are recorded in NAME.log, behind what is there or anew
  local how=log-sector-size=512
  [[ ! ${3-} ]] || how=log-append=on
  recording=$1
  # shellcheck disable=SC2054 # the commas are QEMU's
  pc_disk=(-blockdev "driver=file,node-name=disk-file,filename=${2//,/,,},discard=ignore"
    -blockdev driver=raw,node-name=disk,file=disk-file,discard=ignore
    -blockdev "driver=file,node-name=log-file,filename=${pc_folder//,/,,}/$1.log"
    -blockdev "driver=blklogwrites,node-name=recorded,file=disk,log=log-file,$how,log-super-update-interval=1"
    -device virtio-blk-pci,drive=recorded,bootindex=0,discard=off,write-zeroes=off)
}

# start_recorded_pc NAME DISK [OPTION OF QEMU...]: by BIOS; what it writes is in NAME.log, and the disk as it was in NAME.base
start_recorded_pc() {
  cp --sparse=always "$2" "$pc_folder/$1.base" && : >"$pc_folder/$1.log" && : >"$pc_folder/$1.promises" || return
  disk_of_log "$1" "$2"
  start_pc "$1" bios "$2" "${@:3}"
}

# A promise is noted behind the entry that the recording had reached when it had been given: with the power cut there or later, it holds.
recorded_entries() { od -A n -t u8 -j 16 -N 8 "$pc_folder/$recording.log" | tr -d ' '; }
promised() { printf '%s %s\n' "$(recorded_entries)" "$*" >>"$pc_folder/$recording.promises"; } # promised WHAT [VALUE]

promise_at() {  # promise_at RECORDING POINT WHAT: its value, or yes; nothing if it had not been given
  awk -v point="$2" -v what="$3" '$1 <= point && $2 == what { value = NF > 2 ? $3 : "yes" } END { if (value != "") print value }' \
    "$pc_folder/$1.promises"
}

# Each value is another one, so that a file tells which of the saves it is.
save_often() {
  local k answer save
  local -a requests=() every=(-s -S -k --max-time 60 -b "$pc_folder/cookies" -w '%{stderr}%{http_code} %{url}\n')
  ask_panel api/v1/control/take -b "$pc_folder/cookies" -o "$pc_folder/taken.json" -X POST || return
  save=https://localhost:$pc_port/api/v1/save-values
  for ((k = 1; k <= power_saves; ++k)); do
    requests+=(--next "${every[@]}" -X PUT -H 'Content-Type: application/json' -d "{\"speed\": 0.$((500 + k))}"
      "https://localhost:$pc_port/api/v1/components/pick/parameters" --next "${every[@]}" -X POST "$save")
  done
  k=0
  # The answers one by one, as they come: curl says them on standard error, which it does not keep back.
  while read -r answer; do
    [[ $answer == 200\ * ]] || { printf 'save %d was answered: %s; %s\n' $((k + 1)) "$answer" "$(<"$pc_folder/taken.json")" && return 1; }
    [[ $answer == *"$save" ]] && promised saved $((++k))
  done < <(curl "${requests[@]:1}" 2>&1 >"$pc_folder/saves.json")
  ((k == power_saves)) || { echo "$k of $power_saves saves were answered" && return 1; }
}

power_cut() {  # power_cut COMMAND RECORDING [OPTION...]
  "$root/build/release/image/power_cut/flexrf-power-cut" "$1" --log "$pc_folder/$2.log" --base "$pc_folder/$2.base" "${@:3}"
}

partition_of() {  # partition_of DISK NAME: its first sector and how many it has
  PATH=$PATH:/usr/sbin:/sbin sfdisk -q -J "$1" 2>/dev/null |
    jq -r --arg name "$2" '.partitiontable.partitions[] | select(.name == $name) | "\(.start) \(.size)"'
}

take_partition() {  # take_partition DISK NAME OUTPUT
  local first size
  read -r first size < <(partition_of "$1" "$2") || { echo "the table of partitions has no $2" && return 1; }
  dd if="$1" of="$3" bs=1M skip=$((first / 2048)) count=$(((size + 2047) / 2048)) conv=sparse status=none &&
    truncate -s $((size * 512)) "$3"
}

put_partition() {  # put_partition DISK NAME INPUT
  local first size
  read -r first size < <(partition_of "$1" "$2") || { echo "the table of partitions has no $2" && return 1; }
  (($(stat -c %s "$3") <= size * 512)) || { echo "$3 is larger than the partition $2" && return 1; }
  dd if="$3" of="$1" bs=1M seek=$((first / 2048)) conv=notrunc status=none
}

file_of_data() { PATH=$PATH:/usr/sbin:/sbin debugfs -R "cat $2" "$1" 2>/dev/null; }                      # file_of_data IMAGE PATH
is_in_data() { PATH=$PATH:/usr/sbin:/sbin debugfs -R "stat $2" "$1" 2>/dev/null | grep -q '^Inode'; }    # is_in_data IMAGE PATH

check_file_systems() {  # check_file_systems WORK: as the PC will find them at its next boot
  local work=$1 said PATH=$PATH:/usr/sbin:/sbin
  take_partition "$work/cut" data "$work/data" && take_partition "$work/cut" esp "$work/esp" || return
  # As a PC does it at its start. The journal leaves nothing to repair, but where a block of its own, or the superblock, was torn between two
  # sectors its checksum is wrong: that is damage to e2fsck, and repaired. Any other repair is wrong, and whatever was promised has to be there.
  if ! sh "$disk_scripts/root/usr/lib/flexrf/repair-data" "$work/data" "$work/notice" >"$work/fsck" 2>&1 ||
    ! e2fsck -f -n "$work/data" >>"$work/fsck" 2>&1; then
    cat "$work/fsck"
    return 1
  fi
  if [[ -s $work/notice ]]; then
    if ! grep -q -E 'Journal transaction [0-9]+ was corrupt|Superblock checksum does not match' "$work/fsck" || grep -q 'made anew' "$work/notice"; then
      printf 'lost data: no torn block, and yet %s\n' "$(cat "$work/notice" "$work/fsck")"
      return 1
    fi
    printf 'repaired: %s\n' "$(<"$work/notice")"
  fi
  # The mark of one that was in use is what a power cut leaves; Linux and GRUB do not mind it.
  said=$(fsck.fat -n "$work/esp" | grep -v -E '^fsck.fat|^Dirty bit is set|^ Automatically removing dirty bit|^Leaving|^$| clusters$') || return 0
  printf 'the ESP: %s\n' "$said"
  return 1
}

check_identity() {  # check_identity WORK RECORDING POINT: the panel's key and certificate belong together
  local work=$1
  file_of_data "$work/data" flexrf/panel.key >"$work/key"
  file_of_data "$work/data" flexrf/panel.crt >"$work/certificate"
  if [[ ! -s $work/key ]] && { is_in_data "$work/data" flexrf/panel.key || [[ $(promise_at "$2" "$3" identity) ]]; }; then
    echo "lost identity: the panel's key is not there, or empty"
  elif [[ -s $work/key && $(openssl pkey -in "$work/key" -pubout 2>&1) != "$(openssl x509 -in "$work/certificate" -noout -pubkey 2>&1)" ]]; then
    echo "lost identity: the panel's key is not that of its certificate"
  else
    return 0
  fi
  return 1
}

check_users() {  # check_users WORK RECORDING POINT: nobody before the claim, anna after it
  local work=$1 found
  if ! is_in_data "$work/data" flexrf/panel-users; then
    [[ ! $(promise_at "$2" "$3" claimed) ]] || { echo "lost users: the PC was claimed, and is nobody's again" && return 1; }
    return 0
  fi
  file_of_data "$work/data" flexrf/panel-users >"$work/users"
  chmod 600 "$work/users"
  found=$("$root/build/release/web-ui/server/access/flexrf-password" --list "$work/users" 2>&1)
  [[ $found == "anna "*" admin" ]] || { printf 'lost users: who may log in is not anna: %s\n' "${found:-nobody}" && return 1; }
}

check_configuration() {  # check_configuration WORK RECORDING POINT: one that was saved, and none before the last answer
  local work=$1 file=flexrf/config-a.xml last speed
  last=$(promise_at "$2" "$3" saved)
  if ! is_in_data "$work/data" "$file"; then
    [[ ! $last ]] || { echo "lost configuration: $last saves were answered, and there is none" && return 1; }
    return 0
  fi
  file_of_data "$work/data" "$file" >"$work/config.xml"
  # 0.51 is 0.510.
  speed=$(sed -n 's|.*<speed>0\.\([0-9]*\)</speed>.*|\1|p' "$work/config.xml")00
  speed=${speed:0:3}
  if ! "$root/build/release/apps/pick-station/pick-station" --virtual-time 100ms --config "$work/config.xml" >"$work/loaded" 2>&1 </dev/null ||
    [[ ! $speed =~ ^5[0-9]{2}$ ]]; then
    printf 'lost configuration: it does not load, or was never saved (%s bytes): %s\n' "$(stat -c %s "$work/config.xml")" "$(tail -n 2 "$work/loaded")"
  elif ((10#$speed - 500 < ${last:-0})); then
    echo "lost configuration: it is that of save $((10#$speed - 500)), and save $last had been answered"
  else
    return 0
  fi
  return 1
}

what_boots() {  # what_boots WORK: the slot that GRUB starts and why, now and after the repair of the choice; else what is wrong
  local work=$1 name
  mkdir -p "$work/choice"
  for name in choice0.env choice1.env attempts.env; do
    rm -f "$work/choice/$name"
    mcopy -n -i "$work/esp" "::flexrf/$name" "$work/choice/" 2>"$work/mcopy" || { cat "$work/mcopy" && return 1; }
  done
  "$root/build/release/image/boot/boot_choice_what_boots" "$work/choice" "$root/image/boot/grub.cfg"
}

check_boot() {  # check_boot WORK RECORDING POINT: GRUB starts A, the only slot that has a version
  local said wanted='@(only|confirmed)'
  [[ ! $(promise_at "$2" "$3" confirmed) ]] || wanted=confirmed
  # shellcheck disable=SC2053 # a pattern
  if said=$(what_boots "$1") && [[ $(tail -n 1 <<<"$said") == A\ $wanted ]]; then
    return 0
  fi
  printf 'lost choice: what boots is not A %s: %s\n' "$wanted" "$said"
  return 1
}

# A disk like this is in the PC when somebody switches it on again.
boots_again() {  # boots_again DISK: without the contents of slot A
  pc_disk=()
  fill_versions "$1" "$claimed/bios.img" && start_pc cut bios "$1" -no-reboot || return
  # Claimed or not: either the cell runs, or its page is there for whoever comes.
  await_line 'the cell runs|Nobody has claimed this PC' && panel_answers && no_complaint
  local status=$?
  stop_pc
  rm -f "$1"
  return "$status"
}

# Points anywhere, and those behind each promise but the saves': what it needs may be lost for a few writes only.
points_of() {  # points_of RECORDING COUNT SEED
  {
    power_cut points "$1" --count "$2" --seed "$3" || return
    awk -v last="$(recording=$1 recorded_entries)" '$2 != "saved" { for (point = $1; point < $1 + 8 && point <= last; ++point) print point }' \
      "$pc_folder/$1.promises"
  } | sort -n -u
}

judge() {  # judge RECORDING POINT WORK: the disk that a cut there may leave
  rm -rf "$3" && mkdir -p "$3" || return
  power_cut build "$1" --point "$2" --seed "$2" --output "$3/cut" && check_file_systems "$3" || return
  local status=0 check
  for check in check_identity check_users check_configuration check_boot; do "$check" "$3" "$1" "$2" || status=1; done
  ((status == 0)) || echo "at point $2, seed $2 (flexrf-power-cut build --point $2 --seed $2)"
  return "$status"
}

# The recording of the first boot goes on with saves of the configuration, of the PC as it was kept.
record_saves() {
  need_claimed_pc && cp --sparse=always "$claimed"/bios.{img,base,log,promises} "$pc_folder/" || return
  disk_of_log bios "$pc_folder/bios.img" append
  restore_pc "$claimed/bios.memory" bios bios "$pc_folder/bios.img" -no-reboot && log_in && save_often || return
  stop_pc
  keep cuts "$pc_folder"/bios.{base,log,promises}
}

need_recording() {  # need_recording NAME KEPT COMMAND...: its files are in pc_folder; the command makes and keeps them
  once "$2" "${@:3}" && recorded=$(kept "$2") && cp --sparse=always "$recorded/$1".{base,log,promises} "$pc_folder/"
}

# judge_points PROGRESS BOOTS JUDGE RECORDING < POINTS: points that stand in PROGRESS as right are not judged again; of all points so
# many are booted that were found right
judge_points() {
  local progress=$1 boots=$2 judge=$3 recording=$4 point number=0 wrong=0 fresh=0 booted=0 every work=$pc_folder/cut result
  local -a points
  mapfile -t points
  every=$((boots ? ${#points[@]} / boots : 0)) # none, if there are fewer points than boots
  touch "$progress"
  for point in "${points[@]}"; do
    number=$((number + 1))
    grep -q -x "$point right" "$progress" && continue
    fresh=$((fresh + 1)) result=right
    if ! "$judge" "$recording" "$point" "$work"; then
      result=wrong
    elif ((every > 0 && number % every == every / 2)); then
      booted=$((booted + 1))
      boots_again "$work/cut" || { echo "booted at point $point" && result=wrong; }
    fi
    [[ $result == right ]] || wrong=$((wrong + 1))
    printf '%s %s\n' "$point" "$result" >>"$progress"
  done
  printf '%d points, %d of them judged now, %d wrong, %d booted\n' "${#points[@]}" "$fresh" "$wrong" "$booted"
  ((wrong == 0))
}

cuts_of_recording() {  # cuts_of_recording COUNT SEED BOOTS PROGRESS: of the first boot and the saves
  local points
  need_claimed_pc && need_recording bios cuts record_saves && power_cut describe bios && points=$(points_of bios "$1" "$2") || return
  judge_points "$4" "$3" judge bios <<<"$points"
}

what_a_power_cut_leaves() { cuts_of_recording 40 1 3 "$pc_folder/judged"; }
more_power_cuts() { cuts_of_recording 80 2 5 "$pc_folder/judged.more"; }

# Goes on where it was interrupted, as long as the recording is that of the same image.
campaign_of_power_cuts() {
  need_claimed_pc && once cuts record_saves && cuts_of_recording 300 3 30 "$(kept cuts)/progress"
}

change_root() {  # change_root DISK FUNCTION [a|b]: the function changes the root of the slot, unpacked in the folder that it is given
  local work=$pc_folder/changed slot=${3:-a}
  rm -rf "$work" && mkdir "$work" && take_partition "$1" "root-$slot" "$work/packed" &&
    unsquashfs -quiet -no-progress -d "$work/root" "$work/packed" && "$2" "$work/root" &&
    mksquashfs "$work/root" "$work/root.squashfs" -noappend -quiet -no-progress -all-root -no-xattrs -comp zstd &&
    take_partition "$1" "boot-$slot" "$work/boot" && bind_boot "$work/boot" "$work/root.squashfs" &&
    put_partition "$1" "boot-$slot" "$work/boot" && put_partition "$1" "root-$slot" "$work/root.squashfs" && rm -rf "$work"
}

# Three programs that each leave out one flush: the claim that of the file before it takes its name, the application that of the
# folder after it, the helper that of the copies of the boot choice.
leave_out_flushes() {  # leave_out_flushes ROOT
  local service pattern
  cp "$root/build/release/image/power_cut/without_flush.so" "$1/usr/lib/flexrf/" || return
  while read -r service pattern; do
    mkdir -p "$1/etc/systemd/system/$service.service.d"
    printf '[Service]\nEnvironment=LD_PRELOAD=/usr/lib/flexrf/without_flush.so FLEXRF_WITHOUT_FLUSH=%s\n' "$pattern" \
      >"$1/etc/systemd/system/$service.service.d/without-flush.conf"
  done <<'TEXT'
flexrf-claim /data/flexrf/panel-users.new
flexrf /data/flexrf
flexrf-helper /boot/efi/flexrf/choice?.env
TEXT
}

# The same recording of programs with a flush less each, and the same judgement: it has to find what each of them loses. It looks at
# points in a random order until it has found all three losses.
a_missing_flush_is_found() {
  local disk=$pc_folder/twin.img kind points point found='' looked=0 wrong=0
  need_claimed_pc && cp --sparse=always "$claimed/bios.base" "$disk" && fill_versions "$disk" "$claimed/bios.img" && change_root "$disk" leave_out_flushes &&
    start_recorded_pc twin "$disk" -no-reboot && record_first_boot && save_often || return
  stop_pc
  punch_versions "$pc_folder/twin.base" && points=$(points_of twin 300 1 | shuf --random-source=<(yes)) || return
  for point in $points; do
    found+=$'\n'$(judge twin "$point" "$pc_folder/cut")
    looked=$((looked + 1))
    [[ $found == *$'\nlost users'* && $found == *$'\nlost configuration'* && $found == *$'\nlost choice'* ]] && break
  done
  for kind in users configuration choice; do
    printf '%s: lost at %d of %d points\n' "$kind" "$(grep -c "^lost $kind" <<<"$found")" "$looked"
    grep -q "^lost $kind" <<<"$found" || wrong=1
  done
  return "$wrong"
}
