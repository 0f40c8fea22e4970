#!/usr/bin/env bash
# `doctor` builds the doctor and nothing else, and hands its arguments, findings and exit code on.
source "$(dirname "$0")/stand_in.sh"

doctor=$tree/build/release/runtime/realtime/doctor/flexrf-doctor
mkdir -p "$(dirname "$doctor")"
cat >"$doctor" <<'BODY'
#!/bin/bash
echo "doctor: $*"
[[ ${1-} != --json ]] || exit 3
BODY
chmod +x "$doctor"

flexrf doctor </dev/null
expect "exit code" "$status" 0
expect "findings" "$output" "doctor: "
expect "target" "$(grep ^ninja "$calls")" "ninja -C $tree/build/release flexrf-doctor"

flexrf doctor --json </dev/null
expect "exit code of a missing right" "$status" 3
expect "arguments" "$output" "doctor: --json"
finish
