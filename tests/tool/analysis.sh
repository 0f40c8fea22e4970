#!/usr/bin/env bash
# A batch in which nothing was found is not analysed again until something of what was read is another; in any clone.
source "$(dirname "$0")/stand_in.sh"
source "$tree/cmake/tool/cache.sh"
shopt -s extglob

# Reads what the batch includes, and a header; finds the word "mistake" in either.
stand_in clang-tidy <<'BODY'
batch=${!#}
while read -r file; do echo ". $file" >&2; done < <(sed -n 's/^#include "\(.*\)"$/\1/p' "$batch")
echo ".. $STAND_IN/system.hpp" >&2
echo "1 warning generated." >&2
if [[ -e $STAND_IN/changes ]]; then # in the very tick of the clock in which the analysis began
  file=$(<"$STAND_IN/changes")
  echo "// changed meanwhile" >>"$file"
  touch -r "$TMPDIR"/*/begin "$file"
fi
grep -H mistake "$STAND_IN/system.hpp" $(sed -n 's/^#include "\(.*\)"$/\1/p' "$batch") && exit 1
exit 0
BODY
echo 14.0.6 >"$work/version"
echo 'int system;' >"$work/system.hpp"
memory=$work/memory
mkdir "$memory" "$work/tmp"

clone() {  # clone NAME: with one batch of one file
  mkdir -p "$work/$1/build"
  cp "$repository/.clang-tidy" "$work/$1/"
  echo 'int file;' >"$work/$1/file.cpp"
  echo "#include \"$work/$1/file.cpp\"" >"$work/$1/build/$2.cpp"
  printf '[\n{ "command": "c++ -I%s -c %s", "file": "%s" }\n]\n' "$work/$1" "$work/$1/build/$2.cpp" "$work/$1/build/$2.cpp" \
    >"$work/$1/build/compile_commands.json"
}

analyse() {  # analyse CLONE BATCH: sets status, output and calls_made
  : >"$calls"
  sums_of_memory "$memory" "$work/$1" >"$work/$1/build/sums"
  output=$(TMPDIR=$work/tmp bash "$tree/cmake/tool/tidy.sh" "$work/$1" "$work/$1/build" "^$work/$1/" "${3-$memory}" "$(<"$work/version")" \
    "$work/$1/build/$2.cpp" 2>&1)
  status=$?
  calls_made=$(grep -c clang-tidy "$calls")
}
expect_analysed() {  # expect_analysed WHEN TIMES
  expect "exit code $1" "$status" 0
  expect "what is said $1" "$output" ""
  expect "analyses $1" "$calls_made" "$2"
}

# What goes into batches: everything, or what runs beside a machine.
mkdir -p "$work/list/build"
for file in hal/a.cpp hal/tests/a_test.cpp hal/conformance/a.cpp benchmarks/b.cpp hal/a_stress.cpp build/generated.cpp; do
  printf '{\n  "directory": "%s",\n  "command": "c++ -c %s",\n  "file": "%s"\n},\n' "$work/list/build" "$work/list/$file" "$work/list/$file"
done >"$work/list/build/compile_commands.json"
analysed() {  # analysed WITHOUT_TESTS: the files that stand in batches
  rm -rf "$work/list/out" && mkdir "$work/list/out"
  awk -v root="$work/list" -v out="$work/list/out" -v size=12 -v without_tests="$1" -f "$tree/cmake/tool/tidy_batches.awk" \
    "$work/list/build/compile_commands.json" >"$work/batches"
  xargs sed -n "s|^#include \"$work/list/\(.*\)\"|\1|p" <"$work/batches" | LC_ALL=C sort | paste -s -d ' '
}
expect "what is analysed" "$(analysed 0)" "benchmarks/b.cpp hal/a.cpp hal/a_stress.cpp hal/conformance/a.cpp hal/tests/a_test.cpp"
expect "what is analysed without tests" "$(analysed 1)" "hal/a.cpp"

clone here batch_1
clone elsewhere batch_7
analyse here batch_1
expect_analysed "the first time" 1
analyse here batch_1
expect_analysed "the second time" 0
expect "that it was remembered" "$(ls "$work/here/build")" "*batch_1.remembered*"
analyse elsewhere batch_7
expect_analysed "elsewhere" 0
analyse here batch_1 ''
expect_analysed "without a memory" 1

for changed in "$work/here/file.cpp" "$work/system.hpp" "$work/here/.clang-tidy" "$work/version"; do
  echo '# ' >>"$changed"
  analyse here batch_1
  expect_analysed "after a change of $changed" 1
  analyse here batch_1
  expect_analysed "the second time after a change of $changed" 0
done

for place in "$memory"/*; do sed -i '$d' "$place"; done
analyse here batch_1
expect_analysed "with a memory that has lost its end" 1
for place in "$memory"/*; do : >"$place"; done
analyse here batch_1
expect_analysed "with an empty memory" 1

echo "int mistake;" >>"$work/here/file.cpp"
for time in first second; do
  analyse here batch_1
  expect "exit code of what is found the $time time" "$status" 1
  expect "what is found the $time time" "$output" "*file.cpp:int mistake;"
done

# What is written while it is analysed was not analysed.
echo 'int file;' >"$work/here/file.cpp"
touch -d '1 hour ago' "$work/here/file.cpp" "$work/system.hpp"
rm "$memory"/*
echo "$work/here/file.cpp" >"$work/changes"
analyse here batch_1
rm "$work/changes"
analyse here batch_1
expect_analysed "after a change while it was analysed" 1
finish
