#!/usr/bin/env bash
# What an npm in an empty root gets to know of this machine's.
source "$(dirname "$0")/stand_in.sh"
source "$tree/cmake/tool/npm_settings.sh"

stand_in npm <<'BODY'
case $3 in
  globalconfig) echo "$STAND_IN/global" ;;
  cafile) cat "$STAND_IN/cafile" ;;
  cache) echo "$STAND_IN/cache" ;;
esac
BODY
printf 'registry=https://one.example/\ncache=/elsewhere' >"$work/global" # and no end of line
printf 'strict-ssl = true\ncafile = /elsewhere\nprefix=/elsewhere\n' >"$work/user"
printf '%s\n' "$work/certificates" >"$work/cafile"
echo certificate >"$work/certificates"
mkdir -p "$work/cache/_cacache/content" "$work/fresh/root"
export npm_config_userconfig=$work/user npm_config_fetch_retries=5 npm_config_cache=$work/cache

copy_npm_settings "$work/fresh"
expect "settings" "$(<"$work/fresh/root/.npmrc")" \
  "registry=https://one.example/
strict-ssl = true
fetch-retries=5
cafile=/root/npm_certificates.pem"
expect "certificates" "$(<"$work/fresh/root/npm_certificates.pem")" certificate
expect "cache" "$(ls "$work/fresh/root/.npm/_cacache")" content

echo null >"$work/cafile"
rm -r "$work/cache" "$work/global" "$work/user"
mkdir -p "$work/second/root"
unset NODE_EXTRA_CA_CERTS npm_config_fetch_retries
copy_npm_settings "$work/second"
expect "nothing to tell" "$(find "$work/second" -type f -size +0)" ""

# Without an npm there may still be settings for one.
mkdir "$work/third" "$work/third/root"
rm "$work/bin/npm"
for program in awk cat cp grep ln chown; do ln -s "$(command -v "$program")" "$work/bin/"; done
echo 'registry=https://two.example/' >"$work/user"
(export PATH=$work/bin && copy_npm_settings "$work/third")
expect "settings without an npm" "$(<"$work/third/root/.npmrc")" "registry=https://two.example/"
finish
