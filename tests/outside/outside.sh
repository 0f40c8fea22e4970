#!/usr/bin/env bash
# outside.sh SOURCE BUILD: installs FlexRF, moves it, builds applications against it, one of them with every driver that is there, and
# looks at what is built again after a change.
set -eu -o pipefail
source=$1 build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
rebuild() {  # what ninja did, one line per command
  ninja -C "$work/build" -v -j2 >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "does not build"; }
}
did() { grep -q -e "$1" "$work/log"; }

cmake --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"
! grep -rq -F -e "$source/" -e "$work/first" "$work/prefix/lib/cmake" || fail "the package names folders of its build"
cp -r "$source/tests/outside/project" "$work/project"
cp "$source/hal/gripper/mock/tests/mock_gripper_conformance_test.cpp" "$work/project/driver_test"
headers=$work/prefix/include/flexrf
(cd "$headers" && find . -name '*.hpp' -printf '%P\n') >"$work/headers"
(cd "$headers" && xargs grep -H '^#include "' <"$work/headers") | tr '"' ':' | awk -F : '
  FILENAME != "-" { is_there[$0]; next }
  { folder = $1; sub("[^/]*$", "", folder) }
  !($3 in is_there) && !("generated/" $3 in is_there) && !(folder $3 in is_there) { print $1 " includes " $3; missing = 1 }
  END { exit missing }' "$work/headers" - >&2 || fail "what installed headers include is not installed"
# What helps the tests of who has a driver or a unit of his own.
for place in /conformance/ ^hal/driver/device_bench ^units/unit_bench ^tests/; do
  sed -n "\\|$place|s/.*/#include \"&\"/p" "$work/headers"
done >"$work/project/every/test_support.cpp"
# What the compiler made here before is remembered, as in the build itself.
launcher=()
for part in words cache; do
  # shellcheck source=/dev/null
  source "$source/cmake/tool/$part.sh"
done
root=$work
find_cache
use_compiler_cache
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake "${launcher[@]}" -S "$work/project" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_COMPILE_WARNING_AS_ERROR=ON >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "does not configure"; }
rebuild

"$work/build/every/every" --help >/dev/null || fail "every: exit code $?"
"$work/build/driver_test/driver_test" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "driver_test: exit code $?"; }
drivers() { "$work/prefix/bin/config-gen-parts" "$@"; }
find "$work/prefix/share/flexrf/hal" -name '*.toml' ! -path '*/types/*' ! -path '*/interface/*' -print0 |
  while IFS= read -r -d '' table; do
    drivers --driver "$table" | awk '{ is[$1] = $2 } END { print is["class"] "/" is["name"] }'
  done | sort >"$work/installed"
drivers --application "$work/project/every/every.toml" | sed -n 's/^drivers //p' | tr ' ' '\n' | sort >"$work/linked"
diff "$work/installed" "$work/linked" >&2 || fail "the application with every driver has others than are installed"
(($(wc -l <"$work/installed") > 50)) || fail "only $(wc -l <"$work/installed") drivers are installed"

printf '0.1 a\n0.2 b\n0.3 c\n' >"$work/keys"
"$work/build/tally/tally" --virtual-time 2s --keys "$work/keys" --report "$work/report.json" >/dev/null 2>"$work/log" || fail "tally: exit code $?"
grep -q '"keys"' "$work/report.json" || fail "the report does not know the queue"
"$work/build/second/second" --virtual-time 1s >/dev/null || fail "second: exit code $?"

rebuild
did 'no work to do' || fail "a build after a build does something"

touch "$work/project/tally/tally.toml"
rebuild
did '/bin/config-gen' || fail "a touched table is not read again"
! did '\.cpp\.o -c ' || fail "a touched table whose contents are the same is compiled again"

sed -i 's/5 ms/6 ms/' "$work/project/tally/tally.toml"
rebuild
did 'application\.cpp\.o -c ' || fail "a changed table is not compiled again"
! did 'second\|every' || fail "a change in one application's table builds another one again"
! did 'tally\.cpp\.o -c ' || fail "a change in an application's table compiles its unit again"

sed -i 's/steps]/steps_so_far]/' "$work/project/second/units/tally/tally.toml"
if ninja -C "$work/build" >"$work/log" 2>&1; then fail "a unit whose table has lost a name compiles"; fi
sed -i 's/steps_so_far]/steps]/; s/"u64"/"u63"/' "$work/project/second/units/tally/tally.toml"
if ninja -C "$work/build" >"$work/log" 2>&1; then fail "a broken table builds"; fi
did 'units/tally/tally.toml:[0-9]*:[0-9]*: error: ' || { cat "$work/log" >&2; fail "the error does not cite its place"; }
