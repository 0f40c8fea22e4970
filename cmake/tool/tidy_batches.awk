# Reads BUILD/compile_commands.json and writes, for `flexrf test`, what clang-tidy analyses: files in `out` that include
# a few of ours each, and a compile database for them. Nearly all of an analysis goes into the headers, which are much
# the same for all files of a batch, so a batch takes hardly longer than one of its files. Prints the batches.
# Variables: root, out, size (files of a batch), without_tests (1: neither tests nor benchmarks).

# What a file defines must not meet the libraries of the next, nor CMocka's macros, which come with a test's own headers, the
# headers of what it tests.
function early_includes(file, line) {
  while ((getline line < file) > 0) {
    if (line !~ /^#include (<|"[a-z-]+\/)/ || line ~ /"[^"]*(tests|conformance|benchmarks)\// || line in included) continue
    included[line] = 1
    if (line ~ /</)
      head = head line "\n"
    else
      own_head = own_head line "\n"
  }
  close(file)
}

function add_folders(list, options, n, i) {
  n = split(list, options, "\n") - 1
  for (i = 1; i <= n; ++i)
    if (!(options[i] in looked)) {
      looked[options[i]] = 1
      folders = folders options[i]
    }
}

# NAME.cpp with files `from` to `to`, and its halves NAME_a.cpp and NAME_b.cpp in case they do not go together.
function write_batch(name, from, to, file, body, i) {
  file = out "/" name ".cpp"
  split("", included)
  head = own_head = ""
  body = ""
  split("", looked)
  folders = ""
  for (i = from; i <= to; ++i) {
    add_folders(includes_of[files[i]])
    if (from < to) early_includes(files[i])
    body = body "#define main main_of_" i "\n#include \"" files[i] "\"\n#undef main\n"
  }
  printf "%s%s%s", head, own_head, body > file
  close(file)
  printf "%s{ \"directory\": \"%s\", \"command\": \"%s%s -c %s\", \"file\": \"%s\" }", comma, directory,
    command_of[files[from]], folders, file, file > database
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

# The names that a file gives at its left margin: what stands before the first bracket, brace, = or ; there. None where it has a
# namespace of its own name.
function names_of(file, line, found, own) {
  found = " "
  own = file
  gsub(/.*\/|\.cpp$/, "", own)
  while ((getline line < file) > 0) {
    if (line ~ "^namespace .*::" own " {$") {
      close(file)
      return " "
    }
    if (line !~ /^[A-Za-z]/ || line ~ /^(using )?namespace |^template |^static_assert|^int main\(/) continue
    if (sub(/^(class|struct|union|enum( class)?) /, "", line)) sub(/[^A-Za-z0-9_].*/, "", line)
    sub(/[({=;\[].*/, "", line)
    if (line ~ /::~?[A-Za-z0-9_]+ *$/) continue # a member of what has the name
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

# Files of several programs have the same names again and again: each goes into the first batch that has none of its own, and no
# other "places.hpp", of which each program has one.
function write_packed(list, most, names, n, i, b, bins, given, place, place_of, content, count, packed) {
  n = split(list, names, "\n") - 1
  bins = 0
  for (i = 1; i <= n; ++i) {
    given = names_of(names[i])
    place = match(includes_of[names[i]], /\/places\/[^\n]*/) ? substr(includes_of[names[i]], RSTART, RLENGTH) : ""
    for (b = 1; b <= bins; ++b)
      if (count[b] < most && (!place || !place_of[b] || place == place_of[b]) && !share_a_name(given, content[b])) break
    if (b > bins) {
      bins = b
      count[b] = 0
      content[b] = " "
      packed[b] = place_of[b] = ""
    }
    if (place) place_of[b] = place
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
  # What hardly matters to an analysis, so that files of several libraries go together.
  gsub(/ -(O[0-9]|g1|fPIC|fno-builtin|ffp-contract=off|DBOOST_ALL_NO_LIB|DSIMDJSON_THREADS_ENABLED=1|D[a-z_]+_EXPORTS)/, "", command)
  # The compiler's cache stands before it.
  if (match(command, /[^ ]*ccache /) == 1) command = substr(command, RLENGTH + 1)
  includes = ""
  while (match(command, / -(I|isystem )[^ ]+/)) {
    includes = includes substr(command, RSTART, RLENGTH) "\n"
    command = substr(command, 1, RSTART - 1) substr(command, RSTART + RLENGTH)
  }
}

# Files go together that lie in the same two folders and are compiled alike; where they look for headers is put together. So a
# file that is added changes the batches of its neighbours only. Tests bring CMocka's macros, and asio.cpp is that library itself.
function add(file, part, key, is_test) {
  if (index(file, root "/") != 1 || index(file, root "/build/") == 1 || file in seen) return
  seen[file] = 1
  is_test = file ~ /\/(tests|conformance|benchmarks)\/|_(test|stress)\.cpp$/
  if (is_test && without_tests) return
  split(substr(file, length(root) + 2), part, "/")
  key = is_test SUBSEP (file ~ /\/asio\.cpp$/) SUBSEP part[1] SUBSEP command
  if (!(key in files_of)) keys[++key_count] = key
  files_of[key] = files_of[key] file "\n"
  command_of[file] = command
  includes_of[file] = includes
}

/^ *"file": / {
  file = value_of($0)
  if (file !~ /\/batches\/[^\/]+\/batch_[0-9]+\.cpp$/) {
    add(file)
    next
  }
  # The build's own batch, of what belongs to one library. What is generated is named from where the batch lies.
  while ((getline line < file) > 0)
    if (line ~ /^#include "[^.]/) {
      sub(/^#include "/, "", line)
      sub(/"$/, "", line)
      add(root "/" line)
    }
  close(file)
}

END {
  for (i = 1; i <= key_count; ++i) write_packed(files_of[keys[i]], size)
  printf "\n]\n" > database
}
