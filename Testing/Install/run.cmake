# Installs the build into an empty folder, builds a separate project against it, runs that project and
# the installed program, and imports the installed package in fresh Python processes.
# cmake -DBUILD=... -DSOURCE=... -DPREFIX=... -DPYTHON=... -DPYTHON_DIR=... -P run.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${PREFIX}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}/usr")
# The ABI's version is in the name that consumers load the libraries by.
file(GLOB libraries "${PREFIX}/usr/lib/*/libvtkFreespace*.so" "${PREFIX}/usr/lib/libvtkFreespace*.so")
foreach(library IN LISTS libraries)
  execute_process(COMMAND readelf -d "${library}" OUTPUT_VARIABLE dynamic)
  get_filename_component(name "${library}" NAME)
  if(NOT dynamic MATCHES "SONAME[^\n]*\\[${name}\\.${ABI}\\]")
    message(FATAL_ERROR "${library} has not the name ${name}.${ABI}:\n${dynamic}")
  endif()
endforeach()
run("${CMAKE_COMMAND}" -S "${SOURCE}/consumer" -B "${PREFIX}/consumer" -G Ninja
  "-DCMAKE_PREFIX_PATH=${PREFIX}/usr" -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${PREFIX}/consumer")
run("${PREFIX}/consumer/consumer")
run("${PREFIX}/consumer/core-consumer")
if(EXISTS "${PREFIX}/usr/bin/freespace")
  run("${PREFIX}/usr/bin/freespace" --version)
  set(render "${PREFIX}/usr/bin/freespace" render "${SOURCE}/consumer/tetrahedron.ply" --size 64x48)
  run(${render} -o "${PREFIX}/consumer/baseline.png")
  run(${render} -o "${PREFIX}/consumer/other.png" --zoom 0.5)
  run("${CMAKE_CTEST_COMMAND}" --test-dir "${PREFIX}/consumer" -R Same)
  execute_process(COMMAND "${CMAKE_CTEST_COMMAND}" --test-dir "${PREFIX}/consumer" -R Other
    RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
  if(result EQUAL 0 OR NOT EXISTS "${PREFIX}/consumer/Other-difference.png")
    message(FATAL_ERROR "An image test passed with another picture, or left no difference.")
  endif()
endif()
if(PYTHON)
  foreach(module IN ITEMS freespace freespace.vtkFreespaceFilters freespace.vtkFreespaceReaders
      freespace.vtkFreespaceSurface freespace.vtkFreespaceWriters freespace.vtkFreespaceRendering)
    run("${CMAKE_COMMAND}" -E env "PYTHONPATH=${PREFIX}/usr/${PYTHON_DIR}" "${PYTHON}" -c "import ${module}")
  endforeach()
endif()
