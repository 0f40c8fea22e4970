#!/usr/bin/env bash
# `check` builds the generator and nothing else, gives it the folder, and hands its exit code back.
source "$(dirname "$0")/stand_in.sh"

mkdir -p "$tree/build/release/config-gen"
cat >"$tree/build/release/config-gen/config-gen" <<'BODY'
#!/bin/bash
echo "config-gen $*"
[[ ! -e ${!#}/broken ]]
BODY
chmod +x "$tree/build/release/config-gen/config-gen"

flexrf check keyboard </dev/null
expect "exit code" "$status" 0
expect "folder of a name" "$output" "config-gen check $tree/apps/keyboard"
expect "target" "$(grep ^ninja "$calls")" "ninja -C $tree/build/release config-gen"

mkdir "$work/mine" && touch "$work/mine/broken"
flexrf check "$work/mine" </dev/null
expect "exit code of broken tables" "$status" 1
expect "folder" "$output" "config-gen check $work/mine"

flexrf check </dev/null
expect "exit code without a folder" "$status" 1
finish
