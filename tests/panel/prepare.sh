#!/usr/bin/env bash
# prepare.sh SOURCE WORK NPM: copies the tests to where npm may put its packages, and has it put them there.
set -eu -o pipefail
source=$1 work=$2 npm=$3
mkdir -p "$work"
rm -rf "$work/src"
cp -r "$source/src" "$source/tsconfig.json" "$source/vitest.config.ts" "$work/"
for file in package.json package-lock.json .npmrc; do
  cmp -s "$source/$file" "$work/$file" || rm -f "$work/complete"
  cp "$source/$file" "$work/"
done
[[ -e $work/complete ]] && exit
cd "$work"
# A browser is Debian's: none is fetched.
PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD=1 "$npm" ci --no-audit --no-fund --loglevel=error </dev/null
touch complete
