#!/usr/bin/env bash
# `new` makes a folder from its template, or says why not and changes nothing.
source "$(dirname "$0")/stand_in.sh"
shopt -s extglob

stand_in g++ <<'BODY'
[[ $(cat) != *" operator;"* ]]
BODY
stand_in clang-format </dev/null
mkdir -p "$tree/units" "$tree/hal/operator/keyboard/interface/types" "$tree/runtime/core" "$tree/base"
touch "$tree/hal/operator/keyboard/interface/types/key_event.toml"
echo 'class [[nodiscard]] Status {' >"$tree/base/status.hpp"
mkdir -p "$tree/units/arm_watch" "$tree/hal/robot_arm/simulated"
touch "$tree/hal/robot_arm/simulated/simulated_arm.toml"
touch "$tree/units/arm_watch/text_table.hpp" "$tree/units/arm_watch/reach.hpp"

mock=$tree/hal/operator/pedal/mock
mkdir -p "$mock/tests" "$tree/hal/operator/pedal/interface" "$tree/hal/bell/interface"
touch "$tree/hal/operator/pedal/interface/pedal.toml" "$tree/hal/bell/interface/bell.toml"
printf 'interface = "Pedal"\nname = "mock"\nkind = "mock"\n[configuration.kind]\ndefault = "mock"\n' >"$mock/mock_pedal.toml"
printf '#include "hal/operator/pedal/mock/mock_pedal.hpp"\n#include "hal/driver/mock/mock_noise.hpp"\nclass MockPedal {};\n' \
  >"$mock/mock_pedal.cpp"
touch "$mock/tests/mock_pedal_conformance_test.cpp"

made() { (cd "$1" && find . -type f | LC_ALL=C sort | tr '\n' ' '); }

flexrf new unit lift_guard </dev/null
expect "exit code of a unit" "$status" 0
expect "files of a unit" "$(made "$tree/units/lift_guard")" \
  "./CMakeLists.txt ./lift_guard.cpp ./lift_guard.hpp ./lift_guard.toml ./tests/lift_guard_test.cpp "
expect "class of a unit" "$(<"$tree/units/lift_guard/lift_guard.hpp")" "*class LiftGuard final : public LiftGuardUnit {*"
expect "next steps" "$output" "*-R '^unit_lift_guard_test\$'*units/lift_guard/lift_guard.toml *"

flexrf new app level-cell </dev/null
expect "exit code of an application" "$status" 0
expect "files of an application" "$(made "$tree/apps/level-cell")" \
  "./CMakeLists.txt ./level_cell.toml ./tests/level_cell_cell_test.cpp ./types/level.toml *./units/smoothing/smoothing.toml "
expect "library of the test" "$(<"$tree/apps/level-cell/CMakeLists.txt")" "*LIBRARIES level-cell_application *"
expect "next steps" "$output" "*./flexrf run level-cell *apps/level-cell/level_cell.toml *"
flexrf new driver Pedal sewing </dev/null
pedal=$tree/hal/operator/pedal/sewing
expect "exit code of a driver" "$status" 0
expect "files of a driver" "$(made "$pedal")" "./sewing_pedal.cpp ./sewing_pedal.toml ./tests/sewing_pedal_conformance_test.cpp "
expect "table of a driver" "$(<"$pedal/sewing_pedal.toml")" \
  'interface = "Pedal"'$'\n''name = "sewing"'$'\n''kind = "real"'$'\n''[[]configuration.kind[]]'$'\n''default = "mock"'
expect "source of a driver" "$(<"$pedal/sewing_pedal.cpp")" \
  '#include "hal/operator/pedal/sewing/sewing_pedal.hpp"'$'\n''#include "hal/driver/mock/mock_noise.hpp"'$'\n''class SewingPedal {};'
expect "next steps" "$output" "*-R '^sewing_pedal_conformance_test\$'*hal/operator/pedal/sewing/sewing_pedal.toml *"

flexrf new interface lamp_post </dev/null
expect "exit code of an interface" "$status" 0
expect "files of an interface" "$(made "$tree/hal/lamp_post")" \
  "./conformance/lamp_post_conformance.cpp ./conformance/lamp_post_conformance.hpp ./interface/lamp_post.hpp ./interface/lamp_post.toml *"
expect "class of an interface" "$(<"$tree/hal/lamp_post/interface/lamp_post.hpp")" "*class LampPost : public Actuator<LampPostInterface> {*"
expect "next steps" "$output" "*./flexrf new driver LampPost NAME *"

expect "names left from the template" "$(grep -r -i -E 'new.?(unit|app|interface)' "$tree/units" "$tree/apps" "$tree/hal")" ""

flexrf new unit status </dev/null
expect "a unit that is called as something of the runtime" "$status $(<"$tree/units/status/status.hpp")" "0 *class Status final : public StatusUnit {*"

before=$(find "$tree/units" "$tree/apps" "$tree/hal" -type f -exec cksum {} +)
refused() {  # refused REASON KIND... NAME
  flexrf new "${@:2}" </dev/null
  expect "exit code of 'new ${*:2}'" "$status" 1
  expect "message of 'new ${*:2}'" "$errors" "flexrf: '${*: -1}' cannot be the name: *$1*"
}
refused "is there already" unit lift_guard
refused "is there already" app keyboard
for name in Lift lift-guard lift__guard lift_ _lift 2lift ../lift ''; do refused lower_snake_case unit "$name"; done
for name in Level level_cell level--cell -level 2level a/b; do refused "with dashes" app "$name"; done
refused "a word of C++" unit operator
refused "a word of C++" app operator
refused "more than 40" unit "$(printf 'x%.0s' {1..41})"
refused "key_event.toml has a KeyEvent already" unit key_event
refused "simulated_arm.toml has a SimulatedArm already" unit simulated_arm
refused "text_table.hpp has a TextTable already" unit text_table
refused "reach.hpp has a Reach already" unit reach
refused "the build" app test
for name in Sewing sewing-pedal ''; do refused lower_snake_case driver Pedal "$name"; done
refused "hal/operator/pedal/mock is there already" driver Pedal mock
refused "has a KeyEvent already" interface key_event
refused "hal/lamp_post is there already" interface lamp_post
refused "hal/operator/pedal/interface/pedal.toml has a Pedal already" interface pedal
expect "what a refusal changes" "$(find "$tree/units" "$tree/apps" "$tree/hal" -type f -exec cksum {} +)" "$before"
flexrf new driver Pedals sewing </dev/null
expect "message of an interface that is not there" "$errors" "flexrf: unknown interface 'Pedals', did you mean 'Pedal'? *"
flexrf new driver Bell big </dev/null
expect "message of an interface without a mock" "$errors" "flexrf: Bell has no mock in hal/bell/mock that a driver could begin as*"
flexrf new driver Pedal </dev/null
expect "message of a driver without a name" "$errors" "flexrf: a driver takes the interface that it drives, and its name*"
flexrf new </dev/null
expect "exit code without a kind" "$status" 1
finish
