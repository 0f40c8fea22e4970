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

# A test that waits takes one of four places for each CPU, any other all four of one CPU (flexrf_add_test). So tests that wait for timers and
# processes run beside those that compute.
places=$((4 * $(nproc)))

run_tests() {  # run_tests PRESET [SELECTION OF CTEST...]
  local preset=$1 status=0 sum failed total log name day unchanged=0
  local -a launcher chosen=() passed
  log=$(mktemp "$stages/ctest.XXXXXX")
  find_test_keys "$preset"
  while IFS= read -r name; do
    if day=$(passed_before "$preset" "$name"); then
      unchanged_line "$name" "$day"
      unchanged=$((unchanged + 1))
    else
      chosen+=("$name")
    fi
  done < <(test_names "$@")
  if ((unchanged && !${#chosen[@]})); then
    count 0 0 "$unchanged"
    return
  fi
  ((!unchanged)) || set -- "$@" -R "^($(IFS='|' && echo "${chosen[*]}"))\$"
  set_launcher "$preset"
  "${launcher[@]}" ctest --test-dir "$root/build/$preset" --output-on-failure --no-tests=error --no-label-summary \
    -j "$places" "${@:2}" </dev/null 2>&1 |
    sed -u '/^Could not find executable/,/^Unable to find executable/d' | tee "$log"
  status=${PIPESTATUS[0]}
  sum=$(sed -n 's/^[0-9]*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\1 \2/p' "$log")
  read -r failed total <<<"${sum:-1 1}"
  count "$total" "$failed" "$unchanged"
  mapfile -t passed < <(sed -n -E 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .* Passed .*/\1/p' "$log")
  remember_passed "$preset" "${passed[@]}"
  return "$status"
}
