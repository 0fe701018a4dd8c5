# For regression pictures of one's own, as this project's and VTK's tests have them.
#
# freespace_add_image_test(NAME <test> BASELINE <picture.png>
#   MESH <mesh.ply> [OPTIONS <option of freespace render>...] [MAX_ERROR <difference>])
# renders a mesh with the program and compares the picture with the baseline by VTK's regression measure. The picture
# and, where they differ, the difference are left in the current binary folder: <test>.png, <test>-difference.png.
#
# freespace_add_image_test(NAME <test> BASELINE <picture.png> COMMAND <executable> [<argument>...])
# runs a program that uses vtkTesting (vtkRegressionTestImage): it gets the arguments -T <folder for differences> and
# -V <baseline>.
#
# The pictures do not depend on a display: it is not seen, and windows are off-screen (FREESPACE_WINDOW=osmesa).
function(freespace_add_image_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "" "NAME;BASELINE;MESH;MAX_ERROR" "OPTIONS;COMMAND")
  if(NOT test_NAME OR NOT test_BASELINE)
    message(FATAL_ERROR "freespace_add_image_test needs NAME and BASELINE.")
  endif()
  get_filename_component(baseline "${test_BASELINE}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  if(test_MESH)
    if(NOT Freespace_PROGRAM)
      message(FATAL_ERROR "freespace_add_image_test: the program freespace is not installed; Freespace_PROGRAM names it.")
    endif()
    get_filename_component(mesh "${test_MESH}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
    set(error)
    if(DEFINED test_MAX_ERROR)
      set(error --max-error ${test_MAX_ERROR})
    endif()
    add_test(NAME ${test_NAME} COMMAND "${Freespace_PROGRAM}" render "${mesh}"
      -o "${CMAKE_CURRENT_BINARY_DIR}/${test_NAME}.png" --ref "${baseline}"
      --diff "${CMAKE_CURRENT_BINARY_DIR}/${test_NAME}-difference.png" ${error} ${test_OPTIONS})
  elseif(test_COMMAND)
    add_test(NAME ${test_NAME} COMMAND ${test_COMMAND} -T "${CMAKE_CURRENT_BINARY_DIR}" -V "${baseline}")
  else()
    message(FATAL_ERROR "freespace_add_image_test needs a MESH or a COMMAND.")
  endif()
  set_tests_properties(${test_NAME} PROPERTIES
    ENVIRONMENT "FREESPACE_WINDOW=osmesa" ENVIRONMENT_MODIFICATION "DISPLAY=unset:")
endfunction()
