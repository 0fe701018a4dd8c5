# cpack -G DEB: libfreespace0, libfreespace-dev, python3-freespace and freespace. Configure with
# cmake --preset debian, for Debian's folders.
set(CPACK_PACKAGE_NAME "freespace")
set(CPACK_PACKAGE_VENDOR "Freespace")
set(CPACK_PACKAGE_CONTACT "Freespace developers <freespace@example.org>")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_GENERATOR "DEB")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development python program)
set(CPACK_COMPONENTS_GROUPING "IGNORE")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME "DEB-DEFAULT")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/Packaging/triggers")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY "optional")

set(freespace_libraries "libfreespace${FREESPACE_ABI_VERSION}")
set(same_version "${freespace_libraries} (= ${PROJECT_VERSION})")
set(about "Stereo is trusted only where there are image edges, each cluster of
views becomes a volume of free space, and the boundary of their union is
the surface.")

# freespace_package(COMPONENT name section summary sentence depends)
macro(freespace_package component name section summary sentence depends)
  string(TOUPPER "${component}" upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${name}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION "${section}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${about}\n.\n${sentence}")
  if(FREESPACE_DEBIAN_FOLDERS)
    install(FILES "${PROJECT_SOURCE_DIR}/Packaging/copyright" DESTINATION "share/doc/${name}"
      COMPONENT ${component})
    install(FILES "${CMAKE_BINARY_DIR}/Packaging/changelog.gz" DESTINATION "share/doc/${name}"
      COMPONENT ${component})
  endif()
endmacro()

option(FREESPACE_DEBIAN_FOLDERS "Install what Debian wants in share/doc" OFF)
if(FREESPACE_DEBIAN_FOLDERS)
  configure_file("${PROJECT_SOURCE_DIR}/Packaging/changelog.in" "${CMAKE_BINARY_DIR}/Packaging/changelog")
  execute_process(COMMAND gzip -9nf "${CMAKE_BINARY_DIR}/Packaging/changelog")
  install(FILES README.md ARCHITECTURE.md DESTINATION share/doc/libfreespace-dev COMPONENT development)
endif()

# Loaded at run time, which shlibdeps does not see.
set(loaded "")
if(VTK_VERSION VERSION_LESS 9.4)
  list(APPEND loaded "libosmesa6")
endif()
if(FREESPACE_IMGCODECS_SONAME MATCHES "^libopencv_imgcodecs\\.so\\.([0-9]+)$")
  list(APPEND loaded "libopencv-imgcodecs${CMAKE_MATCH_1}")
endif()
list(JOIN loaded ", " loaded)
freespace_package(runtime ${freespace_libraries} libs "surfaces from photographs - libraries"
  "This package contains the libraries." "${loaded}")
string(CONCAT needed "${same_version}, libvtk9-dev, libeigen3-dev, libcgal-dev, libopencv-dev, "
  "libopencv-contrib-dev, libceres-dev, libnanoflann-dev, nlohmann-json3-dev, libjpeg-dev, libexpat1-dev")
freespace_package(development libfreespace-dev libdevel "surfaces from photographs - development files"
  "This package contains the headers and what CMake's find_package needs." "${needed}")
set(needed "${same_version}, python3-vtk9, python3-numpy")
if(FREESPACE_WRAP_PYTHON)
  find_package(Python3 QUIET COMPONENTS Interpreter)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  string(APPEND needed ", python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next})")
endif()
freespace_package(python python3-freespace python "surfaces from photographs - Python package"
  "This package contains the package freespace for Python 3." "${needed}")
freespace_package(program freespace science "surfaces from photographs"
  "This package contains the program, its manual and its completion." "${same_version}")
include(CPack)
