# Sourced by flexrf: what is checked of the sources themselves: how they are written, which part includes which, promises and their tests,
# and the static analysis.
# shellcheck shell=bash disable=SC2154 # shares its variables with flexrf

sources() {  # every C++ file that a person wrote
  find "$root" \( -path "$root/build" -o -name '.?*' \) -prune -o -type f \
    \( -name '*.cpp' -o -name '*.hpp' -o -name '*.h' \) -print0
}

documents_and_tests() {  # every file that may promise something, or test it
  find "$root" \( -path "$root/build" -o -name node_modules -o -name '.?*' \) -prune -o -type f \
    \( -name '*.md' -o -name '*.cpp' -o -name '*.hpp' -o -name '*.sh' -o -name '*.ts' \) -print
}

# The files of the image's tests are sourced together: a second function of the same name would replace the first.
check_functions() {
  local twice
  twice=$(grep -ohE '^[a-z_]+\(\)' "$tool"/image*.sh | sort | uniq -d)
  [[ ! $twice ]] || { printf 'cmake/tool/image*.sh have two functions with this name: %s\n' "$twice" && return 1; }
}

check_layout() {
  local status=0
  sources | xargs -0 -r -n 50 -P "$(nproc)" clang-format --dry-run -Werror || status=1
  sources | xargs -0 -r awk -v root="$root" -f "$tool/includes.awk" || status=1
  documents_and_tests | sort | awk -v root="$root" -f "$tool/promises.awk" || status=1
  check_functions || status=1
  return "$status"
}

# The static analysis of the files of the release build's list that lie outside build/. With `without tests` of what runs beside a machine.
analyse() {  # analyse [without tests]
  local headers memory='' analysis=$root/build/release/analysis status=0
  headers="^$root/($(cd "$root" && find . -mindepth 1 -maxdepth 1 -type d ! -name build ! -name '.*' -printf '%f\n' |
    sort | paste -s -d '|'))/"
  rm -rf "$analysis"
  mkdir -p "$analysis"
  if [[ $passed_folder ]]; then
    memory=$cache/analysis
    mkdir -p "$memory"
    find "$memory" -type f -mtime +30 -delete
    sums_of_memory "$memory" "$root" >"$analysis/sums"
  fi
  awk -v root="$root" -v out="$analysis" -v size=12 -v without_tests="$(($# > 0))" -f "$tool/tidy_batches.awk" \
    "$root/build/release/compile_commands.json" | tr '\n' '\0' >"$analysis/batches"
  xargs -0 -r -a "$analysis/batches" -n 1 -P "$(nproc)" \
    bash "$tool/tidy.sh" "$root" "$analysis" "$headers" "$memory" "$(clang-tidy --version)" </dev/null || status=1
  printf '%d batches of files, %d of them unchanged since nothing was found in them\n' \
    "$(tr -dc '\0' <"$analysis/batches" | wc -c)" "$(find "$analysis" -name '*.remembered' | wc -l)"
  return "$status"
}
