#!/usr/bin/env bash
# fresh.sh ROOT [--gate|--full]: tries the README's two commands, and then the level that is named, on the current commit in an empty Debian 12
# (minbase with git and ca-certificates), and says after how long the page of the first one answers. The root is made with the mirrors, the apt
# settings and the npm settings of this machine, so that what works here behind a proxy works there too. It is removed afterwards; the records
# of the levels are kept in build/test-records.
set -eu -o pipefail
root=$1 level=${2-}
suite=bookworm
# shellcheck source=cmake/tool/npm_settings.sh
source "$root/cmake/tool/npm_settings.sh"

if ((EUID != 0)); then
  command -v sudo >/dev/null || {
    echo "flexrf: a fresh root needs root, and there is no sudo here" >&2
    exit 3
  }
  export npm_config_userconfig=${npm_config_userconfig-$HOME/.npmrc} # the user's, not root's
  kept=$(compgen -e npm_config_ | paste -s -d ,)
  exec sudo --preserve-env="http_proxy,https_proxy,no_proxy,TMPDIR,NODE_EXTRA_CA_CERTS,$kept" bash "${BASH_SOURCE[0]}" "$@" </dev/null
fi

work=$(mktemp -d "${TMPDIR:-/var/tmp}/flexrf-fresh.XXXXXX")
# Everything is mounted in a namespace of its own, which ends with its last process: nothing is mounted here.
trap 'rm -rf --one-file-system "$work"' EXIT
trap 'exit 130' INT TERM
fresh=$work/root

sources() {  # this machine's own sources of Debian 12; without any, mmdebstrap's
  local file
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [[ -f $file ]] && grep -E "^deb .* $suite(-[a-z]+)? " "$file"
  done >"$work/debian.list"
  [[ -s $work/debian.list ]] && printf '%s\n' "$work/debian.list"
  for file in /etc/apt/sources.list.d/*.sources; do
    [[ -f $file ]] && grep -q -E "^Suites:.*\b$suite\b" "$file" && printf '%s\n' "$file"
  done
  return 0
}

mapfile -t mirrors < <(sources)
apt-config dump --no-empty |
  grep -E '^Acquire::(https?|ftp|socks|Check-|Retries|ForceIPv|Languages|Proxy)' >"$work/apt.conf" || true

if [[ $(git -c safe.directory="$root" -C "$root" status --porcelain) ]]; then
  echo "flexrf: what is not committed is not tried" >&2
fi
git -c safe.directory="$root" -C "$root" bundle create --quiet "$work/flexrf.bundle" HEAD

echo "flexrf: making an empty Debian 12 in $fresh" >&2
mmdebstrap --quiet --variant=minbase --include=git,ca-certificates --aptopt="$work/apt.conf" \
  "$suite" "$fresh" "${mirrors[@]}" </dev/null
cp "$work/flexrf.bundle" "$fresh/root/flexrf.bundle"
cp -L /etc/resolv.conf /etc/hosts "$fresh/etc/"
copy_npm_settings "$fresh"

cat >"$fresh/root/try" <<'TRY'
#!/bin/bash
set -eu -o pipefail
cd /root
git -c advice.detachedHead=false clone --quiet flexrf.bundle flexrf
cd flexrf
echo "== ./flexrf run, in an empty Debian 12"
page_answers() (
  exec 3<>/dev/tcp/127.0.0.1/8080
  printf 'GET / HTTP/1.1\r\nHost: 127.0.0.1:8080\r\nConnection: close\r\n\r\n' >&3
  read -r -t 5 line <&3
  [[ $line == 'HTTP/1.1 200 '* ]]
) 2>/dev/null
if (exec 3<>/dev/tcp/127.0.0.1/8080) 2>/dev/null; then
  echo "another program answers at 127.0.0.1:8080: end it first"
  exit 1
fi
status=0 start=$SECONDS
./flexrf run </dev/null >run.log 2>&1 &
until page_answers || ! kill -0 $! 2>/dev/null; do sleep 1; done
seconds=$((SECONDS - start))
if page_answers; then result="the page answers $seconds s after the clone, packages included"; else result='the page does not answer' status=1; fi
kill -TERM $! 2>/dev/null || true
wait $! || true
cat run.log
echo "$result"
rm run.log
echo "== ./flexrf run keyboard, in an empty Debian 12"
start=$SECONDS
printf 'wwwwddd' | ./flexrf run keyboard || status=1
echo "built, run and ended after $((SECONDS - start)) s"
for level in '' "$@"; do
  echo "== ./flexrf test $level, in an empty Debian 12"
  ./flexrf test $level </dev/null || status=1
done
exit "$status"
TRY

status=0
# shellcheck disable=SC2016 # expands inside
unshare --mount --pid --fork --kill-child bash -c '
  set -eu
  mount --bind "$1" "$1" # so that its root is a mount point, as that of a machine: tests have mounts of their own
  mount -t proc proc "$1/proc"
  mount --rbind /sys "$1/sys"
  mount --rbind /dev "$1/dev"
  exec chroot "$1" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root TERM=dumb LANG=C.UTF-8 \
    ${http_proxy+"http_proxy=$http_proxy"} ${https_proxy+"https_proxy=$https_proxy"} ${no_proxy+"no_proxy=$no_proxy"} \
    /bin/bash /root/try $2' fresh "$fresh" "$level" </dev/null || status=$?
if [[ -d $fresh/root/flexrf/build/test-records ]]; then
  mkdir -p "$root/build/test-records"
  cp "$fresh"/root/flexrf/build/test-records/* "$root/build/test-records/"
fi
exit "$status"
