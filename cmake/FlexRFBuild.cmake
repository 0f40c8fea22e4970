# What every target of FlexRF is built with, and how a test is added.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(FLEXRF_CHECKED "Poison loans, abort on allocation and on waiting system calls in real-time threads" OFF)
option(FLEXRF_FUZZ "Fuzz targets too, which need clang and its libFuzzer (preset fuzz)" OFF)
option(FLEXRF_COMMON_HEADERS "Read the standard library's headers once for all targets" OFF)
set(FLEXRF_SANITIZER "" CACHE STRING "Sanitizers to build with: empty, 'address,undefined' or 'thread'")

add_library(flexrf_options INTERFACE)
add_library(FlexRF::options ALIAS flexrf_options)
target_compile_features(flexrf_options INTERFACE cxx_std_20)
target_compile_options(flexrf_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(CMAKE_UNITY_BUILD)
  # What a source file keeps to itself looks like a header's to the compiler when files are compiled in batches.
  target_compile_options(flexrf_options INTERFACE -Wno-subobject-linkage)
endif()
if(FLEXRF_COMMON_HEADERS)
  # GCC 12 forgets that precompiled headers are the system's, and warns of what std::string does in them. The release preset,
  # which has none of these, looks for all four in the same sources.
  target_compile_options(flexrf_options INTERFACE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                                                  -Wno-stringop-overread)
endif()
# Includes name their layer from the repository's root: "runtime/blackboard/slot.hpp".
target_include_directories(flexrf_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
if(FLEXRF_CHECKED)
  target_compile_definitions(flexrf_options INTERFACE FLEXRF_CHECKED=1)
endif()
if(FLEXRF_SANITIZER)
  # What a sanitizer finds must fail the test: undefined behaviour would only be printed.
  add_compile_options(-fsanitize=${FLEXRF_SANITIZER} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FLEXRF_SANITIZER})
  target_compile_definitions(flexrf_options INTERFACE FLEXRF_SANITIZER=1)
endif()

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
pkg_check_modules(cmocka REQUIRED IMPORTED_TARGET cmocka)
find_package(Eigen3 REQUIRED NO_MODULE)

foreach(label unit stress whole long guest)
  add_custom_target(tests_${label})
endforeach()
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/guest_tests.txt
  CONTENT "$<JOIN:$<TARGET_PROPERTY:tests_guest,flexrf_slow>;$<TARGET_PROPERTY:tests_guest,flexrf_names>,\n>\n")

# flexrf_add_test(NAME name SOURCES file... LIBRARIES target... [LABELS label...] [TIMEOUT seconds] [SERIAL]
#                 [PRECOMPILED target])
# One CMocka executable that ctest runs. Labels: unit (default), stress, whole; long beside one of these for what only
# `flexrf test --full` runs. SERIAL: nothing else runs meanwhile, for a test that needs the CPUs to itself. PRECOMPILED: the
# library of LIBRARIES whose precompiled headers the test is built with. The target tests_<label> builds the tests of a label.
function(flexrf_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "SERIAL" "NAME;TIMEOUT;PRECOMPILED" "SOURCES;LIBRARIES;LABELS")
  if(NOT test_LABELS)
    set(test_LABELS unit)
  endif()
  if(NOT test_TIMEOUT)
    set(test_TIMEOUT 300) # ends what hangs, also on a machine with much else to do
  endif()
  if(FLEXRF_SANITIZER)
    math(EXPR test_TIMEOUT "${test_TIMEOUT} * 5")
  endif()
  add_executable(${test_NAME} ${test_SOURCES})
  target_link_libraries(${test_NAME} PRIVATE FlexRF::options ${test_LIBRARIES} PkgConfig::cmocka)
  if(test_PRECOMPILED)
    target_precompile_headers(${test_NAME} REUSE_FROM ${test_PRECOMPILED})
  endif()
  add_test(NAME ${test_NAME} COMMAND ${test_NAME})
  set_tests_properties(${test_NAME} PROPERTIES LABELS "${test_LABELS}" TIMEOUT ${test_TIMEOUT})
  if(test_SERIAL)
    set_tests_properties(${test_NAME} PROPERTIES RUN_SERIAL ON)
  endif()
  foreach(label IN LISTS test_LABELS)
    add_dependencies(tests_${label} ${test_NAME})
  endforeach()
endfunction()

# flexrf_add_guest_test(NAME name [SLOW] SOURCES file... LIBRARIES target...)
# One CMocka executable, guest/<name> of the build folder, that needs devices and drivers of a real kernel: ctest does not
# know it, `flexrf test --guest` runs it as root in the guest (docs/guest.md), and 0 means passed. Built with everything
# only where the generator is built too, which is the release preset; tests_guest builds them anywhere. Those that are SLOW,
# a minute or more, begin first: no machine works on when the others have nothing left to do.
function(flexrf_add_guest_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "SLOW" "NAME" "SOURCES;LIBRARIES")
  add_executable(${test_NAME} ${test_SOURCES})
  target_link_libraries(${test_NAME} PRIVATE FlexRF::options ${test_LIBRARIES} PkgConfig::cmocka)
  set_target_properties(${test_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/guest)
  if(FLEXRF_HOST_TOOLS)
    set_target_properties(${test_NAME} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  add_dependencies(tests_guest ${test_NAME})
  if(test_SLOW)
    set_property(TARGET tests_guest APPEND PROPERTY flexrf_slow ${test_NAME})
  else()
    set_property(TARGET tests_guest APPEND PROPERTY flexrf_names ${test_NAME})
  endif()
endfunction()

# flexrf_add_benchmark(NAME name SOURCES file... LIBRARIES target...)
# One executable, bench_<name>, that measures and prints; `flexrf bench name` builds and runs it. Never a test. The tool
# finds the names in benchmarks/CMakeLists.txt, so NAME stands on the line of the call.
function(flexrf_add_benchmark)
  cmake_parse_arguments(PARSE_ARGV 0 benchmark "" "NAME" "SOURCES;LIBRARIES")
  add_executable(bench_${benchmark_NAME} ${benchmark_SOURCES})
  target_link_libraries(bench_${benchmark_NAME} PRIVATE FlexRF::options ${benchmark_LIBRARIES})
  set_target_properties(bench_${benchmark_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/benchmarks)
endfunction()

# flexrf_precompile_headers()
# For the end of the top CMakeLists.txt: with FLEXRF_COMMON_HEADERS the standard library's headers are read once for all targets
# that are compiled alike, which is a sixth of the time a build takes. Nothing may rely on it: the presets release and debug
# and the static analysis take each file as it is.
function(flexrf_precompile_headers)
  if(NOT FLEXRF_COMMON_HEADERS)
    return()
  endif()
  file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/flexrf_standard_headers.cpp" CONTENT "")
  add_library(flexrf_standard_headers STATIC "${PROJECT_BINARY_DIR}/flexrf_standard_headers.cpp")
  target_link_libraries(flexrf_standard_headers PRIVATE FlexRF::options)
  target_precompile_headers(flexrf_standard_headers PRIVATE
    <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdio> <cstring> <functional> <limits> <memory> <optional> <span>
    <string> <string_view> <thread> <type_traits> <utility> <vector>)
  flexrf_reuse_headers("${PROJECT_SOURCE_DIR}")
endfunction()

function(flexrf_reuse_headers folder)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(NOT type MATCHES "^(EXECUTABLE|STATIC_LIBRARY|OBJECT_LIBRARY)$")
      continue()
    endif()
    get_target_property(own_headers ${target} PRECOMPILE_HEADERS)
    get_target_property(reused_headers ${target} PRECOMPILE_HEADERS_REUSE_FROM)
    get_target_property(own_options ${target} COMPILE_OPTIONS)
    if(NOT own_headers AND NOT reused_headers AND NOT own_options)
      target_precompile_headers(${target} REUSE_FROM flexrf_standard_headers)
    endif()
  endforeach()
  get_property(folders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(folder IN LISTS folders)
    flexrf_reuse_headers("${folder}")
  endforeach()
endfunction()
