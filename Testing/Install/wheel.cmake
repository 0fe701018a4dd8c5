# Builds the wheel as pip install . does, without a network, installs it into an empty folder and makes a surface with
# it, the same as that of the package in the build folder.
# cmake -DSOURCE=... -DBUILD=... -DFOLDER=... -DPYTHON=... -DPACKAGE=... -DSCENE=... -DCOMPILER=... -P wheel.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${result}:\n${output}")
  endif()
endfunction()

# As Testing/build compiles, which pip does not know: several files at once, through the compiler's cache, and with the
# same compiler, for which Python has a name of its own.
set(ENV{CXX} "${COMPILER}")
set(settings "--config-settings=build-dir=${BUILD}" --config-settings=cmake.define.CMAKE_UNITY_BUILD=ON
  --config-settings=cmake.define.FREESPACE_PRECOMPILE_HEADERS=ON)
find_program(CCACHE ccache)
if(CCACHE)
  list(APPEND settings --config-settings=cmake.define.CMAKE_CXX_COMPILER_LAUNCHER=ccache)
  set(ENV{CCACHE_SLOPPINESS} pch_defines,time_macros)
  set(ENV{CCACHE_BASEDIR} "${SOURCE}")
endif()
file(REMOVE_RECURSE "${FOLDER}")
run("${PYTHON}" -m pip wheel --no-index --no-build-isolation --no-deps ${settings} --wheel-dir "${FOLDER}" "${SOURCE}")
file(GLOB wheel "${FOLDER}/freespace-*.whl")
run("${PYTHON}" -m pip install --no-index --no-deps --target "${FOLDER}/installed" "${wheel}")

# No library of the build folder or of the system may stand in for one of the wheel.
file(WRITE "${FOLDER}/libraries.py" "
import sys
import freespace
from freespace import vtkFreespaceRendering
loaded = {line.split()[-1] for line in open('/proc/self/maps') if 'Freespace' in line}
assert loaded and all(path.startswith(sys.argv[1]) for path in loaded), loaded
")
set(ENV{PYTHONDONTWRITEBYTECODE} 1)
set(ENV{PYTHONPATH} "${FOLDER}/installed")
run("${PYTHON}" "${FOLDER}/libraries.py" "${FOLDER}/installed/freespace/")
run("${PYTHON}" "${SOURCE}/Examples/Python/reconstruct_scene.py" "${SCENE}" "${FOLDER}/wheel.ply" 48)
set(ENV{PYTHONPATH} "${PACKAGE}")
run("${PYTHON}" "${SOURCE}/Examples/Python/reconstruct_scene.py" "${SCENE}" "${FOLDER}/build.ply" 48)
run("${CMAKE_COMMAND}" -E compare_files "${FOLDER}/wheel.ply" "${FOLDER}/build.ply")
