# Sourced by flexrf: the stages of `flexrf test`.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

stage_names=() stage_times=() stage_loads=() stage_results=()
tests_run=0 tests_failed=0
analyses=0 analysis_pid=''

stage() {  # stage NAME COMMAND...: runs it and notes time and result; a failure does not stop the next stage
  local name=$1 result=passed wall user system TIMEFORMAT='%3R %3U %3S'
  shift
  printf '\n== %s\n' "$name"
  # The shell tells the times on its own standard error, which is not the command's.
  { time "$@" 2>&1 || result=FAILED; } 2>"$root/build/.times"
  read -r wall user system <<<"$(tail -n 1 "$root/build/.times" | tr -d .,)"
  stage_names+=("$name")
  stage_times+=("$(duration $((10#$wall * 1000)))")
  stage_loads+=("$(duration $(((10#$user + 10#$system) * 1000)))")
  stage_results+=("$result")
}

skip() {  # skip NAME REASON: a stage that cannot be run here, which the table says
  stage_names+=("$1") stage_times+=(-) stage_loads+=(-) stage_results+=("skipped: $2")
  printf '\n== %s\nskipped: %s\n' "$1" "$2"
}

check() {  # check NAME COMMAND...: a stage that counts as one test
  stage "$@"
  ((tests_run++))
  [[ ${stage_results[-1]} == passed ]] || ((tests_failed++))
}

sources() {  # every C++ file that a person wrote
  find "$root" \( -path "$root/build" -o -name '.?*' \) -prune -o -type f \
    \( -name '*.cpp' -o -name '*.hpp' -o -name '*.h' \) -print0
}

check_format() { sources | xargs -0 -r -n 50 clang-format --dry-run -Werror; }

# Begins the static analysis of the files of the release build's list that lie outside build/. It goes on beside the
# tests, with what they leave of the processors: those with a browser leave half.
begin_analysis() {
  local headers analysis=$root/build/release/analysis
  headers="^$root/($(cd "$root" && find . -mindepth 1 -maxdepth 1 -type d ! -name build ! -name '.*' -printf '%f|')"
  rm -rf "$analysis"
  mkdir -p "$analysis"
  awk -v root="$root" -v out="$analysis" -v size=8 -f "$tool/tidy_batches.awk" \
    "$root/build/release/compile_commands.json" | tr '\n' '\0' >"$analysis/batches"
  # A command of its own, not a shell's: it ends with this script, however that ends.
  setpriv --pdeathsig TERM chrt --idle 0 xargs -0 -r -a "$analysis/batches" -n 1 -P "$(nproc)" \
    bash "$tool/tidy.sh" "$analysis" "${headers%|})/" </dev/null >"$analysis/found" 2>&1 &
  analysis_pid=$!
}

end_analysis() {  # what was found, once all files are through
  local status=0
  wait "$analysis_pid" || status=1
  cat "$root/build/release/analysis/found"
  return "$status"
}

run_tests() {  # run_tests PRESET CTEST ARGUMENT...
  local preset=$1 log=$root/build/$1/ctest.log status counts failed total
  local -a launcher
  shift
  set_launcher "$preset"
  "${launcher[@]}" ctest --test-dir "$root/build/$preset" --output-on-failure --no-tests=error --no-label-summary \
    -j "$(nproc)" "$@" </dev/null 2>&1 |
    sed -u '/^Could not find executable/,/^Unable to find executable/d' | tee "$log"
  status=${PIPESTATUS[0]}
  counts=$(sed -n 's/^[0-9]*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\1 \2/p' "$log")
  read -r failed total <<<"${counts:-1 1}"
  ((tests_failed += failed, tests_run += total))
  return "$status"
}

test_preset() {  # test_preset PRESET full|some: what does not build is a test that fails, the others run all the same
  local preset=$1 extent=$2 without=''
  local -a targets=() selection=()
  if [[ $preset == fuzz ]]; then # decoders given bytes that nobody thought of, and nothing else
    check "build fuzz" build fuzz tests_fuzz
    stage "test fuzz" run_tests fuzz -L '^fuzz$'
    return
  fi
  # Whole cells are what takes long under a sanitizer, and what the other presets run already.
  [[ $extent == some ]] && targets=(tests_unit tests_stress) selection=(-L '^(unit|stress)$')
  [[ ${FLEXRF_LONG-} ]] || without='^long$'
  check "build $preset" build "$preset" "${targets[@]}"
  ((analyses)) && begin_analysis
  if [[ $preset == release ]]; then
    # The page and a browser before it: only here, and apart, as they are of another kind and take their time.
    stage "test $preset" run_tests "$preset" "${selection[@]}" -LE "${without:+$without|}^panel\$"
    stage panel run_tests "$preset" -L '^panel$' ${without:+-LE "$without"}
  else
    stage "test $preset" run_tests "$preset" "${selection[@]}" ${without:+-LE "$without"}
  fi
}

test_guest() {  # what needs real drivers, in the machine that has them; built with the release preset
  local obstacle
  obstacle=$(guest_obstacle)
  if [[ $obstacle ]]; then skip guest "$obstacle"; else stage guest guest_tests; fi
}

test_stages() {  # test_stages [--full | --guest [--long] | PRESET...]
  local start preset index failed=0
  local -a chosen=("$@")
  local -A extent=([release]=full [checked]=full [debug]=full [asan]=some [tsan]=some [fuzz]=full)
  ninja_options=(-k 0) # what fails to build should not keep the rest from being tested
  exec 2>&1 # one report, in the order in which things happened
  mkdir -p "$root/build"
  start=$(microseconds)
  unset FLEXRF_LONG
  [[ $* == *--full || $* == *--long ]] && export FLEXRF_LONG=1
  if [[ ${1-} == --full ]]; then
    extent[asan]=full extent[tsan]=full
  fi
  if [[ ${1-} == --guest ]]; then
    chosen=()
    check "build guest's tests" build release tests_guest
    test_guest
  elif (($# == 0)) || [[ $1 == --full ]]; then
    check "source layout" check_format
    chosen=(checked asan tsan)
    [[ ${1-} == --full ]] && chosen+=(fuzz)
    analyses=1
    test_preset release full
    analyses=0
    check "static analysis" end_analysis
    test_guest
  fi
  for preset in "${chosen[@]}"; do test_preset "$preset" "${extent[$preset]}"; done

  printf '\n%-20s %14s %14s\n' stage time "on all CPUs"
  for index in "${!stage_names[@]}"; do
    printf '%-20s %14s %14s   %s\n' "${stage_names[index]}" "${stage_times[index]}" "${stage_loads[index]}" \
      "${stage_results[index]}"
    [[ ${stage_results[index]} == FAILED ]] && failed=1
  done
  printf '%-20s %14s\n\n' total "$(since "$start")"
  # In ctest's own words, over all stages. Less than all is never 100 %.
  printf '%d%% tests passed, %d tests failed out of %d\n' \
    $(((tests_run - tests_failed) * 100 / (tests_run ? tests_run : 1))) "$tests_failed" "$tests_run"
  return "$failed"
}
