#!/usr/bin/env bash
# The stage "source layout" finds an #include that goes against the arrows between the parts of the tree, and says what may be
# included instead.
source "$(dirname "$0")/stand_in.sh"

judge() {  # judge FILE INCLUDED: sets status and output
  mkdir -p "$tree/$(dirname "$1")"
  printf '#include <vector>\n#include "%s"\n' "$2" >"$tree/$1"
  output=$(awk -v root="$tree" -f "$tree/cmake/tool/includes.awk" "$tree/$1")
  status=$?
  rm "$tree/$1"
}

may() {
  judge "$1" "$2"
  expect "$1 and $2" "$status $output" "0 "
}

may_not() {  # may_not FILE INCLUDED HINT
  judge "$1" "$2"
  expect "exit code of $1 and $2" "$status" 1
  expect "message of $1 and $2" "$output" "$1:2:1: error: $1 may not include $2"$'\n'"$1:2:1: hint: *$3*"
}

may base/time.hpp base/status.hpp
may runtime/executive/executive.cpp base/status.hpp
may runtime/executive/executive.cpp types/key.hpp
may runtime/executive/executive.cpp runtime/parameters/request.hpp
may runtime/device/device.hpp runtime/unit/component.hpp
may runtime/json/reader.cpp base/text.hpp
may runtime/face/change.cpp runtime/json/value_reader.hpp
may runtime/run/report_json.cpp runtime/face/statistics.hpp
may motion/kinematics.hpp runtime/unit/restraint.hpp
may hal/gripper/robotiq/robotiq_control.cpp hal/gripper/interface/gripper.hpp
may hal/gripper/robotiq/robotiq_driver.hpp hal/modbus/station/interface/modbus_station.hpp
may hal/gripper/mock/mock_gripper.hpp hal/driver/mock/mock_plan.hpp
may hal/gripper/simulated/simulated_gripper.cpp hal/modbus/link/simulated/simulated_modbus_link.hpp
may hal/robot_arm/of_drives/canopen/canopen_arm.hpp hal/servo_drive/canopen/canopen_servo_drive.hpp
may hal/gripper/canopen/tests/canopen_gripper_test.cpp hal/servo_drive/canopen/tests/real_axis.hpp
may hal/gripper/conformance/gripper_cases.hpp tests/conformance.hpp
may units/jog/jog.cpp hal/operator/keyboard/interface/key_tracker.hpp
may units/jog/tests/jog_test.cpp hal/operator/keyboard/mock/mock_keyboard.hpp
may units/jog/tests/jog_test.cpp hal/robot_arm/simulated/simulated_arm.hpp
may units/jog/tests/jog_test.cpp hal/driver/device_bench.hpp
may units/jog/tests/jog_test.cpp tests/cmocka.hpp
may web-ui/server/panel.cpp runtime/face/face.hpp
may image/boot/main.cpp base/standard_descriptors.hpp
may image/boot/tests/tool_test.cpp runtime/executive/tests/checks.hpp
may apps/keyboard/main.cpp hal/camera/v4l2/v4l2_camera.hpp

may_not base/time.hpp runtime/core/digest.hpp "base/ may include only base"
may_not runtime/executive/executive.cpp hal/camera/interface/camera.hpp "runtime/ may include only base runtime"
may_not runtime/executive/executive.cpp tests/log_ear.hpp "runtime/ may include only base runtime"
may_not runtime/unit/unit.hpp runtime/device/device.hpp "runtime/unit/ may include of runtime/ only core blackboard unit"
may_not runtime/realtime/machine_file.hpp runtime/executive/application.hpp "runtime/realtime/ may include of runtime/ only core realtime"
may_not runtime/executive/executive.cpp runtime/run/status_view.hpp "runtime/executive/ may include of runtime/ only core log"
may_not runtime/face/directory.cpp runtime/run/report.hpp "runtime/face/ may include of runtime/ only core log"
may_not motion/kinematics.hpp hal/robot_arm/interface/robot_arm.hpp "motion/ may include only base runtime motion"
may_not config-gen/main.cpp runtime/core/digest.hpp "config-gen/ may include only base config-gen"
may_not web-ui/server/panel.cpp units/jog/jog.hpp "web-ui/ may include only base runtime web-ui"
may_not image/boot/main.cpp hal/bus/can_bus.hpp "image/ may include only base runtime web-ui image*"
may_not hal/gripper/mock/mock_gripper.cpp hal/camera/v4l2/v4l2_camera.hpp "of another family only its interface/"
may_not hal/gripper/robotiq/robotiq_gripper.cpp hal/modbus/link/simulated/simulated_modbus_link.hpp "of another family only its interface/"
may_not hal/robot_arm/mock/mock_arm.hpp hal/servo_drive/canopen/canopen_servo_drive.hpp "of another family only its interface/"
may_not units/jog/jog.cpp hal/operator/keyboard/mock/mock_keyboard.hpp "a unit knows interfaces only"
may_not units/jog/tests/jog_test.cpp hal/robot_arm/melfa_mxt/mxt_arm.hpp "its tests also mocks and what is simulated"
may_not units/jog/tests/jog_test.cpp apps/keyboard/world.hpp "units/ may include only"
may_not units/jog/jog.cpp apps/keyboard/world.hpp "units/ may include only"

finish
