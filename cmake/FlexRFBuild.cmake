# What every target of FlexRF is built with, and how a test is added.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(FLEXRF_CHECKED "Poison loans, abort on allocation in real-time threads" OFF)
set(FLEXRF_SANITIZER "" CACHE STRING "Sanitizers to build with: empty, 'address,undefined' or 'thread'")

add_library(flexrf_options INTERFACE)
add_library(FlexRF::options ALIAS flexrf_options)
target_compile_options(flexrf_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
# Includes name their layer from the repository's root: "runtime/blackboard/slot.hpp".
target_include_directories(flexrf_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
if(FLEXRF_CHECKED)
  target_compile_definitions(flexrf_options INTERFACE FLEXRF_CHECKED=1)
endif()
if(FLEXRF_SANITIZER)
  add_compile_options(-fsanitize=${FLEXRF_SANITIZER} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FLEXRF_SANITIZER})
  target_compile_definitions(flexrf_options INTERFACE FLEXRF_SANITIZER=1)
endif()

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
pkg_check_modules(cmocka REQUIRED IMPORTED_TARGET cmocka)
find_package(Eigen3 REQUIRED NO_MODULE)

# flexrf_add_test(NAME name SOURCES file... LIBRARIES target... [LABELS label...] [TIMEOUT seconds])
# One CMocka executable that ctest runs. Labels: unit (default), stress, whole.
function(flexrf_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "" "NAME;TIMEOUT" "SOURCES;LIBRARIES;LABELS")
  if(NOT test_LABELS)
    set(test_LABELS unit)
  endif()
  if(NOT test_TIMEOUT)
    set(test_TIMEOUT 60)
  endif()
  add_executable(${test_NAME} ${test_SOURCES})
  target_link_libraries(${test_NAME} PRIVATE FlexRF::options ${test_LIBRARIES} PkgConfig::cmocka)
  add_test(NAME ${test_NAME} COMMAND ${test_NAME})
  set_tests_properties(${test_NAME} PROPERTIES LABELS "${test_LABELS}" TIMEOUT ${test_TIMEOUT})
endfunction()
