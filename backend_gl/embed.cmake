# cmake -D SHADERS="a.glsl;b.glsl" -D OUTPUT=file.hpp -P embed.cmake
# Writes a header with each shader file as a string named after the file.
set(text "// Made by embed.cmake from backend_gl/shaders.\n#pragma once\n\n#include <string_view>\n\n")
string(APPEND text "namespace vtm::gl::shaders {\n\n")
foreach(file IN LISTS SHADERS)
    get_filename_component(name "${file}" NAME_WE)
    file(READ "${file}" content)
    string(APPEND text "inline constexpr std::string_view ${name} = R\"GLSL(${content})GLSL\";\n\n")
endforeach()
string(APPEND text "}  // namespace vtm::gl::shaders\n")
file(WRITE "${OUTPUT}" "${text}")
