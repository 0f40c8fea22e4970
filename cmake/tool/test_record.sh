# Sourced by flexrf: what a level of `flexrf test` cost. A level leaves a record, of which docs/testing.md quotes the last ones, and a stage
# that uses more processor time than its budget says so.
# shellcheck shell=bash disable=SC2154 # shares its variables with flexrf

records=$root/build/test-records

# Whether anything is remembered on this machine: cold (nothing), warm (a clone in which nothing was built), or again.
memory_state() {
  if [[ -e $root/build/release/build.ninja ]]; then
    printf 'again\n'
  elif [[ $cache && -d $cache/compiler ]]; then
    printf 'warm\n'
  else
    printf 'cold\n'
  fi
}

machine_text() {
  printf '%s CPUs (%s), %s GiB of memory, Linux %s\n' "$(nproc)" "$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)" \
    "$(awk '/^MemTotal/ { printf "%d", $2 / 1048576 + 0.5 }' /proc/meminfo)" "$(uname -r)"
}

begin_record() {  # begin_record LEVEL STATE
  record=$stages/record
  {
    printf 'level\t%s\nstate\t%s\ndate\t%s\n' "$1" "$2" "$(date -u +%F)"
    printf 'commit\t%s\n' "$(git -C "$root" rev-parse --short=8 HEAD 2>/dev/null || echo unknown)"
    printf 'machine\t%s\n' "$(machine_text)"
  } >"$record"
}

record_stage() { [[ ! ${record-} ]] || printf 'stage\t%s\t%d\t%d\n' "$1" "$2" "$3" >>"$record"; } # record_stage NAME WALL LOAD, in microseconds

# Only a clean clone is quoted: what runs again in a folder costs what has changed there.
end_record() {  # end_record WALL LOAD
  local level state
  [[ ${record-} ]] || return 0
  printf 'total\t%d\t%d\n' "$1" "$2" >>"$record"
  awk '{ tests += $1; unchanged += $3 } END { printf "tests\t%d\t%d\n", tests, unchanged }' "$stages"/*.counts >>"$record"
  read -r level state <<<"$(awk -F '\t' '$1 == "level" || $1 == "state" { printf "%s ", $2 }' "$record")"
  [[ $state != again && $left_out == 0 ]] || return 0
  mkdir -p "$records" && cp "$record" "$records/$level-$state.txt"
}

# A timing is no pass mark: other machines are slower. Whoever adds tests on the machine that the budgets were measured on sees it here.
warn_over_budget() {  # warn_over_budget STAGE MICROSECONDS
  local budget
  budget=$(awk -F '\t' -v stage="$1" '$1 == stage { print $2 }' "$tool/test_budgets.txt")
  [[ $budget ]] && (($2 > budget * 1000000)) || return 0
  printf 'over budget: %s used %s on all CPUs, and its budget is %s (cmake/tool/test_budgets.txt)\n' "$1" "$(duration "$2")" \
    "$(duration $((budget * 1000000)))"
}

record_table() {  # record_table RECORD...: as Markdown, a column for each record
  awk -F '\t' '
    function shown(microseconds,  s) { s = int(microseconds / 1000000 + 0.5); return s < 60 ? s " s" : int(s / 60) " min " sprintf("%02d", s % 60) " s" }
    FNR == 1 { column++ }
    $1 == "level" { level[column] = $2 }
    $1 == "state" { state[column] = $2 }
    $1 == "date" { date[column] = $2 }
    $1 == "commit" { commit[column] = $2 }
    $1 == "machine" { machine[column] = $2 }
    $1 == "stage" { if (!($2 in row)) { row[$2] = ++rows; name[rows] = $2 } cell[row[$2], column] = shown($3) ", " shown($4) }
    $1 == "total" { total[column] = shown($2) ", " shown($3); wall[column] = $2; load[column] = $3 }
    $1 == "tests" { tests[column] = $2 " run" ($3 ? ", " $3 " unchanged" : "") }
    END {
      line = "| stage |"; rule = "| --- |"
      for (c = 1; c <= column; ++c) { line = line " `" (level[c] == "first" ? "test" : "test --" level[c]) "`, " state[c] " |"; rule = rule " --- |" }
      print line; print rule
      for (r = 1; r <= rows; ++r) {
        line = "| " name[r] " |"
        for (c = 1; c <= column; ++c) line = line " " ((r, c) in cell ? cell[r, c] : "") " |"
        print line
      }
      line = "| **all** |"; for (c = 1; c <= column; ++c) line = line " **" total[c] "** |"; print line
      line = "| tests |"; for (c = 1; c <= column; ++c) line = line " " tests[c] " |"; print line
      line = "| date, commit |"; for (c = 1; c <= column; ++c) line = line " " date[c] ", " commit[c] " |"; print line
      print ""
      for (c = 1; c <= column; ++c) if (!(machine[c] in said)) { said[machine[c]]; print "Measured on " machine[c] "." }
    }' "$@"
}

quote_records() {  # puts the last records into docs/testing.md, between its two marks
  local level state
  local -a found=()
  for level in first gate full; do
    for state in cold warm; do
      [[ -s $records/$level-$state.txt ]] && found+=("$records/$level-$state.txt")
    done
  done
  ((${#found[@]})) || die "no level of the tests was run in a clean clone yet: ./flexrf test, or ./flexrf test --fresh"
  replace_between "$root/docs/testing.md" '<!-- records -->' '<!-- end of records -->' < <(record_table "${found[@]}")
  say "put into docs/testing.md"
}
