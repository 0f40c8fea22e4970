# Sourced by flexrf: the memory of passed tests. A test is not run again while everything that its result depends on is what it was when
# the test passed: its key is the checksum of that content. Keys name files relative to the repository, so that a clone elsewhere knows them.
# shellcheck shell=bash disable=SC2154 # shares its variables with flexrf

passed_folder='' # a file for each key of a test that passed; empty: nothing is looked up or remembered

use_memory() {  # after find_cache. Without package versions a key would not tell an upgraded library.
  passed_folder=''
  if [[ $cache ]] && command -v dpkg-query >/dev/null; then passed_folder=$cache/passed; fi
  [[ $passed_folder ]] || return 0
  mkdir -p "$passed_folder"
  find "$passed_folder" -type f -mtime +30 -delete
}

# The versions of the packages in packages.txt and of all that these depend on; as lines "NAME VERSION".
package_versions() {
  awk '/^[a-z]/ { print $1 }' "$root/packages.txt" | awk -F '\t' '
    FILENAME == "-" { wanted[++last] = $1; next }
    { version[$1] = $2; needs[$1] = $3 "," $4
      provided = split($5, names, /, */)
      for (i = 1; i <= provided; ++i) { sub(/[ :(].*/, "", names[i]); provider[names[i]] = provider[names[i]] " " $1 } }
    function want(name) { if (!(name in seen)) { seen[name]; wanted[++last] = name } }
    END {
      for (next_one = 1; next_one <= last; ++next_one) {
        name = wanted[next_one]
        if (name in version) {
          if (!(name in printed)) { printed[name]; print name, version[name] }
          count = split(needs[name], alternatives, /[,|] */)
          for (i = 1; i <= count; ++i) { sub(/^ +/, "", alternatives[i]); sub(/[ :(].*/, "", alternatives[i]); want(alternatives[i]) }
        }
        count = split(provider[name], names, " ")
        for (i = 1; i <= count; ++i) want(names[i])
      }
    }' <(dpkg-query -W -f '${Package}\t${Version}\t${Depends}\t${Pre-Depends}\t${Provides}\n') - | sort
}

# Prints the checksum of the inputs that all tests of a run share: kernel, processors, user and packages.
environment_key() {
  [[ -s $stages/environment ]] || {
    uname -srm
    printf 'processors %s, user %s\n' "$(nproc)" "$EUID"
    package_versions
  } >"$stages/environment"
  sha256sum <"$stages/environment" | cut -d ' ' -f 1
}

content_sum() {  # content_sum PATH: of a file, or of a folder with the names and contents of all files in it
  if [[ -d $1 ]]; then
    (cd "$1" && find . \( -path "./build" -o -name .git -o -name node_modules \) -prune -o -type f -print0 | sort -z | xargs -0 -r b2sum -l 128) | b2sum -l 128
  elif [[ -f $1 ]]; then
    b2sum -l 128 <"$1"
  else
    echo missing
  fi | cut -d ' ' -f 1
}

has_long_run() { # has_long_run PATH: whether FLEXRF_LONG is looked at there
  [[ $1 == "$root" ]] || grep -q -r -a -s -F FLEXRF_LONG "$1"
}

# Content sums of the paths that are read from standard input, as lines "SUM LONG PATH"; LONG is 1 where FLEXRF_LONG changes the result.
sums_of() {
  # shellcheck disable=SC2016 # expands in the shells that xargs starts
  root=$root xargs -r -d '\n' -n 8 -P "$(nproc)" bash -c 'source "$0"; for path; do
      long=0; has_long_run "$path" && long=1
      printf "%s %s %s\n" "$(content_sum "$path")" "$long" "$path"
    done' "$tool/memory.sh"
}

# find_keys NAME READS [DEFINITIONS]: leaves $stages/keys-NAME/TEST with each test's key. READS has lines "TEST<TAB>PATH"; a test that is not in
# it has no key. DEFINITIONS has lines "TEST<TAB>how it is started".
find_keys() {
  local name=$1 reads=$2 definitions=${3-/dev/null} folder=$stages/keys-$1 environment
  [[ $passed_folder ]] || return 0
  [[ -d $folder ]] && return
  environment=$(environment_key)
  mkdir -p "$folder.new"
  sort -u "$reads" >"$folder.reads"
  cut -f 2 "$folder.reads" | sort -u >"$folder.paths"
  sums_of <"$folder.paths" >"$folder.sums"
  awk -v root="$root/" -v folder="$folder.new/" -v environment="$environment" -v name="$name" -v long="${FLEXRF_LONG-}" '
    is == "sum" { path = substr($0, length($1) + length($2) + 3); sum[path] = $1; is_long[path] = $2; next }
    { test = $0; sub(/\t.*/, "", test); rest = substr($0, length(test) + 2) }
    is == "definition" { gsub(root, "", rest); definition[test] = definition[test] "\n" rest; next }
    { text[test] = text[test] "\n" sum[rest]
      if (is_long[rest]) longs[test] = long
      gsub(root, "", rest); text[test] = text[test] " " rest }
    END { for (test in text) {
      file = folder test
      print name, test, environment, longs[test] definition[test] text[test] >file
      close(file)
    } }' is=sum "$folder.sums" is=definition "$definitions" is=read "$folder.reads"
  (cd "$folder.new" && find . -type f -printf '%f\0' | xargs -0 -r sha256sum) | while read -r sum test; do
    printf '%s\n' "$sum" >"$folder.new/$test"
  done
  mv "$folder.new" "$folder"
}

# set_keys NAME: for tests whose inputs are known to another script: lines "TEST KEY" from standard input
set_keys() {
  local folder=$stages/keys-$1 test key environment
  [[ $passed_folder ]] || return 0
  environment=$(environment_key)
  mkdir -p "$folder" && : >"$folder.paths" && : >"$folder.reads" && : >"$folder.sums" || return
  while read -r test key; do
    [[ $key ]] && printf '%s\n' "$1 $test $environment $key" | sha256sum | cut -d ' ' -f 1 >"$folder/$test"
  done
}

key_of() {  # key_of NAME TEST: its key; fails if it has none
  [[ $passed_folder && -s $stages/keys-$1/$2 ]] && cat "$stages/keys-$1/$2"
}

passed_before() {  # passed_before NAME TEST: prints the day on which the test passed with these inputs; fails if it did not
  local key
  key=$(key_of "$1" "$2") && [[ -s $passed_folder/$key ]] || return
  touch "$passed_folder/$key" # an entry that is still asked for is kept
  cut -d ' ' -f 1 "$passed_folder/$key"
}

# remember_passed NAME TEST...: their keys were taken before they ran. A test that reads a file which was changed since is not remembered.
remember_passed() {
  local name=$1 folder=$stages/keys-$1 test key
  shift
  [[ $passed_folder && -d $folder ]] || return 0
  while IFS= read -r path; do
    [[ -e $path ]] && find "$path" \( -path "$root/build" -o -name .git -o -name node_modules \) -prune -o -newer "$folder.sums" -type f -print -quit |
      grep -q . && printf '%s\n' "$path"
  done <"$folder.paths" >"$folder.changed"
  for test; do
    key=$(key_of "$name" "$test") || continue
    if [[ -s $folder.changed ]] && awk -F '\t' -v test="$test" 'is == "changed" { changed[$0]; next } $1 == test && $2 in changed { found = 1; exit } END { exit !found }' \
      is=changed "$folder.changed" is=read "$folder.reads"; then
      continue
    fi
    printf '%s %s %s\n' "$(date +%F)" "$name" "$test" >"$passed_folder/$key.$BASHPID" && mv "$passed_folder/$key.$BASHPID" "$passed_folder/$key"
  done
}

unchanged_line() {  # unchanged_line TEST DAY: in place of the runner's line for it
  local line="      Test: $1 "
  while ((${#line} < 60)); do line+=.; done
  printf '%s   unchanged since it passed (%s)\n' "$line" "$2"
}

# run_changed NAME COMMAND TEST...: runs `COMMAND TEST...` with those of the tests that have changed since they passed. The command prints a
# line as ctest's for each.
run_changed() {
  local name=$1 command=$2 test day unchanged=0 status log
  local -a chosen=() passed
  shift 2
  for test; do
    if day=$(passed_before "$name" "$test"); then
      unchanged_line "$test" "$day"
      unchanged=$((unchanged + 1))
    else
      chosen+=("$test")
    fi
  done
  count 0 0 "$unchanged"
  ((${#chosen[@]})) || return 0
  log=$(mktemp "$stages/tests.XXXXXX")
  "$command" "${chosen[@]}" 2>&1 | tee "$log"
  status=${PIPESTATUS[0]}
  mapfile -t passed < <(passed_tests "$log")
  remember_passed "$name" "${passed[@]}"
  return "$status"
}

passed_tests() { sed -n -E 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .* Passed .*/\1/p' "$1"; } # passed_tests LOG
