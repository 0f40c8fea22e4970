# How tables become targets. Each function makes one static library (an application: an executable) from the table in
# the current folder and the author's sources:
#
#   flexrf_add_types(NAME [DIRECTORY folder])                       types/*.toml
#   flexrf_add_interface([NAME name] [SOURCES ...] [LIBRARIES ...])  NAME.toml, and types/ beside it
#   flexrf_add_driver([NAME name] [SOURCES ...] [LIBRARIES ...])     NAME.toml, and types/ beside it
#   flexrf_add_unit([NAME name] [SOURCES ...] [LIBRARIES ...])       NAME.toml, and types/ beside it
#   flexrf_add_application([NAME name] [SOURCES ...] [LIBRARIES ...] [WITHOUT_PANEL])
#                                                                    NAME.toml, types/, units/*/, widgets/ of its own
#
# NAME is the folder's name unless given; an interface's and a driver's is that of the folder's only table. A unit `jog` is the
# target FlexRF::unit_jog, an interface FlexRF::interface_NAME,
# a driver FlexRF::driver_NAME; an application is the executable NAME, and NAME_application is all of it but main().
# Where the panel was built, an application carries it, unless WITHOUT_PANEL.
# LIBRARIES are what the author's sources need beyond the runtime, the types and the interfaces that the table names; a driver's can
# stand in its table.
# Order matters as for add_library: types and interfaces before what uses them, applications last.

include_guard(GLOBAL)
cmake_policy(VERSION 3.25)

# ---- What is known so far: global lists of targets; each target says where its table lies

define_property(GLOBAL PROPERTY FLEXRF_TYPES BRIEF_DOCS "Targets made by flexrf_add_types")
define_property(GLOBAL PROPERTY FLEXRF_INTERFACES BRIEF_DOCS "Targets made by flexrf_add_interface")
define_property(GLOBAL PROPERTY FLEXRF_DRIVERS BRIEF_DOCS "Targets made by flexrf_add_driver")
define_property(GLOBAL PROPERTY FLEXRF_UNITS BRIEF_DOCS "Targets made by flexrf_add_unit")
define_property(GLOBAL PROPERTY FLEXRF_LIBRARY BRIEF_DOCS
  "Folders of FlexRF's own tables: what is made of them is in the namespace flexrf, all else in flexrf::user")
define_property(TARGET PROPERTY FLEXRF_FOLDER BRIEF_DOCS "Folder of the target's table")
define_property(TARGET PROPERTY FLEXRF_ROOT BRIEF_DOCS "Folder below which config-gen searches for the target's table")
define_property(TARGET PROPERTY FLEXRF_OUTPUT BRIEF_DOCS "Folder of what was generated for the target")
define_property(TARGET PROPERTY FLEXRF_CLASS BRIEF_DOCS "Interface: its class. Driver: the class of its interface")
define_property(TARGET PROPERTY FLEXRF_NAME BRIEF_DOCS "Unit: its name in tables. Driver: as in drivers = [...]")

# flexrf_read_tables(<--unit|...> TABLE...): asks config-gen-parts once for what many tables name, before they become targets.
function(flexrf_read_tables option)
  get_property(program GLOBAL PROPERTY FLEXRF_PARTS)
  execute_process(COMMAND "${program}" ${option} ${ARGN} OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  foreach(table IN LISTS ARGN)
    string(FIND "${output}" "\ntable " end)  # of the next one
    string(SUBSTRING "${output}" 0 ${end} lines)
    set_property(GLOBAL PROPERTY "FLEXRF_PARTS_OF ${option} ${table}" "${lines}")
    if(NOT end EQUAL -1)
      math(EXPR end "${end} + 1")
      string(SUBSTRING "${output}" ${end} -1 output)
    endif()
  endforeach()
endfunction()

# What a table names: sets part_KEY for each line KEY of config-gen-parts.
function(_flexrf_list_parts option table)
  get_property(is_read GLOBAL PROPERTY "FLEXRF_PARTS_OF ${option} ${table}" SET)
  if(NOT is_read)
    flexrf_read_tables(${option} "${table}")
  endif()
  get_property(lines GLOBAL PROPERTY "FLEXRF_PARTS_OF ${option} ${table}")
  foreach(key IN ITEMS name class interfaces ports libraries packages units drivers)
    set(part_${key} "" PARENT_SCOPE)
    if("\n${lines}" MATCHES "\n${key} ([^\n]*)")
      string(REPLACE " " ";" words "${CMAKE_MATCH_1}")
      set(part_${key} "${words}" PARENT_SCOPE)
    endif()
  endforeach()
  # What a list of devices names is read from it here, as from the table.
  string(REGEX MATCHALL "\nlist [^\n]+" lists "\n${lines}")
  list(TRANSFORM lists REPLACE "^\nlist " "")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${lists})
endfunction()

# flexrf_need_package(NAME MODULE): PkgConfig::NAME for the library that pkg-config calls MODULE; an installed FlexRF asks for it
# where what it needs is linked.
function(flexrf_need_package name module)
  if(NOT TARGET PkgConfig::${name})
    pkg_check_modules(${name} REQUIRED QUIET IMPORTED_TARGET GLOBAL ${module})
    set_property(GLOBAL APPEND PROPERTY FLEXRF_PACKAGES "${name}=${module}")
  endif()
endfunction()

# Options of config-gen that say where tables are searched: those of the application first, then all known ones.
function(_flexrf_search_paths result)
  set(arguments "")
  foreach(kind IN ITEMS TYPES UNITS INTERFACES DRIVERS)
    set(folders "")
    foreach(target IN LISTS flexrf_local_${kind})
      get_target_property(root ${target} FLEXRF_ROOT)
      list(APPEND folders "${root}")
    endforeach()
    get_property(roots GLOBAL PROPERTY FLEXRF_${kind}_ROOTS)
    list(APPEND folders ${roots})
    list(REMOVE_DUPLICATES folders)
    if(folders)
      string(TOLOWER "--${kind}" option)
      list(APPEND arguments ${option} ${folders})
    endif()
  endforeach()
  get_property(library GLOBAL PROPERTY FLEXRF_LIBRARY)
  set(${result} ${arguments} --library ${library} PARENT_SCOPE)
endfunction()

# ---- Running config-gen

# _flexrf_generate(<--unit|...> TABLE OUTPUT_FOLDER FILE...): the files are made from the table whenever it or what it
# reads changes; those whose contents stay the same keep their time, so nothing is compiled for them.
function(_flexrf_generate option table output)
  list(TRANSFORM ARGN PREPEND "${output}/" OUTPUT_VARIABLE files)
  _flexrf_search_paths(paths)
  set(inputs "${table}")
  if(IS_DIRECTORY "${table}")
    file(GLOB inputs CONFIGURE_DEPENDS "${table}/*.toml")
  endif()
  cmake_path(GET table PARENT_PATH shown)
  cmake_path(RELATIVE_PATH shown BASE_DIRECTORY "${PROJECT_SOURCE_DIR}")
  add_custom_command(
    OUTPUT "${output}/config-gen.stamp" ${files}
    COMMAND FlexRF::config-gen ${option} "${table}" ${paths} --output "${output}"
            --dependencies "${output}/config-gen.d" --stamp "${output}/config-gen.stamp"
    DEPENDS "$<TARGET_FILE:FlexRF::config-gen>" ${inputs}
    DEPFILE "${output}/config-gen.d"
    COMMENT "config-gen ${shown}"
    VERBATIM)
endfunction()

function(_flexrf_generated_library target output)
  cmake_parse_arguments(PARSE_ARGV 2 library "" "" "GENERATED;SOURCES;LIBRARIES;INCLUDES")
  list(TRANSFORM library_GENERATED PREPEND "${output}/")
  add_library(${target} STATIC ${library_GENERATED} ${library_SOURCES})
  if(target MATCHES "^flexrf_(.+)")
    add_library(FlexRF::${CMAKE_MATCH_1} ALIAS ${target})
  endif()
  set(folders "${output}" ${library_INCLUDES})
  list(TRANSFORM folders REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  target_include_directories(${target} PUBLIC ${folders})
  set_target_properties(${target} PROPERTIES FLEXRF_OUTPUT "${output}")
  target_link_libraries(${target} PUBLIC FlexRF::runtime ${library_LIBRARIES})
endfunction()

# What is meant by NAME, DIRECTORY, and the names that the emitter gives.
macro(_flexrf_arguments function)
  cmake_parse_arguments(PARSE_ARGV 0 argument "${_flexrf_flags}" "NAME;DIRECTORY" "SOURCES;LIBRARIES")
  if(argument_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${function}: unknown argument '${argument_UNPARSED_ARGUMENTS}'")
  endif()
  if(NOT argument_DIRECTORY)
    set(argument_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
  endif()
  cmake_path(ABSOLUTE_PATH argument_DIRECTORY NORMALIZE)
  if(NOT argument_NAME)
    cmake_path(GET argument_DIRECTORY FILENAME argument_NAME)
    file(GLOB argument_TABLES CONFIGURE_DEPENDS "${argument_DIRECTORY}/*.toml")
    list(LENGTH argument_TABLES argument_COUNT)
    if("${function}" MATCHES "driver|interface" AND argument_COUNT EQUAL 1)
      cmake_path(GET argument_TABLES STEM argument_NAME)
    endif()
  endif()
  list(TRANSFORM argument_SOURCES REPLACE "^([^/].*)$" "${argument_DIRECTORY}/\\1")
endmacro()

macro(_flexrf_need_table table function)
  if(NOT EXISTS "${table}")
    message(FATAL_ERROR "${function}: there is no table ${table}")
  endif()
  # Names of units and interfaces are read from it here.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${table}")
endmacro()

# The interface targets of these classes.
function(_flexrf_interfaces_in result)
  get_property(targets GLOBAL PROPERTY FLEXRF_INTERFACES)
  set(found "")
  foreach(target IN LISTS targets)
    get_target_property(class ${target} FLEXRF_CLASS)
    if(class IN_LIST ARGN)
      list(APPEND found ${target})
    endif()
  endforeach()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# Where a table lies: in which folder of FlexRF's own ones; else the table's folder of folders for config-gen to search, and
# the one from which headers beside it are included.
function(_flexrf_roots kind folder root_result includes_result)
  get_property(library GLOBAL PROPERTY FLEXRF_LIBRARY)
  foreach(root IN LISTS library)
    cmake_path(IS_PREFIX root "${folder}" is_own)
    if(is_own AND NOT kind STREQUAL TYPES)
      set(${root_result} "${root}" PARENT_SCOPE)
      set(${includes_result} "" PARENT_SCOPE)  # it is included from FlexRF's own root
      return()
    endif()
  endforeach()
  set(root "${folder}")
  if(NOT kind STREQUAL TYPES)
    cmake_path(GET folder PARENT_PATH root)
  endif()
  cmake_path(GET root PARENT_PATH includes)
  set(${root_result} "${root}" PARENT_SCOPE)
  set(${includes_result} "${includes}" PARENT_SCOPE)
endfunction()

function(_flexrf_register kind target folder name class)
  _flexrf_roots(${kind} "${folder}" root unused)
  set_target_properties(${target} PROPERTIES
    FLEXRF_FOLDER "${folder}" FLEXRF_ROOT "${root}" FLEXRF_NAME "${name}" FLEXRF_CLASS "${class}")
  if(flexrf_local_to)
    set(flexrf_local_${kind} ${flexrf_local_${kind}} ${target} PARENT_SCOPE)
  else()
    flexrf_registered(${kind} ${target})
  endif()
endfunction()

# flexrf_registered(KIND TARGET): all that follow may use the target, whose properties say where its table lies.
function(flexrf_registered kind target)
  get_target_property(root ${target} FLEXRF_ROOT)
  get_property(roots GLOBAL PROPERTY FLEXRF_${kind}_ROOTS)
  if(NOT root IN_LIST roots)
    set_property(GLOBAL APPEND PROPERTY FLEXRF_${kind}_ROOTS "${root}")
  endif()
  set_property(GLOBAL APPEND PROPERTY FLEXRF_${kind} ${target})
endfunction()

function(_flexrf_all kind result)
  get_property(targets GLOBAL PROPERTY FLEXRF_${kind})
  set(${result} ${flexrf_local_${kind}} ${targets} PARENT_SCOPE)
endfunction()

# Targets of an application's own types and units begin with its name, as another one may have the same.
macro(_flexrf_target kind name)
  if(flexrf_local_to)
    set(target ${flexrf_local_to}_${kind}_${name})
  else()
    set(target flexrf_${kind}_${name})
  endif()
  set(output "${CMAKE_CURRENT_BINARY_DIR}/generated/${kind}_${name}")
endmacro()

# ---- The functions

function(flexrf_add_types name)
  cmake_parse_arguments(PARSE_ARGV 1 argument "" "DIRECTORY" "")
  if(NOT argument_DIRECTORY)
    set(argument_DIRECTORY types)
  endif()
  cmake_path(ABSOLUTE_PATH argument_DIRECTORY NORMALIZE)
  file(GLOB tables CONFIGURE_DEPENDS "${argument_DIRECTORY}/*.toml")
  if(NOT tables)
    message(FATAL_ERROR "flexrf_add_types: there is no table in ${argument_DIRECTORY}")
  endif()
  set(headers "")
  set(sources "")
  foreach(table IN LISTS tables)
    cmake_path(GET table STEM stem)
    list(APPEND headers types/${stem}.hpp)
    list(APPEND sources types/${stem}.cpp)
  endforeach()
  _flexrf_target(types ${name})
  _flexrf_all(TYPES others)
  _flexrf_generated_library(${target} "${output}" GENERATED ${sources} ${headers} LIBRARIES ${others} Eigen3::Eigen)
  _flexrf_register(TYPES ${target} "${argument_DIRECTORY}" ${name} "")
  # The folder searches itself, too.
  _flexrf_generate(--types-only "${argument_DIRECTORY}" "${output}" ${sources} ${headers})
  if(flexrf_local_to)
    set(flexrf_local_TYPES ${flexrf_local_TYPES} PARENT_SCOPE)
  endif()
endfunction()

function(flexrf_add_interface)
  _flexrf_arguments(flexrf_add_interface)
  set(name ${argument_NAME})
  set(table "${argument_DIRECTORY}/${name}.toml")
  _flexrf_need_table("${table}" flexrf_add_interface)
  if(IS_DIRECTORY "${argument_DIRECTORY}/types")
    flexrf_add_types(${name} DIRECTORY "${argument_DIRECTORY}/types")
  endif()
  _flexrf_list_parts(--interface "${table}")
  _flexrf_target(interface ${name})
  _flexrf_all(TYPES types)
  _flexrf_roots(INTERFACES "${argument_DIRECTORY}" unused includes)
  set(generated ${name}_interface.hpp ${name}_interface.cpp)
  _flexrf_generated_library(${target} "${output}"
    GENERATED ${generated} SOURCES ${argument_SOURCES} LIBRARIES ${types} ${argument_LIBRARIES} INCLUDES ${includes})
  _flexrf_register(INTERFACES ${target} "${argument_DIRECTORY}" ${name} "${part_class}")
  _flexrf_generate(--interface "${table}" "${output}" ${generated} reference.md)
endfunction()

function(flexrf_add_driver)
  _flexrf_arguments(flexrf_add_driver)
  set(stem ${argument_NAME})
  set(table "${argument_DIRECTORY}/${stem}.toml")
  _flexrf_need_table("${table}" flexrf_add_driver)
  if(IS_DIRECTORY "${argument_DIRECTORY}/types")
    flexrf_add_types(${stem} DIRECTORY "${argument_DIRECTORY}/types")
  endif()
  _flexrf_list_parts(--driver "${table}")
  _flexrf_interfaces_in(interfaces ${part_interfaces})
  set(types "")
  if(part_ports)  # of any type
    _flexrf_all(TYPES types)
  endif()
  foreach(package IN LISTS part_packages)
    string(MAKE_C_IDENTIFIER "flexrf_${package}" name)
    flexrf_need_package(${name} ${package})
    list(APPEND argument_LIBRARIES PkgConfig::${name})
  endforeach()
  _flexrf_target(driver ${stem})
  _flexrf_roots(DRIVERS "${argument_DIRECTORY}" unused includes)
  set(generated ${stem}_driver.hpp ${stem}_driver.cpp ${stem}_construct.cpp)
  _flexrf_generated_library(${target} "${output}"
    GENERATED ${generated} SOURCES ${argument_SOURCES}
    LIBRARIES ${types} ${interfaces} ${part_libraries} ${argument_LIBRARIES}
    INCLUDES ${includes})
  _flexrf_register(DRIVERS ${target} "${argument_DIRECTORY}" "${part_name}" "${part_class}")
  _flexrf_generate(--driver "${table}" "${output}" ${generated} reference.md)
endfunction()

function(flexrf_add_unit)
  _flexrf_arguments(flexrf_add_unit)
  set(name ${argument_NAME})
  set(table "${argument_DIRECTORY}/${name}.toml")
  _flexrf_need_table("${table}" flexrf_add_unit)
  if(IS_DIRECTORY "${argument_DIRECTORY}/types")
    flexrf_add_types(${name} DIRECTORY "${argument_DIRECTORY}/types")
  endif()
  _flexrf_list_parts(--unit "${table}")
  _flexrf_interfaces_in(interfaces ${part_interfaces})
  _flexrf_target(unit ${name})
  _flexrf_all(TYPES types)
  _flexrf_roots(UNITS "${argument_DIRECTORY}" unused includes)
  set(generated ${name}_unit.hpp ${name}_unit.cpp ${name}_construct.cpp)
  _flexrf_generated_library(${target} "${output}"
    GENERATED ${generated} SOURCES ${argument_SOURCES} LIBRARIES ${types} ${interfaces} ${argument_LIBRARIES}
    INCLUDES ${includes})
  _flexrf_register(UNITS ${target} "${argument_DIRECTORY}" ${name} "")
  _flexrf_generate(--unit "${table}" "${output}" ${generated} reference.md)
  if(flexrf_local_to)
    set(flexrf_local_TYPES ${flexrf_local_TYPES} PARENT_SCOPE)
    set(flexrf_local_UNITS ${flexrf_local_UNITS} PARENT_SCOPE)
  endif()
endfunction()

function(flexrf_add_application)
  set(_flexrf_flags WITHOUT_PANEL)
  _flexrf_arguments(flexrf_add_application)
  set(name ${argument_NAME})
  string(REPLACE "-" "_" stem ${name})
  set(table "${argument_DIRECTORY}/${stem}.toml")
  file(GLOB tables CONFIGURE_DEPENDS "${argument_DIRECTORY}/*.toml" "${argument_DIRECTORY}/groups/*.toml")
  foreach(one IN LISTS table tables)
    _flexrf_need_table("${one}" flexrf_add_application)
  endforeach()

  set(flexrf_local_to ${name})
  if(IS_DIRECTORY "${argument_DIRECTORY}/types")
    flexrf_add_types(${stem} DIRECTORY "${argument_DIRECTORY}/types")
  endif()
  file(GLOB folders CONFIGURE_DEPENDS LIST_DIRECTORIES true "${argument_DIRECTORY}/units/*")
  foreach(folder IN LISTS folders)
    cmake_path(GET folder FILENAME unit)
    if(EXISTS "${folder}/${unit}.toml")
      file(GLOB sources CONFIGURE_DEPENDS "${folder}/*.cpp")
      list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
      flexrf_add_unit(NAME ${unit} DIRECTORY "${folder}" SOURCES ${sources} LIBRARIES ${argument_LIBRARIES})
    endif()
  endforeach()

  # Only the units and drivers that the tables can mean are built and linked.
  _flexrf_list_parts(--application "${table}")
  set(parts ${flexrf_local_UNITS} ${flexrf_local_TYPES})
  get_property(units GLOBAL PROPERTY FLEXRF_UNITS)
  foreach(unit IN LISTS units)
    get_target_property(unit_name ${unit} FLEXRF_NAME)
    if(unit_name IN_LIST part_units)
      list(APPEND parts ${unit})
    endif()
  endforeach()
  get_property(drivers GLOBAL PROPERTY FLEXRF_DRIVERS)
  foreach(driver IN LISTS drivers)
    get_target_property(driver_name ${driver} FLEXRF_NAME)
    get_target_property(class ${driver} FLEXRF_CLASS)
    if("${class}/${driver_name}" IN_LIST part_drivers)
      list(APPEND parts ${driver})
    endif()
  endforeach()

  set(output "${CMAKE_CURRENT_BINARY_DIR}/generated/${name}")
  set(generated application.cpp descriptor.cpp panel.cpp)
  _flexrf_all(TYPES types)
  _flexrf_generated_library(${name}_application "${output}"
    GENERATED ${generated} SOURCES ${argument_SOURCES} LIBRARIES ${parts} ${types} ${argument_LIBRARIES})
  _flexrf_generate(--application "${table}" "${output}" ${generated} main.cpp descriptor.json reference.md diagram.dot
    diagram.mmd memory_map.txt)
  add_executable(${name} "${output}/main.cpp")
  target_link_libraries(${name} PRIVATE ${name}_application FlexRF::allocation_guard)
  if(NOT argument_WITHOUT_PANEL)  # known when all targets are
    target_link_libraries(${name} PRIVATE $<TARGET_NAME_IF_EXISTS:FlexRF::panel>)
    target_compile_definitions(${name} PRIVATE $<$<TARGET_EXISTS:FlexRF::panel>:FLEXRF_WITH_PANEL=1>)
  endif()
endfunction()
