# Sourced by flexrf: boots the guest, a PREEMPT_RT machine with devices (image/guest, docs/guest.md), and has it do things.
# The guest answers each request with a line; nothing is waited for without a limit.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

boot_limit=200 # s of the machine's processor time: alone it takes about 5. A host that does much else gives it as much as it likes
test_limit=${FLEXRF_GUEST_TEST_LIMIT:-1800} # s for one test, which is for what hangs: alone the longest takes five
long_test_limit=3600 # s for one that has the long tests too: a hundred picks are 11 minutes of the machine's time
guest_folder=$root/build/guest
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

guest_executables() {  # what is built and may be started in the guest
  find "$root"/build/release/{guest,apps,hal} -name CMakeFiles -prune -o -type f -perm -100 ! -name '*.so*' -print 2>/dev/null
}

guest_programs() {  # the tests, and the programs that they start
  local build=$root/build/release
  awk -F '\t' -v folder="$build/guest/" 'is == "name" { tests[$1]; print folder $1; next } $1 in tests { print $2 }' \
    is=name "$build/guest_tests.txt" is=read "$build/tests_read.txt" | sort -u | while read -r program; do
    [[ -f $program && -x $program ]] && printf '%s\n' "$program"
  done
}

prepare_guest() {  # prepare_guest [PROGRAM...]: what all machines have in common; the PROGRAMs come along
  local -a executables
  mkdir -p "$guest_folder"
  (flock 9 && make_kernel 9>&-) 9>"$guest_folder/.lock" || return
  guest_run=$(mktemp -d "${TMPDIR:-/tmp}/flexrf-guest.XXXXXX")
  trap 'stop_guest; rm -rf "$guest_run"' EXIT
  mapfile -t executables < <(guest_executables)
  bash "$root/image/guest/make_initramfs.sh" "$guest_folder/kernel" "$guest_run/initramfs" "$@" -- "${executables[@]}"
}

use_machine() {  # use_machine NUMBER: the one that all of the following is about; there may be several, each of a shell's own
  guest_machine=$guest_run/$1
  guest_console=$guest_folder/console-$1.log
  : >"$guest_console"
  mkdir "$guest_machine" &&
    mkfifo "$guest_machine"/{control,monitor}.{in,out} &&
    exec {to_guest}<>"$guest_machine/control.in" {from_guest}<>"$guest_machine/control.out" \
      {to_monitor}<>"$guest_machine/monitor.in" {from_monitor}<>"$guest_machine/monitor.out"
}

start_machine() {  # start_machine [QEMU'S ARGUMENT...]: its standard input and output are the caller's
  local -a machine=("${guest_time[@]}" -cpu max -m 1024 -nodefaults -no-reboot -display none
    -kernel "$guest_folder/kernel/vmlinuz" -initrd "$guest_run/initramfs"
    # Nothing is told of real time here: protection against the processor's own leaks would only cost time, and a host
    # that is busy must not look like a kernel that hangs.
    -append "console=ttyS0 panic=-1 quiet net.ifnames=0 mitigations=off nosoftlockup rcupdate.rcu_cpu_stall_timeout=300"
    -device isa-serial,chardev=console
    -chardev "socket,id=line_a,path=$guest_machine/line,server=on,wait=off" -chardev "socket,id=line_b,path=$guest_machine/line"
    -device isa-serial,chardev=line_a -device isa-serial,chardev=line_b
    -object can-bus,id=bus -device kvaser_pci,canbus=bus -device kvaser_pci,canbus=bus
    -device i6300esb -action watchdog=reset
    -virtfs "local,path=${root//,/,,},mount_tag=repository,security_model=none,readonly=on"
    -device virtio-serial-pci
    -chardev "pipe,id=control,path=$guest_machine/control" -device virtserialport,chardev=control,name=control
    -chardev "pipe,id=monitor,path=$guest_machine/monitor" -mon chardev=monitor,mode=control)
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
      lost="no answer in $processor_limit s of its processor"
      return 1
    fi
  done
}

tell() { printf '%s\n' "$*" >&"$to_guest"; }

boot_guest() {  # boot_guest [QEMU'S ARGUMENT...]: until it answers
  local start
  start=$(microseconds)
  start_machine "$@"
  if ! hear "$test_limit" "$boot_limit" || ! tell "mount_repository $(printf %q "$root")" ||
    ! hear "$test_limit" "$boot_limit"; then
    stop_guest
    say "the guest did not boot: $lost. Its console (${guest_console#"$root/"}) ends with:"
    tail -n 60 "$guest_console" | tr -d '\r' >&2
    return 1
  fi
  say "booted the guest: $(since "$start")"
}

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

boot_apart() {  # the machine whose console nobody sees unless something fails
  boot_guest -chardev "file,id=console,path=${guest_console//,/,,},append=on" </dev/null
}

guest_console() {  # a shell in the guest, for the person at this terminal
  local rows columns
  read -r rows columns < <(stty size)
  guest_time=("${real_time[@]}")
  use_machine 1 || return
  boot_guest -chardev "stdio,id=console,signal=off,logfile=${guest_console//,/,,}" || return
  say "exit leaves the guest"
  tell "run_console $rows $columns"
  hear || say "$lost"
  stop_guest
  stty sane
}

guest_command() {  # guest_command WORD...: with this standard input unless it is a terminal; ends with its exit code
  local input=stdio,signal=on name status=0
  local -a ports=()
  [[ -t 0 ]] && input=null
  use_machine 1 || return
  # Files take whatever comes, so that nothing is under way any more when the machine is stopped.
  for name in output errors; do
    : >"$guest_machine/$name"
    ports+=(-chardev "file,id=$name,path=$guest_machine/$name" -device "virtserialport,chardev=$name,name=$name")
  done
  boot_guest -chardev "file,id=console,path=${guest_console//,/,,},append=on" \
    -chardev "$input,id=input" -device virtserialport,chardev=input,name=input "${ports[@]}" || return
  tail -q -c +1 -f --pid="$guest_pid" "$guest_machine/output" &
  tail -q -c +1 -f --pid="$guest_pid" "$guest_machine/errors" >&2 &
  tell "run_command$(printf ' %q' "$@")"
  hear || status=1
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

await_reset() {  # await_reset REQUEST SECONDS: while the machine does this its watchdog resets it, and it comes up anew
  when_reset reset
  tell "$1"
  hear "$2" || return
  [[ $heard == ready ]] || { lost="its watchdog did not reset the machine" && return 1; }
  was_watchdog || return
  when_reset shutdown
  tell "mount_repository $(printf %q "$root")" && hear "$test_limit"
}

test_request() { printf 'run_test' && printf ' %q' "$mark" "$limit" "$setting" "$root/build/release/guest/$1"; }

guest_test() {  # guest_test NAME: sets result, taken (microseconds) and told, what is to be read when it did not pass
  local mark="end of $1" setting="FLEXRF_LONG=${FLEXRF_LONG-}" offset status limit=$test_limit
  [[ ${FLEXRF_LONG-} ]] && limit=$long_test_limit
  told=''
  if [[ $guest_pid == '' ]] && { ((unbootable)) || ! boot_apart; }; then
    result='Not Run' taken=0 unbootable=1
    return
  fi
  offset=$(stat -c %s "$guest_console")
  lost=''
  if [[ $1 == *_reset_guest_test ]]; then # run until the machine is reset, and once more after it
    await_reset "$(test_request "$1")" $((limit + 60)) && setting=FLEXRF_AFTER_RESET=1
  fi
  if [[ $lost == '' ]] && tell "$(test_request "$1")" && hear $((limit + 60)); then
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
  [[ $result == Passed ]] || told=$(printf 'The console of the guest during %s:\n' "$1" && show_console "$offset" "$mark")
  # QEMU's CAN controllers are read from another place than they are written at once the machine was reset: they would tell
  # frames of before.
  if [[ $1 == *_reset_guest_test ]]; then stop_guest; fi
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
  local number name result taken told unbootable=0
  trap stop_guest EXIT
  use_machine "$1" || return
  while number=$(next_test); do
    name=${names[number - 1]}
    guest_test "$name"
    [[ $result == Passed ]] || printf '%s (%s)\n' "$name" "$result" >>"$guest_run/failed"
    guest_report "$number" "$name" "$result" "$taken" "$told"
  done
}

guest_report() {  # guest_report NUMBER NAME RESULT MICROSECONDS TEXT: a line as ctest's, behind what there is to be read
  local line
  line=$(printf '%3d/%d Test #%d: %s ' "$1" "${#names[@]}" "$1" "$2")
  while ((${#line} < 60)); do line+=.; done
  (
    flock 9
    [[ $5 ]] && printf '%s\n' "$5"
    printf '%s   %s  %d.%02d sec\n' "$line" "$3" $(($4 / 1000000)) $(($4 % 1000000 / 10000))
  ) 9>"$guest_run/reporting"
}

guest_tests() {  # guest_tests [NAME...]: these or all, in a machine for each of this one's CPUs; counts them
  local machine failed name
  local -a names programs machines=()
  mapfile -t names <"$root/build/release/guest_tests.txt"
  for name; do known_word "test in the guest" "$name" "${names[@]}"; done
  (($#)) && names=("$@")
  mapfile -t programs < <(guest_programs)
  # What did not build is a test that fails.
  ((${#names[@]})) && prepare_guest "${programs[@]}" || { count 1 1; return 1; }
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
