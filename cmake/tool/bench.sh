# Sourced by flexrf: the benchmarks, one after the other, and what they measured.
# shellcheck shell=bash disable=SC2154 # root is flexrf's

results=$root/build/bench

benchmarks() { cat "$root/benchmarks/names.txt"; }  # in the order of the table

summarise() { "$root/build/release/benchmarks/bench_summary" "$results" "$@"; }

measure() {  # measure NAME: what it prints goes to standard output, its figures to build/bench/NAME.json
  local -a options=(--json "$results/$1.json")
  [[ ${FLEXRF_BENCH_SHORT-} ]] && options+=(--quick)
  rm -f "$results/$1.json"
  "$root/build/release/benchmarks/bench_$1" "${options[@]}" </dev/null
}

measure_one() {  # measure_one NAME: the others' last figures stay in results.json and results.md
  local name status=0
  local -a measured=()
  measure "$1" || status=$?
  for name in "${known[@]}"; do [[ -f $results/$name.json ]] && measured+=("$name"); done
  ((${#measured[@]})) && summarise "${measured[@]}" >/dev/null
  return "$status"
}

measure_all() {
  local name start status=0
  for name in "${known[@]}"; do
    start=$(microseconds)
    measure "$name" >"$results/$name.txt" || status=$?
    say "measured $name: $(since "$start")"
  done
  summarise "${known[@]}" || status=$?
  say "also in build/bench/results.json, and for the documentation in results.md"
  return "$status"
}

quote_results() {  # puts the last results into docs/performance.md, between its two marks
  [[ -s $results/results.md ]] || die "nothing was measured yet: ./flexrf bench"
  replace_between "$root/docs/performance.md" '<!-- results -->' '<!-- end of results -->' <"$results/results.md"
  cat "$results/results.md"
  say "put into docs/performance.md"
}
