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
if command -v clang-format >/dev/null; then
  find units/lift_guard apps/level-cell -name '*.[ch]pp' -exec clang-format --dry-run -Werror {} +
fi
./flexrf check level-cell </dev/null
cmake --preset release >/dev/null
ninja -C build/release lift_guard_test level_cell_cell_test level-cell >"$work/log" 2>&1 || {
  cat "$work/log"
  exit 1
}
[[ $(grep -c 'warning:' "$work/log") == 0 ]] || { cat "$work/log"; exit 1; }
ctest --test-dir build/release --output-on-failure --no-tests=error \
  -R '^(lift_guard_test|level_cell_cell_test)$' | tee "$work/log"
grep -q '100% tests passed, 0 tests failed out of 2$' "$work/log"
first=$(./flexrf run level-cell -- --virtual-time 5s --digest </dev/null | tail -n 1)
[[ $first =~ ^[0-9a-f]+$ && $(./flexrf run level-cell -- --virtual-time 5s --digest </dev/null | tail -n 1) == "$first" ]]
