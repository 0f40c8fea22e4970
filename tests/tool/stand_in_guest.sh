# Sourced after stand_in.sh: a stand-in for QEMU and what is in it, which answers as image/guest/init does. The tests `first`
# and `second` are in it. What a test does there is in $work/guest/NAME: nothing (it passes), `ends STATUS`, `takes the
# machine down`, `meets NAME` (it passes when that one has begun too), or `resets` (its watchdog resets the machine). With
# $work/guest/broken no machine boots. A saved machine is a file "the machine". The host has as many CPUs as $work/guest/cpus says, or one.
# shellcheck shell=bash disable=SC2154 # tree and work are stand_in.sh's

mkdir -p "$tree/image/guest" "$tree/build/release" "$work/guest"
touch "$tree/image/guest/modules.txt" "$tree/build/release/tests_read.txt"
echo 'mkdir -p "$1"' >"$tree/image/guest/fetch_kernel.sh"
echo 'touch "$2"' >"$tree/image/guest/make_initramfs.sh"
printf '%s\n' first second >"$tree/build/release/guest_tests.txt"

stand_in uname <<'BODY'
[[ -e $STAND_IN/guest/other_machine ]] && echo aarch64 || echo x86_64
BODY
stand_in nproc <<'BODY'
cat "$STAND_IN/guest/cpus" 2>/dev/null || echo 1
BODY
stand_in qemu-system-x86_64 <<'BODY'
[[ $1 == --version ]] && { echo "QEMU emulator version 7.2"; exit 0; }
state=''
for word; do
  case $word in
    fd:*) read -r state <&"${word#fd:}" ;;
    pipe,id=control,path=*) control=${word#pipe,id=control,path=} ;;
    pipe,id=monitor,path=*) monitor=${word#pipe,id=monitor,path=} ;;
    file,id=console,path=*) console=${word#file,id=console,path=} console=${console%,append=on} ;;
    file,id=output,path=*) output=${word#file,id=output,path=} ;;
    file,id=errors,path=*) errors=${word#file,id=errors,path=} ;;
  esac
done
exec 6<>"$monitor.in" 7<>"$monitor.out" 8<>"$control.in" 9<>"$control.out"
[[ $state || ! -e $STAND_IN/guest/broken ]] || { echo "Kernel panic" >>"$console"; exit 0; }
[[ ${state:-the machine} == "the machine" ]] || exit 1
mount_repository() { echo mounted >&9; }
set_clock() { echo set >&9; }
take_files() { echo taken >&9; }
prepare_saving() {
  local command
  echo prepared >&9
  while IFS= read -r -u 6 command; do
    [[ $command == *exec:* ]] || continue
    command=${command#*exec:}
    sh -c "${command%%\"*}" <<<"the machine"
    echo '{"event": "MIGRATION", "data": {"status": "completed"}}' >&7
  done
}
run_test() {
  local does='' word status
  echo "hello from ${4##*/}, with $3" >>"$console"
  [[ -e $STAND_IN/guest/${4##*/} ]] && does=$(<"$STAND_IN/guest/${4##*/}")
  read -r word status <<<"$does"
  : >"$STAND_IN/guest/${4##*/}.begun"
  [[ $word == takes ]] && exit 0
  if [[ $word == resets && $3 != FLEXRF_AFTER_RESET=1 ]]; then
    echo '{"event": "WATCHDOG"}' >&7
    echo ready >&9
    return
  fi
  if [[ $word == meets ]]; then
    until [[ -e $STAND_IN/guest/$status.begun ]]; do sleep 0.01; done
    status=0
  fi
  echo "$1" >>"$console"
  echo "${status:-0} 1230000" >&9
}
run_command() {
  echo "in the guest: $*; input: $(cat)" >"$output"
  echo "an error" >"$errors"
  echo 7 >&9
}
[[ $state ]] || echo ready >&9
while IFS= read -r -u 8 request; do eval "$request"; done
BODY
