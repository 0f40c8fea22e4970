# Sourced by image_test.sh: a PC gets other versions by bundles (docs/image.md). They are on a second disk, and a unit of the variant for
# tests takes them as the helper takes those of a person; one of them is good, one starts a program that crashes, and others have to be
# refused.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

# pack_other NAME COMPATIBLE BUILT [DRIVERS]: a bundle that is none to boot, for what is refused before anybody looks into it
pack_other() (
  small=$pc_folder/update/small
  rm -rf "$small"
  mkdir -p "$small/identity"
  head -c 65536 /dev/urandom >"$small/root.img"
  head -c 65536 /dev/urandom >"$small/boot.img"
  printf '%s\n' application=pick-station "version=$1" "built=$3" "drivers=${4-$drivers_of_first}" >"$small/identity/version"
  pack_bundle "$small" "$2" "$pc_folder/update/bundles/$1"
)

sign_otherwise() {  # sign_otherwise NAME FORMAT IMAGE...: the small bundle's parts, in another format, or not all of them
  local small=$pc_folder/update/small image
  rm "$small/bundle"/manifest.raucm*
  printf '%s\n' '[update]' compatible=flexrf-pick-station-amd64 "version=$1" '[bundle]' "format=$2" >"$small/bundle/manifest.raucm"
  for image in "${@:3}"; do printf '%s\n' "[image.$image]" "filename=$image.img"; done >>"$small/bundle/manifest.raucm"
  rauc --conf="$small/system.conf" --key="$image_key" --cert="$image_certificate" --keyring="$image_keyring" \
    bundle "$small/bundle" "$pc_folder/update/bundles/$1" >"$small/said" 2>&1 || { cat "$small/said" && return 1; }
}

pack_others() {
  local built=$1 bundles=$pc_folder/update/bundles drivers_of_first=$2
  pack_other foreign flexrf-keyboard-amd64 "$built" && pack_other older flexrf-pick-station-amd64 1 &&
    pack_other other-drivers flexrf-pick-station-amd64 "$built" "${drivers_of_first/camera=simulated/camera=v4l2}" || return
  mksquashfs "$pc_folder/update/small/bundle" "$bundles/unsigned" -quiet -no-progress >/dev/null || return
  sign_otherwise plain plain root boot && sign_otherwise half verity root || return
  mkdir -p "$pc_folder/update/keys" && make_keys "$pc_folder/update/keys" 'FlexRF test' || return
  (
    image_key=$pc_folder/update/keys/signer.key image_certificate=$pc_folder/update/keys/signer.pem image_keyring=$pc_folder/update/keys/ca.pem
    pack_other other-key flexrf-pick-station-amd64 "$built"
  )
}

# bind_boot BOOT ROOT: says in the partition with the kernel which root belongs to it, as the start of the PC compares
bind_boot() {
  local work=$1.slot PATH=$PATH:/usr/sbin:/sbin options
  debugfs -R "dump slot.env $work" "$1" 2>/dev/null && options=$(sed -n 's/^slot_options=\(.*\) flexrf\.root=.*/\1/p' "$work") &&
    slot_block "$options" "$2" >"$work" && printf '%s\n' 'rm slot.env' "write $work slot.env" | debugfs -w -f - "$1" >/dev/null 2>&1 && rm "$work"
}

pack_changed() {  # pack_changed WORK VERSION OUTPUT: a bundle of the root as it was changed
  sed -i "s/^version=.*/version=$2/" "$1/identity/version" "$1/root/usr/lib/flexrf/version" &&
    pack_root "$1/root" "$1/root.img" && bind_boot "$1/boot.img" "$1/root.img" && pack_bundle "$1" flexrf-pick-station-amd64 "$3"
}

# The first version of the variant for tests as a disk, others as bundles, and the disk that they are on.
make_updates() (
  pc_folder=$pc_shared/variant work=$pc_folder/update
  rm -rf "$work"
  mkdir -p "$work/bundles"
  image_version=first
  make_version "$work" pick-station 'test'
  make_disk "$work" pick-station "$pc_folder/first.img"
  unsquashfs -q -n -d "$work/root" "$work/root.img" >/dev/null || return
  pack_changed "$work" second "$work/bundles/second" && cp "$work/boot.img" "$pc_folder/second-boot" && cp "$work/root.img" "$pc_folder/second-root" || return
  # It ends as one does that had a fault.
  printf '%s\n' '#!/bin/sh' 'exit 2' >"$work/root/usr/lib/flexrf/pick-station"
  pack_changed "$work" broken "$work/bundles/broken" || return
  pack_others "$SOURCE_DATE_EPOCH" "$(sed -n 's/^drivers=//p' "$work/identity/version")" || return
  PATH=$PATH:/usr/sbin:/sbin mke2fs -q -t ext4 -L bundles -d "$work/bundles" "$pc_folder/bundles.img" 256M && rm -rf "$work"
)

need_variant() { make_once "$pc_shared/variant/bundles.img" make_updates; }

updates_are_made() {
  rm -f "$pc_shared/variant/bundles.img"
  need_variant
}

set_speed() {  # set_speed VALUE: at the panel, and it is saved
  local status
  log_in && ask_panel api/v1/control/take -b "$pc_folder/cookies" -o "$pc_folder/taken.json" -X POST || return
  status=$(ask_panel api/v1/components/pick/parameters -b "$pc_folder/cookies" -o "$pc_folder/set.json" -w '%{http_code}' -X PUT \
    -H 'Content-Type: application/json' -d "{\"speed\": $1}") &&
    status+=$(ask_panel api/v1/save-values -b "$pc_folder/cookies" -o "$pc_folder/saved.json" -w '%{http_code}' -X POST)
  [[ $status == 200200 ]] || { printf 'the speed was answered: %s %s\n' "$status" "$(<"$pc_folder/set.json")" && return 1; }
}

# The PC's clock is years behind the keys, its power stays on, and what it writes is recorded. Three boots of the broken version end in the one before it.
updates_by_bundles() {
  local pc_limit=1500 why
  # shellcheck disable=SC2054 # the commas are QEMU's
  need_variant && cp --sparse=always "$pc_shared/variant/first.img" "$pc_folder/update.img" &&
    start_recorded_pc update "$pc_folder/update.img" -rtc base=2010-01-01 \
    -drive "file=${pc_shared//,/,,}/variant/bundles.img,format=raw,if=none,id=bundles" -device ide-hd,drive=bundles &&
    claim_pc && promised claimed && await_line 'update test: version first in slot a runs as only' || return
  for why in 'verify unsigned: failed +it is no bundle, or not all of one' 'verify plain: failed +its format is plain' \
    'verify other-key: failed +it is not signed by a key that this PC trusts' 'verify foreign: failed +it is for flexrf-keyboard-amd64' \
    'verify half: failed +it does not hold the two partitions' 'verify older: done older' \
    'install older: failed older the version older is older than the one that runs' 'install older: done older' \
    'install other-drivers: failed other-drivers the devices of version other-drivers have other drivers' \
    'install other-drivers: done other-drivers' \
    'verify truncated: failed +it is no bundle, or not all of one' 'verify damaged: failed +its content is damaged' \
    'install damaged: failed .*its content is damaged' 'after that: primary=A A=whole,[a-z]+ B=not-whole' 'verify nothing: failed +there is no bundle'; do
    await_line "update test: $why" || return
  done
  set_speed 0.555 && promised saved && await_line 'update test: verify second: done second' && promised installing &&
    await_line 'update test: install second: done second' && promised installed &&
    await_line 'update test: after that: primary=B A=whole,[a-z]+ B=whole,unconfirmed' &&
    await_line 'update test: version second in slot b runs as trial' && await_line 'update test: configuration: a 0.555 b 0.555' &&
    await_line 'the version in slot B has confirmed itself' && promised confirmed && set_speed 0.777 && promised saved-anew &&
    await_line 'update test: configuration: a 0.555 b 0.777' && await_line 'update test: install broken: done broken' &&
    await_line 'update test: version second in slot b runs as fallback' && await_line 'update test: configuration: b 0.777' &&
    await_line 'update test: complete: primary=B' && ! console_lines | grep -E 'update test: (left of it|.* is still allowed)' || return
  stop_pc
  punch_versions "$pc_folder/update.base" && keep update "$pc_folder"/update.{base,log,promises} "$pc_shared"/variant/second-{boot,root}
}

# A cut in the update that was recorded, from the verified bundle to the first save of the confirmed version: anywhere, and around what
# changes which version boots.
points_of_update() {  # points_of_update COUNT STEP SEED
  local installing installed confirmed end
  read -r installing installed confirmed end < <(awk '$2 ~ /^(installing|installed|confirmed|saved-anew)$/ { printf "%s ", $1 }' "$pc_folder/update.promises") ||
    [[ $end ]] || return
  {
    shuf -i "$installing-$end" -n "$1" --random-source=<(yes "$3")
    seq "$installing" "$2" $((installing + 60))
    seq $((installed - 60)) "$2" $((installed + 8))
    seq $((confirmed - 20)) "$2" $((confirmed + 8))
  } | awk -v last="$end" '$1 <= last' | sort -n -u
}

speed_saved() { file_of_data "$1" "flexrf/config-$2.xml" | sed -n 's|.*<speed>\(.*\)</speed>.*|\1|p'; } # speed_saved DATA SLOT

check_configurations() {  # check_configurations WORK POINT: the old version's is as it was, whatever the new one writes
  local a b
  a=$(speed_saved "$1/data" a) b=$(speed_saved "$1/data" b)
  if [[ $a != 0.555 ]]; then
    echo "lost configuration: that of slot A has the speed '$a'"
  elif is_in_data "$1/data" flexrf/config-b.xml && [[ $b != 0.555 && $b != 0.777 ]]; then
    echo "lost configuration: that of slot B has the speed '$b'"
  elif [[ $(promise_at update "$2" saved-anew) && $b != 0.777 ]]; then
    echo "lost configuration: a save of the new version was answered, and slot B has the speed '$b'"
  else
    return 0
  fi
  return 1
}

check_started_version() {  # check_started_version WORK POINT: what GRUB starts is the one version or the other, and all of it is there
  local said boots part wanted='@(A\ @(only|confirmed|fallback)|B\ trial)'
  [[ ! $(promise_at update "$2" installed) ]] || wanted='B\ @(trial|confirmed)'
  [[ ! $(promise_at update "$2" confirmed) ]] || wanted='B\ confirmed'
  said=$(what_boots "$1")
  boots=$(tail -n 1 <<<"$said")
  # shellcheck disable=SC2053 # a pattern
  [[ $boots == $wanted ]] || { printf 'lost choice: what boots is not %s: %s\n' "$wanted" "$said" && return 1; }
  for part in boot root; do
    if [[ $boots == A* ]]; then
      take_partition "$1/cut" "$part-a" "$1/part" && cmp "$1/part" "$pc_folder/first-$part"
    else
      take_partition "$1/cut" "$part-b" "$1/part" && cmp -n "$(stat -c %s "$recorded/second-$part")" "$1/part" "$recorded/second-$part"
    fi || { echo "lost version: GRUB starts $boots, and not all of its $part is there" && return 1; }
  done
}

judge_update() {  # judge_update RECORDING POINT WORK: the disk that a cut in the update may leave
  local status=0
  rm -rf "$3" && mkdir -p "$3" || return
  if power_cut build "$1" --point "$2" --seed "$2" --output "$3/cut" && check_file_systems "$3"; then
    check_users "$3" "$1" "$2" || status=1
    check_configurations "$3" "$2" || status=1
    check_started_version "$3" "$2" || status=1
  else
    status=1
  fi
  ((status == 0)) || echo "at point $2, seed $2"
  return "$status"
}

cuts_of_update() {  # cuts_of_update COUNT STEP SEED PROGRESS
  local points part
  need_recording update update updates_by_bundles && power_cut describe update || return
  # The slots of the recording's first disk are holes: a cut must not have put anything there.
  for part in boot root; do take_partition "$pc_folder/update.base" "$part-a" "$pc_folder/first-$part" || return; done
  points=$(points_of_update "$1" "$2" "$3") || return
  judge_points "$4" 0 judge_update update <<<"$points"
}

an_update_is_cut_short() { cuts_of_update 12 6 1 "$pc_folder/judged"; }
more_cuts_of_an_update() { cuts_of_update 40 3 2 "$pc_folder/judged.more"; }

# Goes on where it was interrupted, as long as the recording is that of the same image.
campaign_of_cuts_of_an_update() {
  once update updates_by_bundles && cuts_of_update 200 1 3 "$(kept update)/progress"
}
