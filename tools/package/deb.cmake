# `cpack -G DEB` in a built tree: slosh, libslosh1, libslosh-dev and python3-slosh for the Debian that it runs on. What the program is linked with
# dpkg-shlibdeps finds out; what it runs or opens by name is said here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the slosh authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "fluids of particles, simulated, shown and measured")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program runtime library python)
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

# One version of all four: the library has its scenes and its keys from the same tree as the program.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libslosh1)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# What packages linked with the library ask for, and the cache of the linker.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_BINARY_DIR}/shlibs;${CMAKE_CURRENT_BINARY_DIR}/triggers")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/shlibs "libslosh 1 libslosh1 (>= ${PROJECT_VERSION})\n")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "slosh")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "libegl1, libgl1-mesa-dri, fonts-dejavu-core")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"slosh simulates fluids with smoothed particle hydrodynamics (SPH). This is its
shared library. The scenes of slosh are in the package slosh.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libslosh-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libslosh1 (= ${PROJECT_VERSION}), libc6-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "gcc, pkg-config | cmake")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"slosh simulates fluids with smoothed particle hydrodynamics (SPH). These are
the headers of its shared library, for C and C++, with examples.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-slosh)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "libslosh1 (>= ${PROJECT_VERSION}), python3:any, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "slosh, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"slosh simulates fluids with smoothed particle hydrodynamics (SPH). This is its
module for Python, with columns as arrays of numpy.")
include(CPack)
