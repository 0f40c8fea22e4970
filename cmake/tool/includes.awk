# Which part of the tree may include which: README's table "What is where". Reads source files and prints each #include against
# it, as FILE:LINE:COLUMN with a hint; ends with 1 when there was one. -v root: the repository.

BEGIN {
  FS = "\""
  may["base"] = "base"
  may["runtime"] = "base runtime"
  may["motion"] = "base runtime motion"
  may["hal"] = "base runtime motion hal"
  may["units"] = "base runtime motion units hal"
  may["config-gen"] = "base config-gen"
  may["web-ui"] = "base runtime web-ui"
  may["image"] = "base runtime web-ui image"
  # Of runtime/, from below; run stands above these. What a folder's library links follows it (runtime/*/CMakeLists.txt).
  within["core"] = "core"
  within["log"] = "core log"
  within["realtime"] = "core realtime"
  within["blackboard"] = "core blackboard"
  within["unit"] = "core blackboard unit"
  within["device"] = "core blackboard unit device"
  within["parameters"] = "core blackboard unit parameters"
  within["json"] = "core parameters json"
  within["executive"] = "core log realtime blackboard unit device parameters executive"
  within["face"] = within["executive"] " json face"
}

FNR == 1 {
  file = substr(FILENAME, length(root) + 2)
  part = first(file)
  # Tests and the suites that they share may include whatever helps them, and so may applications; a test of a unit no real driver.
  is_unit_test = file ~ "^units/.*/tests/"
  is_free = !(part in may) || (file ~ "/(tests|conformance)/" && !is_unit_test)
}

is_free { next }

/^#include "[^"]*\// {
  included = $2
  used = first(included)
  if (is_unit_test && (used == "tests" || (used == "hal" && (family(included) == "driver" || is_imagined(included))))) next
  if (used !~ "^(base|runtime|motion|hal|units|config-gen|web-ui|image|apps|tests|benchmarks)$") next  # generated
  if (index(" " may[part] " ", " " used " ") == 0)
    refuse(part "/ may include only " may[part])
  else if (used == "runtime" && part == "runtime" && (folder(file) in within) &&
           index(" " within[folder(file)] " ", " " folder(included) " ") == 0)
    refuse("runtime/" folder(file) "/ may include of runtime/ only " within[folder(file)])
  else if (used == "hal" && part == "units" && included !~ "/interface/")
    refuse("a unit knows interfaces only, hal/<family>/interface/; its tests also mocks and what is simulated")
  else if (used == "hal" && part == "hal" && !within_hal())
    refuse("of another family only its interface/, and hal/driver/ and hal/canopen/; what is imagined (mock, simulated, simulator, in_process, scene) " \
           "may use what is imagined; an arm of drives is made of drives")
}

END { exit failed }

function first(path) { return substr(path, 1, index(path, "/") - 1) }

function folder(path) { return first(substr(path, length(first(path)) + 2)) }

function family(path) { return folder(path) }

function is_imagined(path) { return path ~ "/(mock|simulated[a-z_]*|simulator|in_process|scene)/" }

function within_hal() {
  return family(included) == family(file) || family(included) ~ "^(driver|canopen)$" || included ~ "/interface/" ||
    (is_imagined(file) && is_imagined(included)) ||
    (file ~ "^hal/robot_arm/of_drives/" && family(included) == "servo_drive")
}

function refuse(hint) {
  printf "%s:%d:1: error: %s may not include %s\n%s:%d:1: hint: %s\n", file, FNR, file, included, file, FNR, hint
  failed = 1
}
