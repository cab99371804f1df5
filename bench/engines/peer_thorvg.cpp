// ThorVG on the CPU as a peer process (docs/benchmarks.md).

#include <filesystem>
#include <utility>
#include <vector>

#include <thorvg.h>

#include "bench/engines/argb_pixels.hpp"
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
    Surface() : canvas_(tvg::SwCanvas::gen()) {
        if (!canvas_)
            throw std::runtime_error("ThorVG was built without its engine for the CPU");
    }

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
    }

    /// Before a picture is deleted.
    void forget(tvg::Picture* picture) noexcept {
        if (shown_ == picture)
            static_cast<void>(canvas_->remove(std::exchange(shown_, nullptr)));
    }

    image::Bitmap pixels() const {
        return bitmapOf(reinterpret_cast<const unsigned char*>(words_.data()), 4 * std::ptrdiff_t(width_),
                        width_, height_);
    }

private:
    void fit(int width, int height) {
        if (width == width_ && height == height_)
            return;
        words_.assign(std::size_t(width) * std::size_t(height), 0);
        check(canvas_->target(words_.data(), std::uint32_t(width), std::uint32_t(width),
                              std::uint32_t(height), tvg::ColorSpace::ARGB8888),
              "draw into a buffer of this size");
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

    std::unique_ptr<tvg::SwCanvas> canvas_;
    std::vector<std::uint32_t> words_;
    int width_ = 0, height_ = 0;
    tvg::Picture* shown_ = nullptr;
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
    std::unique_ptr<Document> read(const std::string& path, double width, double height) override {
        return std::make_unique<ThorVgDocument>(surface_, path, width, height);
    }
    image::Bitmap pixels() const override { return surface_.pixels(); }

private:
    Surface surface_;
};

}  // namespace
}  // namespace vtm::bench

int main() {
    using namespace vtm::bench;
    PeerProcess process;
    if (tvg::Initializer::init(0) == tvg::Result::Success)
        process.add("thorvg", "file",
                    std::string("ThorVG ") + tvg::Initializer::version(nullptr, nullptr, nullptr) +
                        " on the CPU, no threads of its own",
                    std::make_unique<ThorVg>());
    else
        std::cout << "missing thorvg: missing, its library does not start.\n";
    process.run();
}
