# Sourced by flexrf: runs the tests of a preset by ctest, those of them whose inputs have changed since they passed.
# shellcheck shell=bash disable=SC2154 # shares its variables with flexrf

test_names() {  # test_names PRESET [SELECTION OF CTEST...]
  ctest --test-dir "$root/build/$1" -N "${@:2}" | sed -n 's/^ *Test *#[0-9]*: //p'
}

# How each test is started, with what environment and time-out, as lines "TEST<TAB>definition"; without the line that asked for it.
test_definitions() {  # test_definitions PRESET
  find "$root/build/$1" -name CTestTestfile.cmake -exec cat {} + |
    sed -n -E 's/^(add_test|set_tests_properties)\(\[=\[([^]]*)\]=\](.*)$/\2\t\1\3/; T; s/ _BACKTRACE_TRIPLES ".*"//; p' | LC_ALL=C sort
}

find_test_keys() {  # find_test_keys PRESET: of all its tests that say what they read, after the build
  local build=$root/build/$1
  [[ $passed_folder && -s $build/tests_read.txt && ! -d $stages/keys-$1 ]] || return 0
  test_definitions "$1" >"$stages/definitions-$1"
  find_keys "$1" "$build/tests_read.txt" "$stages/definitions-$1"
}

# A CPU has three places: a test that computes takes all of them (flexrf_test_computes), any other test one, as it mostly waits for timers and
# processes. Other lanes have work for a CPU that is idle.
places=$((3 * $(nproc)))
niceness=5

run_tests() {  # run_tests PRESET [SELECTION OF CTEST...]
  local preset=$1
  local -a names selection=("${@:2}")
  find_test_keys "$preset"
  mapfile -t names < <(test_names "$@")
  ((${#names[@]})) || { printf 'the preset %s has none of these tests\n' "$preset" && count 1 1 && return 1; }
  run_changed "$preset" run_ctest "${names[@]}"
}

# run_ctest TEST...: these of the preset `preset` that `selection` selects; a test that was not built fails
run_ctest() {
  local status sum failed total log
  local -a launcher
  log=$(mktemp "$stages/ctest.XXXXXX")
  set_launcher "$preset"
  nice -n "$niceness" "${launcher[@]}" ctest --test-dir "$root/build/$preset" --output-on-failure --no-tests=error --no-label-summary \
    -j "$places" "${selection[@]}" -R "^($(IFS='|' && echo "$*"))\$" </dev/null 2>&1 |
    sed -u '/^Could not find executable/,/^Unable to find executable/d' | tee "$log"
  status=${PIPESTATUS[0]}
  sum=$(sed -n 's/^[0-9]*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\1 \2/p' "$log")
  read -r failed total <<<"${sum:-1 1}"
  count "$total" "$failed"
  return "$status"
}
