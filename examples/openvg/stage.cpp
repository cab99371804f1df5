#include "examples/openvg/stage.hpp"

#include <cstdio>
#include <stdexcept>

#include <VG/openvg.h>
#include <vtm/vg.h>

#include <vtm/image/codec.hpp>

namespace stage {

namespace {

class Memory : public Stage {
public:
    Memory(std::string file, int width, int height) : file_(std::move(file)) {
        const VtmSurfaceFormat format = {8, 8, 8, 8, 0, 8, VG_FALSE, VG_TRUE};
        surface_ = vtmCreateSurface(width, height, &format);
        context_ = vtmCreateContext(nullptr);
        if (!surface_ || !context_ || !vtmMakeCurrent(context_, surface_))
            throw std::runtime_error("no OpenVG context");
    }

    ~Memory() override {
        vtmMakeCurrent(nullptr, nullptr);
        vtmDestroyContext(context_);
        vtmDestroySurface(surface_);
    }

    void show(double seconds, const std::function<void(double)>& frame) override {
        frame(seconds);
        checkErrors();
        vtm::image::Bitmap picture{vtmSurfaceWidth(surface_), vtmSurfaceHeight(surface_), {}};
        picture.rgba.resize(std::size_t(picture.width) * std::size_t(picture.height) * 4);
        vtmReadSurface(surface_, picture.rgba.data(), std::size_t(picture.width) * 4);
        vtm::image::writeFile(file_,
                              vtm::image::encodePng(picture));  // the examples cover every pixel: alpha is 1
    }

private:
    std::string file_;
    VtmSurface* surface_;
    VtmContext* context_;
};

}  // namespace

std::unique_ptr<Stage> open(const std::string& target, int width, int height, const std::string& title) {
#ifdef VTM_EXAMPLES_HAVE_WINDOW
    if (target == "window")
        return openWindow(width, height, title);
#else
    if (target == "window")
        throw std::runtime_error("built without windows, so there is none for " + title);
#endif
    return std::make_unique<Memory>(target, width, height);
}

void checkErrors() {
    const char* const names[] = {"VG_BAD_HANDLE_ERROR",
                                 "VG_ILLEGAL_ARGUMENT_ERROR",
                                 "VG_OUT_OF_MEMORY_ERROR",
                                 "VG_PATH_CAPABILITY_ERROR",
                                 "VG_UNSUPPORTED_IMAGE_FORMAT_ERROR",
                                 "VG_UNSUPPORTED_PATH_FORMAT_ERROR",
                                 "VG_IMAGE_IN_USE_ERROR",
                                 "VG_NO_CONTEXT_ERROR"};
    if (const VGErrorCode error = vgGetError(); error != VG_NO_ERROR)
        throw std::runtime_error(names[error - VG_BAD_HANDLE_ERROR]);
}

int run(const std::function<void()>& program) try {
    program();
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}

}  // namespace stage
