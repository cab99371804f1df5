# cmake -D SHADERS="a.glsl;b.glsl" -D OUTPUT=file.cpp -P embed.cmake
# Writes a source with each shader file as a string named after the file (src/shader_text.hpp).
set(text "// Made by embed.cmake from backend_gl/shaders.\n#include \"backend_gl/src/shader_text.hpp\"\n\n")
string(APPEND text "namespace vtm::gl::shaders {\n\n")
foreach(file IN LISTS SHADERS)
    get_filename_component(name "${file}" NAME_WE)
    file(READ "${file}" content)
    string(APPEND text "const std::string_view ${name} = R\"GLSL(${content})GLSL\";\n\n")
endforeach()
string(APPEND text "}  // namespace vtm::gl::shaders\n")
file(WRITE "${OUTPUT}" "${text}")
