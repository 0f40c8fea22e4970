# What every target of FlexRF is built with, and how a test is added.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(FLEXRF_CHECKED "Poison loans, abort on allocation and on waiting system calls in real-time threads" OFF)
option(FLEXRF_FUZZ "Fuzz targets too, which need clang and its libFuzzer (preset fuzz)" OFF)
option(FLEXRF_COMMON_HEADERS "Read the standard library's headers once for all targets" OFF)
set(FLEXRF_BATCH_SIZE "" CACHE STRING "How many source files of a target are compiled as one; empty: each by itself")
set(FLEXRF_LINKER "" CACHE STRING "Linker, as for -fuse-ld; empty: the compiler's own")
set(FLEXRF_SANITIZER "" CACHE STRING "Sanitizers to build with: empty, 'address,undefined' or 'thread'")

# For the few targets that are compiled otherwise in a checked build. All others are compiled alike, which the compiler's
# cache knows.
set(FLEXRF_CHECKED_DEFINITION "")
if(FLEXRF_CHECKED)
  set(FLEXRF_CHECKED_DEFINITION FLEXRF_CHECKED=1)
endif()

add_library(flexrf_options INTERFACE)
add_library(FlexRF::options ALIAS flexrf_options)
target_compile_features(flexrf_options INTERFACE cxx_std_20)
target_compile_options(flexrf_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(FLEXRF_BATCH_SIZE)
  # Debuggers find the sources from the repository's folder, wherever that lies: the compiler's cache may have had them from
  # a clone elsewhere.
  add_compile_options("-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.")
  # What a source file keeps to itself looks like a header's to the compiler when files are compiled in batches.
  target_compile_options(flexrf_options INTERFACE -Wno-subobject-linkage)
endif()
if(FLEXRF_COMMON_HEADERS AND FLEXRF_SANITIZER)
  # False alarms of GCC 12 (see flexrf_read_headers_themselves). The release preset looks for all four in the same sources.
  target_compile_options(flexrf_options INTERFACE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                                                  -Wno-stringop-overread)
endif()
# Includes name their layer from the repository's root: "runtime/blackboard/slot.hpp".
target_include_directories(flexrf_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
# ar makes the index itself: no second program is started for each library.
set(CMAKE_CXX_ARCHIVE_CREATE "<CMAKE_AR> qcs <TARGET> <LINK_FLAGS> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_FINISH "")
if(FLEXRF_LINKER)
  add_link_options(-fuse-ld=${FLEXRF_LINKER})
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

foreach(label unit stress threads whole virtual long guest)
  add_custom_target(tests_${label})
endforeach()
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/guest_tests.txt
  CONTENT "$<JOIN:$<TARGET_PROPERTY:tests_guest,flexrf_slow>;$<TARGET_PROPERTY:tests_guest,flexrf_names>,\n>\n")

# Whether unit tests are watched for threads that they start and do not declare (tests/thread_witness.cpp): not where a
# sanitizer or a guard is loaded before them.
set(FLEXRF_WITNESSES_THREADS OFF)
if(NOT FLEXRF_SANITIZER AND NOT FLEXRF_CHECKED AND NOT FLEXRF_FUZZ)
  set(FLEXRF_WITNESSES_THREADS ON)
endif()

# flexrf_test_reads(NAME path...)
# What a test's result depends on: files, and folders with all that is in them. `flexrf test --quick` runs a test again when
# something of this has changed. A test of flexrf_add_test reads its program and its places; one that says nothing is
# always run.
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/tests_read.txt
  CONTENT "$<JOIN:$<TARGET_GENEX_EVAL:tests_unit,$<TARGET_PROPERTY:tests_unit,flexrf_reads>>,\n>\n")
function(flexrf_test_reads name)
  list(TRANSFORM ARGN PREPEND "${name}\t" OUTPUT_VARIABLE lines)
  set_property(TARGET tests_unit APPEND PROPERTY flexrf_reads ${lines})
endfunction()

# flexrf_test_computes(NAME...)
# Tests that use a processor for most of their time, by measure: each takes all three places of a CPU, any other test one of them
# (cmake/tool/ctest.sh).
function(flexrf_test_computes)
  set_tests_properties(${ARGN} PROPERTIES PROCESSORS 3)
endfunction()

# flexrf_add_test(NAME name SOURCES file... LIBRARIES target... [LABELS label...] [TIMEOUT seconds] [SERIAL] [THREADS] [COMPUTES]
#                 [PRECOMPILED target] [FAMILY program])
# One CMocka executable that ctest runs. Labels: unit (default), stress, whole for whole cells, virtual for those in virtual
# time; long beside one of these for what only `flexrf test --full` runs. SERIAL: nothing else runs meanwhile, for a test that
# needs the CPUs to itself. THREADS: a unit or stress test that starts threads, which `flexrf test` gives to the thread
# sanitizer, too; one that does not say so fails in the release build, and so does one of virtual time that starts a thread.
# COMPUTES: as for flexrf_test_computes; tests in virtual time and stress tests compute anyhow.
# PRECOMPILED: the library of LIBRARIES whose precompiled headers the test is built with. The target tests_<label> builds the
# tests of a label.
# FAMILY: the tests of one family are one program, which runs the test that its argument names; they are compiled in batches,
# because the headers cost more than the tests. The first of SOURCES has an `int main()` without parameters, and the sources
# of a family do not define the same name twice. ctest still runs each test as a process of its own. The test's NAME is a
# target that builds the program; flexrf_add_places takes the program, after its tests.
function(flexrf_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "SERIAL;THREADS;COMPUTES" "NAME;TIMEOUT;PRECOMPILED;FAMILY" "SOURCES;LIBRARIES;LABELS")
  if(NOT test_LABELS)
    set(test_LABELS unit)
  endif()
  if(test_THREADS)
    list(APPEND test_LABELS threads)
  endif()
  if(NOT test_TIMEOUT)
    set(test_TIMEOUT 900) # ends what hangs, also on a machine with much else to do
  endif()
  if(FLEXRF_SANITIZER)
    math(EXPR test_TIMEOUT "${test_TIMEOUT} * 5")
  endif()
  if(test_FAMILY)
    set(program ${test_FAMILY})
    if(NOT TARGET ${program})
      _flexrf_add_family(${program})
    endif()
    _flexrf_join_family(${program} ${test_NAME} ${test_SOURCES})
    add_custom_target(${test_NAME} DEPENDS ${program})
    add_test(NAME ${test_NAME} COMMAND ${program} ${test_NAME})
  else()
    set(program ${test_NAME})
    add_executable(${program} ${test_SOURCES})
    add_test(NAME ${test_NAME} COMMAND ${program})
  endif()
  target_link_libraries(${program} PRIVATE FlexRF::options ${test_LIBRARIES} PkgConfig::cmocka)
  if(test_THREADS)
    target_link_libraries(${program} PRIVATE Threads::Threads)
  endif()
  if(test_PRECOMPILED)
    target_precompile_headers(${program} REUSE_FROM ${test_PRECOMPILED})
  endif()
  set_tests_properties(${test_NAME} PROPERTIES LABELS "${test_LABELS}" TIMEOUT ${test_TIMEOUT})
  if(test_COMPUTES OR "virtual" IN_LIST test_LABELS OR "stress" IN_LIST test_LABELS)
    flexrf_test_computes(${test_NAME})
  endif()
  if(test_SERIAL)
    set_tests_properties(${test_NAME} PROPERTIES RUN_SERIAL ON)
  endif()
  flexrf_test_reads(${test_NAME} "$<TARGET_FILE:${program}>")
  if(FLEXRF_WITNESSES_THREADS AND NOT test_THREADS AND NOT "whole" IN_LIST test_LABELS)
    set_tests_properties(${test_NAME} PROPERTIES
      ENVIRONMENT "LD_PRELOAD=$<TARGET_FILE:thread_witness>;FLEXRF_WITHOUT_THREADS=${test_NAME}")
    add_dependencies(${test_NAME} thread_witness)
  endif()
  foreach(label IN LISTS test_LABELS)
    add_dependencies(tests_${label} ${test_NAME})
  endforeach()
endfunction()

# The program of a family of tests, which has none yet: tests/family.cpp, compiled with the list of them.
function(_flexrf_add_family program)
  set(main "${CMAKE_CURRENT_BINARY_DIR}/families/${program}.cpp")
  file(GENERATE OUTPUT "${main}" CONTENT
    "#define FLEXRF_TESTS TEST($<JOIN:$<TARGET_PROPERTY:${program},flexrf_tests>,) TEST(>)\n#include \"tests/family.hpp\"\n")
  add_executable(${program} "${main}")
  set_source_files_properties("${main}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# Adds a test's sources to the program of its family, in which the test's main() has a name of its own.
function(_flexrf_join_family program test source)
  cmake_path(ABSOLUTE_PATH source)
  target_sources(${program} PRIVATE "${source}" ${ARGN})
  set_property(TARGET ${program} APPEND PROPERTY flexrf_tests ${test})
  set_source_files_properties("${source}" TARGET_DIRECTORY ${program} PROPERTIES
    COMPILE_DEFINITIONS main=${test}_main FLEXRF_MAIN ${test}_main)
endfunction()

# flexrf_add_places(TARGET NAME PATH [NAME PATH]...)
# Tells a program where files and other programs lie: "places.hpp" declares place::NAME for each, a C string. A path of the
# repository or of the build is stored relative to the program's folder, so that the program is the same wherever the
# repository lies.
function(flexrf_add_places target)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/places/${target}")
  get_target_property(tests ${target} flexrf_tests)
  if(NOT tests)
    set(tests ${target})
  endif()
  set(definitions "")
  set(rest ${ARGN})
  while(rest)
    list(POP_FRONT rest name path)
    foreach(test IN LISTS tests)
      flexrf_test_reads(${test} "${path}")
    endforeach()
    cmake_path(IS_PREFIX PROJECT_SOURCE_DIR "${path}" is_source)
    cmake_path(IS_PREFIX PROJECT_BINARY_DIR "${path}" is_built)
    if(is_source OR is_built OR path MATCHES "^\\$<TARGET_FILE")
      set(path "$<PATH:RELATIVE_PATH,${path},$<TARGET_FILE_DIR:${target}>>")
    endif()
    string(APPEND definitions "inline const char* const ${name} = flexrf::beside_program(R\"place(${path})place\");\n")
  endwhile()
  file(GENERATE OUTPUT "${folder}/places.hpp" CONTENT
    "#pragma once\n\n#include \"tests/beside_program.hpp\"\n\nnamespace place {\n\n${definitions}\n}  // namespace place\n")
  target_link_libraries(${target} PRIVATE beside_program)
  target_include_directories(${target} PRIVATE "${folder}")
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
# One executable, bench_<name>, that measures and prints; `flexrf bench name` builds and runs it. Its NAME stands in
# benchmarks/names.txt, too, from which the tool knows it.
function(flexrf_add_benchmark)
  cmake_parse_arguments(PARSE_ARGV 0 benchmark "" "NAME" "SOURCES;LIBRARIES")
  file(STRINGS "${PROJECT_SOURCE_DIR}/benchmarks/names.txt" names)
  if(NOT benchmark_NAME IN_LIST names)
    message(FATAL_ERROR "benchmarks/names.txt lacks ${benchmark_NAME}: `flexrf bench` would not run it")
  endif()
  add_executable(bench_${benchmark_NAME} ${benchmark_SOURCES})
  target_link_libraries(bench_${benchmark_NAME} PRIVATE FlexRF::options ${benchmark_LIBRARIES})
  set_target_properties(bench_${benchmark_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/benchmarks)
endfunction()

# flexrf_public_headers(FOLDER HEADER...)
# What of the repository's FOLDER is installed, and may be relied on by applications outside: what generated code, units, drivers,
# applications and their tests include, and what those headers include. All else is private. Interfaces, their suites, drivers and
# units are found by their tables instead (public_headers.cmake).
function(flexrf_public_headers folder)
  list(TRANSFORM ARGN PREPEND "${folder}/")
  set_property(GLOBAL APPEND PROPERTY FLEXRF_PUBLIC_HEADERS ${ARGN})
endfunction()

# flexrf_compile_together()
# For the end of the top CMakeLists.txt: has few compiler runs do what many would repeat. With FLEXRF_BATCH_SIZE the source
# files of a target are compiled in batches, with FLEXRF_COMMON_HEADERS the standard library's headers are read once for all
# targets that are compiled alike. Nothing may rely on either: the preset debug and the static analysis take each file
# as it is.
function(flexrf_compile_together)
  if(FLEXRF_BATCH_SIZE)
    _flexrf_each_target("${PROJECT_SOURCE_DIR}" _flexrf_batch_sources)
  endif()
  if(FLEXRF_COMMON_HEADERS)
    set(headers <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdio> <cstring> <functional> <limits> <memory> <optional>
                <span> <string> <string_view> <thread> <type_traits> <utility> <vector>)
    _flexrf_add_headers(flexrf_standard_headers ${headers})
    _flexrf_add_headers(flexrf_eigen_headers ${headers} <Eigen/Core> <Eigen/Geometry>)
    target_link_libraries(flexrf_eigen_headers PRIVATE Eigen3::Eigen)
    _flexrf_each_target("${PROJECT_SOURCE_DIR}" _flexrf_reuse_headers)
  endif()
endfunction()

function(_flexrf_add_headers name)
  file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/${name}.cpp" CONTENT "")
  add_library(${name} STATIC "${PROJECT_BINARY_DIR}/${name}.cpp")
  target_link_libraries(${name} PRIVATE FlexRF::options)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# Sets RESULT to whether a target links Eigen, or something that does.
function(_flexrf_links_eigen target result)
  get_property(known GLOBAL PROPERTY "flexrf_links_eigen ${target}")
  if(target STREQUAL "Eigen3::Eigen")
    set(known ON)
  elseif("${known}" STREQUAL "")
    set(known OFF)
    set_property(GLOBAL PROPERTY "flexrf_links_eigen ${target}" OFF) # ends a circle
    if(TARGET "${target}")
      get_target_property(own "${target}" LINK_LIBRARIES)
      get_target_property(passed_on "${target}" INTERFACE_LINK_LIBRARIES)
      foreach(linked IN LISTS own passed_on)
        if(NOT known)
          _flexrf_links_eigen("${linked}" known)
        endif()
      endforeach()
    endif()
    set_property(GLOBAL PROPERTY "flexrf_links_eigen ${target}" "${known}")
  endif()
  set(${result} "${known}" PARENT_SCOPE)
endfunction()

# Calls a function with each target below a folder that is compiled.
function(_flexrf_each_target folder function)
  get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "^(EXECUTABLE|(STATIC|SHARED|OBJECT)_LIBRARY)$")
      cmake_language(CALL ${function} ${target})
    endif()
  endforeach()
  get_property(folders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
  foreach(folder IN LISTS folders)
    _flexrf_each_target("${folder}" ${function})
  endforeach()
endfunction()

# As CMake's own UNITY_BUILD does it; but a batch names its files in a way that is the same in a clone elsewhere, so that the
# compiler's cache knows it there. Those that are generated stand in the target's sources still: they are made first.
function(_flexrf_batch_sources target)
  get_target_property(listed ${target} SOURCES)
  get_target_property(own ${target} SOURCE_DIR)
  get_target_property(build ${target} BINARY_DIR)
  set(sources "")
  foreach(source IN LISTS listed)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${own}" OUTPUT_VARIABLE path)
    get_source_file_property(is_apart "${path}" TARGET_DIRECTORY ${target} SKIP_UNITY_BUILD_INCLUSION)
    if(source MATCHES "\\.cpp$" AND NOT is_apart)
      list(APPEND sources "${source}")
    endif()
  endforeach()
  list(LENGTH sources count)
  if(count LESS 2)
    return()
  endif()
  set(output "${build}/batches/${target}")
  set(batches "")
  set(content "")
  set(taken 0)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${own}" OUTPUT_VARIABLE path)
    cmake_path(IS_PREFIX PROJECT_BINARY_DIR "${path}" is_generated)
    if(is_generated)
      cmake_path(RELATIVE_PATH path BASE_DIRECTORY "${output}" OUTPUT_VARIABLE name)
      set_source_files_properties("${path}" TARGET_DIRECTORY ${target} PROPERTIES HEADER_FILE_ONLY ON)
    else()
      cmake_path(RELATIVE_PATH path BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE name)
      list(REMOVE_ITEM listed "${source}")
    endif()
    get_source_file_property(main "${path}" TARGET_DIRECTORY ${target} FLEXRF_MAIN)
    if(main)
      string(APPEND content "#define main ${main}\n#include \"${name}\"\n#undef main\n")
    else()
      string(APPEND content "#include \"${name}\"\n")
    endif()
    math(EXPR taken "${taken} + 1")
    math(EXPR is_full "${taken} % ${FLEXRF_BATCH_SIZE}")
    if(taken EQUAL count OR is_full EQUAL 0)
      list(LENGTH batches number)
      file(CONFIGURE OUTPUT "${output}/batch_${number}.cpp" CONTENT "${content}" @ONLY)
      list(APPEND batches "${output}/batch_${number}.cpp")
      set(content "")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${listed};${batches}")
endfunction()

# GCC 12 forgets that precompiled headers are the system's, and warns of what std::string does in them, with sanitizers at
# every turn, else in these targets: they read the headers themselves. One that is new here warns of something in
# /usr/include/c++/12/bits/char_traits.h.
set(flexrf_read_headers_themselves
  bench_panel canopen_crash_guest_test canopen_gripper_guest_test canopen_system_calls_guest_test flexrf_panel_api
  reception_cell_test remote_entrance_test)

function(_flexrf_reuse_headers target)
  get_target_property(own_headers ${target} PRECOMPILE_HEADERS)
  get_target_property(reused_headers ${target} PRECOMPILE_HEADERS_REUSE_FROM)
  get_target_property(options ${target} COMPILE_OPTIONS)
  get_target_property(common_options flexrf_standard_headers COMPILE_OPTIONS)
  get_target_property(type ${target} TYPE)
  if(target IN_LIST flexrf_read_headers_themselves AND NOT FLEXRF_SANITIZER)
    return()
  endif()
  if(NOT type STREQUAL SHARED_LIBRARY AND NOT own_headers AND NOT reused_headers AND "${options}" STREQUAL "${common_options}")
    _flexrf_links_eigen(${target} with_eigen)
    if(with_eigen)
      target_precompile_headers(${target} REUSE_FROM flexrf_eigen_headers)
    else()
      target_precompile_headers(${target} REUSE_FROM flexrf_standard_headers)
    endif()
  endif()
endfunction()
