/// \file
/// The drawing context, and how every function of the API gets to it (specification section 4).
#pragma once

#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include <vtm/vg.h>

#include "api/openvg/state/error.hpp"
#include "api/openvg/state/handles.hpp"
#include "api/openvg/state/state.hpp"
#include "api/openvg/state/surface.hpp"

namespace vtm::openvg {
class Recorder;
}

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
