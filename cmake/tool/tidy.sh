#!/usr/bin/env bash
# tidy.sh DATABASE_DIR HEADERS BATCH: analyses a batch of files and prints only what it finds. If two of its files have a
# name of their own in common, its halves are analysed instead.
analyse() {  # analyse BATCH without .cpp
  local found
  found=$(clang-tidy -p "$database" --quiet --header-filter="$headers" "$1.cpp" 2>&1) && return
  if [[ $found == *clang-diagnostic-error* && -e $1_a.cpp ]]; then
    analyse "$1_a"
    analyse "$1_b"
    return
  fi
  failed=1
  grep -v -E '^[0-9]+ (warning|error)s? .*generated|^Suppressed ' <<<"$found"
}

database=$1 headers=$2 failed=0
analyse "${3%.cpp}"
exit "$failed"
