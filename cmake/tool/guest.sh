# Sourced by flexrf: starts the guest, a PREEMPT_RT machine with devices (image/guest, docs/guest.md), and has it do things.
# The guest answers each request with a line; nothing is waited for without a limit.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

boot_limit=200 # s of the machine's processor time: alone it takes about 5. A host that does much else gives it as much as it likes
# s for one test, of the guest's time and of its processor's, which is for what hangs: alone the longest takes five minutes. A machine that
# gets no processor time from a busy host has four times as long.
test_limit=${FLEXRF_GUEST_TEST_LIMIT:-1800}
long_test_limit=3600 # s for one that has the long tests too: a hundred picks are 11 minutes of the machine's time
guest_folder=$root/build/guest
guest_files=$guest_folder/files # what guests take into their memory: each file below its own path
saved_guest='' # the file of the saved guest; empty when guests are booted
guest_run='' guest_machine='' guest_console='' guest_pid='' heard='' lost=''
# Time in the guest as its tests have it: an instruction takes a nanosecond, and while there is none to be carried out the
# next timer is due at once. A host that is busy makes it slow, and is not seen in it.
counted_time=(-accel tcg,thread=single -icount shift=0,sleep=off -smp 1)
# As a person has it, who waits for things beside it.
real_time=(-accel tcg,thread=multi -smp 2)
guest_time=("${counted_time[@]}")

guest_obstacle() {  # prints why there can be no guest on this machine; nothing when there can
  if [[ $(uname -m) != x86_64 ]]; then
    printf 'it needs an amd64 machine\n'
  elif ! command -v dpkg-query >/dev/null; then
    printf 'its kernel is made from packages, and this is not a Debian system\n'
  fi
}

remembered_kernel() {  # remembered_kernel RECIPE: the archive of the newest one that this machine's package lists name
  local version
  version=$(apt-cache show --no-all-versions linux-image-rt-amd64 2>/dev/null | sed -n 's/^Version: //p')
  [[ $cache && $version ]] && printf '%s/guest-kernel/%s-%s.tar\n' "$cache" "$version" "${1:0:16}"
}

make_kernel() {  # once, and anew when what it is made by has changed
  local recipe start remembered log=$guest_folder/kernel.log
  recipe=$(cat "$root"/image/guest/{fetch_kernel.sh,modules.txt} | sha256sum)
  [[ -f $guest_folder/recipe && -d $guest_folder/kernel && $(<"$guest_folder/recipe") == "$recipe" ]] && return
  remembered=$(remembered_kernel "$recipe")
  if [[ -f $remembered ]] && take_kernel "$remembered"; then
    printf '%s\n' "$recipe" >"$guest_folder/recipe"
    return
  fi
  say "making the guest's kernel from packages of Debian 12 (220 MB to download, once)"
  start=$(microseconds)
  if ! bash "$root/image/guest/fetch_kernel.sh" "$guest_folder/kernel" >"$log" 2>&1; then
    cat "$log" >&2
    say "making the guest's kernel failed"
    return 1
  fi
  printf '%s\n' "$recipe" >"$guest_folder/recipe"
  say "made the guest's kernel: $(since "$start")"
  remembered=$(remembered_kernel "$recipe") # the lists may be newer now
  if [[ $remembered ]]; then keep_kernel "$remembered"; fi
}

keep_kernel() {  # keep_kernel ARCHIVE: the only one; its checksum stands beside it
  local folder=${1%/*} new=$1.$$
  rm -rf "$folder"
  mkdir -p "$folder" && tar -C "$guest_folder" -cf "$new" kernel 2>/dev/null &&
    sha256sum <"$new" >"$1.sum" && mv "$new" "$1"
}

take_kernel() {  # take_kernel ARCHIVE: fails when it is damaged
  [[ $(sha256sum <"$1") == "$(cat "$1.sum" 2>/dev/null)" ]] || return
  rm -rf "$guest_folder/kernel"
  tar -C "$guest_folder" -xf "$1"
}

make_kernel_once() {  # though several commands may start here at the same time
  mkdir -p "$guest_folder"
  (flock 9 && make_kernel 9>&-) 9>"$guest_folder/.lock"
}

guest_executables() {  # prints what is built and may be started in the guest
  find "$root"/build/release/{guest,apps,hal} -name CMakeFiles -prune -o -type f -perm -100 ! -name '*.so*' -print 2>/dev/null
}

guest_tools() { PATH=$PATH:/usr/sbin:/sbin type -P bash ip; }

needed_libraries() {  # needed_libraries PROGRAM...: prints the shared libraries that the PROGRAMs load
  local program
  for program; do ldd "$program" 2>/dev/null || true; done |
    sed -n -E 's|^\s*(.* => )?(/[^ ]+) \(0x[0-9a-f]+\)$|\2|p' | sort -u
}

guest_test_reads() {  # guest_test_reads NAME: prints the files that decide the test's result, beside the guest itself (guest_key)
  printf '%s\n' "$root/build/release/guest/$1"
  awk -F '\t' -v name="$1" '$1 == name { print $2 }' "$root/build/release/tests_read.txt"
}

guest_test_files() {  # guest_test_files NAME: prints the programs that the test consists of and starts, and their libraries
  local file
  local -a programs
  mapfile -t programs < <(guest_test_reads "$1" | while IFS= read -r file; do
    [[ -f $file && -x $file ]] && printf '%s\n' "$file"
  done)
  ((${#programs[@]})) || return
  printf '%s\n' "${programs[@]}"
  needed_libraries "${programs[@]}"
}

guest_key() {  # prints a checksum of all that a guest consists of when it has booted: equal keys, equal guests
  local -a tools libraries
  make_kernel_once || return
  mapfile -t tools < <(guest_tools)
  mapfile -t libraries < <(needed_libraries "${tools[@]}")
  {
    declare -f set_machine save_guest
    printf '%s\n' "${counted_time[*]}" "$(qemu-system-x86_64 --version)"
    cd "$root" && find -L build/guest/kernel image/guest /usr/share/seabios "$(type -P qemu-system-x86_64)" "${tools[@]}" \
      "${libraries[@]}" -type f -print0 2>/dev/null | LC_ALL=C sort -z | xargs -0 b2sum -l 128
  } | b2sum -l 128 | cut -d ' ' -f 1
}

prepare_guest() {  # what all machines have in common
  make_kernel_once || return
  guest_run=$(mktemp -d "${TMPDIR:-/tmp}/flexrf-guest.XXXXXX")
  trap 'stop_guest; rm -rf "$guest_run"' EXIT
}

find_saved_guest() {  # sets saved_guest; boots and saves a guest when there is none of this key that is whole
  local folder=${cache:-$guest_folder}/guest-saved key
  key=$(guest_key) || return
  saved_guest=$folder/$key
  mkdir -p "$folder" 2>/dev/null &&
    (flock 9 && { is_whole "$saved_guest" || save_guest "$saved_guest" 9>&-; }) 9>"$folder/.lock" && return
  saved_guest=''
}

is_whole() { [[ -f $1 && $(b2sum <"$1") == "$(cat "$1.sum" 2>/dev/null)" ]]; } # is_whole FILE: its checksum is the one beside it

use_machine() {  # use_machine NUMBER: the one that all of the following is about; there may be several, each of a shell's own
  guest_machine=$guest_run/$1
  guest_console=$guest_folder/console-$1.log
  unattended=(-chardev "file,id=console,path=${guest_console//,/,,},append=on"
    -chardev null,id=input -chardev null,id=output -chardev null,id=errors)
  : >"$guest_console"
  mkdir "$guest_machine" &&
    mkfifo "$guest_machine"/{control,monitor}.{in,out} &&
    exec {to_guest}<>"$guest_machine/control.in" {from_guest}<>"$guest_machine/control.out" \
      {to_monitor}<>"$guest_machine/monitor.in" {from_monitor}<>"$guest_machine/monitor.out"
}

set_machine() {  # sets machine to QEMU's arguments; a guest can be restored with those only that it was saved with
  machine=("${guest_time[@]}" -cpu max -m 1024 -nodefaults -no-reboot -display none
    -kernel "$guest_folder/kernel/vmlinuz"
    # Nothing is told of real time here: protection against the processor's own leaks would only cost time, and a host
    # that is busy must not look like a kernel that hangs.
    -append "console=ttyS0 panic=-1 quiet net.ifnames=0 mitigations=off nosoftlockup rcupdate.rcu_cpu_stall_timeout=300"
    -device isa-serial,chardev=console
    -chardev "socket,id=line_a,path=$guest_machine/line,server=on,wait=off" -chardev "socket,id=line_b,path=$guest_machine/line"
    -device isa-serial,chardev=line_a -device isa-serial,chardev=line_b
    -object can-bus,id=bus -device kvaser_pci,canbus=bus -device kvaser_pci,canbus=bus
    -device i6300esb -action watchdog=reset
    # Its number is another one in each restored machine; the kernel then makes other random numbers.
    -device vmgenid,guid=auto
    -virtfs "local,path=${root//,/,,},mount_tag=repository,security_model=none,readonly=on"
    -device virtio-serial-pci
    -chardev "pipe,id=control,path=$guest_machine/control" -device virtserialport,chardev=control,name=control
    -device virtserialport,chardev=input,name=input
    -device virtserialport,chardev=output,name=output
    -device virtserialport,chardev=errors,name=errors
    -chardev "pipe,id=monitor,path=$guest_machine/monitor" -mon chardev=monitor,mode=control)
}

# start_machine QEMU'S ARGUMENT...: they have the character devices console, input, output and errors; standard input and output are
# the caller's
start_machine() {
  local -a machine
  set_machine
  # It ends with this script, however that ends.
  setpriv --pdeathsig KILL qemu-system-x86_64 "${machine[@]}" "$@" <&0 &
  guest_pid=$!
}

machine_seconds() {  # the processor time that the machine has had, s
  local -a field
  read -r -a field 2>/dev/null <"/proc/$guest_pid/stat" || field=()
  printf '%d\n' $(((field[13] + field[14]) / 100)) # in the kernel's ticks for programs, whatever its own
}

# hear [SECONDS [PROCESSOR_SECONDS]]: sets heard to the guest's next line; fails, with the reason in lost, when none comes in time
hear() {
  local part limit=${1-} processor_limit=${2-} start=$SECONDS
  if [[ $processor_limit ]]; then processor_limit=$((processor_limit + $(machine_seconds))); fi
  heard=''
  while :; do
    IFS= read -r -t 1 -u "$from_guest" part && heard+=$part && return
    heard+=$part
    kill -0 $$ 2>/dev/null || exit # a shell of its own that outlived the script
    if ! kill -0 "$guest_pid" 2>/dev/null; then
      lost="the machine ended by itself"
      return 1
    elif [[ $limit ]] && ((SECONDS - start > limit)); then
      lost="no answer in $limit s"
      return 1
    elif [[ $processor_limit ]] && (($(machine_seconds) > processor_limit)); then
      lost="no answer in $2 s of its processor"
      return 1
    fi
  done
}

tell() { printf '%s\n' "$*" >&"$to_guest"; }

request() {  # request WORD...: waits for the answer of a machine that may have to come up before
  tell "$(printf '%q ' "$@")" && hear "$test_limit" "$boot_limit"
}

boot_machine() {  # boot_machine QEMU'S ARGUMENT...: until it answers
  local -a tools libraries
  mapfile -t tools < <(guest_tools)
  mapfile -t libraries < <(needed_libraries "${tools[@]}")
  bash "$root/image/guest/make_initramfs.sh" "$guest_folder/kernel" "$guest_machine/initramfs" "${tools[@]}" -- "${libraries[@]}" || return
  start_machine -initrd "$guest_machine/initramfs" "$@"
  hear "$test_limit" "$boot_limit"
}

boot_guest() {  # boot_guest QEMU'S ARGUMENT...: with this folder in it
  local start
  start=$(microseconds)
  if ! boot_machine "$@" || ! request mount_repository "$root"; then
    stop_guest
    say "the guest did not boot: $lost. Its console (${guest_console#"$root/"}) ends with:"
    tail -n 60 "$guest_console" | tr -d '\r' >&2
    return 1
  fi
  say "booted the guest: $(since "$start")"
}

# save_guest FILE: boots a guest and writes its state to FILE, with the checksum beside it; other files of FILE's folder are removed.
# The folder of the repository is not mounted, as QEMU saves no machine with a 9p mount.
save_guest() (
  start=$(microseconds) event='' copier=''
  trap 'stop_guest; [[ $copier ]] && kill "$copier" 2>/dev/null; rm -f "$1.new"' EXIT
  say "booting the guest once, to save it"
  use_machine saved && mkfifo "$guest_machine/state" && boot_machine "${unattended[@]}" && request prepare_saving || {
    say "the guest was not saved: ${lost:-it could not be started}"
    return 1
  }
  cat "$guest_machine/state" >"$1.new" &
  copier=$!
  printf '%s\n' '{"execute": "qmp_capabilities"}' \
    '{"execute": "migrate-set-capabilities", "arguments": {"capabilities": [{"capability": "events", "state": true}]}}' \
    "{\"execute\": \"migrate\", \"arguments\": {\"uri\": \"exec:cat >'$guest_machine/state'\"}}" >&"$to_monitor"
  until [[ $event == *'"status": "completed"'* ]]; do
    IFS= read -r -t "$boot_limit" -u "$from_monitor" event && [[ $event != *'"status": "failed"'* && $event != *'"error"'* ]] || {
      say "the guest was not saved: ${event:-QEMU did not answer}"
      return 1
    }
  done
  find "${1%/*}" -type f ! -name .lock ! -name "${1##*/}.new" -delete
  wait "$copier" && b2sum <"$1.new" >"$1.sum" && mv "$1.new" "$1" || {
    say "the guest was not saved: ${1%/*} cannot be written"
    return 1
  }
  say "saved the guest: $(since "$start")"
)

restore_guest() {  # restore_guest QEMU'S ARGUMENT...: the saved guest, with this folder in it; fails when none can be restored
  local start state
  [[ -f $saved_guest ]] || return
  start=$(microseconds)
  exec {state}<"$saved_guest" || return
  start_machine -incoming "fd:$state" "$@"
  exec {state}<&-
  if request set_clock "$EPOCHSECONDS" && request mount_repository "$root"; then
    say "restored the guest: $(since "$start")"
    return
  fi
  stop_guest
  say "the saved guest cannot be restored: $lost. It is removed, and the guest is booted"
  rm -f "$saved_guest"
  return 1
}

start_guest() { restore_guest "$@" || boot_guest "$@"; }

stop_guest() {
  [[ $guest_pid ]] || return 0
  kill -KILL "$guest_pid" 2>/dev/null
  wait "$guest_pid" 2>/dev/null
  guest_pid=''
  # What was under way to or from it is nobody's any more.
  while read -r -t 0.01 -n 4096 -u "$to_guest"; do :; done
  while read -r -t 0.01 -n 4096 -u "$from_guest"; do :; done
  while read -r -t 0.01 -n 4096 -u "$to_monitor"; do :; done
  while read -r -t 0.01 -n 4096 -u "$from_monitor"; do :; done
}

# offer_files FILE...: has the guest take the FILEs into its memory, without what is for debuggers. The copies that guests take them
# from are made when a FILE is another one.
offer_files() {
  local file copy
  for file; do
    copy=$guest_files$file
    [[ -f $copy && ! $copy -nt $file && ! $copy -ot $file ]] && continue
    mkdir -p "${copy%/*}" && strip -p -o "$copy.$BASHPID" "$file" && mv "$copy.$BASHPID" "$copy" || {
      lost="$file could not be copied to $copy"
      return 1
    }
  done
  request take_files "$@" || return
  [[ $heard == taken ]] || { lost="the guest has not taken $heard into its memory" && return 1; }
}

guest_console() {  # a shell in the guest, for the person at this terminal
  local rows columns
  read -r rows columns < <(stty size)
  guest_time=("${real_time[@]}")
  use_machine 1 || return
  boot_guest -chardev "stdio,id=console,signal=off,logfile=${guest_console//,/,,}" "${unattended[@]:2}" || return
  offer_libraries || say "$lost"
  say "exit leaves the guest"
  tell "run_console $rows $columns"
  hear || say "$lost"
  stop_guest
  stty sane
}

offer_libraries() {  # those of all that is built
  local -a executables libraries
  mapfile -t executables < <(guest_executables)
  mapfile -t libraries < <(needed_libraries "${executables[@]}")
  offer_files "${libraries[@]}"
}

guest_command() {  # guest_command WORD...: with this standard input unless it is a terminal; ends with its exit code
  local input=stdio,signal=on name status=0
  local -a files=()
  [[ -t 0 ]] && input=null
  find_saved_guest
  use_machine 1 || return
  # Files take whatever comes, so that nothing is under way any more when the machine is stopped.
  for name in output errors; do
    : >"$guest_machine/$name"
    files+=(-chardev "file,id=$name,path=$guest_machine/$name")
  done
  start_guest "${unattended[@]:0:2}" -chardev "$input,id=input" "${files[@]}" || return
  tail -q -c +1 -f --pid="$guest_pid" "$guest_machine/output" &
  tail -q -c +1 -f --pid="$guest_pid" "$guest_machine/errors" >&2 &
  offer_libraries && tell "run_command$(printf ' %q' "$@")" && hear || status=1
  stop_guest
  wait
  if ((status)); then
    say "$lost. The guest's console ends with:"
    tail -n 60 "$guest_console" | tr -d '\r' >&2
    return 1
  fi
  return "$heard"
}

show_console() {  # show_console OFFSET MARK: what came to the guest's console from there until the mark
  local waited
  for ((waited = 0; waited < 50; ++waited)); do # the last of it may be on its way
    tail -c "+$(($1 + 1))" "$guest_console" | grep -q -F -e "$2" && break
    [[ $guest_pid ]] || break
    sleep 0.1
  done
  tail -c "+$(($1 + 1))" "$guest_console" | tr -d '\r' | grep -v -F -e "$2"
}

when_reset() {  # when_reset shutdown|reset: what QEMU does when the machine is reset; at first it ends
  printf '%s\n' '{"execute": "qmp_capabilities"}' \
    "{\"execute\": \"set-action\", \"arguments\": {\"reboot\": \"$1\"}}" >&"$to_monitor"
}

was_watchdog() {  # QEMU has told that the machine's watchdog acted
  local event
  while IFS= read -r -t 5 -u "$from_monitor" event; do
    [[ $event == *'"event": "WATCHDOG"'* ]] && return
  done
  lost="the machine was reset, and not by its watchdog"
  return 1
}

await_reset() {  # await_reset REQUEST LIMIT: while the machine does this its watchdog resets it, and it comes up anew
  when_reset reset
  tell "$1"
  hear $((4 * $2)) "$2" || return
  [[ $heard == ready ]] || { lost="its watchdog did not reset the machine" && return 1; }
  was_watchdog || return
  when_reset shutdown
  request mount_repository "$root"
}

test_request() { printf 'run_test' && printf ' %q' "$mark" "$limit" "$setting" "$root/build/release/guest/$1"; }

guest_test() {  # guest_test NAME: sets result, taken (the guest's microseconds), used (processor seconds) and told, what is to be read when it did not pass
  local mark="end of $1" setting="FLEXRF_LONG=${FLEXRF_LONG-}" offset status limit=$test_limit start=start_guest resets=''
  local -a files
  [[ ${FLEXRF_LONG-} ]] && limit=$long_test_limit
  told='' used=0
  if [[ $1 == *_reset_guest_test ]]; then # on a machine that was booted: a restored one has nothing to boot from
    resets=1 start=boot_guest
    stop_guest
  fi
  if [[ $guest_pid == '' ]] && { ((unbootable)) || ! "$start" "${unattended[@]}" </dev/null; }; then
    result='Not Run' taken=0 used=0 unbootable=1
    return
  fi
  offset=$(stat -c %s "$guest_console")
  lost='' used=$(machine_seconds)
  mapfile -t files < <(guest_test_files "$1")
  if [[ $resets ]]; then # run until the machine is reset, and once more after it
    offer_files "${files[@]}" && await_reset "$(test_request "$1")" "$limit" && setting=FLEXRF_AFTER_RESET=1
  fi
  if [[ $lost == '' ]] && offer_files "${files[@]}" && tell "$(test_request "$1")" && hear $((4 * limit)) "$limit"; then
    read -r status taken <<<"$heard"
    case $status in
      0) result=Passed ;;
      late) result="Timeout after $limit s" ;;
      *) result="Failed with $status" ;;
    esac
  else
    # The next one gets a machine of its own.
    stop_guest
    result="Failed: $lost" taken=0
  fi
  if [[ $guest_pid ]]; then used=$(($(machine_seconds) - used)); else used=0; fi
  [[ $result == Passed ]] || told=$(printf 'The console of the guest during %s:\n' "$1" && show_console "$offset" "$mark")
  # QEMU's CAN controllers are read from another place than they are written at once the machine was reset: they would tell
  # frames of before.
  if [[ $resets ]]; then stop_guest; fi
}

next_test() {  # prints the number of the one that is nobody's yet; fails when there is none
  local number
  (
    flock 9
    number=$(($(<"$guest_run/taken") + 1))
    ((number <= ${#names[@]})) && printf '%d\n' "$number" | tee "$guest_run/taken"
  ) 9>"$guest_run/taking"
}

guest_machine_tests() {  # guest_machine_tests NUMBER: one after the other in this machine, until none is left
  local number name result taken used told unbootable=0
  trap stop_guest EXIT
  use_machine "$1" || return
  while number=$(next_test); do
    name=${names[number - 1]}
    guest_test "$name"
    [[ $result == Passed ]] || printf '%s (%s)\n' "$name" "$result" >>"$guest_run/failed"
    guest_report "$number" "$name" "$result" "$taken" "$used" "$told"
  done
}

guest_report() {  # guest_report NUMBER NAME RESULT MICROSECONDS SECONDS TEXT: a line as ctest's, behind what there is to be read
  local line
  line=$(printf '%3d/%d Test #%d: %s ' "$1" "${#names[@]}" "$1" "$2")
  while ((${#line} < 60)); do line+=.; done
  (
    flock 9
    [[ $6 ]] && printf '%s\n' "$6"
    printf '%s   %s  %d.%02d sec, %d s of processor time\n' "$line" "$3" $(($4 / 1000000)) $(($4 % 1000000 / 10000)) "$5"
  ) 9>"$guest_run/reporting"
}

guest_tests() {  # guest_tests [NAME...]: these or all, in a machine for each of this one's CPUs; counts them
  local machine failed name
  local -a names machines=()
  mapfile -t names <"$root/build/release/guest_tests.txt"
  for name; do known_word "test in the guest" "$name" "${names[@]}"; done
  (($#)) && names=("$@")
  # What did not build is a test that fails.
  ((${#names[@]})) && prepare_guest || { count 1 1; return 1; }
  find_saved_guest
  : >"$guest_run/failed"
  printf '0\n' >"$guest_run/taken"
  for ((machine = 1; machine <= $(nproc) && machine <= ${#names[@]}; ++machine)); do
    guest_machine_tests "$machine" &
    machines+=($!)
  done
  wait "${machines[@]}"
  (($(<"$guest_run/taken") == ${#names[@]})) || printf 'not all were begun\n' >>"$guest_run/failed"
  failed=$(wc -l <"$guest_run/failed")
  count "${#names[@]}" "$failed"
  printf '\n%d%% tests passed, %d tests failed out of %d\n' \
    $(((${#names[@]} - failed) * 100 / ${#names[@]})) "$failed" "${#names[@]}"
  ((failed)) || return 0
  printf '\nThe following tests FAILED in the guest:\n'
  sed 's/^/\t/' "$guest_run/failed"
  return 1
}
