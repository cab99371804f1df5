#include "bench/engines/engine.hpp"
#include "bench/engines/peer_cairo.hpp"
#include "bench/engines/peer_rsvg.hpp"
#include "bench/measure/measure.hpp"

namespace vtm::bench {

namespace {

class CairoEngine : public Engine {
public:
    explicit CairoEngine(const std::string& version)
        : Engine("cairo", version + ", the paths of our scene, a call each") {}

    void load(const LoadedFile& picture) override { shapes_ = shapesOf(picture.scene); }

    double draw(const asset::View& view) override {
        prepareTarget(view);
        return spentTime([&] { draw(shapes_, view); });
    }

    /// Reading the file is ours.
    std::optional<double> drawCold(const LoadedFile& picture, const asset::View& view) override {
        prepareTarget(view);
        return spentTime([&] { draw(shapesOf(bench::load(picture.file)), view); });
    }

    image::Bitmap pixels(const asset::View& view) override {
        draw(view);
        return canvas_->pixels();
    }

private:
    void prepareTarget(const asset::View& view) {
        if (!canvas_ || canvas_->width() != view.width || canvas_->height() != view.height)
            canvas_.emplace(view.width, view.height);
    }

    void draw(const std::vector<Shape>& shapes, const asset::View& view) {
        canvas_->draw(shapes, view.toPixels, {0, 0, 0, 0});
    }

    std::vector<Shape> shapes_;
    std::optional<CairoCanvas> canvas_;
};

}  // namespace

Engines cairoEngines(std::vector<std::string>& notes) {
    Engines engines;
    if (const auto version = cairoVersion())
        engines.push_back(std::make_unique<CairoEngine>(*version));
    else
        notes.push_back("cairo: missing, built without it (librsvg2-dev).");
    return engines;
}

namespace {

class RsvgEngine : public Engine {
public:
    explicit RsvgEngine(const std::string& version) : Engine("librsvg", version) {}

    void load(const LoadedFile& picture) override { rsvg_ = open(picture); }

    double draw(const asset::View& view) override {
        return spentTime([&] { rsvg_->draw(view); });
    }

    std::optional<double> drawCold(const LoadedFile& picture, const asset::View& view) override {
        std::optional<Rsvg> rsvg;  // outlives the clock
        return spentTime([&] {
            rsvg = open(picture);
            rsvg->draw(view);
        });
    }

    image::Bitmap pixels(const asset::View& view) override {
        rsvg_->draw(view);
        return rsvg_->pixels();
    }

private:
    static Rsvg open(const LoadedFile& picture) {
        return Rsvg(picture.file.path, picture.scene.width, picture.scene.height);
    }

    std::optional<Rsvg> rsvg_;
};

}  // namespace

Engines rsvgEngines(std::vector<std::string>& notes) {
    Engines engines;
    if (const auto version = rsvgVersion())
        engines.push_back(std::make_unique<RsvgEngine>(*version));
    else
        notes.push_back("librsvg: missing, built without it (librsvg2-dev).");
    return engines;
}

}  // namespace vtm::bench
