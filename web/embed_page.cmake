# cmake -D SCRIPTS="a.js;b.js" -D FOLDER=page -D OUTPUT=file.cpp -P embed_page.cmake
# Writes a source with the page's template, style and script as strings, as web/src/page_text.hpp declares them. The
# modules become one script: their lines that import and the word `export` are left out, so all names are in one scope.
# The page's policy permits its style and its script by their hashes.
set(script "\n'use strict';\n")
foreach(file IN LISTS SCRIPTS)
    file(READ "${file}" text)
    string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
    string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
    string(APPEND script "${text}")
endforeach()
file(READ "${FOLDER}/style.css" style)
file(READ "${FOLDER}/index.html" html)

set(source "// Made by embed_page.cmake.\n#include \"web/src/page_text.hpp\"\n\nnamespace vtm::web::text {\n\n")
string(APPEND source "const std::string_view html = R\"PAGE(${html})PAGE\";\n\n")
foreach(name style script)
    string(SHA256 hash "${${name}}")
    string(APPEND source "const std::string_view ${name} = R\"PAGE(${${name}})PAGE\";\n")
    string(APPEND source "const std::string_view ${name}Sha256 = \"${hash}\";\n\n")
endforeach()
file(WRITE "${OUTPUT}" "${source}}  // namespace vtm::web::text\n")
