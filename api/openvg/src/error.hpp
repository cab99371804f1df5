/// \file
/// Errors inside of a call; what the caller sees is vgGetError().
#pragma once

#include <cstdint>

#include <VG/openvg.h>

namespace vtm::openvg {

struct Error {
    explicit Error(VGErrorCode c) : code(c) {}
    VGErrorCode code;
};

/// Throws unless the argument is legal.
inline void require(bool legal, VGErrorCode code = VG_ILLEGAL_ARGUMENT_ERROR) {
    if (!legal)
        throw Error(code);
}

/// Of a pointer to numbers of this type.
template <class T>
bool isAligned(const T* pointer) {
    return reinterpret_cast<std::uintptr_t>(pointer) % alignof(T) == 0;
}

}  // namespace vtm::openvg
