/// \file
/// Lists of attributes: names, each followed by its value, up to EGL_NONE (EGL specification section 3.4.1).
#pragma once

#include <utility>
#include <vector>

#include <EGL/egl.h>

namespace vtm::egl {

/// Of EGLint or EGLAttrib. Null is the empty list.
template <class Number>
std::vector<std::pair<EGLint, EGLint>> attributeList(const Number* list) {
    std::vector<std::pair<EGLint, EGLint>> attributes;
    for (; list && *list != EGL_NONE; list += 2)
        attributes.emplace_back(EGLint(list[0]), EGLint(list[1]));
    return attributes;
}

}  // namespace vtm::egl
