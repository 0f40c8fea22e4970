#!/usr/bin/env bash
# The stage "source layout" finds a promise that no test names, an id that nobody promises, and one that is given twice.
# shellcheck disable=SC2016 # the backticks are those of Markdown
source "$(dirname "$0")/stand_in.sh"

write() {  # write FILE LINE...
  mkdir -p "$tree/$(dirname "$1")"
  printf '%s\n' "${@:2}" >"$tree/$1"
}

judge() {  # sets status and output
  output=$(find "$tree" -type f | sort | awk -v root="$tree" -f "$tree/cmake/tool/promises.awk")
  status=$?
}

is_good() {  # is_good WHAT
  judge
  expect "$1" "$status $output" "0 "
}

says() {  # says WHAT PLACE ERROR HINT: and nothing else
  judge
  expect "exit code: $1" "$status" 1
  expect "message: $1" "$output" "$2:1: error: $3"$'\n'"$2:1: hint: $4"
}

stopping='A thread sees it `[stop-1]`, and ends every hold `[stop-2]`.'
header='  /// What it said last; nothing while it says nothing [robot-arm-1].'
is_good "nothing is promised"

write docs/stopping.md '# How a cell stops' "$stopping"
write hal/robot_arm/interface/robot_arm.hpp '#pragma once' "$header" '  int last = order[robot-7];'
write runtime/tests/motion_test.cpp '#include <vector>' '// [stop-1] [stop-2]' 'void both() {}'
write hal/robot_arm/conformance/cases.cpp '/// Of the sensors.' '// [robot-arm-1]' 'Verdict is_silent();'
is_good "each has its test"

# ---- nobody tests it

write runtime/tests/motion_test.cpp '// [stop-1]' 'void one() {}'
says "in a document" docs/stopping.md:2 "no test names \[stop-2\]" "write \[stop-2\] in a comment above a test *"
write tests/tool/motion.sh '# [stop-2]' 'holds_end'
is_good "a shell test names it"
rm "$tree/tests/tool/motion.sh"
write tests/panel/src/motion.test.ts "describe('a hold', () => {" '  // [stop-2]' "  it('ends', async () => {"
is_good "a test in a browser names it"
write tests/panel/src/motion.test.ts '  // What ends with [stop-2], too.' "  const text = '// [stop-2]';"
says "what only speaks of it" docs/stopping.md:2 "no test names \[stop-2\]" "*"
rm "$tree/tests/panel/src/motion.test.ts"
write runtime/executive/motion.cpp '// [stop-2]' 'void two() {}'
says "what is no test" docs/stopping.md:2 "no test names \[stop-2\]" "*"
rm "$tree/runtime/executive/motion.cpp"
write runtime/tests/motion_test.cpp '// [stop-1] [stop-2]' 'void both() {}'

write hal/robot_arm/conformance/cases.cpp 'Verdict is_silent();'
says "in a header" hal/robot_arm/interface/robot_arm.hpp:2 "no test names \[robot-arm-1\]" "*"
write hal/robot_arm/conformance/cases.cpp '// [robot-arm-1]' 'Verdict is_silent();'

# ---- nobody promises it

write runtime/tests/motion_test.cpp '// [stop-1] [stop-12]' 'void two() {}' '// [stop-2]' 'void one() {}'
says "an id that is none" runtime/tests/motion_test.cpp:1 "nobody promises \[stop-12\]" "promises stand in docs/stopping.md, *"
write runtime/tests/motion_test.cpp '// [stop-1] [stop-2]' 'void both() {}'
write docs/units.md 'An arm holds `[stop-2]` where it is `[stop-9]`.'
is_good "another document quotes"
rm "$tree/docs/units.md"

# ---- given twice, or in another's name

write docs/stopping.md "$stopping" 'It cannot be dropped `[stop-2]`.'
says "a number that was copied" docs/stopping.md:2 "\[stop-2\] is promised already in docs/stopping.md:1" \
  "the next number that is free is 3"
write docs/stopping.md "$stopping"
write hal/robot_arm/interface/arm.hpp "$header"
says "a line that was copied" hal/robot_arm/interface/arm.hpp:1 "\[robot-arm-1\] is no promise of this file" \
  "its promises are called \[arm-1\] and so on"
rm "$tree/hal/robot_arm/interface/arm.hpp"
is_good "all is as it was"

# ---- of two topics in one document

write docs/visual-servoing.md 'It picks `[picker-1]`.' 'In trouble it holds `[trouble-1]`.'
write tests/visual_servoing/cell_test.cpp '// [picker-1]' 'void picks() {}' '// [trouble-1]' 'void holds() {}'
is_good "a document of two topics"
write docs/visual-servoing.md 'It picks `[picker-1]`.' 'In trouble it holds `[trouble-1]`. It stops `[stop-3]`.'
says "an id of neither" docs/visual-servoing.md:2 "\[stop-3\] is no promise of this file" "its promises are called \[picker-1\] and so on"
rm "$tree/docs/visual-servoing.md" "$tree/tests/visual_servoing/cell_test.cpp"

finish
