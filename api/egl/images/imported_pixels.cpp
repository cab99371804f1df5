#include "api/egl/images/imported_pixels.hpp"

#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "api/egl/system/gl_functions.hpp"

namespace vtm::egl {

namespace {

/// A context of ours where textures of a display's EGLImages are.
class ImageContext {
public:
    /// `onGpu`: shares with the compositor's context, if that can be. Throws Error.
    ImageContext(const Display& display, bool onGpu) : display_(display.handle) {
        const EGLConfig config = pbufferConfig(display);
        context_ = onGpu ? newSharingContext(display, config) : EGL_NO_CONTEXT;
        sharesTextures_ = context_ != EGL_NO_CONTEXT;
        if (!sharesTextures_)
            context_ = newGlContext(display, config);
        const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface_ = systemEgl()->CreatePbufferSurface(display_, config, size);
    }
    ~ImageContext() {
        if (surface_ != EGL_NO_SURFACE)
            systemEgl()->DestroySurface(display_, surface_);
        systemEgl()->DestroyContext(display_, context_);
    }
    ImageContext(const ImageContext&) = delete;
    ImageContext& operator=(const ImageContext&) = delete;

    bool sharesTextures() const { return sharesTextures_; }

    /// Runs with the context current. Throws Error.
    template <class Body>
    auto with(Body&& body) {
        const std::lock_guard lock(mutex_);
        requireSystem(surface_ != EGL_NO_SURFACE);
        const GlCurrent current(display_, surface_, context_);
        if (framebuffer_ == 0) {
            gl().GenFramebuffers(1, &framebuffer_);
            gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        }
        return body();
    }

private:
    const EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
    bool sharesTextures_ = false;
    GLuint framebuffer_ = 0;
    std::mutex mutex_;
};

/// Of a display that runs, by whether they are to share. Never destroyed: programs may call at any time.
struct ImageContexts {
    std::mutex mutex;
    std::map<std::pair<const Display*, bool>, std::shared_ptr<ImageContext>> all;
};
ImageContexts& imageContexts() {
    static auto& contexts = *new ImageContexts;
    return contexts;
}

/// Throws Error.
std::shared_ptr<ImageContext> imageContext(const Display& display, bool onGpu) {
    const std::lock_guard lock(imageContexts().mutex);
    auto& context = imageContexts().all[{&display, onGpu}];
    if (!context)
        context = std::make_shared<ImageContext>(display, onGpu);
    return context;
}

std::atomic<int> importedCount = 0;

/// A texture of an EGLImage.
class ImportedPixels {
public:
    /// Throws Error for what OpenVG has no images of.
    ImportedPixels(std::shared_ptr<ImageContext> context, EGLImage image) : context_(std::move(context)) {
        context_->with([&] {
            try {
                create(image);
            } catch (const Error&) {
                gl().DeleteTextures(1, &texture_);
                throw;
            }
        });
        ++importedCount;
    }
    ~ImportedPixels() {
        --importedCount;
        if (texture_ != 0)
            noThrow([&] { gl().DeleteTextures(1, &texture_); });
    }
    ImportedPixels(const ImportedPixels&) = delete;
    ImportedPixels& operator=(const ImportedPixels&) = delete;

    VtmForeignPixels described() { return {this, width_, height_, VGboolean(hasAlpha_), sharedTexture()}; }
    void read(void* bytes) {
        noThrow([&] {
            attach();
            gl().ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
        });
    }
    void write(const void* bytes) {
        noThrow([&] {
            gl().BindTexture(GL_TEXTURE_2D, texture_);
            upload(static_cast<const std::uint8_t*>(bytes));
            gl().Finish();
        });
    }

private:
    void create(EGLImage image) {
        require(gl().EGLImageTargetTexture2DOES != nullptr, EGL_BAD_MATCH);
        while (gl().GetError() != GL_NO_ERROR) {
        }
        gl().GenTextures(1, &texture_);
        gl().BindTexture(GL_TEXTURE_2D, texture_);
        gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl().EGLImageTargetTexture2DOES(GL_TEXTURE_2D, image);
        require(gl().GetError() == GL_NO_ERROR, EGL_BAD_MATCH);
        width_ = levelParameter(GL_TEXTURE_WIDTH);
        height_ = levelParameter(GL_TEXTURE_HEIGHT);
        hasAlpha_ = levelParameter(GL_TEXTURE_ALPHA_SIZE) > 0;
        require(width_ > 0 && height_ > 0 && levelParameter(GL_TEXTURE_RED_TYPE) == GL_UNSIGNED_NORMALIZED,
                EGL_BAD_MATCH);
        attach();
        require(gl().CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, EGL_BAD_MATCH);
        // Of no pixels, to see if it takes them.
        gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, format(), GL_UNSIGNED_BYTE, nullptr);
        require(gl().GetError() == GL_NO_ERROR, EGL_BAD_MATCH);
    }
    /// Needs OpenGL ES 3.1.
    static GLint levelParameter(GLenum name) {
        GLint value = 0;
        if (gl().GetTexLevelParameteriv)
            gl().GetTexLevelParameteriv(GL_TEXTURE_2D, 0, name, &value);
        return gl().GetError() == GL_NO_ERROR ? value : 0;
    }
    GLenum format() const { return hasAlpha_ ? GL_RGBA : GL_RGB; }
    void attach() const {
        gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    }
    void upload(const std::uint8_t* bytes) const {
        std::vector<std::uint8_t> opaque;
        if (!hasAlpha_) {
            gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
            const std::size_t count = std::size_t(width_) * std::size_t(height_);
            opaque.reserve(3 * count);
            for (std::size_t i = 0; i < count; ++i)
                opaque.insert(opaque.end(), bytes + 4 * i, bytes + 4 * i + 3);
            bytes = opaque.data();
        }
        gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, format(), GL_UNSIGNED_BYTE, bytes);
    }
    /// Gives the texture to the compositor, if that is what it is for. Shaders see stored values unless they
    /// are sRGB.
    unsigned sharedTexture() {
        const bool isShared = context_->sharesTextures() && context_->with([&] {
            gl().BindTexture(GL_TEXTURE_2D, texture_);
            const bool isPlain = levelParameter(GL_TEXTURE_INTERNAL_FORMAT) != GL_SRGB8_ALPHA8;
            gl().Finish();
            return isPlain;
        });
        return isShared ? std::exchange(texture_, 0) : 0;
    }
    template <class Body>
    void noThrow(Body&& body) noexcept {
        try {
            context_->with(body);
        } catch (const std::exception&) {
        } catch (const Error&) {
        }
    }

    const std::shared_ptr<ImageContext> context_;
    GLuint texture_ = 0;
    GLint width_ = 0, height_ = 0;
    bool hasAlpha_ = false;
};

VGboolean openPixels(void* owner, VGeglImageKHR name, VGboolean onGpu, VtmForeignPixels* opened) try {
    const auto& display = *static_cast<const Display*>(owner);
    auto pixels = std::make_unique<ImportedPixels>(imageContext(display, onGpu != VG_FALSE), name);
    *opened = pixels->described();
    pixels.release();  // until it is closed
    return VG_TRUE;
} catch (const Error&) {
    return VG_FALSE;
} catch (const std::exception&) {
    return VG_FALSE;
}
void readPixels(void* pixels, void* bytes) { static_cast<ImportedPixels*>(pixels)->read(bytes); }
void writePixels(void* pixels, const void* bytes) { static_cast<ImportedPixels*>(pixels)->write(bytes); }
void closePixels(void* pixels) { delete static_cast<ImportedPixels*>(pixels); }

constexpr VtmForeignFunctions functions{openPixels, readPixels, writePixels, closePixels};

}  // namespace

void importImage(EGLDisplay handle, EGLImage image) {
    Display* const display = findDisplay(handle);
    if (image != EGL_NO_IMAGE && display && display->systemRuns)
        vtmNameForeignPixels(image, &functions, display);
}

void forgetImported(EGLDisplay handle, EGLImage image) { vtmForgetForeignPixels(image, findDisplay(handle)); }

void detachImported(Display& display) {
    vtmDetachForeignPixels(&display);
    const std::lock_guard lock(imageContexts().mutex);
    std::erase_if(imageContexts().all, [&](const auto& one) { return one.first.first == &display; });
}

bool haveImported() { return importedCount > 0; }

void synchronizeImported() {
    const bool isGlCurrent = systemEgl()->GetCurrentContext() != EGL_NO_CONTEXT;
    if (isGlCurrent)
        gl().Finish();
    vtmFinishForeignPixels(VGboolean(isGlCurrent));
}

}  // namespace vtm::egl
