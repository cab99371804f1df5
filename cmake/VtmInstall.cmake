# What `cmake --install` puts down. Its components are the Debian packages (VtmPackages.cmake).
include(CMakePackageConfigHelpers)

set(vtm_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vtm)
set(vtm_openvg_dir ${CMAKE_INSTALL_LIBDIR}/vtm)  # never where our libEGL would stand in for the system's
set(vtm_python_dir lib/python3/dist-packages)    # of Debian's Python, and of PYTHONPATH elsewhere
file(RELATIVE_PATH vtm_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)

# vtm_install_library(component folder targets...): each package of CMake's has targets-COMPONENT.cmake.
function(vtm_install_library component folder)
    install(TARGETS ${ARGN} EXPORT targets-${component}
        LIBRARY DESTINATION ${folder} COMPONENT ${component} NAMELINK_COMPONENT dev
        ARCHIVE DESTINATION ${folder} COMPONENT dev)
    install(EXPORT targets-${component} NAMESPACE vtm:: DESTINATION ${vtm_cmake_dir} COMPONENT dev)
endfunction()

# vtm_install_pkgconfig(name what [LIBS ...] [REQUIRES ...] [PRIVATE ...]). PRIVATE: for linking statically.
function(vtm_install_pkgconfig name what)
    cmake_parse_arguments(pc "" "LIBDIR" "LIBS;REQUIRES;PRIVATE" ${ARGN})
    list(JOIN pc_LIBS " " pc_LIBS)
    list(JOIN pc_REQUIRES ", " pc_REQUIRES)
    list(JOIN pc_PRIVATE " " pc_PRIVATE)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/package/pkgconfig.in ${PROJECT_BINARY_DIR}/package/${name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/package/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endfunction()

# ---- libvtm, libvtm_gl ----------------------------------------------------------------------------
set_target_properties(libvtm PROPERTIES EXPORT_NAME vtm)
vtm_install_library(lib ${CMAKE_INSTALL_LIBDIR} libvtm)
vtm_install_pkgconfig(vtm "${PROJECT_DESCRIPTION}" LIBDIR ${CMAKE_INSTALL_LIBDIR} LIBS -lvtm
    PRIVATE -lfmt -lpugixml -lpng -ldeflate -ljpeg -lwebp -lwoff2dec -lharfbuzz -lfontconfig -lfribidi -lunibreak -lfreetype -lz -ltbb -lstdc++ -lm -ldl -pthread)
if(TARGET libvtm_gl)
    set_target_properties(libvtm_gl PROPERTIES EXPORT_NAME gl)
    vtm_install_library(gl ${CMAKE_INSTALL_LIBDIR} libvtm_gl)
    if(NOT BUILD_SHARED_LIBS)
        set(entry -Wl,--undefined=vtm_gl_draw)  # as in api/gl/CMakeLists.txt
    endif()
    vtm_install_pkgconfig(vtm-gl "VTM's pictures in OpenGL ES" LIBDIR ${CMAKE_INSTALL_LIBDIR} REQUIRES vtm
        LIBS -lvtm_gl ${entry}
        PRIVATE -lEGL -lGLESv2)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/api/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)

# ---- OpenVG, EGL ----------------------------------------------------------------------------------
if(TARGET vtm_openvg)
    set(openvg vtm_openvg vtm_egl)
    set_target_properties(vtm_openvg PROPERTIES EXPORT_NAME openvg)
    set_target_properties(vtm_egl PROPERTIES EXPORT_NAME egl)
    if(TARGET vtm_openvg_gles)
        list(APPEND openvg vtm_openvg_gles)
        set_target_properties(vtm_openvg_gles PROPERTIES EXPORT_NAME openvg_gles)
    endif()
    vtm_install_library(openvg ${vtm_openvg_dir} ${openvg})
    set(rpath "-Wl,-rpath,\${libdir}")
    vtm_install_pkgconfig(vtm-openvg "OpenVG 1.1 on VTM" LIBDIR ${vtm_openvg_dir} LIBS -lOpenVG ${rpath})
    vtm_install_pkgconfig(vtm-egl "EGL with OpenVG, in front of the system's" LIBDIR ${vtm_openvg_dir} REQUIRES vtm-openvg
        LIBS -lEGL ${rpath})
    # The name that programs ask for.
    vtm_install_pkgconfig(openvg "OpenVG 1.1, VGU and EGL" LIBDIR ${vtm_openvg_dir} REQUIRES vtm-egl)
endif()

# ---- The command ----------------------------------------------------------------------------------
if(TARGET vtm)
    install(TARGETS vtm RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
    if(VTM_PYTHON)
        # Its man page and completions are made from its own --help.
        set(pages ${PROJECT_BINARY_DIR}/package/pages)
        add_custom_command(OUTPUT ${pages}/vtm.1.gz ${pages}/vtm.bash ${pages}/_vtm ${pages}/vtm.fish
            COMMAND ${VTM_PYTHON} ${PROJECT_SOURCE_DIR}/cmake/package/pages.py $<TARGET_FILE:vtm> ${pages}
            DEPENDS vtm ${PROJECT_SOURCE_DIR}/cmake/package/pages.py
            VERBATIM)
        add_custom_target(vtm_pages ALL DEPENDS ${pages}/vtm.1.gz)
        install(FILES ${pages}/vtm.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
        install(FILES ${pages}/vtm.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME vtm
            COMPONENT tools)
        install(FILES ${pages}/_vtm DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT tools)
        install(FILES ${pages}/vtm.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tools)
    else()
        message(STATUS "vtm: installed without man page and completions, Python 3 is not installed")
    endif()
endif()

# ---- Python ---------------------------------------------------------------------------------------
if(BUILD_SHARED_LIBS)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/api/python/vtm DESTINATION ${vtm_python_dir} COMPONENT python
        PATTERN __pycache__ EXCLUDE)
endif()

# ---- For find_package(vtm) ------------------------------------------------------------------------
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/package/vtm-config.cmake.in
    ${PROJECT_BINARY_DIR}/package/vtm-config.cmake INSTALL_DESTINATION ${vtm_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/vtm-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/vtm-config.cmake ${PROJECT_BINARY_DIR}/package/vtm-config-version.cmake
    DESTINATION ${vtm_cmake_dir} COMPONENT dev)

include(VtmPackages)
