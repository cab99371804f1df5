// ThorVG as a peer process (docs/benchmarks.md): its engine for the CPU, and its engine for OpenGL ES.

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <EGL/egl.h>
#include <thorvg.h>

#include <vtm/gl/context.hpp>
#include "bench/engines/argb_pixels.hpp"
#include "bench/engines/gl_framebuffer.hpp"
#include "bench/engines/peer_process.hpp"

namespace vtm::bench {
namespace {

void check(tvg::Result result, const char* step) {
    if (result != tvg::Result::Success)
        throw std::runtime_error(std::string("ThorVG cannot ") + step + " (result " +
                                 std::to_string(int(result)) + ")");
}

/// A canvas and its pixels. It shows one picture at a time.
class Surface {
public:
    explicit Surface(std::unique_ptr<tvg::Canvas> canvas) : canvas_(std::move(canvas)) {
        if (!canvas_)
            throw std::runtime_error("ThorVG was built without this engine");
    }
    virtual ~Surface() = default;
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    void draw(tvg::Picture* picture, const asset::View& view) {
        fit(view.width, view.height);
        show(picture);
        const glm::dmat3x2& m = view.toPixels;
        check(picture->transform({float(m[0][0]), float(m[1][0]), float(m[2][0]),  //
                                  float(m[0][1]), float(m[1][1]), float(m[2][1]),  //
                                  0, 0, 1}),
              "transform the picture");
        check(canvas_->update(), "prepare the picture");
        check(canvas_->draw(true), "draw the picture");
        check(canvas_->sync(), "draw the picture");
        finish();
    }

    /// Before a picture is deleted.
    void forget(tvg::Picture* picture) noexcept {
        if (shown_ == picture)
            static_cast<void>(canvas_->remove(std::exchange(shown_, nullptr)));
    }

    virtual image::Bitmap pixels() const = 0;

protected:
    int width() const { return width_; }
    int height() const { return height_; }

    template <class Canvas>
    Canvas& canvas() {
        return static_cast<Canvas&>(*canvas_);
    }

private:
    /// Makes the canvas draw into pixels of this size.
    virtual void aim(int width, int height) = 0;
    /// Waits until the pixels stand.
    virtual void finish() {}

    void fit(int width, int height) {
        if (width == width_ && height == height_)
            return;
        aim(width, height);
        width_ = width;
        height_ = height;
    }

    void show(tvg::Picture* picture) {
        if (picture == shown_)
            return;
        if (shown_)
            check(canvas_->remove(std::exchange(shown_, nullptr)), "put a picture away");
        check(canvas_->add(picture), "show the picture");
        shown_ = picture;
    }

    std::unique_ptr<tvg::Canvas> canvas_;
    int width_ = 0, height_ = 0;
    tvg::Picture* shown_ = nullptr;
};

class CpuSurface : public Surface {
public:
    CpuSurface() : Surface(std::unique_ptr<tvg::Canvas>(tvg::SwCanvas::gen())) {}

    image::Bitmap pixels() const override {
        return bitmapOf(reinterpret_cast<const unsigned char*>(words_.data()), 4 * std::ptrdiff_t(width()),
                        width(), height());
    }

private:
    void aim(int width, int height) override {
        words_.assign(std::size_t(width) * std::size_t(height), 0);
        check(canvas<tvg::SwCanvas>().target(words_.data(), std::uint32_t(width), std::uint32_t(width),
                                             std::uint32_t(height), tvg::ColorSpace::ARGB8888),
              "draw into a buffer of this size");
    }

    std::vector<std::uint32_t> words_;
};

/// In the context that is current.
class GlSurface : public Surface {
public:
    GlSurface() : Surface(std::unique_ptr<tvg::Canvas>(tvg::GlCanvas::gen())) {}

    image::Bitmap pixels() const override { return target_.value().pixels(); }

private:
    void aim(int width, int height) override {
        target_.reset();
        target_.emplace(width, height);
        check(canvas<tvg::GlCanvas>().target(nullptr, nullptr, eglGetCurrentContext(),
                                             std::int32_t(target_->name()), std::uint32_t(width),
                                             std::uint32_t(height), tvg::ColorSpace::ABGR8888S),
              "draw into a framebuffer of this size");
    }
    void finish() override { glFinish(); }

    std::optional<GlFramebuffer> target_;
};

struct Release {
    void operator()(tvg::Picture* picture) const { picture->unref(); }
};

/// From the file's bytes: ThorVG keeps what it has loaded by path.
class ThorVgDocument : public Document {
public:
    ThorVgDocument(Surface& surface, const std::string& path, double width, double height)
        : surface_(surface), picture_(tvg::Picture::gen()) {
        picture_->ref();  // a canvas deletes what nobody else has
        const std::vector<std::uint8_t> bytes = image::readFile(path);
        const std::string folder = std::filesystem::path(path).parent_path().string();
        check(picture_->load(reinterpret_cast<const char*>(bytes.data()), std::uint32_t(bytes.size()), "svg",
                             folder.c_str(), true),
              "read it");
        check(picture_->size(float(width), float(height)), "give it this size");
    }
    ~ThorVgDocument() override { surface_.forget(picture_.get()); }
    ThorVgDocument(const ThorVgDocument&) = delete;
    ThorVgDocument& operator=(const ThorVgDocument&) = delete;

    void draw(const asset::View& view) override { surface_.draw(picture_.get(), view); }

private:
    Surface& surface_;
    std::unique_ptr<tvg::Picture, Release> picture_;
};

class ThorVg : public Peer {
public:
    explicit ThorVg(std::unique_ptr<Surface> surface) : surface_(std::move(surface)) {}
    std::unique_ptr<Document> read(const std::string& path, double width, double height) override {
        return std::make_unique<ThorVgDocument>(*surface_, path, width, height);
    }
    image::Bitmap pixels() const override { return surface_->pixels(); }

private:
    std::unique_ptr<Surface> surface_;
};

/// The engine for the CPU, or that for OpenGL ES, in the context that is current.
void add(PeerProcess& process, const gl::Context* context) {
    const std::string version = std::string("ThorVG ") + tvg::Initializer::version(nullptr, nullptr, nullptr);
    if (context)
        process.add("thorvg-gl", "file", version + ", OpenGL ES engine on " + context->renderer(),
                    std::make_unique<ThorVg>(std::make_unique<GlSurface>()));
    else
        process.add("thorvg", "file", version + " on the CPU, no threads of its own",
                    std::make_unique<ThorVg>(std::make_unique<CpuSurface>()));
}

}  // namespace
}  // namespace vtm::bench

/// `gl` asks for the engine for OpenGL ES.
int main(int count, char** arguments) {
    using namespace vtm;
    const std::string engine = count > 1 ? arguments[1] : "";
    std::optional<gl::Context> context;
    bench::PeerProcess process;
    try {
        bench::check(tvg::Initializer::init(0), "start");
        if (engine == "gl")
            context.emplace();
        bench::add(process, context ? &*context : nullptr);
    } catch (const std::exception& error) {
        std::cout << "missing thorvg" << (engine.empty() ? "" : "-" + engine) << ": missing, " << error.what()
                  << ".\n";
    }
    process.run();
}
