#!/usr/bin/env bash
# `test` runs every stage whatever fails, selects by preset, and ends with the sum.
source "$(dirname "$0")/stand_in.sh"
source "$(dirname "$0")/stand_in_guest.sh"
shopt -s extglob

stand_in ctest <<'BODY'
echo "long: ${FLEXRF_LONG-unset}" >>"$STAND_IN/calls"
if [[ $2 == */tsan && -e $STAND_IN/busy ]]; then # until the build of asan behind is over, and its shell
  until [[ -s $STAND_IN/tree/build/.stages/build\ asan.result ]]; do sleep 0.1; done
  sleep 0.5
fi
[[ $2 == */checked && -e $STAND_IN/failing ]] && { echo "75% tests passed, 1 tests failed out of 4"; exit 8; }
echo "100% tests passed, 0 tests failed out of 4"
BODY
stand_in clang-format </dev/null
stand_in clang-tidy </dev/null
stand_in setarch <<'BODY'
exec "${@:2}"
BODY

# The PC's own are tried by themselves.
cat >"$tree/cmake/tool/image_test.sh" <<'BODY'
image_tests() {
  echo "image; long: ${FLEXRF_LONG-unset}" >>"$STAND_IN/calls"
  count 7 0
}
BODY

last_line() { printf '%s\n' "${output##*$'\n'}"; }

flexrf test </dev/null
expect "exit code" "$status" 0
expect "last line" "$(last_line)" "100% tests passed, 0 tests failed out of 35"
for stage in "source layout" "static analysis" panel guest image {build,test}\ {release,checked,asan,tsan}; do
  expect "time of $stage" "$output" "*"$'\n'"$stage *[0-9] s   passed*"
done
expect "tests of checked" "$(grep "^ctest .*/checked " "$calls")" "!(* -L *) -LE ^long\$"
# The panel's run beside the others: which begins first is chance.
expect "tests of release" "$(grep "^ctest .*/release .* -j" "$calls" | LC_ALL=C sort)" \
  "* -L ^panel\$ -LE ^long\$"$'\n'"!(* -L *) -LE ^long\$|^panel\$"
expect "tests of asan" "$(grep "^ctest .*/asan " "$calls")" "* -L ^(unit|stress)\$ -LE ^long\$"
expect "what is built of asan" "$(grep "^ninja .*/asan" "$calls")" "*tests_unit tests_stress"
expect "tests of tsan" "$(grep "^ctest .*/tsan " "$calls")" "* -L ^threads\$ -LE ^long\$"
expect "what is built of tsan" "$(grep "^ninja .*/tsan" "$calls")" "*tests_threads"
for preset in asan tsan; do
  expect "start of $preset" "$(grep "^setarch --addr-no-randomize ctest .*/$preset " "$calls")" "?*"
done
expect "image" "$(grep ^image "$calls")" "image; long: unset"
expect "long tests" "$(sort -u <(grep ^long: "$calls"))" "long: unset"

: >"$calls"
flexrf test --full </dev/null
expect "exit code of --full" "$status" 0
expect "long tests of --full" "$(sort -u <(grep ^long: "$calls"))" "long: 1"
expect "image of --full" "$(grep ^image "$calls")" "image; long: 1"
expect "selections of --full" "$(grep '^ctest.* -L' "$calls" | LC_ALL=C sort)" "*/fuzz * -L ^fuzz\$"$'\n'"* -L ^panel\$"$'\n'"* -LE ^panel\$"$'\n'"*/tsan * -L ^(threads|whole|stress)\$"
expect "what is built of fuzz" "$(grep "^ninja .*/fuzz" "$calls")" "*tests_fuzz"

: >"$calls"
flexrf test tsan debug </dev/null
expect "exit code of two presets" "$status" 0
expect "presets" "$(grep '^ctest' "$calls" | sed 's|.*/build/\([a-z]*\) .*|\1|')" "tsan"$'\n'"debug"
expect "last line of two presets" "$(last_line)" "100% tests passed, 0 tests failed out of 10"

# What builds behind ends while the tests of asan wait.
touch "$work/busy"
flexrf test tsan asan </dev/null
expect "processor time of a build" "$output" "*"$'\n'"build asan +([^s])s +( )[1-9]* s   passed*"
expect "processor time of tests that wait" "$output" "*"$'\n'"test tsan +([^s])s +( )0.? s   passed*"
rm "$work/busy"

touch "$work/failing"
: >"$calls"
flexrf test </dev/null
expect "exit code of a failure" "$status" 1
expect "stages after a failure" "$output" "*test checked *FAILED*test tsan *passed*"
expect "last line of a failure" "$(last_line)" "97% tests passed, 1 tests failed out of 35"

touch "$work/broken"
flexrf test release </dev/null
expect "exit code of a broken build" "$status" 1
expect "tests after a broken build" "$output" "*error: broken*build release *FAILED*test release *passed*panel *passed*"
expect "last line of a broken build" "$(last_line)" "88% tests passed, 1 tests failed out of 9"
finish
