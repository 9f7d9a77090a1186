# The Debian package: program, data, scenes, man pages, completion, reader of results. scripts/packaging/build_deb.sh
# builds it. The engine as a library is not in it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tread)
set(CPACK_PACKAGE_VENDOR "the tread developers")
set(CPACK_PACKAGE_CONTACT "the tread developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "transient wheel-rail rolling contact by explicit finite elements")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"A flexible half wheelset rolls at up to 500 km/h, under traction, over a
flexible rail on a slab track. The contact patch is resolved in space and
time. A scene file goes in; forces, creepage, stresses, frictional work and a
report come out.")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS
  "${PROJECT_BINARY_DIR};tread;program;/" "${PROJECT_BINARY_DIR};tread;python;/")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-h5py, paraview")
include(CPack)
