#!/usr/bin/env bash
# scaffolds.sh SOURCE: in a copy of the repository, what `new` makes builds without a warning, is laid out as the rest, and
# passes its tests.
set -eu -o pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
copy=$work/flexrf
mkdir "$copy"
tar -C "$source" --exclude=./build --exclude=./.git -c . | tar -C "$copy" -x
cd "$copy"

./flexrf new unit lift_guard </dev/null
./flexrf new app level-cell </dev/null
./flexrf new driver Gripper schunk </dev/null
./flexrf new interface lamp_post </dev/null
./flexrf new driver LampPost dali </dev/null
if command -v clang-format >/dev/null; then
  find units/lift_guard apps/level-cell hal/gripper/schunk hal/lamp_post -name '*.[ch]pp' -exec clang-format --dry-run -Werror {} +
fi
# As a person has it who knows nothing of the names in use: those of the runtime, of its tests and of the standard library do;
# what another table makes is refused, and nothing is left of it.
for name in status tick log string; do ./flexrf new unit "$name" </dev/null; done
if ./flexrf new unit pose </dev/null 2>"$work/log"; then exit 1; fi
grep -q "'pose' cannot be the name: runtime/types/pose.toml has a Pose already" "$work/log"
[[ ! -e units/pose ]]

./flexrf check level-cell </dev/null
# The tool's own build, with what it remembers.
root=$copy tool=$copy/cmake/tool
for part in words cache build; do
  # shellcheck source=/dev/null
  source "$tool/$part.sh"
done
find_cache
tests=(unit_{lift_guard,status,tick,log,string}_test level_cell_cell_test {schunk_gripper,{mock,dali}_lamp_post}_conformance_test)
build release "${tests[@]}" level-cell
if grep 'warning:' build/release/build.log; then exit 1; fi
ctest --test-dir build/release --output-on-failure --no-tests=error \
  -R "^($(IFS='|' && echo "${tests[*]}"))\$" | tee "$work/log"
grep -q "100% tests passed, 0 tests failed out of ${#tests[@]}\$" "$work/log"
first=$(./flexrf run level-cell -- --virtual-time 5s --digest </dev/null | tail -n 1)
[[ $first =~ ^[0-9a-f]+$ && $(./flexrf run level-cell -- --virtual-time 5s --digest </dev/null | tail -n 1) == "$first" ]]
