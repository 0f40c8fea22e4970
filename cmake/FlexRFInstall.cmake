# What an application outside this repository needs, under one prefix that may be moved:
#
#   bin/config-gen                    the generator
#   include/flexrf/                   public headers under the paths they are included by, and generated ones
#   share/flexrf/                     the tables that applications build on
#   lib/, lib/cmake/FlexRF/           libraries, find_package(FlexRF), flexrf_add_application() and the others

set(headers include/flexrf)
set(package lib/cmake/FlexRF)

# All targets of this project that the given ones need, themselves included.
function(_flexrf_needed result)
  set(waiting ${ARGN})
  set(needed "")
  while(waiting)
    list(POP_FRONT waiting target)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" target "${target}")
    if(NOT TARGET ${target})
      continue()
    endif()
    get_target_property(original ${target} ALIASED_TARGET)
    if(original)
      set(target ${original})
    endif()
    get_target_property(imported ${target} IMPORTED)
    if(imported OR target IN_LIST needed)
      continue()
    endif()
    list(APPEND needed ${target})
    get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
    if(links)
      list(APPEND waiting ${links})
    endif()
  endwhile()
  set(${result} "${needed}" PARENT_SCOPE)
endfunction()

set(registry "# Which tables the installed targets were made from.\n")
set(made "")
foreach(kind IN ITEMS TYPES INTERFACES DRIVERS UNITS)
  get_property(targets GLOBAL PROPERTY FLEXRF_${kind})
  foreach(target IN LISTS targets)
    list(APPEND made ${target})
    get_target_property(folder ${target} FLEXRF_FOLDER)
    get_target_property(output ${target} FLEXRF_OUTPUT)
    get_target_property(name ${target} FLEXRF_NAME)
    get_target_property(class ${target} FLEXRF_CLASS)
    get_target_property(root ${target} FLEXRF_ROOT)
    cmake_path(RELATIVE_PATH root BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE searched)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE place)
    install(DIRECTORY "${output}/" DESTINATION ${headers}/generated FILES_MATCHING PATTERN "*.hpp")
    install(DIRECTORY "${folder}/" DESTINATION share/flexrf/${place} FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv"
            PATTERN tests EXCLUDE)
    string(REGEX REPLACE "^flexrf_" "FlexRF::" exported ${target})
    string(APPEND registry "set_property(GLOBAL APPEND PROPERTY FLEXRF_${kind} ${exported})\n"
           "set_target_properties(${exported} PROPERTIES FLEXRF_FOLDER \"\${_flexrf_tables}/${place}\" "
           "FLEXRF_ROOT \"\${_flexrf_tables}/${searched}\" FLEXRF_NAME \"${name}\" FLEXRF_CLASS \"${class}\")\n")
  endforeach()
endforeach()
file(WRITE "${PROJECT_BINARY_DIR}/FlexRFRegistry.cmake" "${registry}")

target_include_directories(flexrf_options INTERFACE
  $<INSTALL_INTERFACE:${headers}> $<INSTALL_INTERFACE:${headers}/generated>)
set(panel "")
if(TARGET flexrf_panel)  # where it was built; of its headers an application needs this one
  set(panel flexrf_panel)
  install(FILES web-ui/server/panel.hpp DESTINATION ${headers}/web-ui/server)
endif()
_flexrf_needed(needed flexrf_runtime flexrf_allocation_guard ${panel} ${made})
foreach(target IN LISTS needed)
  string(REGEX REPLACE "^flexrf_" "" exported ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${exported})
endforeach()
install(TARGETS ${needed} config-gen EXPORT FlexRFTargets
        ARCHIVE DESTINATION lib OBJECTS DESTINATION lib RUNTIME DESTINATION bin)
install(EXPORT FlexRFTargets NAMESPACE FlexRF:: DESTINATION ${package})
install(DIRECTORY runtime motion hal units DESTINATION ${headers} FILES_MATCHING PATTERN "*.hpp"
        PATTERN tests EXCLUDE PATTERN conformance EXCLUDE)
include(CMakePackageConfigHelpers)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/FlexRFConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES cmake/FlexRFConfig.cmake cmake/FlexRFGenerate.cmake "${PROJECT_BINARY_DIR}/FlexRFRegistry.cmake"
              "${PROJECT_BINARY_DIR}/FlexRFConfigVersion.cmake" DESTINATION ${package})

# Everything that is installed, without the applications and the tests.
add_custom_target(installed)
foreach(target IN LISTS needed ITEMS config-gen)
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL INTERFACE_LIBRARY)
    add_dependencies(installed ${target})
  endif()
endforeach()
