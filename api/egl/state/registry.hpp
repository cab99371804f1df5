/// \file
/// Which object a handle stands for. A handle of ours is an address that no other library has, and no object
/// before it had: what is not found here is the system's to judge.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include <EGL/egl.h>
#include <VG/openvg.h>

#include "api/egl/state/objects.hpp"

namespace vtm::egl {

struct Error {
    EGLint code;
};

/// Throws unless what a call asks for is right.
inline void require(bool isRight, EGLint code) {
    if (!isRight)
        throw Error{code};
}

/// Of a call that libOpenVG could not do with an image.
inline EGLint errorOf(VGErrorCode code) {
    switch (code) {
        case VG_BAD_HANDLE_ERROR:
            return EGL_BAD_PARAMETER;
        case VG_IMAGE_IN_USE_ERROR:
            return EGL_BAD_ACCESS;
        case VG_OUT_OF_MEMORY_ERROR:
            return EGL_BAD_ALLOC;
        default:
            return EGL_BAD_MATCH;
    }
}

/// An address inside of an array of ours that is used for nothing else.
void* newHandle();

template <class T>
class Table {
public:
    /// With a new handle, if it has none.
    void add(const std::shared_ptr<T>& object) {
        const std::lock_guard lock(mutex_);
        while (!object->handle || !objects_.try_emplace(object->handle, object).second)
            object->handle = newHandle();
    }

    /// Null if the handle is not ours.
    std::shared_ptr<T> find(void* handle) const {
        const std::lock_guard lock(mutex_);
        const auto it = objects_.find(handle);
        return it == objects_.end() ? nullptr : it->second;
    }

    bool has(void* handle) const { return find(handle) != nullptr; }

    /// The one whose handle was, or null. Whatever is freed with it is freed after the lock.
    std::shared_ptr<T> remove(void* handle) {
        const std::lock_guard lock(mutex_);
        const auto it = objects_.find(handle);
        if (it == objects_.end())
            return nullptr;
        std::shared_ptr<T> object = std::move(it->second);
        objects_.erase(it);
        return object;
    }

    /// Those of a display.
    std::vector<std::shared_ptr<T>> removeAll(const Display& display) {
        std::vector<std::shared_ptr<T>> removed;
        const std::lock_guard lock(mutex_);
        for (auto it = objects_.begin(); it != objects_.end();) {
            if (displayOf(*it->second) != &display) {
                ++it;
                continue;
            }
            removed.push_back(std::move(it->second));
            it = objects_.erase(it);
        }
        return removed;
    }

private:
    static const Display* displayOf(const Config& config) { return config.display; }
    template <class O>
    static const Display* displayOf(const O& object) {
        return &object.display;
    }

    mutable std::mutex mutex_;
    std::map<void*, std::shared_ptr<T>> objects_;
};

/// Never destroyed: programs may call at any time.
Table<Config>& configs();
Table<Surface>& surfaces();
Table<Context>& contexts();
Table<Image>& images();

/// Null if no program got it from us.
Display* findDisplay(EGLDisplay handle);
/// The one that there is, or a new one with these members.
Display& addDisplay(EGLDisplay handle, bool isSystems, bool mayBeAlone,
                    std::optional<void*> native = std::nullopt);
/// The display of a machine without any. Asked for again it is the same.
Display& ownDisplay();

/// Throw Error.
Display& initializedDisplay(EGLDisplay handle);

template <class T>
std::shared_ptr<T> get(Table<T>& table, const Display& display, void* handle, EGLint error) {
    std::shared_ptr<T> object = table.find(handle);
    if constexpr (requires { object->config; }) {
        if (!object || &object->display != &display)
            throw Error{error};
    } else {
        if (!object || object->display != &display)
            throw Error{error};
    }
    return object;
}

inline std::shared_ptr<Surface> getSurface(const Display& display, EGLSurface handle) {
    return get(surfaces(), display, handle, EGL_BAD_SURFACE);
}
inline std::shared_ptr<Context> getContext(const Display& display, EGLContext handle) {
    return get(contexts(), display, handle, EGL_BAD_CONTEXT);
}
/// EGL_BAD_MATCH for one of the system's, EGL_BAD_CONFIG for none at all.
std::shared_ptr<Config> getConfig(const Display& display, EGLConfig handle);

}  // namespace vtm::egl
