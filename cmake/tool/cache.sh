# Sourced by flexrf: the folder that remembers, across clones, what was made once: objects of the compiler (ccache), files in
# which the static analysis found nothing, the guest's kernel. Whatever is wrong with it costs time, and nothing else.
# shellcheck shell=bash disable=SC2034 # shares its variables with flexrf

cache='' # the folder, or nothing
find_cache() {  # as FLEXRF_CACHE says, "off" for none, or where a user's caches are
  local folder=${FLEXRF_CACHE:-${XDG_CACHE_HOME:-${HOME:+$HOME/.cache}}/flexrf}
  cache=''
  [[ $folder == off || $folder == /flexrf ]] && return
  if [[ $folder != /* ]]; then
    say "nothing is remembered: FLEXRF_CACHE is neither 'off' nor an absolute path, but '$folder'"
  elif ! mkdir -p "$folder" 2>/dev/null || [[ ! -w $folder || ! -x $folder ]]; then
    say "nothing is remembered: $folder cannot be written; FLEXRF_CACHE can name another folder, or 'off'"
  else
    cache=$folder
  fi
}

# The compiler's cache, as the build of a preset starts it. A clone elsewhere gives the same objects: paths below the
# repository are taken relative to the build's folder. Headers are known by their contents alone.
use_compiler_cache() {
  if [[ ! $cache ]]; then
    export CCACHE_DISABLE=1
    return
  fi
  export CCACHE_DIR=$cache/compiler CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1 CCACHE_COMPILERCHECK=content
  export CCACHE_MAXSIZE=${CCACHE_MAXSIZE:-5G}
  export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
}

# sums_of_memory FOLDER ROOT: of all that remembered batches of the analysis had read in a repository, as it is now; once, not
# for each that read it.
sums_of_memory() {
  find "$1" -type f -exec tail -q -n +2 {} + | cut -c 67- | sort -u | (cd "$2" && xargs -r -d '\n' sha256sum 2>/dev/null)
}
