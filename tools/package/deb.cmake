# `cpack -G DEB` in a built tree: slosh and libslosh-dev for the Debian that it runs on. What the program is linked with
# dpkg-shlibdeps finds out; what it runs or opens by name is said here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the slosh authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "fluids of particles, simulated, shown and measured")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME slosh)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# libepoxy opens the OpenGL libraries, EGL the driver; the panel reads the font.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
    "libgl1, libegl1, libgl1-mesa-dri, fonts-dejavu-core, ffmpeg, gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/postinst)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"slosh simulates a fluid with smoothed particle hydrodynamics (SPH), shows it
live, and measures what each stage costs and how right the result is.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libslosh-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libc6-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "gcc, pkg-config | cmake")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"The solver of slosh as a static library, with its headers and an example.")
include(CPack)
