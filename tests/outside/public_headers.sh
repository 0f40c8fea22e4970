#!/usr/bin/env bash
# public_headers.sh SOURCE LIST: the public headers are whole; and in a tree of their own, what is wrong with some is found, and the
# private ones are not installed.
set -u -o pipefail
source=$1 list=$2
script=$source/cmake/public_headers.cmake
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree=$work/tree
failures=0

cmake -D SOURCE="$source" -D LIST="$list" -D SCAFFOLDS=ON -P "$script" || failures=1

write() {  # write FILE [LINE]...
  mkdir -p "$(dirname "$tree/$1")"
  printf '%s\n' "${@:2}" >"$tree/$1"
}
begin() {  # a tree with nothing wrong
  rm -rf "$tree"
  write base/time.hpp '#pragma once'
  write runtime/slot.hpp '#pragma once' '#include <vector>' '#include "base/time.hpp"' '#include "types/key.hpp"'
  write runtime/private.hpp '#pragma once'
  write hal/arm/interface/arm.hpp '#include "runtime/slot.hpp"'
  write hal/arm/conformance/arm_cases.hpp '#include "hal/arm/interface/arm.hpp"' '#include "tests/verdict.hpp"'
  write hal/arm/mock/mock_arm.hpp '#include "hal/arm/mock/plan.hpp"'
  write hal/arm/mock/plan.hpp '#include "hal/arm/interface/arm.hpp"'
  write hal/arm/mock/not_needed.hpp '#pragma once'
  write hal/arm/mock/tests/mock_arm_test.cpp '#include "hal/arm/conformance/arm_cases.hpp"'
  write hal/parts/ring.hpp '#pragma once'
  write hal/parts/private.hpp '#pragma once'
  write units/jog/jog.hpp '#include "units/shared/motion.hpp"'
  write units/shared/motion.hpp '#include "hal/arm/interface/arm.hpp"'
  write tests/verdict.hpp '#pragma once'
  write cmake/tool/templates/unit/new_unit.cpp '#include "units/new_unit/new_unit.hpp"' '#include "tests/verdict.hpp"'
  write config-gen/emit.cpp '#include "base/private.hpp"' '  out << "#include \"runtime/slot.hpp\"\n";'
  cat >"$work/list" <<'LINES'
listed base/time.hpp
listed runtime/slot.hpp
listed hal/parts/ring.hpp
listed tests/verdict.hpp
table hal/arm/mock/mock_arm.hpp
table units/jog/jog.hpp
LINES
}
judge() { output=$(cmake -D SOURCE="$tree" -D LIST="$work/list" "$@" -P "$script" 2>&1); }
is_found() {  # is_found PLACE MESSAGE
  if judge -D SCAFFOLDS=ON || [[ $output != *"$1: error: $2"* ]]; then
    printf 'FAILED: %s: %s\n  said: %s\n' "$1" "$2" "$output"
    failures=1
  fi
}

begin
judge -D SCAFFOLDS=ON || { echo "FAILED: nothing is wrong, but it says: $output" && failures=1; }
judge -D DESTINATION="$work/installed" || failures=1
installed=$(cd "$work/installed" && find . -type f -printf '%P\n' | LC_ALL=C sort | tr '\n' ' ')
expected="base/time.hpp hal/arm/conformance/arm_cases.hpp hal/arm/interface/arm.hpp hal/arm/mock/mock_arm.hpp hal/arm/mock/plan.hpp \
hal/parts/ring.hpp runtime/slot.hpp tests/verdict.hpp units/jog/jog.hpp units/shared/motion.hpp "
[[ $installed == "$expected" ]] || { echo "FAILED: installed are $installed" && failures=1; }

echo 'listed base/gone.hpp' >>"$work/list"
is_found base/gone.hpp:1:1 "there is no such header"
begin
write runtime/slot.hpp '#pragma once' '#include "runtime/private.hpp"'
is_found runtime/slot.hpp:2:1 "the public header runtime/slot.hpp includes runtime/private.hpp, which is private"
begin
write hal/arm/mock/plan.hpp '#include "hal/parts/private.hpp"'
is_found hal/arm/mock/plan.hpp:1:1 "the public header hal/arm/mock/plan.hpp includes hal/parts/private.hpp, which is private"
begin
write hal/arm/interface/arm.hpp '#include "hal/arm/mock/tests/world.hpp"'
is_found hal/arm/interface/arm.hpp:1:1 "the public header hal/arm/interface/arm.hpp includes hal/arm/mock/tests/world.hpp"
begin
write hal/arm/mock/tests/mock_arm_test.cpp '#include <vector>' '#include "runtime/private.hpp"'
is_found hal/arm/mock/tests/mock_arm_test.cpp:2:1 "what \`flexrf new\` makes of it includes runtime/private.hpp"
begin
write cmake/tool/templates/unit/new_unit.cpp '#include "runtime/private.hpp"'
is_found cmake/tool/templates/unit/new_unit.cpp:1:1 "what \`flexrf new\` makes of it includes runtime/private.hpp"
begin
write config-gen/emit.cpp '#include "base/private.hpp"' '  std::set<std::string> own{"runtime/slot.hpp", "runtime/private.hpp"};'
is_found config-gen/emit.cpp:2:1 "generated code includes runtime/private.hpp, which is private"
exit "$failures"
