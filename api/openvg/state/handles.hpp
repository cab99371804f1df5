/// \file
/// Which object a number stands for (specification section 3.6).
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "api/openvg/state/error.hpp"
#include "api/openvg/state/objects.hpp"

namespace vtm::openvg {

/// The objects that some contexts share. A number is not given twice before 2^32 others were.
class Handles {
public:
    /// Held by every call of the contexts, so that objects may be used from several threads.
    std::recursive_mutex mutex;

    template <class T>
    VGHandle add(std::shared_ptr<T> object) {
        VGHandle handle = VG_INVALID_HANDLE;
        while (handle == VG_INVALID_HANDLE || objects_.contains(handle))
            handle = next()++;
        object->handle = handle;
        objects_.emplace(handle, std::move(object));
        return handle;
    }

    /// Null if the handle is none, or one of another type.
    template <class T>
    std::shared_ptr<T> find(VGHandle handle) const {
        const auto it = objects_.find(handle);
        return it == objects_.end() ? nullptr : std::dynamic_pointer_cast<T>(it->second);
    }

    /// Throws Error(VG_BAD_HANDLE_ERROR).
    template <class T>
    std::shared_ptr<T> get(VGHandle handle) const {
        std::shared_ptr<T> object = find<T>(handle);
        if (!object)
            throw Error(VG_BAD_HANDLE_ERROR);
        return object;
    }

    template <class T>
    void destroy(VGHandle handle) {
        const std::shared_ptr<T> object = get<T>(handle);
        objects_.erase(handle);
        object->handle = VG_INVALID_HANDLE;
    }

private:
    /// Of the whole process: numbers of contexts that share nothing differ too.
    static std::atomic<VGHandle>& next() {
        static std::atomic<VGHandle> number = 1;
        return number;
    }

    std::unordered_map<VGHandle, std::shared_ptr<Object>> objects_;
};

}  // namespace vtm::openvg
