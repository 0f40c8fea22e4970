# Sourced after stand_in.sh: a stand-in for QEMU and what is in it, which answers as image/guest/init does. The tests `first`
# and `second` are in it. What a test does there is in $work/guest/NAME: nothing (it passes), `ends STATUS`, `takes the
# machine down`, `meets NAME` (it passes when that one has begun too), or `resets` (its watchdog resets the machine). What
# does not boot is told by $work/guest/broken. The host has as many CPUs as $work/guest/cpus says, or one.
# shellcheck shell=bash disable=SC2154 # tree and work are stand_in.sh's

mkdir -p "$tree/image/guest" "$tree/build/release" "$work/guest"
touch "$tree/image/guest/modules.txt"
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
for word; do
  case $word in
    pipe,id=control,path=*) control=${word#pipe,id=control,path=} ;;
    pipe,id=monitor,path=*) monitor=${word#pipe,id=monitor,path=} ;;
    file,id=console,path=*) console=${word#file,id=console,path=} console=${console%,append=on} ;;
    file,id=output,path=*) output=${word#file,id=output,path=} ;;
    file,id=errors,path=*) errors=${word#file,id=errors,path=} ;;
  esac
done
exec 7<>"$monitor.out" 8<>"$control.in" 9<>"$control.out"
[[ -e $STAND_IN/guest/broken ]] && { echo "Kernel panic" >>"$console"; exit 0; }
mount_repository() { echo mounted >&9; }
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
echo ready >&9
while IFS= read -r -u 8 request; do eval "$request"; done
BODY
