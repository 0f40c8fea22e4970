# Sourced by flexrf: the image of an industrial PC's disk, tried in a virtual PC (docs/image.md). The product's image is known by its console
# and its panel alone; what runs inside, the variant for tests tells on the console.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

pc_limit=400 # s of the machine's processor time until a PC has come up: alone it takes 60. A host that does much else gives it as much as it likes
pc_shared=$root/build/image/test # of all groups of tests; each has a folder in it
pc_folder=$pc_shared
pc_console='' pc_pid='' pc_port='' pc_began=0
pc_disk=() # options of QEMU for a disk other than an ordinary one
firmware_of_uefi=/usr/share/OVMF/OVMF_CODE_4M.fd variables_of_uefi=/usr/share/OVMF/OVMF_VARS_4M.fd
ticks_per_second=$(getconf CLK_TCK)
# The time of each version of the tests, so that the same inputs give the same image, whatever the last commit is.
time_of_test_version=1767225600

# shellcheck source=cmake/tool/image_kept.sh
source "$tool/image_kept.sh"

# start_pc NAME bios|uefi DISK [OPTION OF QEMU...]: its panel is at pc_port, its monitor reads to_monitor and answers in from_monitor
start_pc() {
  local -a machine
  local monitor=$pc_folder/$1.monitor
  pc_console=$pc_folder/$1.console
  printf '%s\n' "$1" >"$pc_folder/machine" # whose console tells why a test failed
  pc_port=$((20000 + RANDOM % 5000 * 2)) # and the next one, for another address
  : >"$pc_console"
  pc_began=$SECONDS
  rm -f "$monitor".{in,out}
  mkfifo "$monitor".{in,out} && exec {to_monitor}<>"$monitor.in" {from_monitor}<>"$monitor.out" || return
  # shellcheck disable=SC2054 # the commas are QEMU's
  machine=(-machine q35 -accel tcg -cpu max -smp 2 -m 1024 -display none -device i6300esb -watchdog-action reset
    -nic "user,model=e1000e,hostfwd=tcp:127.0.0.1:$pc_port-:8443,hostfwd=tcp:127.0.0.1:$((pc_port + 1))-10.0.2.16:8443"
    -serial "file:${pc_console//,/,,}" -monitor "pipe:${monitor//,/,,}" "${@:4}")
  if ((${#pc_disk[@]})); then
    machine+=("${pc_disk[@]}")
  else
    # shellcheck disable=SC2054 # the commas are QEMU's
    machine+=(-drive "file=${3//,/,,},format=raw,if=none,id=disk" -device ide-hd,drive=disk)
  fi
  if [[ $2 == uefi ]]; then
    [[ -f $pc_folder/$1.variables ]] || cp "$variables_of_uefi" "$pc_folder/$1.variables" || return
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
  exec {to_monitor}>&- {from_monitor}>&-
}

# save_pc FILE: writes its memory and the state of its devices, and ends it; its disk stays as it is at that moment
save_pc() {
  local said='' part file=${1//,/,,} limit=$(($(pc_seconds) + pc_limit))
  printf '%s\n' 'migrate_set_parameter max-bandwidth 10G' "migrate \"exec:zstd -q -1 -T1 -f -o '$file'\"" 'info migrate' quit >&"$to_monitor"
  while kill -0 "$pc_pid" 2>/dev/null; do
    (($(pc_seconds) <= limit)) || { echo "in $pc_limit s of its processor the PC was not saved" && return 1; }
    while IFS= read -r -t 0.2 -u "$from_monitor" part; do said+=$part$'\n'; done
  done
  while IFS= read -r -t 0.01 -u "$from_monitor" part; do said+=$part$'\n'; done
  stop_pc
  [[ $said == *'Migration status: completed'* ]] || { printf 'the PC was not saved: %s\n' "$said" && return 1; }
}

# restore_pc FILE NAME bios|uefi DISK [OPTION OF QEMU...]: goes on where save_pc had ended a PC with the same devices; its console begins anew
restore_pc() {
  local said='' part
  start_pc "${@:2}" -incoming "exec:zstd -q -d -c '${1//,/,,}'" || return
  until [[ $said == *'VM status: running'* ]]; do
    if ! kill -0 "$pc_pid" 2>/dev/null || (($(pc_seconds) > pc_limit)); then
      printf 'the PC does not go on where it was saved: %s\n' "$(<"$pc_folder/$2.qemu")"
      return 1
    fi
    printf 'info status\n' >&"$to_monitor"
    while IFS= read -r -t 0.2 -u "$from_monitor" part; do said+=$part$'\n'; done
  done
}

# The processor time that it has had, s; or a quarter of the time on the wall, as one that stands still uses none.
pc_seconds() {
  local -a field
  local used wall=$(((SECONDS - pc_began) / 4))
  read -r -a field 2>/dev/null <"/proc/$pc_pid/stat" || field=()
  used=$(((field[13] + field[14]) / ticks_per_second))
  printf '%d\n' $((used > wall ? used : wall))
}

console_lines() { tr -d '\r' <"$pc_console" | sed 's/\x1b\[[0-9;]*m//g'; }

await_line() {  # await_line PATTERN: until the console has a line like it, which it prints; else why not
  local lines size=-1 seen=-1
  until [[ $size != "$seen" ]] && seen=$size && lines=$(console_lines | grep -E -e "$1"); do
    size=$(stat -c %s "$pc_console")
    if [[ $size != "$seen" ]]; then
      continue
    elif ! kill -0 "$pc_pid" 2>/dev/null; then
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

# The text on the PC's screen. A PC that boots by BIOS has it in memory; characters that are not ASCII are read as blanks.
screen() {
  local text=$pc_folder/screen.text
  rm -f "$text"
  printf 'pmemsave 0xb8000 4000 "%s"\n' "$text" >&"$to_monitor"
  until [[ $(stat -c %s "$text" 2>/dev/null) == 4000 ]]; do kill -0 "$pc_pid" 2>/dev/null && sleep 0.05 || return; done
  # A character and its colours, 80 times in a line.
  od -A n -v -t u1 -w2 "$text" | awk '{ printf "%c", ($1 >= 32 && $1 < 127) ? $1 : 32 } NR % 80 == 0 { print "" }' | sed 's/ *$//; /^$/d'
}

await_screen() {  # await_screen PATTERN [KEY]: which is pressed again and again
  local shown
  until shown=$(screen) && grep -q -E -e "$1" <<<"$shown"; do
    if ! kill -0 "$pc_pid" 2>/dev/null || (($(pc_seconds) > pc_limit)); then
      printf 'the screen never showed: %s; but:\n%s\n' "$1" "$shown"
      return 1
    fi
    [[ ! ${2-} ]] || press "$2"
    sleep 0.2
  done
}

ask_panel() {  # ask_panel [PATH [OPTION OF CURL...]]
  curl -s -S -k --retry 10 --retry-all-errors --max-time 300 "${@:2}" "https://localhost:$pc_port/${1-}"
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

try_to_claim() {  # try_to_claim CODE [OPTION OF CURL...]: prints the status
  local page token
  page=$(ask_panel) || return
  token=$(sed -n 's/.*name="token" value="\([0-9a-f]*\)".*/\1/p' <<<"$page")
  ask_panel claim --retry 0 -o "$pc_folder/claimed.html" -w '%{http_code}\n' --data-urlencode "token=$token" --data-urlencode "code=$1" \
    -d user=anna --data-urlencode 'password=only for this test' --data-urlencode 'repeated=only for this test' "${@:2}"
}

# As somebody does who stands before the PC: before that there is its page, and nothing else.
claim_pc() {  # claim_pc [OPTION OF CURL...]
  local code
  await_line 'Nobody has claimed this PC\. The code is' >/dev/null || return
  await_screen 'Nobody has claimed this PC\. Open its page, and type the code  [0-9A-Z]{5}-[0-9A-Z]{5}$' && await_screen '^  https://10\.0\.2\.15:8443/$' || return
  [[ $(ask_panel api/v1/state --retry 0 -o "$pc_folder/state.json" -w '%{http_code}') == 503 && $(try_to_claim 00000-00000) == 403 ]] ||
    { echo "an unclaimed PC answered: $(<"$pc_folder/state.json") $(<"$pc_folder/claimed.html")" && return 1; }
  screen >"$pc_folder/screen-unclaimed.text" && code=$(sed -n 's/.*type the code  //p' "$pc_folder/screen-unclaimed.text")
  [[ $code == "$(console_lines | sed -n 's/.*The code is  \([0-9A-Z-]*\)  at.*/\1/p' | tail -n 1)" ]] || { echo "screen and serial line show two codes" && return 1; }
  [[ $(try_to_claim "$code" "$@") == 200 ]] || { echo "the claim was answered: $(<"$pc_folder/claimed.html")" && return 1; }
  await_line 'This PC is claimed'
}

log_in() {  # again and again where a host that does much else gives the PC no time for it
  local status try
  for try in {1..10}; do
    # Without the retries of curl, which wait longer each time.
    status=$(ask_panel api/v1/login --retry 0 -c "$pc_folder/cookies" -o "$pc_folder/login.json" -w '%{http_code}' -H 'Content-Type: application/json' \
      -d '{"user": "anna", "password": "only for this test"}')
    [[ $status == 200 ]] && return
    [[ $status == 000 || $status == 503 || $status == 429 ]] || break
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

# version_of_test FUNCTION ARGUMENT...: a version whose content does not depend on the last commit, and which is packed in a shorter time
version_of_test() {
  local SOURCE_DATE_EPOCH=$time_of_test_version compression_of_root=(-Xcompression-level 3)
  export SOURCE_DATE_EPOCH
  "$@"
}

make_product() (  # the disk of the product as it comes from the tool
  image_version=first image_boot_password=$menu_hash
  make_image pick-station "$pc_shared/product.img" product
)

# make_once FILE COMMAND...: carries out the command unless there is the file. One image at a time is made, for they share a kernel and packages
make_once() (
  exec 9>"$pc_shared/making.lock"
  flock 9
  [[ -f $1 ]] || version_of_test "${@:2}" 9>&-
)

need_product() { make_once "$pc_shared/product.img" make_product; }

product_is_made() {
  [[ $(unset SOURCE_DATE_EPOCH && time_of_version) == $(git -C "$root" log -1 --format=%ct 2>/dev/null || date +%s)* ]] ||
    { echo "a version without SOURCE_DATE_EPOCH has not the time of the last commit" && return 1; }
  rm -f "$pc_shared/product.img"
  need_product
}

# What a PC promises from its first boot on, while its disk's writes are recorded: nothing moves until its version has been healthy for a
# minute.
record_first_boot() {
  await_line 'first boot: data has [67][0-9][0-9] MiB' && promised identity && claim_pc && promised claimed &&
    await_line 'the cell runs' && panel_answers && log_in &&
    await_line 'motion is not permitted: nobody has claimed this PC' &&
    await_line 'this machine does not permit motion: this version has not confirmed itself' &&
    await_line 'the version in slot A has confirmed itself' && promised confirmed && await_line 'this machine permits motion' &&
    await_screen '^The cell runs, and all is well\.$' && await_screen '^Nothing may move before Start is given at the panel\.$'
}

# A disk that is larger than the image; nobody was there before. The PC is kept as it is when its version has confirmed itself.
first_boot_by_bios() {
  local disk=$pc_folder/bios.img
  need_product && cp --sparse=always "$pc_shared/product.img" "$disk" && truncate -s +512M "$disk" &&
    start_recorded_pc bios "$disk" -no-reboot && record_first_boot && fingerprint >"$pc_folder/fingerprint" || return
  [[ $(console_lines) == *"$(<"$pc_folder/fingerprint")"* ]] || { echo "the console does not show the certificate's fingerprint" && return 1; }
  [[ $(tr -d ' :\n' <"$pc_folder/screen-unclaimed.text") == *"$(sed 's/.*=//' "$pc_folder/fingerprint" | tr -d :)"* ]] || { echo "the screen does not show it" && return 1; }
  own_identifiers "$disk" && keeps_room "$disk" || return
  save_pc "$pc_folder/bios.memory" && punch_versions "$pc_folder/bios.base" && keep claimed "$pc_folder"/bios.{img,memory,base,log,promises} "$pc_folder/fingerprint"
}

own_identifiers() {  # own_identifiers DISK: it has none of its image's
  local shared PATH=$PATH:/usr/sbin:/sbin
  shared=$(for disk in "$pc_shared/product.img" "$1"; do sfdisk -q -J "$disk" | jq -r '.partitiontable | .id, .partitions[].uuid' | sort -u; done | sort | uniq -d)
  [[ ! $shared ]] || { printf 'the disk has identifiers of its image: %s\n' "$shared" && return 1; }
}

keeps_room() {  # keeps_room DISK: a quarter of data, which is smaller than 2 GiB, is root's
  local first total reserved PATH=$PATH:/usr/sbin:/sbin
  read -r first _ < <(partition_of "$1" data) && read -r total reserved < <(dumpe2fs -h "$1?offset=$((first * 512))" 2>/dev/null |
    awk -F : '$1 == "Block count" { total = $2 } $1 == "Reserved block count" { print total + 0, $2 + 0 }') || return
  ((reserved * 100 > total * 24 && reserved * 100 < total * 26)) || { echo "of $total blocks of data $reserved are root's" && return 1; }
}

need_claimed_pc() {  # sets claimed to the folder of the PC that first_boot_by_bios keeps
  once claimed first_boot_by_bios && claimed=$(kept claimed)
}

# The same disk, after its power went; and something has damaged a copy of the boot choice. The PC is kept for what an admin does to it.
second_boot_by_uefi() {
  local disk=$pc_folder/uefi.img
  rm -f "$pc_folder/uefi.variables"
  need_claimed_pc && cp --sparse=always "$claimed/bios.img" "$disk" &&
    printf 'damaged' >"$pc_folder/choice0.env" && mcopy -o -i "$disk@@2M" "$pc_folder/choice0.env" ::flexrf/ &&
    start_pc uefi uefi "$disk" -no-reboot && await_line 'choice0.env is damaged: .*; written anew from the other copy' && await_line 'the cell runs' && panel_answers &&
    log_in && await_line 'motion is permitted' && no_complaint &&
    await_machine '.notices | length == 1 and (.[0] | test("choice0.env is damaged"))' || return
  [[ $(fingerprint) == "$(<"$claimed/fingerprint")" ]] || { echo "the panel has another certificate than before" && return 1; }
  ! console_lines | grep -E 'first boot|has not confirmed itself|has claimed' || return
  save_pc "$pc_folder/uefi.memory" && keep uefi "$pc_folder"/uefi.{img,memory,variables}
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
  need_variant && cp --sparse=always "$pc_shared/variant/first.img" "$pc_folder/variant.img" &&
    start_pc variant bios "$pc_folder/variant.img" && claim_pc && await_line 'report: complete' && what_is_reported &&
    await_line 'report: the cell is stopped' && await_line 'report: another process is the cell' &&
    await_line 'report: now all hangs' && await_line 'report: boot 2' && [[ $(console_lines | grep -c 'the cell runs') == 3 ]]
}

# Emulated it has not got the time that its threads want: that it starts, and that its page is there, is all that can be asked.
flagship_starts() {
  make_once "$pc_folder/flagship.img" make_image visual-servoing "$pc_folder/flagship.img" product &&
    start_pc flagship bios "$pc_folder/flagship.img" -no-reboot && claim_pc && await_line 'the cell runs' && panel_answers
}

# Name, which is that of a function; level, which is one of image_levels; and group. The tests of a group share a folder, and one comes
# after the other. Lanes take groups in this order.
image_levels=(first gate full soak)
image_test_list() {
  cat <<'TEXT'
product_is_made first boot
first_boot_by_bios first boot
updates_are_made gate variant
updates_by_bundles gate variant
an_update_is_cut_short gate variant
what_a_power_cut_leaves gate cut
second_boot_by_uefi full uefi
an_admin_at_the_panel full uefi
what_runs_and_what_hangs full report
data_beyond_repair full damage
grubs_menu_wants_a_password full menu
grub_without_its_file_restarts full menu
more_power_cuts full cut
a_missing_flush_is_found full twin
more_cuts_of_an_update full variant
a_missing_chip_is_refused full chip
flagship_starts full flagship
data_made_anew_stays full damage
data_is_repaired full damage
damaged_users_lead_to_a_claim full damage
data_is_full full damage
written_anew_it_is_as_before full anew
data_is_missing full missing
a_confirmed_version_that_fails_gives_way full failing
a_confirmed_application_that_crashes_gives_way full crashing
two_disks_of_one_image full disks
a_missing_camera_is_waited_for full camera
campaign_of_power_cuts soak cut
campaign_of_cuts_of_an_update soak variant
TEXT
}

image_lanes=${FLEXRF_IMAGE_LANES:-2} # groups of tests that go on beside each other: a PC keeps hardly more than one processor busy

image_targets() {  # image_targets LEVEL: what its tests need of the release build
  printf '%s\n' pick-station flexrf-boot-choice flexrf-claim flexrf-helper flexrf-screen
  [[ $1 == first ]] || printf '%s\n' flexrf-power-cut flexrf-password boot_choice_what_boots
  [[ $1 != full ]] || printf '%s\n' visual-servoing flexrf_without_flush
}

build_image_programs() {  # build_image_programs LEVEL
  local -a targets
  mapfile -t targets < <(image_targets "$1")
  build release "${targets[@]}"
}

find_images() {  # of what the images of the tests are; once, when the programs are built
  [[ ! $image_inputs ]] || return 0
  mkdir -p "$image_folder" "$pc_shared" && choose_keys 2>"$pc_shared/keys.log" || return
  image_inputs=$(find_image_inputs) || { say "a package of the image is not in this machine's lists" && return 1; }
}

# image_test_key NAME: a checksum of all that the test depends on, when its programs are built; one that passed with it would pass again.
# Fails if that cannot be known, as without package lists.
image_test_key() {
  local level
  level=$(image_test_list | awk -v name="$1" '$1 == name { print $2 }')
  find_images && (
    cd "$root/build/release" && {
      printf '%s %s\n' "$1" "$(image_key)"
      [[ $level == first ]] || sha256sum "${judging_programs[@]}"
      [[ $level != full ]] || { sha256sum image/power_cut/without_flush.so apps/visual-servoing/visual-servoing && cat "$root/apps/visual-servoing/config.xml" 2>/dev/null; }
    } | sha256sum | head -c 32
  )
}

image_test() {  # image_test NUMBER NAME: a line as ctest's, behind what there is to be read
  local start line told result=Passed machine used
  start=$(microseconds)
  rm -f "$pc_folder/machine"
  told=$(
    "$2" 2>&1
    status=$?
    stop_pc
    times >"$pc_folder/times"
    exit "$status"
  ) || result=Failed
  # The second line is about the processes that it started, the PC among them: as 1m2.345s 0m1.234s.
  used=$(awk 'NR == 2 { split($0, part, /[ms ]+/); printf "%.1f", part[1] * 60 + part[2] + part[3] * 60 + part[4] }' "$pc_folder/times")
  (
    flock 9
    [[ $told ]] && printf '%s\n' "$told"
    if [[ $result == Failed && -f $pc_folder/machine ]]; then
      read -r machine <"$pc_folder/machine"
      pc_console=$pc_folder/$machine.console
      echo "its console ends with:"
      console_lines | tail -n 40
      cat "$pc_folder/$machine.qemu" 2>/dev/null
    fi
    line="$1/$image_test_count Test #$1: $2 "
    while ((${#line} < 60)); do line+=.; done
    printf '%s   %s  %s, %s s of processor time\n' "$line" "$result" "$(since "$start")" "$used"
  ) 9>"$pc_shared/.reporting"
  printf '%s\n' "$result" >>"$pc_shared/.results"
}

next_group() {  # prints one that is no lane's yet; fails when there is none
  (
    flock 9
    sed -n 1p "$pc_shared/.groups" | grep . && sed -i 1d "$pc_shared/.groups"
  ) 9>"$pc_shared/.taking"
}

image_lane() {  # one group after the other, until none is left
  local group number name
  while group=$(next_group); do
    pc_folder=$pc_shared/$group
    mkdir -p "$pc_folder"
    while read -r number name _ _; do
      image_test "$number" "$name" </dev/null
    done < <(awk -v group="$group" '$4 == group' "$pc_shared/.chosen")
  done
}

# image_tests LEVEL [NAME...]: after build_image_programs, the tests of this level, or these of them; what they need of other levels' is taken as it was kept, or made
image_tests() {
  local failed lane name
  local -a lanes=() names
  rm -rf "$pc_shared"
  mkdir -p "$pc_shared"
  image_test_list | awk -v level="$1" '$2 == level' >"$pc_shared/.level"
  mapfile -t names < <(cut -d ' ' -f 1 "$pc_shared/.level")
  for name in "${@:2}"; do known_word "test of the image" "$name" "${names[@]}"; done
  awk -v names=" ${*:2} " 'names == "  " || index(names, " " $1 " ") { print ++number, $0 }' "$pc_shared/.level" >"$pc_shared/.chosen"
  image_test_count=$(wc -l <"$pc_shared/.chosen")
  awk '!seen[$4]++ { print $4 }' "$pc_shared/.chosen" >"$pc_shared/.groups"
  : >"$pc_shared/.results"
  find_images || { count 1 1 && return 1; }
  set -m # groups of processes of their own, which end as one
  for ((lane = 0; lane < image_lanes; ++lane)); do
    image_lane &
    lanes+=($!)
  done
  set +m
  # shellcheck disable=SC2064 # the groups of now
  trap "kill -TERM -- ${lanes[*]/#/-} 2>/dev/null" EXIT
  wait "${lanes[@]}"
  trap - EXIT
  failed=$((image_test_count - $(grep -c '^Passed$' "$pc_shared/.results")))
  count "$image_test_count" "$failed"
  find "$pc_shared" -size +1M ! -name '*.console' -delete
  printf '\n%d%% tests passed, %d tests failed out of %d\n' $(((image_test_count - failed) * 100 / image_test_count)) "$failed" "$image_test_count"
  ((failed == 0))
}
