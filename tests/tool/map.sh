#!/usr/bin/env bash
# map.sh EXECUTABLE MEMORY_MAP: the map of a real application names its parts, and its kinds are all of the cell.
source "$(dirname "$0")/stand_in.sh"

map=$(bash "$tree/cmake/tool/map.sh" "$1" "$2")
expect "exit code" $? 0
for row in "slots: *target" "queues*keys" "stacks *266240  control" "units*robot" "drivers*arm" "*JointState*.bss"; do
  expect "map" "$map" "*$row*"
done
expect "budget" "$map" "*8388608  its memory_budget, of which *"
kinds=$(awk '/  the cell$/ { exit } substr($0, 1, 12) + 0 > 0 && substr($0, 13, 2) == "  " { sum += $1 } END { print sum }' <<<"$map")
expect "sum of the kinds" "$kinds" "$(awk '/  the cell$/ { print $1 }' <<<"$map")"
finish
