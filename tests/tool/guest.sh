#!/usr/bin/env bash
# `guest` runs a command in the machine; `test --guest` runs the tests in it, shows the console of what fails, gives the next
# test a machine of its own when one takes the machine down, or has it reset, and says when there can be no machine.
source "$(dirname "$0")/stand_in.sh"
source "$(dirname "$0")/stand_in_guest.sh"

last_line() { printf '%s\n' "${output##*$'\n'}"; }
boots() { grep -c ^qemu "$calls"; }

flexrf guest -- show 'two words' <<<"keys"
expect "exit code of a command" "$status" 7
expect "output of a command" "$output" "in the guest: show two words; input: keys"
expect "errors of a command" "$errors" "*made the guest's kernel*booted the guest*an error*"
expect "what is built" "$(grep ^ninja "$calls")" "*tests_guest keyboard*keyboard*"

: >"$calls"
flexrf test --guest </dev/null
expect "exit code" "$status" 0
expect "lines" "$output" "*1/2 Test #1: first ...*   Passed  1.23 sec*2/2 Test #2: second ...*   Passed  1.23 sec*"
expect "last line" "$(last_line)" "100% tests passed, 0 tests failed out of 3"
expect "the kernel is made once" "$errors" ""
expect "machines" "$(boots)" 1

: >"$calls"
echo 2 >"$work/guest/cpus"
# Else one machine might have done all before the other came to look for a test.
echo "meets second" >"$work/guest/first"
rm "$work/guest/second.begun"
flexrf test --guest </dev/null
expect "exit code with two machines" "$status" 0
expect "one of the two's lines" "$output" "*1/2 Test #1: first ...*   Passed  1.23 sec*"
expect "the other's lines" "$output" "*2/2 Test #2: second ...*   Passed  1.23 sec*"
expect "last line with two machines" "$(last_line)" "100% tests passed, 0 tests failed out of 3"
expect "a machine for each CPU" "$(boots)" 2
rm "$work/guest/cpus" "$work/guest/first"

: >"$calls"
echo "ends 3" >"$work/guest/first"
flexrf test --guest </dev/null
expect "exit code of a failure" "$status" 1
expect "console of a failure" "$output" "*hello from first*Failed with 3*second*Passed*FAILED in the guest*first*guest *FAILED*"
expect "last line of a failure" "$(last_line)" "66% tests passed, 1 tests failed out of 3"
expect "machines with a failure" "$(boots)" 1
flexrf test --guest --long </dev/null
expect "what a test is told of long tests" "$output" "*hello from first, with FLEXRF_LONG=1*"

: >"$calls"
echo "takes the machine down" >"$work/guest/first"
flexrf test --guest </dev/null
expect "exit code when the machine ends" "$status" 1
expect "the next one" "$output" "*hello from first*the machine ended by itself*second*Passed*"
expect "machines when one ends" "$(boots)" 2
rm "$work/guest/first"

: >"$calls"
printf '%s\n' dog_reset_guest_test second >"$tree/build/release/guest_tests.txt"
echo resets >"$work/guest/dog_reset_guest_test"
flexrf test --guest </dev/null
expect "exit code when the machine is reset" "$status" 0
expect "what has it reset" "$output" "*dog_reset_guest_test *Passed*second *Passed*"
expect "machines when one was reset" "$(boots)" 2
printf '%s\n' first second >"$tree/build/release/guest_tests.txt"

: >"$calls"
touch "$work/guest/broken"
flexrf test --guest </dev/null
expect "exit code without a machine" "$status" 1
expect "why there is none" "$output" "*did not boot: the machine ended by itself*Kernel panic*first*Not Run*second*Not Run*"
expect "last line without a machine" "$(last_line)" "33% tests passed, 2 tests failed out of 3"
expect "it is tried once" "$(boots)" 1
rm "$work/guest/broken"

echo false >"$tree/image/guest/fetch_kernel.sh"
flexrf test --guest </dev/null
expect "exit code without a kernel" "$status" 1
expect "message without a kernel" "$output" "*making the guest's kernel failed*guest *FAILED*"

touch "$work/guest/other_machine"
flexrf test --guest </dev/null
expect "exit code where there can be none" "$status" 0
expect "the table says so" "$output" "*guest *- *skipped: it needs an amd64 machine*"
expect "what was not run is not counted" "$(last_line)" "100% tests passed, 0 tests failed out of 1"
flexrf guest -- true </dev/null
expect "exit code of a command there" "$status" 1
expect "message of a command there" "$errors" "*no guest on this machine: it needs an amd64 machine"
finish
