#!/usr/bin/env bash
# --check-only says what a build would say, a broken URDF included, and writes nothing; and it has nothing to say of the
# applications that come along: check_only.sh CONFIG_GEN REPOSITORY CATALOGUE_TEST
set -u -o pipefail
generator=$1
repository=$2
catalogue_test=$3
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
broken=$(mktemp -d)
trap 'rm -rf "$work" "$broken"' EXIT
cd "$work" || exit 1

check() {  # check FOLDER: sets status and output
  output=$(timeout 60 "$generator" --application "$1/cell.toml" --check-only --types "$tests/base/types" --units "$tests/base/units" \
    --interfaces "$tests/base/hal/interfaces" --drivers "$tests"/base/hal/{linux,simulated} 2>&1)
  status=$?
}

fail() {
  printf 'FAILED: %s\n%s\n' "$1" "$output"
  exit 1
}

check "$tests/cells/shared"
[[ $status == 0 && ! $output ]] || fail "good tables are not good: $status"
"$catalogue_test" urdf-is-broken "$broken" || fail "the catalogue has no broken URDF"
check "$broken"
[[ $status == 1 && $output == *"six-axis.urdf:4:3: error: joint 'shoulder' has no <limit>"* ]] || fail "a broken URDF passes: $status"
[[ ! $(ls -A) ]] || fail "it wrote $(ls -A)"

check_application() {  # check_application TABLE DRIVERS...: sets status and output
  local table=$1
  shift
  output=$("$generator" --application "$table" --check-only --types "$repository/runtime/types" --units "$repository/units" \
    --interfaces "$repository/hal" --drivers "$repository/hal" "$@" 2>&1)
  status=$?
}

# Nor of the cells that tests are made of, but of one whose keyboard tells more than it wants to know.
for table in "$repository"/tests/{applications,generator,panel,paced_cell,station_cell,camera}/*/*.toml; do
  part=$(dirname "$(dirname "$table")")
  [[ $(<"$table") == *memory_budget* ]] || continue
  check_application "$table" "$part/drivers" --interfaces "$repository/hal" "$part/interfaces"
  [[ $table != */hand.toml ]] || output=${output#*"hand.toml:6:9: warning: output 'keys' of 'keyboard' goes nowhere"*$'\n'*"should see it"}
  [[ $status == 0 && ! $output ]] || fail "$table is not without a word: $status"
done

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
[[ $status == 1 && $output == *"folder.toml:1:1: error: this is a folder, and no file that could be read as a whole"*": hint: "* ]] ||
  fail "a folder has no place: $status"

# What is no file is told for what it is, at once, whatever names it: a table, a group, a URDF, a list, a data sheet.
refuse() {  # refuse BASE FILE MESSAGE: the file is a pipe, a folder, a device, a link to itself
  local kind
  for kind in "a pipe" "a folder" "a device" "a link"; do
    rm -rf odd_file
    cp -r "$tests/catalogue/base/$1" odd_file
    rm "odd_file/$2"
    case $kind in
      "a pipe") mkfifo "odd_file/$2" ;;
      "a folder") mkdir "odd_file/$2" ;;
      "a device") ln -s /dev/zero "odd_file/$2" ;;
      "a link") ln -s "$(basename "$2")" "odd_file/$2" ;;
    esac
    check odd_file
    if [[ $kind == "a link" ]]; then
      [[ $status == 1 && $output == *"odd_file/"*": error: "*"Too many levels of symbolic links"*": hint: "* ]] ||
        fail "$2 of $1 is a link to itself: $status"
    else
      [[ $status == 1 && $output == *"odd_file/$3 is $kind, and no file that could be read as a whole"*": hint: "* ]] ||
        fail "$2 of $1 is $kind: $status"
    fi
  done
}
refuse arm cell.toml "cell.toml:1:1: error: this"
refuse axes groups/axis.toml "groups/axis.toml:1:1: error: this"
refuse arm six-axis.urdf "cell.toml:13:8: error: 'six-axis.urdf'"
refuse station registers.csv "cell.toml:7:16: error: 'registers.csv'"
refuse eds servo.eds "cell.toml:7:15: error: 'servo.eds'"

# One that fails while it is read is named.
for file in arm/six-axis.urdf station/registers.csv eds/servo.eds; do
  rm -rf odd_file
  cp -r "$tests/catalogue/base/${file%/*}" odd_file
  ln -sf /proc/self/mem "odd_file/${file#*/}"
  check odd_file
  [[ $status == 1 && $output == "odd_file/${file#*/}:1:1: error: cannot read this file: Input/output error"*": hint: "* ]] ||
    fail "$file fails while it is read: $status"
done

rm -rf odd_file
cp -r "$tests/catalogue/base/arm" odd_file
mkdir odd_file/widgets
ln -s /proc/self/mem odd_file/widgets/dial.js
printf '\n[widget.dial]\nkind = "dial"\n' >>odd_file/cell.toml
check odd_file
[[ $status == 1 && $output == *"cannot read "*"odd_file/widgets/dial.js: Input/output error"* ]] ||
  fail "a widget's file fails while it is read: $status"

# What the tables of this repository say of themselves: an emergency stop is an input.
cp -r "$repository/apps/pick-station" box
sed -i 's/^green_lamp,LAMP_GREEN,output,,,,true/green_lamp,LAMP_GREEN,output,,,true,true/' box/box_lines.csv
check_application box/pick_station.toml box/drivers
[[ $status == 1 && $output == *"box/box_lines.csv:4:32: error: 'configuration.emergency_stop' of [device.green_lamp] needs direction to be input"* ]] ||
  fail "an emergency stop may be an output: $status"

# Rules for the build system, of a folder that has what is special there.
odd="$work/a\\ b#c\$d"
cp -r "$tests/cells/shared" "$odd"
output=$("$generator" --application "$odd/cell.toml" --types "$tests/base/types" --units "$tests/base/units" --interfaces "$tests/base/hal/interfaces" \
  --drivers "$tests"/base/hal/{linux,simulated} --output made --dependencies made/rules --stamp made/stamp 2>&1)
status=$?
[[ $status == 0 && $(<made/rules) == *'/a\\\ b\#c$$d/cell.toml'* ]] || fail "the rules do not name the folder: $status $(<made/rules)"

# --fix replaces the word and nothing else, and ends as what is left deserves it.
cp -r "$tests/cells/shared" misspelt
sed -i '1s/^summary/sumary/' misspelt/cell.toml
fix() {  # fix OPTIONS...: sets status and output
  output=$("$generator" --application misspelt/cell.toml --check-only --types "$tests/base/types" --units "$tests/base/units" \
    --interfaces "$tests/base/hal/interfaces" --drivers "$tests"/base/hal/{linux,simulated} "$@" 2>&1)
  status=$?
}
fix --fix --dry-run
[[ $status == 1 && $output == "misspelt/cell.toml:1:1: 'sumary' -> 'summary'"$'\n'* && $(head -n 1 misspelt/cell.toml) == sumary* ]] ||
  fail "a dry run is none: $status"
fix --fix
[[ $status == 0 && $output == "misspelt/cell.toml:1:1: 'sumary' -> 'summary'" ]] || fail "the word is not replaced: $status"
cmp misspelt/cell.toml "$tests/cells/shared/cell.toml" || fail "more than the word was replaced"
fix --dry-run
[[ $status == 1 && $output == *"--dry-run belongs to --fix"* ]] || fail "a dry run of nothing: $status"
