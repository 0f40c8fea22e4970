#!/usr/bin/env bash
# `check` builds the generator and nothing else, gives it the folder, and hands its exit code back.
source "$(dirname "$0")/stand_in.sh"

mkdir -p "$tree/build/release/config-gen"
cat >"$tree/build/release/config-gen/config-gen" <<'BODY'
#!/bin/bash
echo "config-gen $*"
! grep -q broken "$2"
BODY
chmod +x "$tree/build/release/config-gen/config-gen"

flexrf check keyboard-single </dev/null
expect "exit code" "$status" 0
expect "table of a name" "$output" \
  "config-gen --application $tree/apps/keyboard-single/keyboard_single.toml --check-only --types $tree/runtime/types *"
expect "target" "$(grep ^ninja "$calls")" "ninja -C $tree/build/release config-gen"
expect "message" "$errors" "*no error in *"

mkdir "$work/mine"
flexrf check "$work/mine" </dev/null
expect "exit code of an empty folder" "$status" 1
expect "message of an empty folder" "$errors" "*mine.toml is missing"

echo broken >"$work/mine/mine.toml"
flexrf check "$work/mine/" </dev/null
expect "exit code of broken tables" "$status" 1
expect "table of a folder" "$output" "config-gen --application $work/mine/mine.toml *"

flexrf check apps/keybord </dev/null
expect "exit code of no folder" "$status" 1
expect "message of no folder" "$errors" "*there is no folder apps/keybord"

flexrf check </dev/null
expect "exit code without a folder" "$status" 1

# A folder of the repository brings the repository's other tables along, one elsewhere does not.
flexrf check --fix keyboard-single </dev/null
expect "exit code of --fix" "$status" 0
expect "--fix of a name" "$output" "* --drivers $tree/hal --fix $tree"
flexrf check --fix --dry-run keyboard-single </dev/null
expect "--fix --dry-run" "$output" "* --drivers $tree/hal --fix $tree --dry-run"
flexrf check --dry-run --fix "$work/mine" </dev/null
expect "--fix of a folder elsewhere" "$output" "* --drivers $tree/hal --fix --dry-run"
flexrf check --dry-run keyboard-single </dev/null
expect "exit code of --dry-run alone" "$status" 1
expect "message of --dry-run alone" "$errors" "*--dry-run belongs to --fix*"
flexrf check --fxi keyboard-single </dev/null
expect "exit code of an unknown option" "$status" 1
expect "message of an unknown option" "$errors" "*unknown option '--fxi', did you mean '--fix'?*"
finish
