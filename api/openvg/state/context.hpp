/// \file
/// The drawing context, what it draws into and the objects behind handles (specification sections 3.6, 4
/// and 7.2), and how every function of the API gets to it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <vtm/vg.h>
#include "api/openvg/draw/glyph_cache.hpp"
#include "api/openvg/state/error.hpp"
#include "api/openvg/state/objects.hpp"
#include "api/openvg/state/state.hpp"

namespace vtm::openvg {
class Compositor;
}

struct VtmSurface {
    std::shared_ptr<vtm::openvg::ImageStorage> storage;
    std::optional<vtm::openvg::MaskValues> mask;    ///< nothing: every value counts as 1
    vtm::openvg::Compositor* compositor = nullptr;  ///< one for all surfaces of its kind
    bool isImage = false;                           ///< drawn into an image of a context
    /// What vtmTakeGlPicture gave.
    std::shared_ptr<const vtm::openvg::gl::Texture> picture;
    VtmContext* user = nullptr;  ///< the context that it is current with
    bool isDestroyed = false;    ///< goes when it is no longer current

    vtm::openvg::StoredPixels& pixels() const { return storage->pixels; }
    int width() const { return pixels().width(); }
    int height() const { return pixels().height(); }
    vtm::openvg::Rectangle bounds() const { return {0, 0, width(), height()}; }
};

namespace vtm::openvg {

using Surface = ::VtmSurface;

inline constexpr int maxSurfaceSide = 16384;

/// The objects that some contexts share. A number is not given twice before 2^32 others were.
class Handles {
public:
    /// Held by every call of the contexts, so that objects may be used from several threads.
    std::recursive_mutex mutex;
    /// Of the glyphs of all fonts.
    GlyphCache glyphs;

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

class Recorder;
}  // namespace vtm::openvg

struct VtmContext {
    vtm::openvg::State state;
    std::shared_ptr<vtm::openvg::Handles> objects;  ///< shared by contexts that share
    VtmSurface* surface = nullptr;                  ///< not null while current
    VGErrorCode error = VG_NO_ERROR;                ///< the oldest not asked for
    bool isDestroyed = false;                       ///< goes when it is no longer current

    std::shared_ptr<vtm::openvg::Recorder> recorder;  ///< while a recording is under way
    std::string recordingFault;                       ///< of the last one
};

namespace vtm::openvg {

using Context = ::VtmContext;

/// Of this thread; null if there is none.
Context* currentContext();

/// Of what vtmReadSurface and vtmWriteSurface copy.
PixelFormat bytesFormat();

inline void setError(Context& context, VGErrorCode code) {
    if (context.error == VG_NO_ERROR)
        context.error = code;
}

/// Runs a function of the API: gives its result, or `otherwise` if there is no context or an error, which is
/// kept.
template <class Result, class Body>
Result callOr(Result otherwise, Body&& body) noexcept {
    Context* const context = currentContext();
    if (!context)
        return otherwise;
    Result result = otherwise;
    const VGErrorCode code = errorOf([&] {
        const std::lock_guard lock(context->objects->mutex);
        result = std::forward<Body>(body)(*context);
    });
    setError(*context, code);
    return result;
}

template <class Body>
void call(Body&& body) noexcept {
    callOr(0, [&](Context& context) {
        std::forward<Body>(body)(context);
        return 0;
    });
}

}  // namespace vtm::openvg
