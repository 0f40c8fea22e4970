# Sourced by flexrf: makes a unit, an application or an interface from cmake/tool/templates, and a driver from the mock of its interface.
# shellcheck shell=bash disable=SC2154 # root and tool are flexrf's

refuse() { die "'$1' cannot be the name: $2"; }

camel_case() {  # camel_case NAME: my_unit or my-app as MyUnit, MyApp
  local part
  local -a parts
  IFS=_- read -r -a parts <<<"$1"
  for part in "${parts[@]}"; do printf '%s' "${part^}"; done
}

need_identifier() {  # need_identifier NAME STEM: the tables, hence the generated code, call it STEM
  ((${#2} <= 40)) || refuse "$1" "more than 40 characters"
  g++ -std=c++20 -fsyntax-only -x c++ - <<<"extern int $2;" 2>/dev/null || refuse "$1" "it is a word of C++"
}

need_free_class() {  # need_free_class NAME: no table has this class, nor a header of units/, which is called as what it declares
  local class place
  class=$(camel_case "$1")
  # In their namespace they have no neighbours but each other: a Status or a Slot of the runtime is in none's way.
  place=$(find "$root"/{runtime,hal,units,apps} \( -path '*/types/'"$1.toml" -o -path "$root/hal/*/$1.toml" \) -print | head -n 1)
  [[ $place ]] || place=$(find "$root/units" -name "$1.hpp" -print | head -n 1)
  [[ $place ]] && refuse "$1" "${place#"$root/"} has a $class already"
}

instantiate() {  # instantiate TEMPLATE FOLDER OLD NEW...: its files, with each word OLD in text and names as NEW
  local template=$1 folder=$2 file made place
  local -a words=()
  shift 2
  while (($#)); do
    words+=(-e "s/$1/$2/g")
    shift 2
  done
  place=$(mktemp -d "$(dirname "$folder")/.new.XXXXXX")
  while IFS= read -r -d '' file; do
    made=$place/$(sed "${words[@]}" <<<"$file")
    mkdir -p "$(dirname "$made")"
    sed "${words[@]}" "$template/$file" >"$made"
  done < <(cd "$template" && find . -type f -print0)
  # A long name may want other line breaks.
  command -v clang-format >/dev/null &&
    find "$place" -name '*.[ch]pp' -exec clang-format -i --style="file:$root/.clang-format" {} +
  chmod 755 "$place"
  mv -T "$place" "$folder" || die "could not make $folder"
}

need_free_folder() {  # need_free_folder NAME FOLDER
  [[ -e $root/$2 ]] && refuse "$1" "$2 is there already"
}

need_snake_case() {  # need_snake_case NAME WHAT EXAMPLE
  [[ $1 =~ ^[a-z][a-z0-9]*(_[a-z0-9]+)*$ ]] || refuse "$1" "$2's name is lower_snake_case, as $3"
}

next_step() { printf '  %-44s %s\n' "$@"; }

new_unit() {
  local name=$1 class
  need_snake_case "$name" "a unit" robot_control
  need_free_folder "$name" "units/$name"
  need_identifier "$name" "$name"
  need_free_class "$name"
  class=$(camel_case "$name")
  instantiate "$tool/templates/unit" "$root/units/$name" new_unit "$name" NewUnit "$class"
  cat <<TEXT
Made units/$name, which the build finds. It builds and passes its test as it is:

  ./flexrf build && ctest --test-dir build/release -R '^unit_${name}_test\$' --output-on-failure

Next:
TEXT
  next_step "units/$name/$name.toml" "say what it reads, writes and can be told (docs/tables.md)"
  next_step "units/$name/$name.cpp" "what one step does"
  next_step "units/$name/tests/${name}_test.cpp" "what it promises"
  next_step "the table of an application" "use it: type = \"$name\" in [unit.X], and X in a thread's units"
}

new_app() {
  local name=$1 stem=${1//-/_}
  [[ $name =~ ^[a-z][a-z0-9]*(-[a-z0-9]+)*$ ]] ||
    refuse "$name" "an application's name is lower case with dashes, as keyboard-single"
  need_free_folder "$name" "apps/$name"
  case $name in
    all | clean | help | test | install | package | installed | config-gen | flexrf* | tests-* | bench-*)
      refuse "$name" "the build means something else by it"
      ;;
  esac
  need_identifier "$name" "$stem"
  instantiate "$tool/templates/app" "$root/apps/$name" new-app "$name" new_app "$stem"
  cat <<TEXT
Made apps/$name, which the build finds. It runs as it is, and passes its test:

  ./flexrf run $name -- --virtual-time 5s
  ./flexrf build && ctest --test-dir build/release -R '^${stem}_cell_test\$' --output-on-failure

Next:
TEXT
  next_step "apps/$name/$stem.toml" "the cell: devices, units, slots, threads; ./flexrf check $name"
  next_step "apps/$name/types/" "what its units tell each other"
  next_step "apps/$name/units/" "its own units; those of units/ can be used too"
  next_step "apps/$name/tests/" "what the cell promises"
}

# Sets `tables`: for each interface by its class, as Gripper, where its table lies below hal/.
find_interfaces() {
  local table
  declare -g -A tables=()
  while IFS= read -r table; do
    tables[$(camel_case "$(basename "$table" .toml)")]=$table
  done < <(cd "$root/hal" && find . -path '*/interface/*.toml' ! -path '*/types/*' -printf '%P\n' | sort)
}

new_driver() {
  local interface=$1 name=$2 family mock old class stem
  local -a known
  find_interfaces
  mapfile -t known < <(printf '%s\n' "${!tables[@]}" | sort)
  known_word interface "$interface" "${known[@]}"
  need_snake_case "$name" "a driver" schunk
  family=hal/$(dirname "$(dirname "${tables[$interface]}")")
  need_free_folder "$name" "$family/$name"
  mock=$(find "$root/$family" -path "$root/$family/mock/mock_*.toml")
  [[ $mock ]] || die "$interface has no mock in $family/mock that a driver could begin as"
  old=$(basename "$mock" .toml)
  stem=${name}_${old#mock_}
  need_identifier "$name" "$stem"
  need_free_class "$stem"
  class=$(camel_case "$stem")
  instantiate "$root/$family/mock" "$root/$family/$name" "${family//\//\\/}\\/mock\\/" "${family//\//\\/}\\/$name\\/" \
    "$old" "$stem" "$(camel_case "$old")" "$class" '^name = "mock"' "name = \"$name\"" '^kind = "mock"' 'kind = "real"'
  cat <<TEXT
Made $family/$name, which the build finds. It begins as a copy of the mock of $interface, builds, and passes the suite that each of its
drivers has to pass:

  ./flexrf build && ctest --test-dir build/release -R '^${stem}_conformance_test\$' --output-on-failure

Next:
TEXT
  next_step "$family/$name/$stem.toml" "what it is, and what can be configured (docs/tables.md)"
  next_step "$family/$name/$stem.hpp" "what it does instead; its functions never wait and never allocate"
  next_step "$family/$name/tests/" "the far end: what it drives, or a simulator of it"
  next_step "docs/devices.md" "a line of what was tested where"
}

new_interface() {
  local name=$1 class
  need_snake_case "$name" "an interface" robot_arm
  need_free_folder "$name" "hal/$name"
  need_identifier "$name" "$name"
  need_free_class "$name"
  need_free_class "mock_$name"
  class=$(camel_case "$name")
  find_interfaces
  [[ ${tables[$class]-} ]] && refuse "$name" "hal/${tables[$class]} is there already"
  instantiate "$tool/templates/interface" "$root/hal/$name" new_interface "$name" NewInterface "$class"
  cat <<TEXT
Made hal/$name, which the build finds. Its mock passes its suite as it is:

  ./flexrf build && ctest --test-dir build/release -R '^mock_${name}_conformance_test\$' --output-on-failure

Next:
TEXT
  next_step "hal/$name/interface/$name.toml" "what can be configured, and what it tells (docs/tables.md)"
  next_step "hal/$name/interface/$name.hpp" "what a unit can ask of it"
  next_step "hal/$name/conformance/" "what every driver of it must do"
  next_step "./flexrf new driver $class NAME" "a driver of it"
  next_step "docs/devices.md" "a line of what was tested where"
}
