# How every target of ours is made: the language level, the warnings, the include roots.

add_library(vtm_settings INTERFACE)
target_compile_features(vtm_settings INTERFACE cxx_std_20)
target_include_directories(vtm_settings INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/api/include)

add_library(vtm_warnings INTERFACE)
target_compile_options(vtm_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# GCC 12 warns of overlapping copies inside std::string (its bug 105651), and of members of a std::variant's other
# alternatives as perhaps uninitialised, depending on what it inlines.
target_compile_options(vtm_warnings INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-maybe-uninitialized>")
# In inner loops & and | of bools are meant: nothing branches.
target_compile_options(vtm_warnings INTERFACE "$<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>")
option(VTM_UNITY "Compile a module's files several at a time: a whole build takes less time, one after a change longer" OFF)
# Where files are compiled several at a time, what one declares is seen by those after it.
add_library(vtm_unity_warnings INTERFACE)
target_compile_options(vtm_unity_warnings INTERFACE -Wno-shadow "$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>")
if(VTM_UNITY)
    target_link_libraries(vtm_warnings INTERFACE vtm_unity_warnings)
endif()
option(VTM_WERROR "Treat our warnings as errors" OFF)
if(VTM_WERROR)
    target_compile_options(vtm_warnings INTERFACE -Werror)
endif()

option(VTM_PRECOMPILE_HEADERS "Precompile what most files include: a whole build takes less time" OFF)
option(VTM_PRECOMPILE_TESTS "The same for tests" OFF)
set(VTM_TEST_FLAGS "" CACHE STRING "The compiler's flags for tests alone, after the others")
set(vtm_precompiled
    <algorithm> <array> <bit> <cmath> <cstdint> <cstring> <functional> <limits> <map> <memory> <mutex> <numbers> <optional>
    <random> <span> <stdexcept> <string> <string_view> <unordered_map> <utility> <variant> <vector>
    <fmt/format.h>
    <glm/common.hpp> <glm/geometric.hpp> <glm/mat2x2.hpp> <glm/mat3x2.hpp> <glm/matrix.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <glm/vec4.hpp>)

# vtm_unite(target): its files are always compiled several at a time. For what is no part of the library: headers take most
# of the time. vtm_warnings is already linked.
function(vtm_unite target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
    target_link_libraries(${target} PRIVATE vtm_unity_warnings)
endfunction()

# vtm_precompile(target kind header...): these headers too. Targets of one kind share what the first of them compiles,
# so they have the same flags and definitions.
function(vtm_precompile target kind)
    string(MAKE_C_IDENTIFIER "vtm_precompiled_${kind}" first)
    get_property(known GLOBAL PROPERTY ${first})
    if(known)
        target_precompile_headers(${target} REUSE_FROM ${known})
    else()
        target_precompile_headers(${target} PRIVATE ${vtm_precompiled} ${ARGN})
        set_property(GLOBAL PROPERTY ${first} ${target})
    endif()
    # ccache needs it.
    target_compile_options(${target} PRIVATE "$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>")
    target_link_libraries(${target} PRIVATE fmt::fmt)  # its definitions are those of the precompiled headers
endfunction()

# vtm_library(module SOURCES ... DEPENDS ... LINK ... FLAGS ...): the module's library, vtm::module.
# DEPENDS: what its headers need too. LINK: what only its sources need. FLAGS: the compiler's.
function(vtm_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LINK;FLAGS" ${ARGN})
    add_library(vtm_${name} STATIC ${ARG_SOURCES})
    add_library(vtm::${name} ALIAS vtm_${name})
    # Public headers make what they declare visible; nothing else leaves the libraries that are made of these.
    set_target_properties(vtm_${name} PROPERTIES
        POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
        UNITY_BUILD ${VTM_UNITY})
    # Nobody replaces single functions of ours when a program is loaded, so they may be inlined where they are public.
    target_compile_options(vtm_${name} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>" ${ARG_FLAGS})
    target_link_libraries(vtm_${name} PUBLIC vtm_settings ${ARG_DEPENDS} PRIVATE vtm_warnings ${ARG_LINK})
    if(VTM_PRECOMPILE_HEADERS)
        vtm_precompile(vtm_${name} "${ARG_FLAGS}")
    endif()
endfunction()

# vtm_test(module SOURCES ... LINK ...): the module's tests, each registered with CTest by name.
function(vtm_test name)
    if(NOT VTM_BUILD_TESTS)
        return()
    endif()
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
    add_executable(${name}_tests ${ARG_SOURCES})
    target_link_libraries(${name}_tests PRIVATE vtm_warnings ${ARG_LINK} GTest::gtest_main)
    target_compile_definitions(${name}_tests PRIVATE VTM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    target_compile_options(${name}_tests PRIVATE ${VTM_TEST_FLAGS})
    if(VTM_PRECOMPILE_TESTS)
        vtm_precompile(${name}_tests tests <gtest/gtest.h>)
        list(FILTER ARG_SOURCES INCLUDE REGEX "\\.c$")
        set_source_files_properties(${ARG_SOURCES} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
    gtest_discover_tests(${name}_tests TEST_PREFIX ${name}. DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 300)
endfunction()

# Debian's own Python first: the numpy and Pillow that ./dev setup installs live there.
find_program(VTM_PYTHON NAMES python3 HINTS /usr/bin)
if((VTM_BUILD_TESTS OR VTM_BUILD_BENCH) AND NOT VTM_PYTHON)
    message(FATAL_ERROR "tests and benchmarks need Python 3; without them: -DVTM_BUILD_TESTS=OFF -DVTM_BUILD_BENCH=OFF")
endif()

# vtm_script_test(name script.py arguments...): a Python test; exit code 77 means skipped.
function(vtm_script_test name script)
    if(VTM_BUILD_TESTS)
        add_test(NAME ${name} COMMAND ${VTM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARGN})
        set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)
    endif()
endfunction()
