# Reads BUILD/compile_commands.json and writes, for `flexrf test`, what clang-tidy analyses: files in `out` that include
# a few of ours each, and a compile database for them. Nearly all of an analysis goes into the headers, which are much
# the same for all files of a batch, so a batch takes hardly longer than one of its files. Prints the batches.
# Variables: root, out, size (files of a batch).

function system_includes(file, line) {
  while ((getline line < file) > 0)
    if (line ~ /^#include </ && !(line in included)) {
      included[line] = 1
      head = head line "\n"
    }
  close(file)
}

# NAME.cpp with files `from` to `to`, and its halves NAME_a.cpp and NAME_b.cpp in case they do not go together.
function write_batch(name, from, to, file, body, i) {
  file = out "/" name ".cpp"
  split("", included)
  head = "" # before all else: what one file defines must not meet the libraries of the next
  body = ""
  for (i = from; i <= to; ++i) {
    if (from < to) system_includes(files[i])
    body = body "#define main main_of_" i "\n#include \"" files[i] "\"\n#undef main\n"
  }
  printf "%s%s", head, body > file
  close(file)
  printf "%s{ \"directory\": \"%s\", \"command\": \"%s -c %s\", \"file\": \"%s\" }", comma, directory_of[key],
    command_of[key], file, file > database
  comma = ",\n"
  if (from < to) {
    write_batch(name "_a", from, int((from + to) / 2))
    write_batch(name "_b", int((from + to) / 2) + 1, to)
  }
}

function write_list(list, most, names, n, i) {
  n = split(list, names, "\n") - 1 # each ends with one
  for (i = 1; i <= n; ++i) {
    files[++taken] = names[i]
    if (taken < most && i < n) continue
    write_batch("batch_" ++batches, 1, taken)
    print out "/batch_" batches ".cpp"
    taken = 0
  }
}

# The names that a file gives at its left margin: what stands before the first bracket, brace, = or ; there.
function names_of(file, line, found) {
  found = " "
  while ((getline line < file) > 0) {
    if (line !~ /^[A-Za-z]/ || line ~ /^(using )?namespace |^int main\(/) continue
    sub(/[({=;\[].*/, "", line)
    sub(/[^A-Za-z0-9_]+$/, "", line)
    sub(/.*[^A-Za-z0-9_]/, "", line)
    found = found line " "
  }
  close(file)
  return found
}

function share_a_name(left, right, names, n, i) {
  n = split(left, names, " ")
  for (i = 1; i <= n; ++i)
    if (index(right, " " names[i] " ")) return 1
  return 0
}

# Tests and benchmarks have the same names again and again: each goes into the first batch that has none of its own.
function write_packed(list, most, names, n, i, b, bins, given, content, count) {
  n = split(list, names, "\n") - 1
  bins = 0
  for (i = 1; i <= n; ++i) {
    given = names_of(names[i])
    for (b = 1; b <= bins; ++b)
      if (count[b] < most && !share_a_name(given, content[b])) break
    if (b > bins) {
      bins = b
      count[b] = 0
      content[b] = " "
      packed[b] = ""
    }
    ++count[b]
    content[b] = content[b] given
    packed[b] = packed[b] names[i] "\n"
  }
  for (b = 1; b <= bins; ++b) write_list(packed[b], most)
}

function value_of(line) {
  sub(/^ *"[a-z]+": "/, "", line)
  sub(/",?$/, "", line)
  return line
}

BEGIN { database = out "/compile_commands.json"; printf "[\n" > database }

/^ *"directory": / { directory = value_of($0) }

/^ *"command": / {
  command = value_of($0)
  sub(/ -o [^ ]+ -c [^ ]+$/, "", command)
  # A precompiled header is the other compiler's, and each file names what it needs.
  gsub(/ -Winvalid-pch| -include [^ ]*cmake_pch\.hxx| -Werror/, "", command)
}

function add(file, key) {
  if (index(file, root "/") != 1 || index(file, root "/build/") == 1 || file in seen) return
  seen[file] = 1
  directory_of[key] = directory
  command_of[key] = command
  if (file !~ /\/tests\/|_test\.cpp$|_stress\.cpp$|\/benchmarks\//)
    product[key] = product[key] file "\n"
  else
    rest[key] = rest[key] file "\n"
}

/^ *"file": / {
  file = value_of($0)
  if (file !~ /\/Unity\/unity_[0-9]+_cxx\.cxx$/) {
    add(file, directory SUBSEP command)
    next
  }
  # The build's own batch, of what belongs to one library.
  while ((getline line < file) > 0)
    if (line ~ /^#include "/) {
      sub(/^#include "/, "", line)
      sub(/"$/, "", line)
      add(line, directory SUBSEP command)
    }
  close(file)
}

END {
  for (key in product) write_list(product[key], size)
  for (key in rest) write_packed(rest[key], size)
  printf "\n]\n" > database
}
