#!/usr/bin/env bash
# `test --quick` runs what reads something else than when it passed, what has not passed, and what does not say what it reads.
source "$(dirname "$0")/stand_in.sh"
shopt -s extglob

# Knows the tests program, table and silent; fails those that are named in $work/failing.
stand_in ctest <<'BODY'
if [[ $* == *" -N"* ]]; then
  printf '  Test #%d: %s\n' 1 program 2 table 3 silent
  exit
fi
for ((i = 1; i <= $#; ++i)); do [[ ${!i} == -R ]] && next=$((i + 1)) && chosen=${!next}; done
failed=0 total=0
for name in program table silent; do
  [[ ${chosen-} && ! $name =~ $chosen ]] && continue
  total=$((total + 1)) result="   Passed "
  grep -q -x "$name" "$STAND_IN/failing" && failed=$((failed + 1)) result="***Failed "
  printf '%3d/3 Test #%d: %s .....%s   0.01 sec\n' "$total" "$total" "$name" "$result"
done
echo "$(((total - failed) * 100 / total))% tests passed, $failed tests failed out of $total"
exit $((failed > 0))
BODY
touch "$work/failing"
mkdir -p "$tree/build/release" "$tree/tables/deep"
echo 1 >"$tree/program"
echo 1 >"$tree/tables/deep/a.toml"
printf '%s\t%s\n' program "$tree/program" table "$tree/program" table "$tree/tables" of_another_build /none >"$tree/build/release/tests_read.txt"

ran() { sed -n 's/^.*[0-9] Test #[0-9]*: \([a-z]*\) .*/\1/p' <<<"$output" | paste -s -d ' '; }
quick() {  # quick WHEN RAN [STATUS]
  flexrf test --quick </dev/null
  expect "exit code $1" "$status" "${3-0}"
  expect "tests $1" "$(ran)" "$2"
}

quick "the first time" "program table silent"
expect "stages" "$output" "*build release *passed*test release *passed*100% tests passed, 0 tests failed out of 4"
quick "the second time" silent
expect "what is told of the others" "$output" "*Test: program .* unchanged since it passed (20*2 tests were not run again*out of 2"
echo 2 >"$tree/tables/deep/a.toml"
quick "after a change of a table" "table silent"
echo 2 >"$tree/program"
echo table >"$work/failing"
quick "after a change of the program" "program table silent" 1
quick "after a failure" "table silent" 1
: >"$work/failing"
quick "after it was mended" "table silent"
touch "$tree/tables/deep/b.toml"
quick "after a new table" "table silent"
rm "$tree/tables/deep/b.toml"
quick "after it was taken away" silent

echo 3 >"$tree/program"
flexrf test release </dev/null
expect "exit code of all tests" "$status" 0
quick "after all tests" silent
flexrf test --quick --no-memory </dev/null
expect "tests without memory" "$(ran)" "program table silent"
FLEXRF_CACHE=off flexrf test --quick </dev/null
expect "tests without a cache" "$(ran)" "program table silent"
flexrf test --quick now </dev/null
expect "exit code with a word behind it" "$status" 1
expect "message with a word behind it" "$errors" "flexrf: --quick takes no names*"
finish
