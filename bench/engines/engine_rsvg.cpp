#include "bench/engines/engine.hpp"
#include "bench/engines/peer_rsvg.hpp"
#include "bench/measure/measure.hpp"

namespace vtm::bench {
namespace {

class RsvgEngine : public Engine {
public:
    explicit RsvgEngine(const std::string& version) : Engine("librsvg", version) {}

    void load(const Picture& picture) override { rsvg_ = open(picture); }

    double draw(const asset::View& view) override {
        return cpuTime([&] { rsvg_->draw(view); });
    }

    std::optional<double> drawCold(const Picture& picture, const asset::View& view) override {
        std::optional<Rsvg> rsvg;  // outlives the clock
        return cpuTime([&] {
            rsvg = open(picture);
            rsvg->draw(view);
        });
    }

    image::Bitmap pixels(const asset::View& view) override {
        rsvg_->draw(view);
        return rsvg_->pixels();
    }

private:
    static Rsvg open(const Picture& picture) {
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
