# Debian packages: `cpack` in the build folder, after the build. One for each component of VtmInstall.cmake.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The VTM authors")
set(VTM_PACKAGE_CONTACT "The VTM authors <maintainers@vtm.invalid>" CACHE STRING "The Debian packages' maintainer")
set(CPACK_PACKAGE_CONTACT ${VTM_PACKAGE_CONTACT})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/api ${PROJECT_BINARY_DIR}/api/openvg)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_COMPONENTS_ALL)

# Policy 12.7; what has changed is told by CHANGELOG.md.
set(vtm_changelog ${PROJECT_BINARY_DIR}/package/changelog)
file(CONFIGURE OUTPUT ${vtm_changelog} CONTENT [[vtm (@PROJECT_VERSION@) unstable; urgency=medium

  * See CHANGELOG.md.

 -- @CPACK_PACKAGE_CONTACT@  Thu, 01 Jan 2026 00:00:00 +0000
]] @ONLY)
execute_process(COMMAND gzip -9nc ${vtm_changelog} OUTPUT_FILE ${vtm_changelog}.gz)
# Libraries where the loader looks.
file(WRITE ${PROJECT_BINARY_DIR}/package/triggers "activate-noawait ldconfig\n")

# vtm_package(component name section what [DEPENDS ...] [RECOMMENDS ...] [SUGGESTS ...] [EXTRA control files...])
function(vtm_package component name section what)
    cmake_parse_arguments(ARG "" "" "DEPENDS;RECOMMENDS;SUGGESTS;EXTRA" ${ARGN})
    string(TOUPPER ${component} COMPONENT)
    list(JOIN ARG_DEPENDS ", " depends)
    list(JOIN ARG_RECOMMENDS ", " recommends)
    set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${name} PARENT_SCOPE)
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SECTION ${section} PARENT_SCOPE)
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_RECOMMENDS "${recommends}" PARENT_SCOPE)
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SUGGESTS "${ARG_SUGGESTS}" PARENT_SCOPE)
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_CONTROL_EXTRA "${ARG_EXTRA}" PARENT_SCOPE)
    set(CPACK_DEBIAN_${COMPONENT}_DESCRIPTION "${what}" PARENT_SCOPE)
    set(documents ${CMAKE_INSTALL_DATADIR}/doc/${name})
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${documents} RENAME copyright COMPONENT ${component})
    install(FILES ${vtm_changelog}.gz DESTINATION ${documents} COMPONENT ${component})
endfunction()

set(same "(= ${PROJECT_VERSION})")
set(development "libvtm0 ${same}" libglm-dev)
vtm_package(lib libvtm0 libs "Vector pictures drawn exactly, on the CPU
SVG files become compact maps of disjoint regions, which are drawn at any
scale without seams. This package holds the library." SUGGESTS libavif15
    RECOMMENDS libvtm-gl0 EXTRA ${PROJECT_BINARY_DIR}/package/triggers)
if(TARGET libvtm_gl)
    list(APPEND development "libvtm-gl0 ${same}")
    vtm_package(gl libvtm-gl0 libs "Vector pictures drawn exactly, with OpenGL ES
The part of libvtm that draws with OpenGL ES 3.0, and makes textures of
vector pictures." DEPENDS "libvtm0 ${same}" EXTRA ${PROJECT_BINARY_DIR}/package/triggers)
endif()
if(TARGET vtm_openvg)
    list(APPEND development "libvtm-openvg0 ${same}" libegl-dev)  # EGL/egl.h
    vtm_package(openvg libvtm-openvg0 libs "OpenVG 1.1 and EGL with OpenVG
The libraries stand in a folder of their own, not where they would take the
place of the system's EGL.")
endif()
if(TARGET vtm)
    vtm_package(tools vtm-tools graphics "Draw, compile and inspect vector pictures
The command vtm draws SVG files as pictures and compiles them to .vtm files." SUGGESTS libpotrace0)
endif()
if(VTM_PYTHON AND BUILD_SHARED_LIBS)
    vtm_package(python python3-vtm python "Vector pictures in Python, as NumPy arrays
SVG files are drawn exactly by libvtm."
        DEPENDS "libvtm0 ${same}" python3 python3-numpy)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
endif()
vtm_package(dev libvtm-dev libdevel "Vector pictures drawn exactly: what programs are built with
Headers, CMake package and pkg-config files of libvtm, libvtm-gl and VTM's
OpenVG." DEPENDS ${development})

include(CPack)
