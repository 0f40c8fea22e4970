#!/usr/bin/env bash
# map.sh EXECUTABLE MEMORY_MAP: where an application's memory went, as the linker placed it: the cell's objects by kind
# against the budget that config-gen's memory map names, then the rest of the process.
set -eu -o pipefail
executable=$1 memory_map=$2
most_rows=20 # of one kind

echo "Memory of $(basename "$executable") in bytes, read from the executable"
echo
nm --print-size --size-sort --reverse-sort --radix=d --demangle "$executable" |
  awk -v most="$most_rows" -v budget="$(awk '$2 == "memory_budget" { print $1 }' "$memory_map")" '
    function add(kind, name, bytes) {
      total[kind] += bytes
      if (!((kind, name) in size)) names[kind, ++count[kind]] = name
      size[kind, name] += bytes
    }
    # nm sorts single objects; what is shown may be several.
    function show(kind, title,   i, j, name, rest) {
      if (!count[kind]) return
      printf "%12d  %s\n", total[kind], title
      for (i = 2; i <= count[kind]; ++i) {
        name = names[kind, i]
        for (j = i; j > 1 && size[kind, names[kind, j - 1]] < size[kind, name]; --j) names[kind, j] = names[kind, j - 1]
        names[kind, j] = name
      }
      for (i = 1; i <= count[kind] && i <= most; ++i) printf "%14d  %s\n", size[kind, names[kind, i]], names[kind, i]
      for (rest = 0; i <= count[kind]; ++i) rest += size[kind, names[kind, i]]
      if (count[kind] > most) printf "%14d  %d more\n", rest, count[kind] - most
      printf "\n"
    }
    # Of the types that nm knows: b and d are memory that can be written, r is not. Upper case is visible to other files.
    $3 !~ /^[bBdDrRuVv]$/ { next }
    {
      bytes = $2 + 0
      symbol = $0
      sub(/^[0-9]+ [0-9]+ [a-zA-Z] /, "", symbol)
    }
    symbol ~ /^flexrf::application::/ {
      sub(/^flexrf::application::/, "", symbol)
      cell += bytes
      if (symbol ~ /^slot_.*_history(_memory)?$/) {
        gsub(/^slot_|_history(_memory)?$/, "", symbol)
        add("history", symbol, bytes)
      } else if (symbol ~ /^slot_/) {
        gsub(/^slot_|_memory$/, "", symbol)
        add("slot", symbol, bytes)
      } else if (symbol ~ /^(queue|ring)_/) {
        gsub(/^(queue|ring)_|(_[0-9]+)?(_memory)?$|_(sources|sinks|readers|writers)$/, "", symbol)
        add("queue", symbol, bytes)
      } else if (symbol ~ /^stack_/) {
        add("stack", substr(symbol, 7), bytes)
      } else if (symbol ~ /^unit_/ && $3 ~ /[bB]/) {
        add("unit", substr(symbol, 6), bytes)
      } else if (symbol ~ /^device_/ && $3 ~ /[bB]/) {
        add("device", substr(symbol, 8), bytes)
      } else {
        add("other", symbol, bytes)
      }
      next
    }
    $3 ~ /[rR]/ { constant += bytes; next }
    { add("process", symbol, bytes) }
    END {
      show("slot", "slots: buffers and control")
      show("history", "histories")
      show("queue", "queues")
      show("stack", "stacks of threads, with their guard pages")
      show("unit", "units")
      show("device", "drivers: each device has room for its largest")
      show("other", "what connects and describes them")
      printf "%12d  the cell\n%12d  its memory_budget, of which %.1f %% are used\n\n", cell, budget, 100 * cell / budget
      show("process", "objects of the runtime and of what else is linked in")
      printf "%12d  their constants\n\n", constant
    }'

# Types are no objects: their sizes are config-gen's, which the generated code asserts.
sed -n '/^Data types/,$p' "$memory_map"
echo
echo "Sections of 1 KiB and more"
size -A -d "$executable" | awk '$2 ~ /^[0-9]+$/ && $3 > 0 {
  total += $2
  if ($2 >= 1024) printf "%12d  %s\n", $2, $1
} END { printf "%12d  all sections\n", total }'
