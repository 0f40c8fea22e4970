# Sourced by the tests of this folder. Makes a small tree with the real `flexrf` in it and, first in PATH, stand-ins for
# dpkg-query, apt-get, cmake, ninja and ctest that note how they were called in $calls.
# shellcheck shell=bash disable=SC2034,SC2016 # its variables are for the tests; the stand-ins expand later
set -u -o pipefail
unset FLEXRF_LONG
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree=$work/tree
calls=$work/calls
export STAND_IN=$work
export FLEXRF_CACHE=$work/cache
failures=0

mkdir -p "$tree"/apps/{keyboard,keyboard-single,visual-servoing} "$tree/cmake" "$work/bin"
cp "$repository/flexrf" "$repository/packages.txt" "$repository/CMakePresets.json" "$tree/"
cp -r "$repository/cmake/tool" "$tree/cmake/"
touch "$tree/apps/keyboard/keyboard.toml" "$tree/apps/keyboard-single/keyboard_single.toml" \
  "$tree/apps/visual-servoing/visual_servoing.toml" "$calls"

# The kept page fits unless a test has made $work/changed_page.
mkdir -p "$tree/web-ui/page"
echo '[[ $1 == fits && ! -e $STAND_IN/changed_page ]]' >"$tree/web-ui/page/page.sh"

stand_in() {  # stand_in NAME: a program of that name, whose body is read from standard input
  {
    printf '#!/bin/bash\nprintf "%%s\\n" "%s $*" >>"$STAND_IN/calls"\n' "$1"
    cat
  } >"$work/bin/$1"
  chmod +x "$work/bin/$1"
}

# What is installed is listed in $work/installed.
stand_in dpkg-query <<'BODY'
status=0
installed=$'\n'$(<"$STAND_IN/installed")$'\n'
for name in "${@:4}"; do
  if [[ $installed == *$'\n'"$name"$'\n'* ]]; then echo "$name installed"; else status=1; fi
done
exit $status
BODY
# The package manager and the build try to take the standard input away.
stand_in apt-get <<'BODY'
cat >/dev/null
[[ " $* " == *" install "* ]] || exit 0
[[ -e $STAND_IN/no_network ]] && { echo "E: Unable to locate package"; exit 100; }
while [[ $1 != --no-install-recommends ]]; do shift; done
shift
printf '%s\n' "$@" >>"$STAND_IN/installed"
BODY
stand_in cmake <<'BODY'
cat >/dev/null
mkdir -p "build/$2"
touch "build/$2/build.ninja"
printf '"file": "%s/unit.cpp"\n' "$PWD" >"build/$2/compile_commands.json"
BODY
# Builds an application that reports its arguments and standard input and ends as its first argument says.
stand_in ninja <<'BODY'
cat >/dev/null
while [[ $1 != -C ]]; do shift; done
[[ -e $STAND_IN/broken ]] && { echo "[1/2] Building"; echo "FAILED: it"; echo "source.cpp:1: error: broken"; exit 1; }
[[ $2 == */asan && -e $STAND_IN/busy ]] && for ((i = 0; i < 1000000; ++i)); do :; done
echo "[1/1] Linking"
mkdir -p "$2/apps/$3"
cat >"$2/apps/$3/$3" <<'APPLICATION'
#!/bin/bash
echo "arguments: $*"
echo "input: $(cat)"
[[ ${1-} == SIG* ]] && kill -"${1#SIG}" $$
exit "${1-0}"
APPLICATION
chmod +x "$2/apps/$3/$3"
BODY

install_all() { awk '/^[^#]/ {print $1}' "$repository/packages.txt" >"$work/installed"; }
install_all
export PATH=$work/bin:$PATH

flexrf() {  # flexrf ARGUMENT...: sets status, output and errors; standard input is the caller's
  "$tree/flexrf" "$@" >"$work/output" 2>"$work/errors"
  status=$?
  output=$(<"$work/output")
  errors=$(<"$work/errors")
}

expect() {  # expect WHAT ACTUAL PATTERN: the pattern is bash's
  # shellcheck disable=SC2053 # it is meant as a pattern
  [[ $2 == $3 ]] && return
  printf 'FAILED: %s\n  expected: %s\n  actual:   %s\n' "$1" "$3" "$2"
  failures=$((failures + 1))
}

finish() { exit $((failures > 0)); }
