#!/usr/bin/env bash
# fetch_packages.sh FOLDER NAME...: prints the files of these Debian packages, of the version that this machine's package lists name;
# what FOLDER does not have of them yet is downloaded into it, what it has is compared with the lists' checksums.
set -eu -o pipefail
folder=$1
shift
mkdir -p "$folder"

list() { apt-get download --print-uris "$@" </dev/null 2>/dev/null; } # lines 'ADDRESS' FILE SIZE SHA256:SUM

renew_lists() {
  local -a as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || {
      echo "the package lists are old or missing, and renewing them needs root. As root: apt-get update" >&2
      return 1
    }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get -q update </dev/null >&2
}

is_good() { [[ -f $folder/$1 ]] && sha256sum --status -c - <<<"$2  $folder/$1"; } # is_good FILE SUM

fetch() {  # fetch NAME...: fails when the lists name something that the mirror has no longer
  local listed file sum
  local -a wanted=()
  listed=$(list "$@") && [[ $listed ]] || return
  while read -r _ file _ sum; do
    is_good "$file" "${sum#SHA256:}" || wanted+=("${file%%_*}")
  done <<<"$listed"
  if ((${#wanted[@]})); then
    echo "downloading ${#wanted[@]} packages" >&2
    (cd "$folder" && apt-get -q -o APT::Sandbox::User=root download "${wanted[@]}" </dev/null >&2) || return
  fi
  while read -r _ file _ sum; do
    is_good "$file" "${sum#SHA256:}" || return
    printf '%s/%s\n' "$folder" "$file"
  done <<<"$listed"
}

fetch "$@" || { renew_lists && fetch "$@"; } || {
  echo "not all packages could be had: $*" >&2
  echo "hint: is there a network, and does /etc/apt name a mirror of Debian 12?" >&2
  exit 1
}
