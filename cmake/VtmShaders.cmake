# vtm_embed_shaders(out HEADER h NAMESPACE n SHADERS names...): shaders/NAME.glsl of the current folder as strings, in a
# source that the build makes; `out` becomes its path. embed_shaders.cmake does the work.
set(VTM_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_shaders.cmake)
function(vtm_embed_shaders out)
    cmake_parse_arguments(ARG "" "HEADER;NAMESPACE" "SHADERS" ${ARGN})
    list(TRANSFORM ARG_SHADERS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/shaders/)
    list(TRANSFORM ARG_SHADERS APPEND .glsl)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/shader_text.cpp)
    add_custom_command(
        OUTPUT ${source}
        COMMAND ${CMAKE_COMMAND} -D "SHADERS=${ARG_SHADERS}" -D HEADER=${ARG_HEADER} -D NAMESPACE=${ARG_NAMESPACE}
            -D OUTPUT=${source} -P ${VTM_EMBED_SCRIPT}
        DEPENDS ${ARG_SHADERS} ${VTM_EMBED_SCRIPT}
        VERBATIM)
    set(${out} ${source} PARENT_SCOPE)
endfunction()
