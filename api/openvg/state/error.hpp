/// \file
/// Errors inside of a call; what the caller sees is vgGetError().
#pragma once

#include <cstdint>
#include <exception>
#include <utility>

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

/// What `body` ends with.
template <class Body>
VGErrorCode errorOf(Body&& body) noexcept {
    try {
        std::forward<Body>(body)();
        return VG_NO_ERROR;
    } catch (const Error& error) {
        return error.code;
    } catch (const std::exception&) {
        // What is left are allocations, and limits of ours that a call went beyond.
        return VG_OUT_OF_MEMORY_ERROR;
    }
}

/// The pointer that `body` gives, or null; `error`, if not null, becomes what it ends with.
template <class Body>
auto madeOrNull(VGErrorCode* error, Body&& body) noexcept {
    decltype(body()) result = nullptr;
    const VGErrorCode code = errorOf([&] { result = std::forward<Body>(body)(); });
    if (error)
        *error = code;
    return result;
}

/// Of a pointer to numbers of this type.
template <class T>
bool isAligned(const T* pointer) {
    return reinterpret_cast<std::uintptr_t>(pointer) % alignof(T) == 0;
}

}  // namespace vtm::openvg
