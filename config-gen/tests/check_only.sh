#!/usr/bin/env bash
# --check-only says what a build would say, a broken URDF included, and writes nothing: check_only.sh CONFIG_GEN
set -u -o pipefail
generator=$1
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

check() {  # check FOLDER: sets status and output
  output=$("$generator" --application "$tests/$1/cell.toml" --check-only --types "$tests/base/types" --units "$tests/base/units" \
    --interfaces "$tests/base/hal/interfaces" --drivers "$tests"/base/hal/{linux,simulated} 2>&1)
  status=$?
}

fail() {
  printf 'FAILED: %s\n%s\n' "$1" "$output"
  exit 1
}

check cells/shared
[[ $status == 0 && ! $output ]] || fail "good tables are not good: $status"
check catalogue/urdf-is-broken
[[ $status == 1 && $output == *"six-axis.urdf:4:3: error: joint 'shoulder' has no <limit>"* ]] || fail "a broken URDF passes: $status"
[[ ! $(ls -A) ]] || fail "it wrote $(ls -A)"
