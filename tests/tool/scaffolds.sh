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
# As a person has it who knows nothing of the names in use: a name that is taken is refused, and nothing is left of it.
if ./flexrf new unit status </dev/null 2>"$work/log"; then exit 1; fi
grep -q "'status' cannot be the name: runtime/core/status.hpp has a Status already" "$work/log"
[[ ! -e units/status ]]

./flexrf check level-cell </dev/null
# The tool's own build, with what it remembers.
root=$copy tool=$copy/cmake/tool
for part in words cache build; do
  # shellcheck source=/dev/null
  source "$tool/$part.sh"
done
find_cache
build release lift_guard_test level_cell_cell_test level-cell
if grep 'warning:' build/release/build.log; then exit 1; fi
ctest --test-dir build/release --output-on-failure --no-tests=error \
  -R '^(lift_guard_test|level_cell_cell_test)$' | tee "$work/log"
grep -q '100% tests passed, 0 tests failed out of 2$' "$work/log"
first=$(./flexrf run level-cell -- --virtual-time 5s --digest </dev/null | tail -n 1)
[[ $first =~ ^[0-9a-f]+$ && $(./flexrf run level-cell -- --virtual-time 5s --digest </dev/null | tail -n 1) == "$first" ]]
