# Sourced by flexrf: configures and builds a preset, quietly.
# shellcheck shell=bash disable=SC2154 # root and tool are flexrf's

# GCC 12's sanitizers map their shadow at fixed addresses, which a kernel that randomises widely may have given away.
set_launcher() {  # set_launcher PRESET: sets `launcher` to what the preset's programs are started with
  launcher=()
  case $1 in
    asan | tsan | fuzz) setarch --addr-no-randomize true 2>/dev/null && launcher=(setarch --addr-no-randomize) ;;
  esac
}

configure() {  # configure PRESET: once; later ninja itself sees when a CMakeLists.txt changes
  local directory=$root/build/$1 start
  local -a options=()
  # The generator is the same in every preset, and takes longest to compile.
  [[ $1 == release ]] || options=("-DFLEXRF_HOST_TOOLS=$root/build/release/config-gen")
  command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  [[ -f $directory/build.ninja && ! $root/CMakePresets.json -nt $directory/build.ninja ]] && return
  start=$(microseconds)
  if ! (cd "$root" && cmake --preset "$1" "${options[@]}") </dev/null >"$directory/configure.log" 2>&1; then
    cat "$directory/configure.log" >&2
    say "configuring $1 failed"
    return 1
  fi
  say "configured $1: $(since "$start")"
}

show_progress() {  # passes ninja's output on to the log, and on a terminal shows where it is in one line
  local line
  while IFS= read -r line; do
    printf '%s\n' "$line"
    [[ -t 2 && $line == \[* ]] && printf '\r\033[K%s' "${line:0:${COLUMNS:-80}-1}" >&2
  done
  if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
}

ninja_options=()
build() {  # build PRESET [TARGET...]: one line when it goes well, the compiler's output when it does not
  local preset=$1 directory=$root/build/$1 start what
  local -a launcher
  shift
  what="${*:-everything} ($preset)"
  [[ $preset == release ]] || build release host-tools || return
  mkdir -p "$directory"
  (
    flock 9 # two commands at once must not build in one folder
    configure "$preset" 9>&- || exit 1
    set_launcher "$preset"
    use_compiler_cache
    start=$(microseconds)
    if ! "${launcher[@]}" ninja "${ninja_options[@]}" -C "$directory" "$@" </dev/null 2>&1 9>&- | show_progress >"$directory/build.log"; then
      grep -v -E '^\[[0-9]+/[0-9]+\] |^ninja: Entering' "$directory/build.log" >&2
      say "building $what failed after $(since "$start")"
      exit 1
    fi
    say "built $what: $(since "$start")"
  ) 9>"$directory/.lock"
}
