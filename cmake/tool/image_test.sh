# Sourced by flexrf: the image of an industrial PC's disk, tried in a virtual PC (docs/image.md). The product's image is known by its console
# and its panel alone; what runs inside, the variant for tests tells on the console.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

pc_limit=400 # s of the machine's processor time until a PC has come up: alone it takes 60. A host that does much else gives it as much as it likes
pc_folder=$root/build/image/test
pc_console='' pc_pid='' pc_port='' pc_began=0
pc_disk=() # options of QEMU for a disk other than an ordinary one
firmware_of_uefi=/usr/share/OVMF/OVMF_CODE_4M.fd variables_of_uefi=/usr/share/OVMF/OVMF_VARS_4M.fd

start_pc() {  # start_pc NAME bios|uefi DISK [OPTION OF QEMU...]: its panel is at pc_port
  local -a machine
  pc_console=$pc_folder/$1.console
  pc_port=$((20000 + RANDOM % 5000 * 2)) # and the next one, for another address
  : >"$pc_console"
  pc_began=$SECONDS
  # shellcheck disable=SC2054 # the commas are QEMU's
  machine=(-machine q35 -accel tcg -cpu max -smp 2 -m 1024 -display none -device i6300esb -watchdog-action reset
    -nic "user,model=e1000e,hostfwd=tcp:127.0.0.1:$pc_port-:8443,hostfwd=tcp:127.0.0.1:$((pc_port + 1))-10.0.2.16:8443" -serial "file:${pc_console//,/,,}" "${@:4}")
  if ((${#pc_disk[@]})); then
    machine+=("${pc_disk[@]}")
  else
    # shellcheck disable=SC2054 # the commas are QEMU's
    machine+=(-drive "file=${3//,/,,},format=raw,if=none,id=disk" -device ide-hd,drive=disk)
  fi
  if [[ $2 == uefi ]]; then
    cp "$variables_of_uefi" "$pc_folder/$1.variables" || return
    machine+=(-drive "if=pflash,format=raw,readonly=on,file=$firmware_of_uefi"
      -drive "if=pflash,format=raw,file=${pc_folder//,/,,}/$1.variables")
  fi
  # It ends with this script, however that ends.
  setpriv --pdeathsig KILL qemu-system-x86_64 "${machine[@]}" </dev/null >"$pc_folder/$1.qemu" 2>&1 &
  pc_pid=$!
}

stop_pc() {  # as when the power goes, with what it had written on the disk
  [[ $pc_pid ]] || return 0
  kill -KILL "$pc_pid" 2>/dev/null
  wait "$pc_pid" 2>/dev/null
  pc_pid=''
}

# The processor time that it has had, s; or a quarter of the time on the wall, as one that stands still uses none.
pc_seconds() {
  local -a field
  local used wall=$(((SECONDS - pc_began) / 4))
  read -r -a field 2>/dev/null <"/proc/$pc_pid/stat" || field=()
  used=$(((field[13] + field[14]) / $(getconf CLK_TCK)))
  printf '%d\n' $((used > wall ? used : wall))
}

console_lines() { tr -d '\r' <"$pc_console" | sed 's/\x1b\[[0-9;]*m//g'; }

await_line() {  # await_line PATTERN: until the console has a line like it, which it prints; else why not
  local lines
  until lines=$(console_lines | grep -E -e "$1"); do
    if ! kill -0 "$pc_pid" 2>/dev/null; then
      printf 'the PC ended by itself before it said: %s\n' "$1"
      return 1
    elif (($(pc_seconds) > pc_limit)); then
      printf 'in %d s of its processor the PC did not say: %s\n' "$pc_limit" "$1"
      return 1
    fi
    sleep 0.2
  done
  printf '%s\n' "${lines%%$'\n'*}"
}

ask_panel() {  # ask_panel [PATH [OPTION OF CURL...]]
  curl -s -S -k --retry 10 --retry-all-errors --max-time 60 "${@:2}" "https://localhost:$pc_port/${1-}"
}

# A disk whose power went is no damaged disk: nobody is to read that on the screen.
no_complaint() { ! console_lines | grep 'EXT4-fs error'; }

panel_answers() {
  local page
  page=$(ask_panel) || return
  [[ $page == *'<html'* || $page == *'<!doctype html'* || $page == *'<!DOCTYPE html'* ]] && return
  printf 'the panel answers: %s\n' "${page:0:300}"
  return 1
}

fingerprint() {  # of the certificate that the panel shows
  openssl s_client -connect "127.0.0.1:$pc_port" </dev/null 2>/dev/null | openssl x509 -noout -fingerprint -sha256
}

variant_is_made() { (make_image pick-station "$pc_folder/variant.img" 'test'); }

try_to_claim() {  # try_to_claim CODE: prints the status
  local page token
  page=$(ask_panel) || return
  token=$(sed -n 's/.*name="token" value="\([0-9a-f]*\)".*/\1/p' <<<"$page")
  ask_panel claim --retry 0 -o "$pc_folder/claimed.html" -w '%{http_code}\n' --data-urlencode "token=$token" --data-urlencode "code=$1" \
    -d user=anna --data-urlencode 'password=only for this test' --data-urlencode 'repeated=only for this test'
}

# As somebody does who stands before the PC: before that there is its page, and nothing else.
claim_pc() {
  local code
  await_line 'Nobody has claimed this PC\. The code is' >/dev/null || return
  [[ $(ask_panel api/v1/state --retry 0 -o "$pc_folder/state.json" -w '%{http_code}') == 503 && $(try_to_claim 00000-00000) == 403 ]] ||
    { echo "an unclaimed PC answered: $(<"$pc_folder/state.json") $(<"$pc_folder/claimed.html")" && return 1; }
  code=$(console_lines | sed -n 's/.*The code is  \([0-9A-Z-]*\)  at.*/\1/p' | tail -n 1)
  [[ $(try_to_claim "$code") == 200 ]] || { echo "the claim was answered: $(<"$pc_folder/claimed.html")" && return 1; }
  await_line 'This PC is claimed'
}

log_in() {  # again and again where a host that does much else gives the PC no time for it
  local status try
  for try in {1..10}; do
    status=$(ask_panel api/v1/login -c "$pc_folder/cookies" -o "$pc_folder/login.json" -w '%{http_code}' -H 'Content-Type: application/json' \
      -d '{"user": "anna", "password": "only for this test"}')
    [[ $status == 200 ]] && return
    [[ $status == 503 || $status == 429 ]] || break
    sleep "$try"
  done
  echo "the log-in was answered: $(<"$pc_folder/login.json")"
  return 1
}

# shellcheck source=cmake/tool/image_power_test.sh
source "$tool/image_power_test.sh"
# shellcheck source=cmake/tool/image_damage_test.sh
source "$tool/image_damage_test.sh"
# shellcheck source=cmake/tool/image_update_test.sh
source "$tool/image_update_test.sh"
# shellcheck source=cmake/tool/image_panel_test.sh
source "$tool/image_panel_test.sh"
# shellcheck source=cmake/tool/image_menu_test.sh
source "$tool/image_menu_test.sh"

# What a PC promises from its first boot on, while its disk's writes are recorded: nothing moves until its version has been healthy for a
# minute.
record_first_boot() {
  await_line 'first boot: data has [67][0-9][0-9] MiB' && promised identity && claim_pc && promised claimed &&
    await_line 'the cell runs' && panel_answers && log_in &&
    await_line 'motion is not permitted: nobody has claimed this PC' &&
    await_line 'this machine does not permit motion: this version has not confirmed itself' &&
    await_line 'the version in slot A has confirmed itself' && promised confirmed && await_line 'this machine permits motion' &&
    save_often
}

# A disk that is larger than the image; nobody was there before.
first_boot_by_bios() {
  truncate -s +512M "$pc_folder/product.img" && start_recorded_pc bios "$pc_folder/product.img" -no-reboot && record_first_boot &&
    fingerprint >"$pc_folder/fingerprint" && [[ $(console_lines) == *"$(<"$pc_folder/fingerprint")"* ]]
}

# The same disk, after its power went; and something has damaged a copy of the boot choice.
second_boot_by_uefi() {
  printf 'damaged' >"$pc_folder/choice0.env" && mcopy -o -i "$pc_folder/product.img@@2M" "$pc_folder/choice0.env" ::flexrf/ &&
    start_pc uefi uefi "$pc_folder/product.img" -no-reboot && await_line 'choice0.env is damaged: .*; written anew from the other copy' && await_line 'the cell runs' && panel_answers &&
    log_in && await_line 'motion is permitted' || return
  [[ $(fingerprint) == "$(<"$pc_folder/fingerprint")" ]] || { echo "the panel has another certificate than before" && return 1; }
  ! console_lines | grep -E 'first boot|has not confirmed itself|has claimed'
}

what_is_reported() {
  local wrong=0 expected lines
  lines=$(console_lines | sed -n 's/^.*report: //p')
  for expected in 'cell CapEff: 0+' 'cell CapBnd: 0+' 'cell NoNewPrivs: 1' 'cell Seccomp: 2' 'cell Uid: 990.*' 'isolated 1' \
    'mounted / squashfs ro' 'mounted /data ext4 rw' 'device gpiochip[0-9]+' 'device video[0-9]+' 'tcp6? port 8443'; do
    grep -q -x -E "$expected" <<<"$lines" || { printf 'the report lacks: %s\n' "$expected" && wrong=1; }
  done
  # The client of DHCP may listen for its answers.
  grep -E '^(tcp|udp|raw)6? port' <<<"$lines" | grep -v -x -E 'tcp6? port 8443|udp port 68|udp6 port 546|raw6 port 58' && wrong=1
  grep -E '^(interrupt|kernel thread) ' <<<"$lines" && wrong=1
  return "$wrong"
}

# At its first boot the variant tells what runs, stops the cell, and then takes all CPUs for itself for ever: the one ends in the cell
# started anew, the other in the watchdog's reset.
what_runs_and_what_hangs() {
  local pc_limit=1000 # two boots, and two CPUs that are busy until the watchdog acts
  start_pc variant bios "$pc_folder/variant.img" && claim_pc && await_line 'report: complete' && what_is_reported &&
    await_line 'report: the cell is stopped' && await_line 'report: another process is the cell' &&
    await_line 'report: now all hangs' && await_line 'report: boot 2' && [[ $(console_lines | grep -c 'the cell runs') == 3 ]]
}

# Emulated it has not got the time that its threads want: that it starts, and that its page is there, is all that can be asked.
flagship_starts() {
  (make_image visual-servoing "$pc_folder/flagship.img" product) &&
    start_pc flagship bios "$pc_folder/flagship.img" -no-reboot && claim_pc && await_line 'the cell runs' && panel_answers
}

image_test() {  # image_test NUMBER OF NAME MACHINE: a line as ctest's, behind what there is to be read
  local start line told result=Passed
  start=$(microseconds)
  told=$("$3" 2>&1; status=$?; stop_pc; exit "$status") || result=Failed
  [[ $told ]] && printf '%s\n' "$told"
  if [[ $result == Failed ]]; then
    [[ -f $pc_folder/$4.console ]] && pc_console=$pc_folder/$4.console && echo "its console ends with:" && console_lines | tail -n 40
    cat "$pc_folder/$4.qemu" 2>/dev/null
  fi
  line="$1/$2 Test #$1: $3 "
  while ((${#line} < 60)); do line+=.; done
  printf '%s   %s  %s\n' "$line" "$result" "$(since "$start")"
  [[ $result == Passed ]]
}

# Name, which is that of a function; the machine whose console tells why it failed; and the lane: the two go on beside each other, as a
# PC keeps hardly more than one processor busy. In a lane one comes after the other: they share disks.
image_test_list() {
  cat <<'TEXT'
first_boot_by_bios bios product
second_boot_by_uefi uefi product
what_a_power_cut_leaves cut product
data_beyond_repair damaged product
an_admin_at_the_panel admin product
grubs_menu_wants_a_password menu product
variant_is_made none variant
what_runs_and_what_hangs variant variant
updates_are_made none variant
updates_by_bundles update variant
an_update_is_cut_short cut variant
TEXT
  [[ ${FLEXRF_LONG-} ]] || return 0
  cat <<'TEXT'
a_missing_flush_is_found twin product
data_made_anew_stays anew product
data_is_repaired repaired product
data_is_full full product
data_is_missing missing product
a_missing_camera_is_waited_for camera product
a_missing_chip_is_refused chip product
flagship_starts flagship variant
TEXT
}

image_lane() {  # image_lane LANE: its tests, in a folder of its own; leaves the number of those that failed
  local number=1 failed=0 name machine lane
  [[ $1 == product ]] || pc_folder=$pc_folder/$1
  mkdir -p "$pc_folder"
  while read -r name machine lane; do
    number=$((number + 1))
    [[ $lane == "$1" ]] || continue
    image_test "$number" "$image_test_count" "$name" "$machine" </dev/null || failed=$((failed + 1))
  done < <(image_test_list)
  echo "$failed" >"$pc_folder/failed"
}

image_tests() {  # as ctest would run them
  local failed=0 lane
  image_test_count=$(($(image_test_list | wc -l) + 1))
  rm -rf "$pc_folder"
  mkdir -p "$pc_folder"
  if ! build release pick-station visual-servoing flexrf-boot-choice flexrf-claim flexrf-helper flexrf-power-cut flexrf-password \
    boot_choice_what_boots flexrf_without_flush; then
    count 1 1
    return 1
  fi
  # The first image fetches what all are made of.
  image_test 1 "$image_test_count" product_and_update_are_made none || failed=1
  set -m # a group of processes of its own, which ends as one
  image_lane variant >"$pc_folder/variant.log" 2>&1 &
  lane=$!
  set +m
  # shellcheck disable=SC2064 # the group of now
  trap "kill -TERM -- -$lane 2>/dev/null" EXIT
  image_lane product
  wait "$lane"
  trap - EXIT
  cat "$pc_folder/variant.log"
  failed=$((failed + $(cat "$pc_folder/failed") + $(cat "$pc_folder/variant/failed")))
  count "$image_test_count" "$failed"
  rm -rf "$pc_folder"/{,variant/}*.{img,base,log,raucb} "$pc_folder/variant/update"
  printf '\n%d%% tests passed, %d tests failed out of %d\n' $(((image_test_count - failed) * 100 / image_test_count)) "$failed" "$image_test_count"
  ((failed == 0))
}
