# Sourced by flexrf: an industrial PC whose disk is damaged or full, whose clock is wrong, or that lacks a device (docs/image.md). Each
# begins with a copy of a disk that was claimed, and knows by the console and the panel what became of it.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

claimed_disk() { need_claimed_pc && cp --sparse=always "$claimed/bios.img" "$1"; } # claimed_disk COPY

overwrite_data() {  # overwrite_data DISK FROM KIB: so much of data is what somebody else wrote there
  local first
  read -r first _ < <(partition_of "$1" data) || return
  head -c $(($3 * 1024)) /dev/urandom | dd of="$1" bs=1K seek=$((first / 2 + $2)) conv=notrunc iflag=fullblock status=none
}

asks_with_certificate() {  # with the panel's certificate as the only one that is trusted, at the time of this machine
  openssl s_client -connect "127.0.0.1:$pc_port" </dev/null 2>/dev/null | openssl x509 >"$pc_folder/panel.crt"
  curl -s -S --max-time 60 --cacert "$pc_folder/panel.crt" --resolve "flexrf:$pc_port:127.0.0.1" -o "$pc_folder/trusted.html" \
    "https://flexrf:$pc_port/"
}

answers_at() {  # answers_at HOST STATUS
  local status
  status=$(ask_panel '' --retry 0 -H "Host: $1:8443" -o "$pc_folder/at.html" -w '%{http_code}')
  [[ $status == "$2" ]] || { echo "asked for $1 the panel answers $status" && return 1; }
}

time_of_pc() { date -d "$(ask_panel '' -I | sed -n 's/^Date: *//Ip' | tr -d '\r')" +%s; }

# Neither the superblock nor a copy of it is left, a copy of the boot choice is damaged, and the clock has lost its battery: the PC is one that
# nobody has claimed.
data_beyond_repair() {
  local disk=$pc_folder/damaged.img now
  pc_disk=()
  claimed_disk "$disk" && overwrite_data "$disk" 0 200000 && printf 'damaged' >"$pc_folder/choice1.env" &&
    mcopy -o -i "$disk@@2M" "$pc_folder/choice1.env" ::flexrf/ && start_pc damaged bios "$disk" -no-reboot -rtc base=2001-01-01T00:00:00 &&
    await_line 'data was damaged beyond repair, and is made anew' && await_line 'motion is not permitted: nobody has claimed this PC' &&
    claim_pc -H 'Host: cell7.example.org:8443' && await_line 'The panel answers at cell7.example.org, too' && await_line 'the cell runs' && log_in &&
    await_machine '(.notices | any(test("choice1.env is damaged"))) and .hosts == ["cell7.example.org"]' &&
    answers_at cell7.example.org 200 && answers_at elsewhere.example.org 421 && asks_with_certificate && now=$(time_of_pc) || return
  # That of the version, which systemd takes for one that stands before it.
  ((now >= time_of_test_version && now < $(date +%s))) || { echo "the PC's clock says $now" && return 1; }
  ! fingerprint | grep -F -f "$claimed/fingerprint" || { echo "the key that was lost is there" && return 1; }
}

# What was made anew is there the next time, and nothing is said of it.
data_made_anew_stays() {
  pc_disk=()
  [[ -f $pc_folder/damaged.img ]] || { data_beyond_repair && stop_pc; } || return
  start_pc anew bios "$pc_folder/damaged.img" -no-reboot && await_line 'the cell runs' && log_in || return
  ! console_lines | grep -E 'data was|first boot|has claimed'
}

# The superblock is lost, and a copy of it is there.
data_is_repaired() {
  local disk=$pc_folder/repaired.img
  pc_disk=()
  claimed_disk "$disk" && overwrite_data "$disk" 1 1 && start_pc repaired bios "$disk" -no-reboot &&
    await_line 'data was badly damaged, and is repaired' && await_line 'the cell runs' && log_in || return
  [[ $(fingerprint) == "$(<"$claimed/fingerprint")" ]] || { echo "the panel has another certificate than before" && return 1; }
}

spoil_own_files() {  # spoil_own_files DISK: users and certificate are what somebody else wrote there
  local work=$pc_folder/spoiled.data PATH=$PATH:/usr/sbin:/sbin
  take_partition "$1" data "$work" && e2fsck -p "$work" >/dev/null || return
  head -c 500 /dev/urandom >"$pc_folder/garbage"
  debugfs -w -f - "$work" >"$pc_folder/debugfs" 2>&1 <<TEXT
rm flexrf/panel-users
write $pc_folder/garbage flexrf/panel-users
rm flexrf/panel.crt
write $pc_folder/garbage flexrf/panel.crt
TEXT
  put_partition "$1" data "$work" && rm "$work"
}

# With damaged users nobody could log in, and with a damaged certificate no page would be served. The PC shows the claim page, with a new
# certificate, and its notices say why.
damaged_users_lead_to_a_claim() {
  local disk=$pc_folder/spoiled.img
  pc_disk=()
  claimed_disk "$disk" && spoil_own_files "$disk" && start_pc spoiled bios "$disk" -no-reboot && await_line 'who may log in could not be read' &&
    await_line "the panel's key or certificate was damaged, and is made anew" && claim_pc && await_line 'the cell runs' && log_in &&
    await_machine '[.notices[] | select(test("set aside|made anew"))] | length == 2' || return
  ! fingerprint | grep -F -f "$claimed/fingerprint" || { echo "the certificate that was damaged is there" && return 1; }
}

fill_data() {  # fill_data DISK: a file takes every block that is free
  local work=$pc_folder/full.data size free PATH=$PATH:/usr/sbin:/sbin
  take_partition "$1" data "$work" && e2fsck -p "$work" >/dev/null || return
  size=$(dumpe2fs -h "$work" 2>/dev/null | sed -n 's/^Block size: *//p')
  free=$(dumpe2fs -h "$work" 2>/dev/null | sed -n 's/^Free blocks: *//p')
  # Less than what its own tree of extents takes, which the second file has.
  debugfs -w -f - "$work" >"$pc_folder/debugfs" 2>&1 <<TEXT
write /dev/null filling
fallocate filling 0 $((free - 64))
set_inode_field filling size $(((free - 63) * size))
TEXT
  e2fsck -f -p "$work" >>"$pc_folder/debugfs" || { cat "$pc_folder/debugfs" && return 1; }
  put_partition "$1" data "$work" && rm "$work"
}

try_to_save() { ask_panel api/v1/save-values --retry 0 -b "$pc_folder/cookies" -o "$pc_folder/saved.json" -w '%{http_code}' -X POST; }

change_speed() { # change_speed VALUE: prints the status
  ask_panel api/v1/components/pick/parameters -b "$pc_folder/cookies" -o "$pc_folder/set.json" -w '%{http_code}' -X PUT \
    -H 'Content-Type: application/json' -d "{\"speed\": $1}"
}

# The cell runs, people get in, a save says why it cannot be, and the journal has made no room for itself with what is others'.
data_is_full() {
  local disk=$pc_folder/full.img status
  pc_disk=()
  claimed_disk "$disk" && fill_data "$disk" && start_pc full bios "$disk" -no-reboot && await_line 'the cell runs' && log_in &&
    await_line 'motion is permitted' && await_machine '.data.free == 0 and .data.other > 100000000' || return
  ask_panel api/v1/control/take -b "$pc_folder/cookies" -o "$pc_folder/taken.json" -X POST || return
  status="$(change_speed 0.777) $(try_to_save)"
  [[ $status == '200 507' && $(<"$pc_folder/saved.json") == *'make room there'* ]] ||
    { echo "set and save were answered: $status $(<"$pc_folder/set.json") $(<"$pc_folder/saved.json")" && return 1; }
}

# as_documented DISK: what docs/industrial-pc.md says of writing the image anew, word for word, with mounts of its own, so that this machine's
# disks have no part in it
as_documented() (
  local loop data first words
  read -r first _ < <(partition_of "$1" data) && PATH=$PATH:/usr/sbin:/sbin || return
  # Its data by a device of its own, as not every machine makes those of a loop device's partitions.
  loop=$(losetup -f --show "$1" 2>&1) || { printf '%s\n' "$loop" && return 1; }
  trap 'losetup -d "$loop"' EXIT
  data=$(losetup -f --show -o $((first * 512)) "$1" 2>&1) || { printf '%s\n' "$data" && return 1; }
  trap 'losetup -d "$loop" "$data"' EXIT
  words=$(sed -n '/^### Writing the image anew/,/^### /s/^    //p' "$root/docs/industrial-pc.md" |
    sed "s|\./flexrf|$root/flexrf|; s|build/image/pick-station.img|$pc_shared/product.img|; s|/dev/sdX|$loop --yes|")
  [[ $words == *cp*flash*cp* ]] || { printf 'the steps are not found: %s\n' "$words" && return 1; }
  rm -rf "$pc_folder/other-machine" && mkdir -p "$pc_folder/other-machine" /dev/disk && cd "$pc_folder/other-machine" || return
  # shellcheck disable=SC2016 # expands inside
  unshare --mount bash -e -c 'mount -t tmpfs none /dev/disk && mkdir /dev/disk/by-partlabel && ln -s "$1" /dev/disk/by-partlabel/data && eval "$2"' \
    recovery "$data" "$words" >steps.log 2>&1 || { cat steps.log && return 1; }
)

# The image is written anew, and what the PC had on its data partition is put back, in another machine.
written_anew_it_is_as_before() {
  local disk=$pc_folder/bios.img status
  if ! PATH=$PATH:/usr/sbin:/sbin losetup -f >/dev/null 2>&1; then
    echo "not tried: a loop device, which is root's to make"
    return 0
  fi
  need_product && need_claimed_pc && cp --sparse=always "$claimed"/bios.{img,log} "$pc_folder/" || return
  disk_of_log bios "$disk" append
  restore_pc "$claimed/bios.memory" anew bios "$disk" -no-reboot && log_in &&
    ask_panel api/v1/control/take -b "$pc_folder/cookies" -o "$pc_folder/taken.json" -X POST || return
  status="$(change_speed 0.777) $(try_to_save)"
  [[ $status == '200 200' ]] || { echo "set and save were answered: $status $(<"$pc_folder/set.json") $(<"$pc_folder/saved.json")" && return 1; }
  stop_pc
  pc_disk=()
  as_documented "$disk" && start_pc again bios "$disk" -no-reboot && await_line 'the cell runs' && log_in || return
  [[ $(fingerprint) == "$(<"$claimed/fingerprint")" ]] || { echo "the panel has another certificate than before" && return 1; }
  ask_panel api/v1/components/pick/parameters -b "$pc_folder/cookies" | jq -e '.runtime.speed == 0.777' || return
  await_line 'the version in slot A has confirmed itself' && no_complaint || return
  ! console_lines | grep -E 'Nobody has claimed|data was'
}

data_is_missing() {
  local disk=$pc_folder/missing.img
  pc_disk=()
  claimed_disk "$disk" && PATH=$PATH:/usr/sbin:/sbin sfdisk -q --part-label "$disk" 7 other && start_pc missing bios "$disk" -no-reboot &&
    await_line 'What this PC needs could not be started' && await_screen '^What this PC needs could not be started \(see above\)' && await_screen 'Timed out waiting for device .*data' &&
    screen >"$pc_folder/screen-missing.text"
}

# confirm_both DISK: copies the version of slot A into slot B, marks slot B as confirmed, and makes it the primary.
confirm_both() {
  local choice=$pc_folder/choice part file words
  rm -rf "$choice" && mkdir "$choice" || return
  for part in boot root; do
    take_partition "$1" "$part-a" "$pc_folder/part" && put_partition "$1" "$part-b" "$pc_folder/part" || return
  done
  for file in choice0.env choice1.env attempts.env; do mcopy -i "$1@@2M" "::flexrf/$file" "$choice/" || return; done
  printf 'rauc.slot=B\n' >"$pc_folder/cmdline"
  for words in "mark-whole B $pc_folder/part" 'set-primary B' 'confirm B'; do
    # shellcheck disable=SC2086 # words
    "$root/build/release/image/boot/flexrf-boot-choice" --folder "$choice" --kernel-command-line "$pc_folder/cmdline" $words || return
  done
  mcopy -o -i "$1@@2M" "$choice"/*.env ::flexrf/
}

# The disk has bad sectors in the root of the confirmed primary: after three failed starts GRUB starts the other slot, which confirms itself and becomes
# the primary.
a_confirmed_version_that_fails_gives_way() {
  local disk=$pc_folder/failing.img first starts
  pc_disk=()
  claimed_disk "$disk" && confirm_both "$disk" && read -r first _ < <(partition_of "$disk" root-b) &&
    head -c 1M /dev/urandom | dd of="$disk" bs=1M seek=$((first / 2048)) conv=notrunc iflag=fullblock status=none && start_pc failing bios "$disk" || return
  await_line 'the cell runs' && log_in || return
  starts=$(console_lines | grep -c 'start: /dev/sda6 is damaged')
  ((starts == 3)) || { echo "it was started $starts times" && return 1; }
  await_line 'the version in slot A has confirmed itself' && await_machine '.slot == "A" and .boot == "fallback" and .slots.A.primary and .slots.B.whole' &&
    await_machine '.notices | any(test("^slot B.* was started three times and did not come up; version .* in slot A runs in its place$"))' &&
    await_machine '.last_failure | .slot == "B" and .starts == 3 and .start == 0 and (.reason | test("before its services ran"))' &&
    ask_machine 200 choose '{"slot": "B", "other_drivers": true}' && await_machine '.slots.B.primary'
}

crashes() { printf '%s\n' '#!/bin/sh' 'exit 2' >"$1/usr/lib/flexrf/pick-station"; } # crashes ROOT: as an application does that has a fault

# The confirmed primary's application ends at once, each time: three restarts of the PC later the other version runs.
a_confirmed_application_that_crashes_gives_way() {
  local disk=$pc_folder/crashing.img pc_limit=1500
  pc_disk=()
  claimed_disk "$disk" && confirm_both "$disk" && change_root "$disk" crashes b && start_pc crashing bios "$disk" || return
  await_line 'the cell runs' && log_in && await_machine '.slot == "A" and .boot == "fallback"' &&
    await_machine '.notices | any(test("^slot B.* was started three times and did not come up"))' &&
    await_machine '.last_failure | .slot == "B" and .starts == 3 and .start == 3 and (.reason | test("did not answer")) and (.lines | any(test("flexrf.service")))' &&
    ask_machine 200 dismiss-failure '{"slot": "B"}' && await_machine '.last_failure == null'
}

# boots_of_two NAME bios|uefi FIRST SECOND: a PC with two disks; its firmware starts the first one, and the kernel sees the second one first or, on USB, later
boots_of_two() {
  # shellcheck disable=SC2054 # the commas are QEMU's
  pc_disk=(-drive "file=${3//,/,,},format=raw,if=none,id=first" -drive "file=${4//,/,,},format=raw,if=none,id=second" -device qemu-xhci)
  case $1 in
    usb*) pc_disk+=(-device ide-hd,drive=first,bootindex=0 -device usb-storage,drive=second) ;;
    from-usb*) pc_disk+=(-device usb-storage,drive=first,bootindex=0 -device ide-hd,drive=second) ;;
    *) pc_disk+=(-device ide-hd,bus=ide.1,drive=first,bootindex=0 -device ide-hd,bus=ide.0,drive=second) ;;
  esac
  start_pc "$1" "$2" none -no-reboot
}

# Two disks of one image, of which one was claimed: the PC runs what its firmware starts, with the data beside it. Two that are copies of
# each other are refused.
two_disks_of_one_image() {
  local claimed_one=$pc_folder/claimed.img new_one=$pc_folder/new.img copy=$pc_folder/copy.img
  need_product && claimed_disk "$claimed_one" && cp --sparse=always "$pc_shared/product.img" "$new_one" && cp --sparse=always "$claimed_one" "$copy" || return
  boots_of_two usb bios "$claimed_one" "$new_one" && await_line 'the cell runs' && log_in || return
  stop_pc
  boots_of_two sata uefi "$claimed_one" "$new_one" && await_line 'the cell runs' && log_in || return
  stop_pc
  boots_of_two from-usb uefi "$new_one" "$claimed_one" && await_line 'Nobody has claimed this PC\. The code is' || return
  stop_pc
  boots_of_two usb-copy bios "$claimed_one" "$copy" && await_line 'start: two disks are copies of each other \(sda5 sdb5\)' || return
  stop_pc
  boots_of_two sata-copy uefi "$copy" "$claimed_one" && await_line 'start: two disks are copies of each other \(sda5 sdb5\)'
}

with_real_camera() { sed -i '/^ExecStart=/s/$/ --hardware camera=v4l2,station_link=tcp,io_station=real/' "$1/etc/systemd/system/flexrf.service"; }
with_real_box() { sed -i '/^ExecStart=/s/$/ --hardware box=gpio/' "$1/etc/systemd/system/flexrf.service"; }

# A camera and a station on the network are waited for, as their drivers have it: the cell runs, and says what it lacks.
a_missing_camera_is_waited_for() {
  local disk=$pc_folder/camera.img
  pc_disk=()
  claimed_disk "$disk" && change_root "$disk" with_real_camera && start_pc camera bios "$disk" -no-reboot && await_line 'the cell runs' &&
    await_line 'there is no camera' && await_line 'Connection refused|port 1502' && log_in && await_line 'motion is permitted'
}

# Without what its emergency stop hangs on the cell does not start: it is tried five times, and then the PC is started anew.
a_missing_chip_is_refused() {
  local disk=$pc_folder/chip.img pc_limit=1000 starts
  pc_disk=()
  claimed_disk "$disk" && change_root "$disk" with_real_box && start_pc chip bios "$disk" -no-reboot || return
  await_line 'not started: .*' || return
  while kill -0 "$pc_pid" 2>/dev/null; do
    (($(pc_seconds) <= pc_limit)) || { echo "the PC does not restart" && return 1; }
    sleep 0.2
  done
  # In the report at its end each says it once more.
  starts=$(console_lines | grep -c -E '\]: \[ +[0-9.]+\] error .* not started: ')
  ((starts == 5)) || { echo "it was started $starts times" && return 1; }
}
