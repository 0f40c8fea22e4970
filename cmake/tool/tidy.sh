#!/usr/bin/env bash
# tidy.sh ROOT DATABASE_DIR HEADERS MEMORY VERSION BATCH: analyses a batch of files and prints only what it finds. If two of its files
# have a name of their own in common, its halves are analysed instead.
# In the folder MEMORY, unless it is empty, a batch in which nothing is found leaves what it read: the checksum of each file, by
# a name that stands for analyser, settings, command and batch. As long as all of it is the same, as DATABASE_DIR/sums has it now,
# the analysis is not repeated.
root=$1 database=$2 headers=$3 memory=$4 version=$5 batch=${6%.cpp}
cd "$root" || exit 1
failed=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

checksum() { sha256sum | cut -d ' ' -f 1; }

# The same in a clone elsewhere.
name_of_memory() {
  {
    cat .clang-tidy "$0"
    printf '%s\n' "$version" "$headers"
    grep -F "$batch.cpp" "$database/compile_commands.json"
    cat "$batch.cpp"
  } | sed "s|$batch|batch|g; s|$root|.|g" | checksum
}

is_remembered() {  # the first line is the checksum of the others, so that one that is damaged is none
  [[ -f $1 && $(tail -n +2 "$1" | checksum) == "$(head -n 1 "$1")" ]] &&
    ! tail -n +2 "$1" | grep -q -v -x -F -f "$database/sums"
}

remember() {  # what clang-tidy listed as read, with one dot or more for its depth
  sed -n -E "s|^\.+ (.*)$|\1|p" "$work/read" | sed "s|^$root/|./|" | sort -u >"$work/files"
  # Who changed a file meanwhile wants it looked at; in the tick of the clock in which it began, that cannot be told.
  local file
  while read -r file; do [[ $work/begin -nt $file ]] || return; done <"$work/files"
  xargs -d '\n' sha256sum <"$work/files" >"$work/sums" || return
  { checksum <"$work/sums" && cat "$work/sums"; } >"$1.$$" && mv "$1.$$" "$1"
}

analyse() {  # analyse BATCH without .cpp
  local found
  found=$(clang-tidy -p "$database" --quiet --header-filter="$headers" --extra-arg=-H "$1.cpp" 2>"$work/errors") && {
    cat "$work/errors" >>"$work/read"
    return
  }
  found+=$'\n'$(grep -v -E '^\.+ ' "$work/errors")
  if [[ $found == *clang-diagnostic-error* && -e $1_a.cpp ]]; then
    analyse "$1_a"
    analyse "$1_b"
    return
  fi
  failed=1
  grep -v -E '^$|^[0-9]+ (warning|error)s? .*generated|^Suppressed ' <<<"$found"
}

if [[ $memory ]]; then
  place=$memory/$(name_of_memory)
  if is_remembered "$place"; then
    touch "$place" "$batch.remembered" # what is of use still is kept
    exit
  fi
fi
touch "$work/begin"
analyse "$batch"
[[ $memory ]] && ((!failed)) && remember "$place"
exit "$failed"
