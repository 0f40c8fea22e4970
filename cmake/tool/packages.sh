# Sourced by flexrf: installs the Debian packages of packages.txt that are missing.
# shellcheck shell=bash disable=SC2154 # root and tool are flexrf's

missing_packages() {  # missing_packages USE...: a line "name<TAB>why" for each package not installed
  local name use why installed command
  local -a names=()
  local -A reason=()
  while read -r name use why; do
    IFS=: read -r use command <<<"$use"
    [[ $name == '' || $name == \#* || " $* " != *" $use "* ]] && continue
    [[ $command ]] && command -v "$command" >/dev/null && continue
    names+=("$name")
    reason[$name]=$why
  done <"$root/packages.txt"
  # dpkg-query also fails when one of them is unknown to it, which is what we ask.
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${names[@]}" 2>/dev/null)
  for name in "${names[@]}"; do
    [[ $'\n'$installed$'\n' == *$'\n'"$name installed"$'\n'* ]] || printf '%s\t%s\n' "$name" "${reason[$name]}"
  done
}

install_packages() {  # install_packages USE...: ends with a message if what is missing cannot be installed
  local missing name why start log
  local -a names=() as_root=()
  if ! command -v dpkg-query >/dev/null; then
    say "this is not a Debian system: what packages.txt lists has to be here already"
    return
  fi
  # The page of the panel is kept in the repository; only after its sources have changed is it built.
  if [[ " $* " == *' build '* ]] && ! bash "$root/web-ui/page/page.sh" fits; then set -- "$@" page; fi
  missing=$(missing_packages "$@")
  [[ $missing ]] || return 0
  say "Debian packages that are missing:"
  while IFS=$'\t' read -r name why; do
    names+=("$name")
    printf '  %-20s %s\n' "$name" "$why" >&2
  done <<<"$missing"
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      say "installing them needs root, and there is no sudo here. As root: apt-get install ${names[*]}"
      exit 3
    fi
    as_root=(sudo)
  fi
  command -v apt-get >/dev/null || die "there is no apt-get here to install them with: ${names[*]}"
  say "installing them with ${as_root[*]+${as_root[*]} }apt-get"
  as_root+=(env DEBIAN_FRONTEND=noninteractive)
  start=$(microseconds)
  log=$(mktemp)
  # A third party's broken source need not stop us: whether the packages come is what counts.
  "${as_root[@]}" apt-get -q update </dev/null >"$log" 2>&1
  if ! "${as_root[@]}" apt-get -q -y -o DPkg::Lock::Timeout=300 install --no-install-recommends "${names[@]}" \
    </dev/null >>"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    die "apt-get could not install: ${names[*]}"
  fi
  rm -f "$log"
  say "installed ${#names[@]} packages in $(since "$start")"
}
