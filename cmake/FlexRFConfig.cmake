# find_package(FlexRF): libraries, the generator, and the functions of FlexRFGenerate.cmake.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(Eigen3 NO_MODULE)
find_dependency(PkgConfig)
pkg_check_modules(pugixml REQUIRED QUIET IMPORTED_TARGET pugixml)

include("${CMAKE_CURRENT_LIST_DIR}/FlexRFTargets.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/FlexRFGenerate.cmake")
cmake_path(SET _flexrf_tables NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../../../share/flexrf")
include("${CMAKE_CURRENT_LIST_DIR}/FlexRFRegistry.cmake")
