#!/usr/bin/env bash
# What is remembered serves a clone elsewhere, and whatever is wrong with it costs time only: with the real compiler and the real
# ccache, on a source of two files.
set -u -o pipefail
shopt -s extglob
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
unset "${!CCACHE_@}"

expect() {  # expect WHAT ACTUAL PATTERN: the pattern is bash's
  # shellcheck disable=SC2053 # it is meant as a pattern
  [[ $2 == $3 ]] && return
  printf 'FAILED: %s\n  expected: %s\n  actual:   %s\n' "$1" "$3" "$2"
  failures=$((failures + 1))
}

clone() {  # clone NAME: as one that lies elsewhere
  mkdir -p "$work/$1"/{source,build}
  echo 'inline int answer() { return 42; }' >"$work/$1/source/answer.hpp"
  printf '#include "source/answer.hpp"\nconst char* place() { return __FILE__; }\nint ask() { return answer(); }\n' \
    >"$work/$1/source/ask.cpp"
}

compile() {  # compile CLONE: as the build does it; sets status, said and known, the checksum of what was made
  rm -f "$work/$1/build/ask.o"
  said=$(
    exec 2>&1
    root=$work/$1
    # shellcheck source=cmake/tool/words.sh
    source "$repository/cmake/tool/words.sh"
    # shellcheck source=cmake/tool/cache.sh
    source "$repository/cmake/tool/cache.sh"
    find_cache
    use_compiler_cache
    cd "$root/build" && ccache g++ -O1 -g1 "-ffile-prefix-map=$root=." "-I$root" -MD -MF ask.d -o ask.o -c "$root/source/ask.cpp"
  )
  status=$?
  known=$(cksum <"$work/$1/build/ask.o")
}
hits() { CCACHE_DIR=$FLEXRF_CACHE/compiler ccache --print-stats | awk '$1 ~ /^(direct|preprocessed)_cache_hit$/ { sum += $2 } END { print sum }'; }
entries() { find "$FLEXRF_CACHE/compiler" -type f -name '*[RM]'; }

clone here
clone elsewhere
export FLEXRF_CACHE=off
compile here
expect "exit code without a cache" "$status" 0
bare=$known

export FLEXRF_CACHE=$work/cache
compile here
expect "exit code of the first time" "$status" 0
expect "what is made the first time" "$known" "$bare"
expect "hits of the first time" "$(hits)" 0
compile elsewhere
expect "what is made elsewhere" "$known" "$bare"
expect "hits elsewhere" "$(hits)" 1
echo 'inline int answer() { return 43; }' >"$work/elsewhere/source/answer.hpp"
compile elsewhere
expect "hits after a change" "$(hits)" 1
expect "what is made after a change" "$known" "!($bare)"

while IFS= read -r entry; do printf 'X' | dd of="$entry" bs=1 seek=40 conv=notrunc status=none; done < <(entries)
expect "entries to damage" "$(entries | wc -l)" "[1-9]*"
compile here
expect "exit code with damaged entries" "$status" 0
expect "what is made with damaged entries" "$known" "$bare"
while IFS= read -r entry; do : >"$entry"; done < <(entries)
compile here
expect "exit code with empty entries" "$status" 0
expect "what is made with empty entries" "$known" "$bare"
export CCACHE_MAXSIZE=1k
compile here
expect "exit code with a full cache" "$status" 0
expect "what is made with a full cache" "$known" "$bare"
unset CCACHE_MAXSIZE

touch "$work/file"
for place in "$work/file" "$work/file/below" relative; do
  FLEXRF_CACHE=$place compile here
  expect "exit code with FLEXRF_CACHE=$place" "$status" 0
  expect "what is made with FLEXRF_CACHE=$place" "$known" "$bare"
  expect "message with FLEXRF_CACHE=$place" "$said" "flexrf: nothing is remembered: *$place*"
done
exit $((failures > 0))
