# Sourced by flexrf: the stages of `flexrf test`.
# Stages that wait (tests, a browser) run in the foreground, one after the other; those that compute go on behind them, at low
# priority, so that no processor has nothing to do.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

stage_names=() stage_times=() stage_loads=() stage_results=()
left_out='' # labels of ctest's that are not run: the long ones, or none
stages=$root/build/.stages # what each stage leaves: NAME.log, NAME.counts, NAME.result
behind=()                  # the processes that run stages behind the others

count() { printf '%d %d\n' "$1" "$2" >>"$counts"; } # count TESTS FAILED: what a stage adds to the sum

apart() ("$@") # in a shell of its own

# In one whose children alone count: those that run behind, and end meanwhile, are the caller's. The shell tells the times on
# its own standard error, which is not the command's.
timed_apart() (
  TIMEFORMAT='%3R %3U %3S'
  time apart "$@" 2>&1
  exit "$?" # as what comes last would have the shell's standard error, too
)

measure() {  # measure NAME COMMAND...: leaves time, time on all CPUs and result; a failure does not stop the next stage
  local name=$1 result=passed wall user system counts=$stages/$1.counts
  shift
  : >"$counts"
  { timed_apart "$@" || result=FAILED; } 2>"$stages/$name.times"
  # No failure is lost in the sum.
  [[ $result == passed ]] || grep -q -v ' 0$' "$counts" || count 1 1
  read -r wall user system <<<"$(tail -n 1 "$stages/$name.times" | tr -d .,)"
  printf '%d %d %s\n' $((10#$wall * 1000)) $(((10#$user + 10#$system) * 1000)) "$result" >"$stages/$name.result"
}

count_as_test() {  # count_as_test COMMAND...: it is one test itself
  local status=0
  "$@" || status=$?
  count 1 $((status != 0))
  return "$status"
}

heading() { printf '\n== %s\n' "$1"; }

note() {  # note NAME: what the stage has left, for the table
  local wall load result
  read -r wall load result <"$stages/$1.result"
  stage_names+=("$1")
  stage_times+=("$(duration "$wall")")
  stage_loads+=("$(duration "$load")")
  stage_results+=("$result")
}

stage() {  # stage NAME COMMAND...: in the foreground
  heading "$1"
  measure "$@"
  note "$1"
}

skip() {  # skip NAME REASON: a stage that cannot be run here, which the table says
  stage_names+=("$1") stage_times+=(-) stage_loads+=(-) stage_results+=("skipped: $2")
  heading "$1"
  printf 'skipped: %s\n' "$2"
}

begin_behind() {  # begin_behind NICE FUNCTION: which runs stages behind those of the foreground, each with stage_behind
  set -m # a group of processes of its own, which ends as one
  {
    renice -n "$1" -p "$BASHPID" >/dev/null
    "$2"
  } </dev/null >>"$stages/behind.log" 2>&1 &
  behind+=($!)
  set +m
  trap 'kill -TERM -- "${behind[@]/#/-}" 2>/dev/null' EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
}

stage_behind() {  # stage_behind NAME COMMAND...
  kill -0 $$ 2>/dev/null || exit # whom this is for has been killed
  measure "$@" >"$stages/$1.log"
}

end_behind() {  # end_behind NAME: waits for that stage, and shows what it said
  heading "$1"
  while [[ ! -s $stages/$1.result ]]; do
    if ! kill -0 "${behind[@]}" 2>/dev/null && [[ ! -s $stages/$1.result ]]; then
      cat "$stages/behind.log"
      echo "what runs behind ended before this"
      # With a disk that is full, or a folder that somebody removed, it would come to no end.
      { echo 1 1 >"$stages/$1.counts" && printf '0 0 FAILED\n' >"$stages/$1.result"; } || die "$stages cannot be written"
    fi
    sleep 0.2
  done
  cat "$stages/$1.log"
  note "$1"
}

sources() {  # every C++ file that a person wrote
  find "$root" \( -path "$root/build" -o -name '.?*' \) -prune -o -type f \
    \( -name '*.cpp' -o -name '*.hpp' -o -name '*.h' \) -print0
}

documents_and_tests() {  # every file that may promise something, or test it
  find "$root" \( -path "$root/build" -o -name node_modules -o -name '.?*' \) -prune -o -type f \
    \( -name '*.md' -o -name '*.cpp' -o -name '*.hpp' -o -name '*.sh' -o -name '*.ts' \) -print
}

# The files of the image's tests are sourced together: of two functions with one name the second would take the place of the first.
check_functions() {
  local twice
  twice=$(grep -ohE '^[a-z_]+\(\)' "$tool"/image*.sh | sort | uniq -d)
  [[ ! $twice ]] || { printf 'cmake/tool/image*.sh have two functions with this name: %s\n' "$twice" && return 1; }
}

# How sources are written, which of them know which, and that what is promised is tested.
check_layout() {
  local status=0
  sources | xargs -0 -r -n 50 -P "$(nproc)" clang-format --dry-run -Werror || status=1
  sources | xargs -0 -r awk -v root="$root" -f "$tool/includes.awk" || status=1
  documents_and_tests | sort | awk -v root="$root" -f "$tool/promises.awk" || status=1
  check_functions || status=1
  return "$status"
}

# The static analysis of the files of the release build's list that lie outside build/.
analyse() {
  local headers memory='' analysis=$root/build/release/analysis status=0
  headers="^$root/($(cd "$root" && find . -mindepth 1 -maxdepth 1 -type d ! -name build ! -name '.*' -printf '%f\n' |
    sort | paste -s -d '|'))/"
  rm -rf "$analysis"
  mkdir -p "$analysis"
  if [[ $cache ]]; then
    memory=$cache/analysis
    mkdir -p "$memory"
    find "$memory" -type f -mtime +30 -delete
    sums_of_memory "$memory" "$root" >"$analysis/sums"
  fi
  awk -v root="$root" -v out="$analysis" -v size=8 -f "$tool/tidy_batches.awk" \
    "$root/build/release/compile_commands.json" | tr '\n' '\0' >"$analysis/batches"
  xargs -0 -r -a "$analysis/batches" -n 1 -P "$(nproc)" \
    bash "$tool/tidy.sh" "$root" "$analysis" "$headers" "$memory" "$(clang-tidy --version)" </dev/null || status=1
  printf '%d batches of files, %d of them as they were when nothing was found in them\n' \
    "$(tr -dc '\0' <"$analysis/batches" | wc -c)" "$(find "$analysis" -name '*.remembered' | wc -l)"
  return "$status"
}

# What each test of the release build reads, as lines "NAME CHECKSUMS" of $stages/checksums, once after the build; one that
# does not say what it reads is not among them.
find_checksums() {
  local path reads=$stages/reads
  [[ -e $stages/checksums ]] && return
  ctest --test-dir "$root/build/release" -N | sed -n 's/^ *Test *#[0-9]*: //p' |
    awk -F '\t' 'is == "name" { tests[$1]; next } $1 in tests' is=name - is=read "$root/build/release/tests_read.txt" >"$reads"
  cut -f 2 "$reads" | sort -u >"$reads.paths"
  {
    while IFS= read -r path; do [[ -f $path ]] && printf '%s\0' "$path"; done <"$reads.paths" |
      xargs -0 -r -n 16 -P "$(nproc)" b2sum -l 128
    while IFS= read -r path; do
      [[ -d $path ]] && printf '%s  %s\n' "$(find "$path" \( -path "$root/build" -o -path "$root/.git" \) -prune -o -type f -print0 |
        sort -z | xargs -0 b2sum -l 128 | b2sum -l 128 | cut -d ' ' -f 1)" "$path"
    done <"$reads.paths"
  } | awk 'is == "sum" { sums[substr($0, 35)] = $1; next }
    { split($0, part, "\t"); all[part[1]] = all[part[1]] "," sums[part[2]] }
    END { for (name in all) print name, all[name] }' is=sum - is=read "$reads" >"$stages/checksums"
}

remember_passed() {  # remember_passed CTEST_LOG: what the tests that passed had read; those that failed are forgotten
  local known=$root/build/release/tests_passed.txt
  touch "$known"
  awk 'is == "sums" { sums[$1] = $2; next }
    is == "log" { if ($2 == "Test") { ran[$4]; if (/ Passed /) passed[$4] } next }
    !($1 in ran)
    END { for (name in passed) if (name in sums) print name, sums[name] }' \
    is=sums "$stages/checksums" is=log "$1" is=known "$known" >"$known.new"
  mv "$known.new" "$known"
}

run_tests() {  # run_tests PRESET CTEST ARGUMENT...
  local preset=$1 status sum failed total log
  local -a launcher
  log=$(mktemp "$stages/ctest.XXXXXX")
  shift
  set_launcher "$preset"
  [[ $preset == release ]] && find_checksums
  "${launcher[@]}" ctest --test-dir "$root/build/$preset" --output-on-failure --no-tests=error --no-label-summary \
    -j "$(nproc)" "$@" </dev/null 2>&1 |
    sed -u '/^Could not find executable/,/^Unable to find executable/d' | tee "$log"
  status=${PIPESTATUS[0]}
  sum=$(sed -n 's/^[0-9]*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\1 \2/p' "$log")
  read -r failed total <<<"${sum:-1 1}"
  count "$total" "$failed"
  [[ $preset == release ]] && remember_passed "$log"
  return "$status"
}

quick_tests() {  # the release build's tests whose reads are not as they were when they passed
  local known=$root/build/release/tests_passed.txt without="$left_out|^panel\$" chosen
  touch "$known"
  find_checksums
  chosen=$(ctest --test-dir "$root/build/release" -N -LE "$without" | sed -n 's/^ *Test *#[0-9]*: //p' |
    awk 'is == "passed" { passed[$1] = $2; next } is == "now" { now[$1] = $2; next } !($1 in now) || passed[$1] != now[$1]' \
      is=passed "$known" is=now "$stages/checksums" is=name - | paste -s -d '|')
  if [[ $chosen ]]; then
    run_tests release -R "^($chosen)\$" -LE "$without"
  else
    echo "nothing has changed of what the tests read"
  fi
}

declare -A build_targets=() test_selection=() # of a preset, where that is not everything
choose_extent() {  # choose_extent full|some: which tests of the sanitizers' presets
  # Without a second thread there is nothing that the thread sanitizer could find; a test that starts one unsaid fails in release.
  build_targets=([fuzz]=tests_fuzz [tsan]='tests_threads tests_whole tests_stress')
  test_selection=([fuzz]='-L ^fuzz$' [tsan]='-L ^(threads|whole|stress)$')
  [[ $1 == full ]] && return
  # Whole cells are what takes long under a sanitizer, and what the other presets run already.
  build_targets[asan]='tests_unit tests_stress' test_selection[asan]='-L ^(unit|stress)$'
  build_targets[tsan]=tests_threads test_selection[tsan]='-L ^threads$'
}

build_preset() {  # build_preset PRESET
  local -a targets
  read -r -a targets <<<"${build_targets[$1]-}"
  count_as_test build "$1" "${targets[@]}"
}

test_preset() {  # test_preset PRESET: what does not build is a test that fails, the others run all the same
  local -a selection
  read -r -a selection <<<"${test_selection[$1]-}"
  if [[ $1 == release ]]; then
    stage "test release" run_tests release -LE "${left_out:+$left_out|}^panel\$"
  else
    stage "test $1" run_tests "$1" "${selection[@]}" ${left_out:+-LE "$left_out"}
  fi
}

behind_presets=() behind_analysis='' behind_guest=''
# The page and a browser before it: only in release, and apart, as they are of another kind and mostly wait themselves.
test_panel() { stage_behind panel run_tests release -L '^panel$' ${left_out:+-LE "$left_out"}; }
build_behind() {
  local preset
  for preset in "${behind_presets[@]}"; do stage_behind "build $preset" build_preset "$preset"; done
}
check_behind() {  # what nothing waits for takes what processors are left, as while a build has one file to compile
  [[ $behind_guest ]] && stage_behind guest guest_tests
  [[ $behind_analysis ]] && stage_behind "static analysis" count_as_test analyse
}

# The release build first, as all others take its generator, and what is behind the tests needs both processors then.
run_stages() {  # run_stages PRESET...: these, and what runs behind them
  local preset
  if [[ ${1-} == release ]]; then
    stage "build release" build_preset release
    behind_presets=("${@:2}")
    find_checksums
    begin_behind 0 test_panel
  else
    behind_presets=("$@")
  fi
  begin_behind 10 build_behind
  begin_behind 15 check_behind
  for preset; do
    [[ $preset == release ]] || end_behind "build $preset"
    test_preset "$preset"
  done
  [[ ${1-} == release ]] && end_behind panel
  [[ $behind_analysis ]] && end_behind "static analysis"
  [[ $behind_guest ]] && end_behind guest
  # One that ended long ago is no child that could be waited for any more.
  wait "${behind[@]}" 2>/dev/null || true
}

# Last, and alone: its PCs are emulated, and what they do in time is what a person would wait for.
image_stage() {
  local obstacle
  # shellcheck source=cmake/tool/image.sh
  source "$tool/image.sh"
  # shellcheck source=cmake/tool/image_test.sh
  source "$tool/image_test.sh"
  obstacle=$(image_obstacle)
  if [[ $obstacle ]]; then skip image "$obstacle"; else stage image image_tests; fi
}

show_table() {
  local index
  printf '\n%-20s %14s %14s\n' stage time "on all CPUs"
  for index in "${!stage_names[@]}"; do
    printf '%-20s %14s %14s   %s\n' "${stage_names[index]}" "${stage_times[index]}" "${stage_loads[index]}" \
      "${stage_results[index]}"
  done
}

show_sum() {  # in ctest's own words, over all stages; less than all is never 100 %
  awk '{ tests += $1; failed += $2 }
    END { printf "%d%% tests passed, %d tests failed out of %d\n", tests ? int((tests - failed) * 100 / tests) : 0, failed, tests
          exit failed > 0 }' "$stages"/*.counts
}

test_stages() {  # test_stages [--full | --guest [--long] [NAME...] | --image [--long] | --quick | PRESET...]
  local start obstacle
  local -a chosen=("${@:2}")
  ninja_options=(-k 0) # what fails to build should not keep the rest from being tested
  exec 2>&1 # one report, in the order in which things happened
  mkdir -p "$stages"
  exec {being_tested}>"$stages/.lock"
  flock -n "$being_tested" || die "tests are under way in this folder already"
  rm -f "$stages"/*
  start=$(microseconds)
  unset FLEXRF_LONG
  left_out='^long$'
  [[ ${1-} == --full || ${2-} == --long ]] && export FLEXRF_LONG=1 left_out=''
  [[ ${2-} == --long ]] && chosen=("${@:3}")
  choose_extent some
  obstacle=$(guest_obstacle)
  case ${1-} in
    --guest)
      stage "build guest's tests" count_as_test build release tests_guest
      if [[ $obstacle ]]; then skip guest "$obstacle"; else stage guest guest_tests "${chosen[@]}"; fi
      ;;
    --image) image_stage ;;
    --quick)
      stage "build release" build_preset release
      stage "test release" quick_tests
      ;;
    '' | --full)
      stage "source layout" count_as_test check_layout
      behind_analysis=1
      [[ $obstacle ]] || behind_guest=1
      if (($#)); then
        choose_extent full
        run_stages release checked tsan asan fuzz
      else
        run_stages release checked tsan asan
      fi
      [[ $obstacle ]] && skip guest "$obstacle"
      image_stage
      ;;
    *) run_stages "$@" ;;
  esac
  show_table
  printf '%-20s %14s\n\n' total "$(since "$start")"
  show_sum
}
