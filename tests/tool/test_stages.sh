#!/usr/bin/env bash
# `test` runs every stage whatever fails, selects by preset, and ends with the sum.
source "$(dirname "$0")/stand_in.sh"
source "$(dirname "$0")/stand_in_guest.sh"
shopt -s extglob

stand_in ctest <<'BODY'
[[ $* == *" -N"* ]] && { echo "  Test #1: it"; exit; }
echo "long: ${FLEXRF_LONG-unset}" >>"$STAND_IN/calls"
if [[ $2 == */tsan && -e $STAND_IN/busy ]]; then # until the build of asan behind is over, and its shell
  until [[ -s $STAND_IN/tree/build/.stages/build\ asan.result ]]; do sleep 1; done
  sleep 0.5
fi
[[ ${FLEXRF_LONG-} == part* ]] && echo "1/1 Test #1: it ....   Passed  1 s"
[[ $2 == */checked && -e $STAND_IN/failing ]] && { echo "75% tests passed, 1 tests failed out of 4"; exit 8; }
echo "100% tests passed, 0 tests failed out of 4"
BODY
stand_in clang-format </dev/null
stand_in clang-tidy </dev/null
stand_in setarch <<'BODY'
exec "${@:2}"
BODY

# The PC's own are tried by themselves.
mkdir -p "$tree/image/disk"
echo 'mib_of() { echo 1; }' >"$tree/image/disk/partitions.sh"
cat >"$tree/cmake/tool/image_test.sh" <<'BODY'
image_levels=(first gate full soak)
image_test_list() { printf '%s\n' 'boots first a' 'updates gate b' 'flagship full c' 'campaign soak d'; }
image_test_key() { echo "key of $1"; }
build_image_programs() { :; }
image_tests() {
  echo "image $*; long: ${FLEXRF_LONG-unset}" >>"$STAND_IN/calls"
  count 7 0
  echo "1/1 Test #1: $2 ....   Passed  1 s"
}
BODY

last_line() { printf '%s\n' "${output##*$'\n'}"; }
stages_of() {  # stages_of OUTPUT: the names in the table, sorted
  sed -n -E 's/^([a-z]+( [a-z]+)*) +([0-9]+ min )?[0-9.]+ s .* (passed|FAILED)$/\1/p' <<<"$output" | LC_ALL=C sort | paste -s -d ,
}
test_calls() { grep "^ctest .*-j" "$calls" | grep -v -e ' -N' | LC_ALL=C sort; }

FLEXRF_CACHE=off flexrf test </dev/null
expect "exit code" "$status" 0
expect "last line" "$(last_line)" "100% tests passed, 0 tests failed out of 19"
expect "stages" "$(stages_of)" "build release,guest,image first,panel,source layout,test release"
expect "use of the processors" "$output" "*total * % of 1 CPUs*"
expect "selections" "$(test_calls)" "*/release * -j 1 -L ^panel\$ -LE ^long\$ -R ^(it)\$"$'\n'"*/release * -j 3 -LE ^panel\$|^long\$ -R ^(it)\$"
expect "image" "$(grep ^image "$calls")" "image first boots; long: unset"
expect "long tests" "$(sort -u <(grep ^long: "$calls"))" "long: unset"
expect "record" "$(cut -f 1-2 "$tree"/build/test-records/first-*.txt)" $'level\tfirst\nstate\tcold\n*'$'stage\tguest\n*'

: >"$calls"
flexrf test --gate --no-memory </dev/null
expect "exit code of --gate" "$status" 0
expect "stages of --gate" "$(stages_of)" \
  "build asan,build checked,build release,build tsan,image gate,static analysis,test asan,test checked,test tsan"
expect "tests of checked" "$(grep "^ctest .*/checked .* -j" "$calls")" "!(* -L *) -LE ^long\$ *"
expect "tests of asan" "$(grep "^ctest .*/asan .* -j" "$calls")" "* -L ^(unit|stress)\$ -LE ^long\$ *"
expect "what is built of asan" "$(grep "^ninja .*/asan" "$calls")" "*tests_unit tests_stress"
expect "tests of tsan" "$(grep "^ctest .*/tsan .* -j" "$calls")" "* -L ^threads\$ -LE ^long\$ *"
expect "what is built of tsan" "$(grep "^ninja .*/tsan" "$calls")" "*tests_threads"
for preset in asan tsan; do
  expect "start of $preset" "$(grep "^setarch --addr-no-randomize ctest .*/$preset " "$calls")" "?*"
done
expect "image of --gate" "$(grep ^image "$calls")" "image gate updates; long: unset"

: >"$calls"
flexrf test --full --no-memory </dev/null
expect "exit code of --full" "$status" 0
expect "stages of --full" "$(stages_of)" \
  "build asan,build checked,build fuzz,build release,build tsan,guest,image first,image full,image gate,panel,source layout,static analysis,test asan,test checked,test fuzz,test release,test tsan"
expect "long tests of --full" "$(sort -u <(grep ^long: "$calls"))" "long: 1"
expect "image of --full" "$(grep ^image "$calls")" "image first boots; long: 1"$'\n'"image gate updates; long: 1"$'\n'"image full flagship; long: 1"
expect "selections of --full" "$(test_calls | grep -e ' -L')" "*/fuzz * -L ^fuzz\$ -R *"$'\n'"* -L ^panel\$ -R *"$'\n'"* -LE ^panel\$ -R *"$'\n'"*/tsan * -L ^(threads|whole|stress)\$ -R *"
expect "what is built of fuzz" "$(grep "^ninja .*/fuzz" "$calls")" "*tests_fuzz"

: >"$calls"
printf '%s\t%s\n' it "$tree/build/release/it" other "$tree/build/release/other" it "$tree/cmake" >"$tree/build/release/tests_read.txt"
printf 'tries part %%u of %%u\n' >"$tree/build/release/it"
printf 'tries nothing\n' >"$tree/build/release/other"
chmod +x "$tree"/build/release/{it,other}
flexrf test --soak </dev/null
expect "exit code of --soak" "$status" 0
expect "orders of --soak" "$(grep -e '^ctest .*-j' -e '^long: part' "$calls" | head -n 4)" \
  "ctest */release * -R ^(it)\$"$'\n'"long: part 1 of 20"$'\n'"ctest */release * -R ^(it)\$"$'\n'"long: part 2 of 20"
expect "parts of --soak" "$(grep -c '^long: part' "$calls")" 20
expect "image of --soak" "$(grep ^image "$calls")" "image soak campaign; long: 1"
: >"$calls"
flexrf test --soak </dev/null
expect "orders of a second --soak" "$(grep -c '^long: part' "$calls")" 0
rm "$tree"/build/release/{it,other,tests_read.txt}

: >"$calls"
flexrf test tsan debug --no-memory </dev/null
expect "exit code of two presets" "$status" 0
expect "presets" "$(grep '^ctest.* -j' "$calls" | sed 's|.*/build/\([a-z]*\) .*|\1|')" "tsan"$'\n'"debug"
expect "last line of two presets" "$(last_line)" "100% tests passed, 0 tests failed out of 10"

# The build of asan in its lane ends while the tests of tsan wait.
touch "$work/busy"
flexrf test tsan asan --no-memory </dev/null
expect "processor time of a build" "$output" "*"$'\n'"build asan +([^s])s +( )[1-9]* s   passed*"
spent() { sed -n -E "s/^$1 +[^ ].* {2,}([0-9.]+) s +passed.*/\1/p" <<<"$output"; } # spent STAGE: on all CPUs, s
expect "processor time of tests that wait" "$(awk -v tests="$(spent 'test tsan')" -v build="$(spent 'build asan')" '
  BEGIN { if (tests != "" && tests < build / 2) print "little"; else print tests " s beside the " build " s of a build" }')" little
rm "$work/busy"

printf 'build release\t1000\ntest release\t0\n' >"$tree/cmake/tool/test_budgets.txt"
flexrf test release --no-memory </dev/null
expect "exit code over a budget" "$status" 0
expect "what is over its budget" "$output" "!(*over budget: build*)over budget: test release used 0.* s on all CPUs, and its budget is 0.0 s*"

touch "$work/failing"
: >"$calls"
flexrf test --gate --no-memory </dev/null
expect "exit code of a failure" "$status" 1
expect "stages after a failure" "$output" "*test checked *FAILED*test tsan *passed*"
expect "last line of a failure" "$(last_line)" "9[0-9]% tests passed, 1 tests failed out of *"

touch "$work/broken"
flexrf test release --no-memory </dev/null
expect "exit code of a broken build" "$status" 1
expect "tests after a broken build" "$output" "*error: broken*build release *FAILED*test release *passed*panel *passed*"
expect "last line of a broken build" "$(last_line)" "88% tests passed, 1 tests failed out of 9"

# The tests of tsan take longer than the limit: what had failed by then has failed.
rm "$work/broken"
stand_in ctest <<'BODY'
[[ $* == *" -N"* ]] && { echo "  Test #1: it"; exit; }
case $2 in
  */checked) echo "100% tests passed, 0 tests failed out of 4" ;;
  */tsan) echo "1/4 Test #1: it ....***Failed  1 s" && sleep 1000 ;;
esac
BODY
flexrf test --gate --time-limit 0s --no-memory </dev/null
expect "exit code without time" "$status" 0
expect "what there is no time for" "$output" "*build checked * left out: it had not ended after 0s*test asan * left out: *"
expect "sum without time" "$output" "*8 stages had not ended when the time was over: ./flexrf test --gate does them*"
# A busy machine takes longer to come to the tests of tsan: the limit is doubled until they have begun in it.
limit=5
until
  flexrf test --gate --time-limit "${limit}s" --no-memory </dev/null
  [[ $output == *"***Failed"* ]] || ((limit > 300))
do
  ((limit *= 2))
done
expect "exit code of a stage that is ended" "$status" 1
expect "what ended in time" "$output" "*test checked * passed*"
expect "what was ended" "$output" "*test tsan * left out: it had not ended after ${limit}s*"
expect "failures of what was ended" "$(last_line)" "* 1 tests failed out of *"
flexrf test --time-limit 5min </dev/null
expect "message of a limit without --gate" "$errors" "flexrf: --time-limit goes with --gate*"
flexrf test --gate --time-limit soon </dev/null
expect "message of a limit that is no number" "$errors" "flexrf: --time-limit takes a time, such as 40min or 90s*"

flexrf test --gate --full </dev/null
expect "message with two levels" "$errors" "flexrf: --full comes first, and one level at a time*"
flexrf test --long </dev/null
expect "message of --long alone" "$errors" "flexrf: --long goes with --guest and --image*"
finish
