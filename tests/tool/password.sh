#!/usr/bin/env bash
# `password` builds its tool and nothing else, hands options, file and standard input over, and its exit code back.
source "$(dirname "$0")/stand_in.sh"

mkdir -p "$tree/build/release/web-ui/server/access"
cat >"$tree/build/release/web-ui/server/access/flexrf-password" <<'BODY'
#!/bin/bash
echo "arguments: $*"
[[ $1 == --list ]] || echo "input: $(cat)"
[[ " $* " == *" nobody "* ]] && exit 1
exit 0
BODY
chmod +x "$tree/build/release/web-ui/server/access/flexrf-password"

flexrf password <<<"a secret"
expect "exit code" "$status" 0
expect "arguments and input" "$output" "arguments: $tree/apps/visual-servoing/panel-users"$'\n'"input: a secret"
expect "target" "$(grep ^ninja "$calls")" "ninja -C $tree/build/release flexrf-password"

flexrf password --role operator --user ann keyboard-single <<<"a secret"
expect "options" "$output" "arguments: --role operator --user ann $tree/apps/keyboard-single/panel-users"*
flexrf password --list keyboard-single </dev/null
expect "list" "$output" "arguments: --list $tree/apps/keyboard-single/panel-users"
flexrf password --remove nobody </dev/null
expect "exit code of the tool" "$status" 1

: >"$calls"
for wrong in --roll "keyboard keyboard-single" --user; do
  # shellcheck disable=SC2086 # words
  flexrf password $wrong </dev/null
  expect "exit code of '$wrong'" "$status" 1
  expect "help for '$wrong'" "$errors" "*./flexrf password *"
done
expect "calls of what was not understood" "$(<"$calls")" ""
finish
