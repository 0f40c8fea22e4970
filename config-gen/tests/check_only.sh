#!/usr/bin/env bash
# --check-only says what a build would say, a broken URDF included, and writes nothing; and it has nothing to say of the
# applications that come along: check_only.sh CONFIG_GEN REPOSITORY
set -u -o pipefail
generator=$1
repository=$2
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

check_application() {  # check_application TABLE DRIVERS...: sets status and output
  local table=$1
  shift
  output=$("$generator" --application "$table" --check-only --types "$repository/runtime/types" --units "$repository/units" \
    --interfaces "$repository/hal/interfaces" --drivers "$repository"/hal/{linux,mock,simulated} "$@" 2>&1)
  status=$?
}

checked=0
for table in "$repository"/apps/*/*.toml "$repository/cmake/tool/templates/app/new_app.toml"; do
  check_application "$table" "$(dirname "$table")/drivers"
  [[ $status == 0 && ! $output ]] || fail "$table is not without a word: $status"
  checked=$((checked + 1))
done
((checked >= 4)) || fail "only $checked applications were found"

check_application "$work/nowhere.toml"
[[ $status == 1 && $output == *"nowhere.toml:1:1: error: cannot read this file: No such file or directory"*": hint: "* ]] ||
  fail "a table that is not there has no place: $status"
mkdir folder.toml
check_application "$work/folder.toml"
[[ $status == 1 && $output == *"folder.toml:1:1: error: cannot read this file: Is a directory"*": hint: "* ]] ||
  fail "a folder has no place: $status"
