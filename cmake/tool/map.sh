#!/usr/bin/env bash
# map.sh EXECUTABLE: where its memory goes, as the linker placed it: sections, then the largest objects.
set -eu -o pipefail
executable=$1

echo "Sections of $(basename "$executable"), in bytes"
size -A -d "$executable" |
  awk '$2 ~ /^[0-9]+$/ && $3 > 0 && $2 > 0 { printf "  %12d  %s\n", $2, $1; total += $2 } END { printf "  %12d  total\n", total }'
echo
echo "Objects of 256 bytes and more, in bytes (zeroed at start, data, constant)"
# Of the types that nm knows: b and d are memory that can be written, r is not. Upper case is visible to other files.
nm --print-size --size-sort --reverse-sort --radix=d --demangle "$executable" |
  awk '$3 ~ /^[bBdDrRuVv]$/ && $2 + 0 >= 256 {
    kind = $3 ~ /[bB]/ ? "zeroed" : $3 ~ /[rR]/ ? "constant" : "data"
    bytes = $2 + 0
    sub(/^[0-9]+ [0-9]+ [a-zA-Z] /, "")
    printf "  %12d  %-8s  %s\n", bytes, kind, $0
  }'
