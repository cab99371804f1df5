// SVG files as textures in a user's shader: affine views and floors in perspective.

#include <cmath>

#include <vtm/compiler/compile.hpp>
#include "backend_gl/testing.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/reference/reference.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"
#include "conformance/runner/kinds/svg_files.hpp"

namespace vtm::conformance {
namespace {

using image::Raster;

/// The truth of a floor: so many points of a pixel, read from the exact picture at this many pixels of its
/// longer side. They are a Fibonacci lattice (Niederreiter 1992, 5.3): no two in one row or column, so an
/// edge along either is right to 1 / samples.
constexpr int samples = 377, stride = 233, truthPixels = 2048;

class TextureSubject : public Subject {
public:
    TextureSubject(const SvgCase& made, const SceneSettings& settings, Fault fault)
        : scene_(made.scene()),
          settings_(settings),
          views_(viewsOf(settings.views, scene_, made.name)),
          canvas_((renderer(), damaged(compiler::compile(scene_, settings.compile).asset, fault))) {}

    std::size_t views() const override { return views_.size(); }
    std::string labelOf(std::size_t view) const override { return views_[view].label; }
    std::vector<Engine> engines(std::size_t) const override { return {Engine::Gl}; }
    Bounds bounds(Engine) const override { return settings_.bounds; }

    Raster expected(std::size_t index) override {
        const LabelledView& view = views_[index];
        return view.toPicture
                   ? floor(*view.toPicture, view.view.width, view.view.height)
                   : reference::render(scene_, {view.view.width, view.view.height, view.view.toPixels});
    }
    Raster drawn(std::size_t index, Engine) override {
        const LabelledView& view = views_[index];
        if (!view.toPicture)
            return canvas_.draw(view.view);
        return canvas_.draw(*view.toPicture, view.view.width, view.view.height,
                            {asset::Wrap::Repeat, asset::Wrap::Repeat});
    }

private:
    /// The exact picture, made once.
    const Raster& picture() {
        if (picture_.rgba.empty()) {
            const asset::View view = cases::wholePicture(scene_, truthPixels);
            picture_ = reference::render(scene_, {view.width, view.height, view.toPixels});
        }
        return picture_;
    }

    /// The picture's pixel at (s, t), repeated.
    const float* texel(double s, double t) {
        const Raster& p = picture();
        const auto place = [](double share, int n) {
            return std::min(n - 1, int((share - std::floor(share)) * n));
        };
        return p.pixel(place(s, p.width), place(t, p.height));
    }

    Raster floor(const glm::dmat3& toPicture, int width, int height) {
        Raster result(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int i = 0; i < samples; ++i) {
                    const glm::dvec3 at =
                        toPicture *
                        glm::dvec3(x + (i + 0.5) / samples, y + (i * stride % samples + 0.5) / samples, 1);
                    const float* const colour = texel(at.x / at.z, at.y / at.z);
                    for (int c = 0; c < 4; ++c)
                        result.pixel(x, y)[c] += colour[c] / float(samples);
                }
        return result;
    }

    scene::Scene scene_;
    SceneSettings settings_;
    std::vector<LabelledView> views_;
    gl::test::TextureCanvas canvas_;
    Raster picture_;
};

}  // namespace

std::vector<Case> textureCases(const Folder& folder) {
    return svgCases(folder, [](const SvgCase& made) {
        const SceneSettings settings = sceneSettings(made.settings);
        return [=](const Setting& setting) {
            TextureSubject subject(made, settings, setting.fault);
            return judge(subject, setting);
        };
    });
}

}  // namespace vtm::conformance
