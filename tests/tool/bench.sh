#!/usr/bin/env bash
# `bench` runs all benchmarks or one, keeps their figures, prints one table of all, and puts it into the documentation.
source "$(dirname "$0")/stand_in.sh"

mkdir -p "$tree/benchmarks" "$tree/docs" "$tree/build/release/benchmarks"
printf '%s\n' first second >"$tree/benchmarks/names.txt"
for name in first second; do
  cat >"$tree/build/release/benchmarks/bench_$name" <<'BODY'
#!/bin/bash
printf '%s\n' "$(basename "$0") $*" >>"$STAND_IN/calls"
echo "table of $(basename "$0")"
[[ -e $STAND_IN/no_right ]] && exit 1
echo "{}" >"$2"
BODY
done
cat >"$tree/build/release/benchmarks/bench_summary" <<'BODY'
#!/bin/bash
folder=$1
shift
echo "table of $*"
echo "| table of $* |" >"$folder/results.md"
BODY
chmod +x "$tree/build/release/benchmarks/"*
kept=$tree/build/bench
page=$tree/docs/performance.md
printf '%s\n' before '<!-- results -->' old '<!-- end of results -->' after >"$page"

flexrf bench --markdown </dev/null
expect "exit code of quoting nothing" "$status" 1
expect "message of quoting nothing" "$errors" "*nothing was measured yet*"

FLEXRF_BENCH_SHORT='' flexrf bench </dev/null
expect "exit code" "$status" 0
expect "one table" "$output" "table of first second"
expect "each one's own table" "$(<"$kept/second.txt")" "table of bench_second"
expect "built together" "$(grep ^ninja "$calls")" "ninja -C $tree/build/release bench_summary bench_first bench_second"
expect "arguments" "$(grep ^bench_second "$calls")" "bench_second --json $kept/second.json"

FLEXRF_BENCH_SHORT=1 flexrf bench second </dev/null
expect "exit code of one" "$status" 0
expect "its own table" "$output" "table of bench_second"
expect "short blocks" "$(tail -n 1 "$calls")" "bench_second --json $kept/second.json --quick"
expect "the other's figures stay" "$(<"$kept/results.md")" "| table of first second |"

flexrf bench --markdown </dev/null
expect "exit code of quoting" "$status" 0
expect "page" "$(tr '\n' ' ' <"$page")" "before <!-- results -->  | table of first second |  <!-- end of results --> after "

touch "$work/no_right"
flexrf bench </dev/null
expect "exit code when one fails" "$status" 1
expect "the table all the same" "$output" "table of first second"
expect "no old figures" "$(ls "$kept")" "first.txt*results.md*second.txt"

flexrf bench secnd </dev/null
expect "exit code of an unknown one" "$status" 1
expect "nearest name" "$errors" "*did you mean 'second'*"
finish
