# cmake -D SHADERS="a.glsl;b.glsl" -D HEADER=module/shader_text.hpp -D NAMESPACE=vtm::x::shaders -D OUTPUT=file.cpp -P embed_shaders.cmake
# Writes a source with each shader file as a string named after the file, as HEADER declares them.
set(text "// Made by embed_shaders.cmake.\n#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n")
foreach(file IN LISTS SHADERS)
    get_filename_component(name "${file}" NAME_WE)
    file(READ "${file}" content)
    string(APPEND text "const std::string_view ${name} = R\"GLSL(${content})GLSL\";\n\n")
endforeach()
string(APPEND text "}  // namespace ${NAMESPACE}\n")
file(WRITE "${OUTPUT}" "${text}")
