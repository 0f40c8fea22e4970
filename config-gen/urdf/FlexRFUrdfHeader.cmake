# flexrf_urdf_header(target urdf constant): an interface library with "<constant>.hpp", which holds the chain as
# flexrf::<constant>. For tests of parts; an application gets its constant from the generator.
function(flexrf_urdf_header target urdf constant)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}")
  set(header "${folder}/${constant}.hpp")
  add_custom_command(
    OUTPUT "${header}"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${folder}"
    COMMAND urdf_header "${urdf}" "${constant}" "${header}"
    DEPENDS "$<TARGET_FILE:urdf_header>" "${urdf}")
  add_library(${target} INTERFACE "${header}")
  target_include_directories(${target} INTERFACE "${folder}")
endfunction()
