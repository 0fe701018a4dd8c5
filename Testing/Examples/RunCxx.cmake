# Builds the C++ examples against an installed Freespace and runs them.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
run("${CMAKE_COMMAND}" -S "${SOURCE}" -B "${FOLDER}" -G Ninja
  "-DCMAKE_PREFIX_PATH=${PREFIX}/usr" -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${FOLDER}")
run("${FOLDER}/BoxFromPoints" "${FOLDER}/section.vtp")
run("${FOLDER}/ReconstructScene" "${SCENE}" "${FOLDER}/mesh.ply" 64)
foreach(file IN ITEMS section.vtp mesh.ply)
  if(NOT EXISTS "${FOLDER}/${file}")
    message(FATAL_ERROR "An example did not write ${file}.")
  endif()
endforeach()
