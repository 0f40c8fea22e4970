#!/usr/bin/env bash
# The panel's page, as Vite makes it of web-ui/panel and embed.mjs packs it. The packed page is kept in web-ui/page/kept with the
# key of its sources, so that a build needs npm only after somebody has changed the page.
#
#   page.sh fits                   fails unless the kept page was made from the sources as they are
#   page.sh build WORK OUTPUT      packs the page in OUTPUT: a copy of the kept page if that fits
#   page.sh prepare WORK           copies the sources to WORK, and has npm fetch their packages
#   page.sh compare WORK           builds the page from its sources and compares it with the kept page
#   page.sh renew                  builds the page from its sources and keeps it
set -eu -o pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
sources=$here/../panel kept=$here/kept

# The names and contents of every file that the page depends on: what packs it too, but neither tests nor documents.
key() {
  {
    cd "$here" && sha256sum <embed.mjs
    cd "$sources" && find . \( -name node_modules -o -name dist -o -name tests \) -prune -o -type f ! -name '*.md' ! -name .gitignore -print0 |
      LC_ALL=C sort -z | xargs -0 sha256sum
  } | sha256sum | cut -d ' ' -f 1
}

fits() { [[ -f $kept/key && $(<"$kept/key") == "$(key)" ]]; }

need_npm() {
  command -v npm >/dev/null && command -v node >/dev/null && return
  echo "npm and node (18 or newer) are not installed, and web-ui/panel has changed since its page was kept in web-ui/page/kept." >&2
  echo "Install them with ./flexrf build, or on Debian with: apt-get install nodejs npm" >&2
  exit 1
}

prepare() {  # prepare WORK
  local work=$1 file
  need_npm
  mkdir -p "$work"
  find "$work" -mindepth 1 -maxdepth 1 ! -name node_modules ! -name complete ! -name '.npmrc' ! -name 'package*.json' -exec rm -rf {} +
  for file in package.json package-lock.json .npmrc; do
    cmp -s "$sources/$file" "$work/$file" || rm -f "$work/complete"
    cp "$sources/$file" "$work/"
  done
  cp -r "$sources"/{src,public,index.html,tsconfig.json} "$sources"/*.ts "$work/"
  [[ -e $work/complete ]] && return
  (cd "$work" && npm_config_update_notifier=false npm ci --no-audit --no-fund --loglevel=error </dev/null)
  touch "$work/complete"
}

pack() {  # pack WORK OUTPUT: from the sources in WORK
  (cd "$1" && node node_modules/vite/bin/vite.js build --logLevel warn)
  rm -rf "$2"
  mkdir -p "$2"
  node "$here/embed.mjs" "$1/dist" "$2"
  key >"$2/key"
}

build() {  # build WORK OUTPUT
  if fits; then
    rm -rf "$2"
    cp -r "$kept" "$2"
  else
    prepare "$1"
    pack "$1" "$2"
  fi
}

compare() {  # compare WORK
  pack "$1" "$1/packed"
  diff -r "$1/packed" "$kept" && return
  echo "web-ui/page/kept is not the page that web-ui/panel gives: run web-ui/page/page.sh renew, and commit what it has written" >&2
  return 1
}

renew() {
  local work=$here/../../build/page
  prepare "$work"
  pack "$work" "$kept"
}

case "${1-} $#" in
  'fits 1' | 'prepare 2' | 'build 3' | 'compare 2' | 'renew 1') "$@" ;;
  *)
    sed -n '/^#   /s/^# *//p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac
