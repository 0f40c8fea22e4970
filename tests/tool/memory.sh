#!/usr/bin/env bash
# A test is run again when something that it reads has changed, and only then: with a real build, a real ctest, and one input of each kind.
# shellcheck disable=SC2034,SC2154 # shares its variables with what it sources
set -u -o pipefail
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
mkdir -p "$work/bin"
export PATH=$work/bin:$PATH

# The versions that this machine's packages have, and one that the test gives.
cat >"$work/bin/dpkg-query" <<BODY
#!/bin/bash
printf 'cmake\t%s\tlibc6 (>= 2)\t\t\nlibc6\t%s\t\t\t\nunused\t1\t\t\t\n' 3.25 "\$(cat "$work/version")"
BODY
chmod +x "$work/bin/dpkg-query"
echo 2.36 >"$work/version"

make_project() {  # make_project FOLDER: a program that includes a header, one that reads a table and a picture, a script, and a silent one
  mkdir -p "$1/tables" "$1/tests"
  cat >"$1/CMakeLists.txt" <<TEXT
cmake_minimum_required(VERSION 3.25)
project(memory LANGUAGES CXX)
set(FLEXRF_CHECKED ON)
include("$repository/cmake/FlexRFBuild.cmake")
include_directories("$repository")
add_library(beside_program STATIC "$repository/tests/beside_program.cpp")
enable_testing()
flexrf_add_test(NAME of_header SOURCES of_header.cpp LIBRARIES FlexRF::options)
flexrf_add_test(NAME of_files SOURCES of_files.cpp LIBRARIES FlexRF::options)
flexrf_add_places(of_files table "\${CMAKE_CURRENT_SOURCE_DIR}/tables" picture "\${CMAKE_CURRENT_SOURCE_DIR}/picture.png")
add_test(NAME of_script COMMAND bash "\${CMAKE_CURRENT_SOURCE_DIR}/script.sh")
flexrf_test_reads(of_script "\${CMAKE_CURRENT_SOURCE_DIR}/script.sh")
add_test(NAME silent COMMAND true)
TEXT
  echo 'constexpr int answer = 0;' >"$1/header.hpp"
  printf '#include <cstdio>\n#include "header.hpp"\nint main() { std::printf("%%d", answer); }\n' >"$1/of_header.cpp"
  printf '#include "places.hpp"\nint main() { return place::table == nullptr || place::picture == nullptr; }\n' >"$1/of_files.cpp"
  echo a >"$1/tables/a.toml"
  echo b >"$1/picture.png"
  printf 'test ! -e "%s/failing"\n' "$work" >"$1/script.sh"
  cp "$repository/packages.txt" "$1/"
}

# Runs the tests of a project in a process of its own, with the functions that `flexrf test` uses.
tests() (  # tests FOLDER: builds, and prints the names of those that ran, and how many were unchanged
  root=$1 tool=$repository/cmake/tool cache=$work/cache stages=$work/stages counts=$work/counts
  rm -rf "$stages" "$counts"
  mkdir -p "$stages" "$cache"
  source "$tool/words.sh"
  source "$tool/build.sh"
  source "$tool/memory.sh"
  source "$tool/ctest.sh"
  count() { echo "$*" >>"$counts"; }
  cmake -G Ninja -S "$root" -B "$root/build/release" -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 && ninja -C "$root/build/release" >>"$work/log" 2>&1 ||
    { cat "$work/log" >&2 && return 1; }
  use_memory
  find_test_keys release
  [[ -e $work/meanwhile ]] && sleep 0.02 && source "$work/meanwhile"
  run_tests release >"$work/output" 2>&1
  sed -n -E 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .*/\1/p' "$work/output" | sort | paste -s -d ' '
)

expect() {  # expect WHEN RAN: which tests run, and that all others are told as unchanged
  local ran unchanged
  ran=$(tests "${3-$work/here}")
  unchanged=$(grep -c 'unchanged since it passed (20[0-9-]*)' "$work/output")
  [[ $ran == "$2" && $((unchanged + $(wc -w <<<"$2"))) == 4 ]] && return
  printf 'FAILED: %s\n  expected: %s\n  ran: %s; unchanged: %d\n' "$1" "$2" "$ran" "$unchanged"
  failures=$((failures + 1))
}

make_project "$work/here"
expect "the first time" "of_files of_header of_script silent"
expect "the second time" silent
echo 'constexpr int answer = 1;' >"$work/here/header.hpp"
expect "after a change of a header" "of_header silent"
echo '// nothing that the compiler sees' >>"$work/here/header.hpp"
expect "after a change of a comment" silent
echo c >"$work/here/tables/a.toml"
expect "after a change of a table" "of_files silent"
touch "$work/here/tables/b.toml"
expect "after a new table" "of_files silent"
echo c >"$work/here/picture.png"
expect "after a change of a picture" "of_files silent"
echo '# another' >>"$work/here/script.sh"
expect "after a change of a script" "of_script silent"
touch "$work/here"/{script.sh,picture.png,of_header.cpp}
expect "after files have another time and the same content" silent
echo 2.37 >"$work/version"
expect "after another version of a package that one of packages.txt depends on" "of_files of_header of_script silent"
echo 2.36 >"$work/version"
expect "with the version of before" silent
sed -i 's/NAME silent COMMAND true/NAME silent COMMAND true 1/; s/of_script COMMAND bash/of_script COMMAND bash -u/' "$work/here/CMakeLists.txt"
expect "after a test is started otherwise" "of_script silent"

touch "$work/failing"
echo '# fails' >>"$work/here/script.sh"
expect "a test that fails" "of_script silent"
expect "a test that has failed" "of_script silent"
rm "$work/failing"
expect "after it was mended" "of_script silent"
expect "after it has passed" silent

echo 'echo "# while the tests ran" >>"$root/script.sh"' >"$work/meanwhile"
echo '# before' >>"$work/here/script.sh"
expect "a file that changes after its sum was taken" "of_script silent"
rm "$work/meanwhile"
expect "after that" "of_script silent"

cp -r "$work/here" "$work/elsewhere"
rm -rf "$work/elsewhere/build"
expect "in a clone elsewhere" silent "$work/elsewhere"
exit $((failures > 0))
