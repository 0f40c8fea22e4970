# Builds config-gen-parts while the build is configured, and again when its sources have changed. FLEXRF_PARTS: the program.

if(FLEXRF_HOST_TOOLS)
  set_property(GLOBAL PROPERTY FLEXRF_PARTS "${FLEXRF_HOST_TOOLS}/parts/config-gen-parts")
  return()
endif()

set(folder "${CMAKE_CURRENT_BINARY_DIR}/parts")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  parts/CMakeLists.txt parts/main.cpp model/diagnostics.cpp model/diagnostics.hpp model/hint.hpp model/limits.hpp model/source_text.cpp model/source_text.hpp model/words.cpp model/words.hpp
  read/csv.cpp read/csv.hpp read/device_list.cpp read/device_list.hpp read/parts.cpp read/parts.hpp read/row.cpp read/row.hpp
  read/tree.cpp read/tree.hpp)
set(as_here -G "${CMAKE_GENERATOR}" "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" "-DCMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}")
if(CMAKE_CXX_COMPILER_LAUNCHER)
  list(APPEND as_here "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}")
endif()
foreach(step IN ITEMS "-S;${CMAKE_CURRENT_SOURCE_DIR}/parts;-B;${folder};${as_here}" "--build;${folder}")
  execute_process(COMMAND "${CMAKE_COMMAND}" ${step} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "config-gen-parts, which tells what tables name, cannot be built:\n${output}")
  endif()
endforeach()
set_property(GLOBAL PROPERTY FLEXRF_PARTS "${folder}/config-gen-parts")
