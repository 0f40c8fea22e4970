# Sourced by flexrf: runs the stages of `flexrf test`, measures them, and shows the table at the end. Which stages a level has stands in
# levels.sh.
# A lane is a process that runs stages one after the other; lanes run beside each other and beside the stages of the foreground, so that the
# processors have work while tests wait for timers, browsers and processes.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

stage_names=() stage_times=() stage_loads=() stage_results=()
stage_load_sum=0          # microseconds of processor time of all stages
stages=$root/build/.stages # what each stage leaves: NAME.log, NAME.counts, NAME.result
lanes=()                   # their processes

# count TESTS FAILED [UNCHANGED]: what a stage adds to the sum; UNCHANGED tests were not run again.
count() { printf '%d %d %d\n' "$1" "$2" "${3-0}" >>"$counts"; }

in_subshell() ("$@")

# In a subshell whose children alone are counted, since those of the lanes are the caller's. The shell prints the times on its own standard
# error, which is not the command's.
timed_subshell() (
  TIMEFORMAT='%3R %3U %3S'
  time in_subshell "$@" 2>&1
  exit "$?" # a command that ends a function would have the shell's standard error, too
)

measure() {  # measure NAME COMMAND...: leaves time, time on all CPUs and result; a failure does not stop the next stage
  local name=$1 result=passed wall user system counts=$stages/$1.counts
  shift
  : >"$counts"
  { timed_subshell "$@" || result=FAILED; } 2>"$stages/$name.times"
  # A stage that failed without counting a failure still counts one.
  [[ $result == passed ]] || grep -q -v -E '^[0-9]+ 0 ' "$counts" || count 1 1
  read -r wall user system <<<"$(tail -n 1 "$stages/$name.times" | tr -d .,)"
  printf '%d %d %s\n' $((10#$wall * 1000)) $(((10#$user + 10#$system) * 1000)) "$result" >"$stages/$name.result"
}

count_as_test() {  # count_as_test COMMAND...: the command is one test
  local status=0
  "$@" || status=$?
  count 1 $((status != 0))
  return "$status"
}

heading() { printf '\n== %s\n' "$1"; }

note() {  # note NAME: adds what the stage has left to the table
  local wall load result over
  read -r wall load result <"$stages/$1.result"
  stage_names+=("$1")
  stage_times+=("$(duration "$wall")")
  stage_loads+=("$(duration "$load")")
  stage_results+=("$result")
  stage_load_sum=$((stage_load_sum + load))
  record_stage "$1" "$wall" "$load"
  warn_over_budget "$1" "$load"
}

stage() {  # stage NAME COMMAND...: in the foreground
  heading "$1"
  measure "$@"
  note "$1"
}

add_row() {  # add_row NAME RESULT: of a stage that has no times
  stage_names+=("$1") stage_times+=(-) stage_loads+=(-) stage_results+=("$2")
  printf '%s\n' "$2"
}

skip() {  # skip NAME REASON: a stage that cannot run on this machine; the table says so
  heading "$1"
  add_row "$1" "skipped: $2"
}

# With `--time-limit` a stage that has not ended in time is ended, and those behind it do not begin: the table names them. They have not
# passed, so that the next run does them; of their tests, those that failed by then have failed.
left_out=0
time_is_over_at=''
limit_time() {  # from now on
  case $time_limit in
    *min) time_is_over_at=$((SECONDS + 10#${time_limit%min} * 60)) ;;
    *s) time_is_over_at=$((SECONDS + 10#${time_limit%s})) ;;
  esac
}
time_is_over() { [[ $time_is_over_at ]] && ((SECONDS >= time_is_over_at)); }

end_late_lanes() {  # what their stages say while they are ended is no failure
  local log
  for log in "$stages"/*.log; do cp "$log" "${log%.log}.said"; done
  kill -TERM -- "${lanes[@]/#/-}" 2>/dev/null
  lanes=()
}

leave_out() {  # leave_out NAME: for want of time; its output is shown as far as it came
  local failed=0
  if ((${#lanes[@]})); then end_late_lanes; fi
  if [[ -s $stages/$1.said ]]; then
    cat "$stages/$1.said"
    failed=$(grep -c -E '\*\*\*(Failed|Timeout|Exception|Not Run)|\.   Failed  ' "$stages/$1.said")
  fi
  printf '%d %d 0\n' "$failed" "$failed" >"$stages/$1.counts"
  ((left_out += 1))
  add_row "$1" "left out: it had not ended after $time_limit"
}

start_lane() {  # start_lane NICE FUNCTION [ARGUMENT...]: the function runs its stages with lane_stage
  if time_is_over; then return; fi
  set -m # a process group of its own, which is ended as one
  {
    renice -n "$1" -p "$BASHPID" >/dev/null
    "${@:2}"
  } </dev/null >>"$stages/lanes.log" 2>&1 &
  lanes+=($!)
  set +m
  trap 'kill -TERM -- "${lanes[@]/#/-}" 2>/dev/null' EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
}

lane_stage() {  # lane_stage NAME COMMAND...
  kill -0 $$ 2>/dev/null || exit # the script was killed
  measure "$@" >"$stages/$1.log"
}

await_stage() {  # await_stage NAME: waits for a stage of a lane, and shows its output
  heading "$1"
  while [[ ! -s $stages/$1.result ]]; do
    if time_is_over; then
      leave_out "$1"
      return
    fi
    if ! kill -0 "${lanes[@]}" 2>/dev/null && [[ ! -s $stages/$1.result ]]; then
      cat "$stages/lanes.log"
      echo "the lane of this stage ended early"
      # On a full disk, or in a folder that somebody removed, this loop would not end.
      { echo 1 1 0 >"$stages/$1.counts" && printf '0 0 FAILED\n' >"$stages/$1.result"; } || die "$stages cannot be written"
    fi
    sleep 0.2
  done
  cat "$stages/$1.log"
  note "$1"
}

end_lanes() {  # a lane that ended long ago is no child any more that could be waited for
  ((${#lanes[@]})) && wait "${lanes[@]}" 2>/dev/null
  lanes=()
}

show_table() {  # show_table MICROSECONDS: which all of it took
  local index
  printf '\n%-20s %14s %14s\n' stage time "on all CPUs"
  for index in "${!stage_names[@]}"; do
    printf '%-20s %14s %14s   %s\n' "${stage_names[index]}" "${stage_times[index]}" "${stage_loads[index]}" \
      "${stage_results[index]}"
  done
  printf '%-20s %14s %14s   %d %% of %d CPUs\n\n' total "$(duration "$1")" "$(duration "$stage_load_sum")" \
    $((stage_load_sum * 100 / ($1 * $(nproc) + 1))) "$(nproc)"
}

show_sum() {  # in ctest's words, over all stages; a sum with a failure is never 100 %
  awk -v left_out="$left_out" '{ tests += $1; failed += $2; unchanged += $3 }
    END { if (unchanged) printf "%d tests were not run again, as nothing has changed since they passed\n", unchanged
          if (left_out) printf "%d stages had not ended when the time was over: ./flexrf test --gate does them\n", left_out
          printf "%d%% tests passed, %d tests failed out of %d\n", tests ? int((tests - failed) * 100 / tests) : 0, failed, tests
          exit failed > 0 }' "$stages"/*.counts
}
