#!/usr/bin/env bash
# tidy.sh ROOT HEADERS FILE: analyses one file and prints only what it finds.
findings=$(clang-tidy -p "$1/build/release" --quiet --header-filter="$2" "$3" 2>&1) && exit
grep -v -E '^[0-9]+ warnings? generated|^Suppressed ' <<<"$findings"
exit 1
