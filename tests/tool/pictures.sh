#!/usr/bin/env bash
# `pictures` builds the applications that are shown, has the browser's packages put in place, and tells where pictures go.
source "$(dirname "$0")/stand_in.sh"

mkdir -p "$tree/apps/pick-station" "$tree/tests/panel"
touch "$tree/apps/pick-station/pick_station.toml"
cat >"$tree/tests/panel/prepare.sh" <<'BODY'
printf 'prepare %s\n' "$*" >>"$STAND_IN/calls"
mkdir -p "$2"
BODY
stand_in node <<'BODY'
printf 'in %s, build %s\n' "$PWD" "$FLEXRF_BUILD" >>"$STAND_IN/calls"
exit 7
BODY
work_folder=$tree/build/release/tests/panel/work

flexrf pictures </dev/null
expect "exit code" "$status" 7
expect "calls" "$(<"$calls")" "*ninja *build/release keyboard pick-station visual-servoing*\
prepare $tree/tests/panel $work_folder npm*node node_modules/vite-node/vite-node.mjs src/pictures/make.ts $tree/docs/images*\
in $work_folder, build $tree/build/release"

flexrf pictures film </dev/null
expect "one subject" "$(<"$calls")" "*make.ts $tree/docs/images film"$'\n'*

: >"$calls"
flexrf pictures flim </dev/null
expect "exit code of a wrong subject" "$status" 1
expect "message of a wrong subject" "$errors" "*did you mean 'film'*"
flexrf pictures film keyboard </dev/null
expect "exit code of two subjects" "$status" 1
expect "calls of what was not understood" "$(<"$calls")" ""
finish
