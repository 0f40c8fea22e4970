#!/usr/bin/env bash
# `guest` runs a command in the machine; `test --guest` runs the tests in it, shows the console of what fails, gives the next
# test a machine of its own when one takes the machine down, or has it reset, and says when there can be no machine. A machine is booted
# once and saved; what is wrong with the saved one costs a boot.
shopt -s extglob
source "$(dirname "$0")/stand_in.sh"
source "$(dirname "$0")/stand_in_guest.sh"

last_line() { printf '%s\n' "${output##*$'\n'}"; }
boots() { grep -c '^qemu.* -initrd ' "$calls"; }
restores() { grep -c '^qemu.* -incoming ' "$calls"; }
saved() { find "$work/cache/guest-saved" -type f -name '*[0-9a-f]' ! -name '*.*'; }

flexrf guest -- show 'two words' <<<"keys"
expect "exit code of a command" "$status" 7
expect "output of a command" "$output" "in the guest: show two words; input: keys"
expect "errors of a command" "$errors" "*made the guest's kernel*saved the guest*restored the guest*an error*"
expect "boots of a command" "$(boots)" 1
expect "what is built" "$(grep ^ninja "$calls")" "*tests_guest keyboard*keyboard*"

: >"$calls"
flexrf test --guest --no-memory </dev/null
expect "exit code" "$status" 0
expect "lines" "$output" "*1/2 Test #1: first ...*   Passed  1.23 sec*2/2 Test #2: second ...*   Passed  1.23 sec*"
expect "last line" "$(last_line)" "100% tests passed, 0 tests failed out of 3"
expect "the kernel is made once" "$errors" ""
expect "boots with a saved machine" "$(boots)" 0
expect "machines" "$(restores)" 1

: >"$calls"
echo 2 >"$work/guest/cpus"
# Else one machine might have done all before the other came to look for a test.
echo "meets second" >"$work/guest/first"
rm "$work/guest/second.begun"
flexrf test --guest --no-memory </dev/null
expect "exit code with two machines" "$status" 0
expect "one of the two's lines" "$output" "*1/2 Test #1: first ...*   Passed  1.23 sec*"
expect "the other's lines" "$output" "*2/2 Test #2: second ...*   Passed  1.23 sec*"
expect "last line with two machines" "$(last_line)" "100% tests passed, 0 tests failed out of 3"
expect "a machine for each CPU" "$(restores)" 2
rm "$work/guest/cpus" "$work/guest/first"

: >"$calls"
echo "ends 3" >"$work/guest/first"
flexrf test --guest --no-memory </dev/null
expect "exit code of a failure" "$status" 1
expect "console of a failure" "$output" "*hello from first*Failed with 3*second*Passed*FAILED in the guest*first*guest *FAILED*"
expect "last line of a failure" "$(last_line)" "66% tests passed, 1 tests failed out of 3"
expect "machines with a failure" "$(restores)" 1
flexrf test --guest --long --no-memory </dev/null
expect "what a test is told of long tests" "$output" "*hello from first, with FLEXRF_LONG=1*"

: >"$calls"
echo "takes the machine down" >"$work/guest/first"
flexrf test --guest --no-memory </dev/null
expect "exit code when the machine ends" "$status" 1
expect "the next one" "$output" "*hello from first*the machine ended by itself*second*Passed*"
expect "machines when one ends" "$(restores)" 2
rm "$work/guest/first"

: >"$calls"
flexrf test --guest </dev/null
expect "exit code of tests that are remembered" "$status" 0
: >"$calls"
flexrf test --guest </dev/null
expect "tests that are unchanged" "$output" "*Test: first *unchanged since it passed*Test: second *unchanged since it passed*2 tests were not run again*"
expect "machines for unchanged tests" "$(boots) $(restores)" "0 0"
mkdir -p "$tree/build/release/guest"
echo changed >"$tree/build/release/guest/first"
flexrf test --guest </dev/null
expect "tests after a change of a program" "$output" "*Test: second *unchanged*1/1 Test #1: first *Passed*"
echo "# one more" >>"$tree/image/guest/devices.sh"
flexrf test --guest </dev/null
expect "tests in another guest" "$output" "*1/2 Test #1: first *Passed*2/2 Test #2: second *Passed*"
rm -r "$tree/build/release/guest"
: >"$calls"

printf '%s\n' dog_reset_guest_test second >"$tree/build/release/guest_tests.txt"
echo resets >"$work/guest/dog_reset_guest_test"
flexrf test --guest --no-memory </dev/null
expect "exit code when the machine is reset" "$status" 0
expect "what has it reset" "$output" "*dog_reset_guest_test *Passed*second *Passed*"
expect "the machine that is reset is booted" "$(boots)" 1
expect "the next one is restored" "$(restores)" 1
printf '%s\n' first second >"$tree/build/release/guest_tests.txt"

damage() { printf X | dd of="$(saved)" bs=1 seek=3 conv=notrunc status=none; }
: >"$calls"
before=$(saved)
damage
flexrf test --guest --no-memory </dev/null
expect "exit code with a damaged machine" "$status" 0
expect "boots with a damaged machine" "$(boots)" 1
expect "machines instead of the damaged one" "$(restores)" 1
expect "the machine that is saved instead" "$(saved)" "$before"

: >"$calls"
damage
b2sum <"$(saved)" >"$(saved).sum"
flexrf test --guest --no-memory </dev/null
expect "exit code with a machine that cannot be restored" "$status" 0
expect "message about a machine that cannot be restored" "$output" "*cannot be restored: the machine ended by itself*booted the guest*"
expect "boots with a machine that cannot be restored" "$(boots)" 1
expect "a machine that cannot be restored is removed" "$(saved)" ""

: >"$calls"
flexrf test --guest --no-memory </dev/null
expect "it is saved again" "$(saved)" "$before"
echo "# another" >"$tree/image/guest/devices.sh"
flexrf test --guest --no-memory </dev/null
expect "exit code with another guest" "$status" 0
expect "boots with another guest" "$(boots)" 2
expect "another guest has another key" "$(saved)" "!($before)"
expect "one machine is kept" "$(saved | wc -l)" 1

: >"$calls"
FLEXRF_CACHE=off flexrf test --guest --no-memory </dev/null
expect "exit code without a cache" "$status" 0
expect "boots without a cache" "$(boots)" 1
expect "where the machine is saved without a cache" "$(ls "$tree/build/guest/guest-saved")" "$(ls "$work/cache/guest-saved")"

: >"$calls"
rm -r "$work/cache/guest-saved"
touch "$work/cache/guest-saved"
flexrf test --guest --no-memory </dev/null
expect "exit code where nothing can be saved" "$status" 0
expect "boots where nothing can be saved" "$(boots)" 1
expect "machines where nothing can be saved" "$(restores)" 0
rm "$work/cache/guest-saved"

: >"$calls"
touch "$work/guest/broken"
flexrf test --guest --no-memory </dev/null
expect "exit code without a machine" "$status" 1
expect "why there is none" "$output" "*did not boot: the machine ended by itself*Kernel panic*first*Not Run*second*Not Run*"
expect "last line without a machine" "$(last_line)" "33% tests passed, 2 tests failed out of 3"
expect "it is tried once to be saved, and once for the tests" "$(boots)" 2
rm "$work/guest/broken"

echo false >"$tree/image/guest/fetch_kernel.sh"
flexrf test --guest --no-memory </dev/null
expect "exit code without a kernel" "$status" 1
expect "message without a kernel" "$output" "*making the guest's kernel failed*guest *FAILED*"

touch "$work/guest/other_machine"
flexrf test --guest --no-memory </dev/null
expect "exit code where there can be none" "$status" 0
expect "the table says so" "$output" "*guest *- *skipped: it needs an amd64 machine*"
expect "what was not run is not counted" "$(last_line)" "100% tests passed, 0 tests failed out of 1"
flexrf guest -- true </dev/null
expect "exit code of a command there" "$status" 1
expect "message of a command there" "$errors" "*no guest on this machine: it needs an amd64 machine"
finish
