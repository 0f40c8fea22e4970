# Sourced by flexrf: the levels of `flexrf test`. docs/testing.md tells what each is for.
#   first     what somebody who cloned the repository needs to trust it
#   gate      what is added before a change lands: sanitizers, static analysis, updates and power cuts of the image
#   full      everything that ends within two hours
#   soak      campaigns that take longer; they are seeded, and go on where they were stopped
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

# shellcheck source=cmake/tool/memory.sh
source "$tool/memory.sh"
# shellcheck source=cmake/tool/stages.sh
source "$tool/stages.sh"
# shellcheck source=cmake/tool/test_record.sh
source "$tool/test_record.sh"
# shellcheck source=cmake/tool/source_checks.sh
source "$tool/source_checks.sh"
# shellcheck source=cmake/tool/ctest.sh
source "$tool/ctest.sh"

without_long=(-LE '^long$') # the long tests are left out, but where the level is full

declare -A build_targets=() test_selection=() # of a preset, where that is not everything
choose_extent() {  # choose_extent full|some: which tests of the sanitizers' presets
  # Without a second thread there is nothing that the thread sanitizer could find; a test that starts one unsaid fails in release.
  build_targets=([fuzz]=tests_fuzz [tsan]='tests_threads tests_whole tests_stress')
  test_selection=([fuzz]='-L ^fuzz$' [tsan]='-L ^(threads|whole|stress)$')
  [[ $1 == full ]] && return
  # Whole cells take long under a sanitizer, and the other presets run them.
  build_targets[asan]='tests_unit tests_stress' test_selection[asan]='-L ^(unit|stress)$'
  build_targets[tsan]=tests_threads test_selection[tsan]='-L ^threads$'
}

build_preset() {  # build_preset PRESET
  local -a targets
  read -r -a targets <<<"${build_targets[$1]-}"
  count_as_test build "$1" "${targets[@]}"
}

test_preset() {  # test_preset PRESET: a test that was not built fails, and the others run
  local -a selection
  read -r -a selection <<<"${test_selection[$1]-}"
  run_tests "$1" "${selection[@]}" "${without_long[@]}"
}

test_release() { run_tests release -LE "^panel\$${without_long[1]:+|${without_long[1]}}"; }

# The page is tried by a browser, in the release preset alone. A browser draws as long as it is there: the longer its test waits for a CPU, the
# more it takes of it. So there is one for each CPU, and nothing goes before them.
test_panel() {
  local places niceness=0
  places=$(nproc)
  run_tests release -L '^panel$' "${without_long[@]}"
}

campaign_parts=20

# Runs one part of the tests that know campaigns, such as all orders of some events (tests/test_extent.hpp). Passes are remembered for each part, so that a second
# start goes on where the first was stopped.
test_campaign() {  # test_campaign PART
  local FLEXRF_LONG="part $1 of $campaign_parts" preset=release
  local -a names selection=()
  export FLEXRF_LONG
  rm -rf "$stages/keys-release" # they depend on FLEXRF_LONG
  find_test_keys release
  mapfile -t names < <(sort -u "$root/build/release/tests_read.txt" | while IFS=$'\t' read -r name path; do
    [[ -f $path && -x $path ]] && grep -q -a -F 'part %u of %u' "$path" && printf '%s\n' "$name"
  done | sort -u)
  ((${#names[@]})) || { printf 'there are no tests that know campaigns\n' && count 1 1 && return 1; }
  run_changed release run_ctest "${names[@]}"
}

test_guest() {  # test_guest [NAME...]
  local name key
  local -a names
  mapfile -t names <"$root/build/release/guest_tests.txt"
  for name; do known_word "test in the guest" "$name" "${names[@]}"; done
  if (($#)); then names=("$@"); fi
  if [[ $passed_folder ]]; then
    key=$(guest_key) || return
    find_keys guest <(for name in "${names[@]}"; do guest_test_reads "$name" | sed "s/^/$name\t/"; done) \
      <(for name in "${names[@]}"; do printf '%s\t%s\n' "$name" "$key"; done)
  fi
  run_changed guest guest_tests "${names[@]}"
}

test_image() {  # test_image LEVEL [NAME...]
  local level=$1 name
  local -a names
  mapfile -t names < <(image_test_list | awk -v level="$level" '$2 == level { print $1 }')
  if (($# > 1)); then names=("${@:2}"); fi
  build_image_programs "$level" || { count 1 1 && return 1; }
  set_keys "image-$level" < <(for name in "${names[@]}"; do printf '%s %s\n' "$name" "$(image_test_key "$name")"; done)
  run_changed "image-$level" image_tests_of_level "${names[@]}"
}

image_tests_of_level() { image_tests "$level" "$@"; } # of the level that test_image has

presets_lane() {  # presets_lane PRESET...: builds them one after the other, as each uses all processors
  local preset
  for preset; do lane_stage "build $preset" build_preset "$preset"; done
}
panel_lane() { lane_stage panel test_panel; }
guest_lane() { lane_stage guest test_guest; }
image_lane_of() {  # image_lane_of LEVEL...
  local level
  for level; do lane_stage "image $level" test_image "$level"; done
}
analysis_lane() { lane_stage "static analysis" count_as_test analyse "$@"; }

release_is_built() {  # all else takes its generator, and most its programs
  stage "build release" build_preset release
  find_test_keys release
}

# Priorities follow how much a test minds to wait: a browser draws meanwhile; the other tests of ctest wait for events (run_ctest: nice 5); the
# guest's clock counts instructions; builds and analyses only have to end. A PC of the image has real time in it, and cannot confirm its version
# when its panel is slow: it starts when the tests of ctest are over, beside a guest or an analysis of lower priority.
start_first_lanes() {
  start_lane 0 panel_lane
  [[ $no_guest ]] || start_lane 10 guest_lane
}

await_guest() {
  if [[ $no_guest ]]; then skip guest "$no_guest"; else await_stage guest; fi
}

start_image_lane() { [[ $no_image ]] || start_lane 0 image_lane_of "$@"; } # start_image_lane LEVEL...
await_image_lane() {  # await_image_lane LEVEL...
  local level
  for level; do
    if [[ $no_image ]]; then skip "image $level" "$no_image"; else await_stage "image $level"; fi
  done
}
image_stage() {  # image_stage LEVEL [NAME...]: in the foreground
  if [[ $no_image ]]; then skip "image $1" "$no_image"; else stage "image $1" test_image "$@"; fi
}

test_presets() {  # test_presets PRESET...: each when it is built
  local preset
  for preset; do
    await_stage "build $preset"
    start_lane 0 lane_stage "test $preset" test_preset "$preset"
    await_stage "test $preset"
  done
}

level_first() {
  stage "source layout" count_as_test check_layout
  release_is_built
  start_first_lanes
  stage "test release" test_release
  await_stage panel
  start_image_lane first
  await_guest
  await_image_lane first
}

level_gate() {
  limit_time
  release_is_built
  start_lane 12 presets_lane checked tsan asan
  start_lane 15 analysis_lane without tests
  test_presets checked tsan asan
  start_image_lane gate
  await_stage "static analysis"
  await_image_lane gate
}

level_full() {
  without_long=()
  choose_extent full
  stage "source layout" count_as_test check_layout
  release_is_built
  start_first_lanes
  start_lane 12 presets_lane checked tsan asan fuzz
  start_lane 15 analysis_lane
  stage "test release" test_release
  await_stage panel
  test_presets checked tsan asan fuzz
  start_image_lane first gate full
  await_stage "static analysis"
  await_guest
  await_image_lane first gate full
}

level_soak() {
  local part
  release_is_built
  for ((part = 1; part <= campaign_parts; ++part)); do stage "campaign $part" test_campaign "$part"; done
  image_stage soak
}

level_presets() {  # level_presets PRESET...: these and nothing else
  if [[ $1 == release ]]; then
    release_is_built
    shift
    start_lane 0 panel_lane
    start_lane 12 presets_lane "$@"
    stage "test release" test_release
    await_stage panel
  else
    start_lane 12 presets_lane "$@"
  fi
  test_presets "$@"
}

level_guest() {  # level_guest [NAME...]
  stage "build guest's tests" count_as_test build release tests_guest
  if [[ $no_guest ]]; then skip guest "$no_guest"; else stage guest test_guest "$@"; fi
}

level_image() {  # level_image [NAME...]: of all levels but soak, of full only with --long; or these, of any level
  local level name
  local -a known
  if (($#)); then
    mapfile -t known < <(image_test_list | cut -d ' ' -f 1)
    for name; do known_word "test of the image" "$name" "${known[@]}"; done
    for level in "${image_levels[@]}"; do
      mapfile -t known < <(image_test_list | awk -v level="$level" -v names=" $* " '$2 == level && index(names, " " $1 " ") { print $1 }')
      ((!${#known[@]})) || image_stage "$level" "${known[@]}"
    done
  else
    for level in first gate ${long:+full}; do image_stage "$level"; done
  fi
}

# test_level LEVEL [WORD...]: LEVEL is first, gate, full, soak, quick, guest, image or presets
test_level() {
  local start wall state no_guest no_image level=$1
  shift
  ninja_options=(-k 0) # what fails to build does not keep the rest from being tested
  exec 2>&1            # one report, in the order in which things happened
  state=$(memory_state)
  mkdir -p "$stages"
  exec {being_tested}>"$stages/.lock"
  flock -n "$being_tested" || die "tests are under way in this folder already"
  rm -rf "${stages:?}"/*
  start=$(microseconds)
  unset FLEXRF_LONG
  [[ $level == full || $level == soak || $long ]] && export FLEXRF_LONG=1
  [[ $long ]] && without_long=()
  choose_extent some
  no_guest=$(guest_obstacle)
  if [[ $level == @(first|gate|full|soak|image) ]]; then
    # shellcheck source=cmake/tool/image.sh
    source "$tool/image.sh"
    # shellcheck source=cmake/tool/image_test.sh
    source "$tool/image_test.sh"
    no_image=$(image_obstacle)
  fi
  case $level in
    first | gate | full) begin_record "$level" "$state" && "level_$level" ;;
    quick) release_is_built && stage "test release" test_release ;;
    guest) level_guest "$@" ;;
    image) level_image "$@" ;;
    soak) level_soak ;;
    presets) level_presets "$@" ;;
  esac
  end_lanes
  wall=$(($(microseconds) - start))
  show_table "$wall"
  end_record "$wall" "$stage_load_sum"
  show_sum
}
