// Our own drawings, which are there without any test data beside the checkout: every engine agrees.

#include <gtest/gtest.h>

#include "asset/evaluate.hpp"
#include "asset/scan.hpp"
#include "compiler/compile.hpp"
#include "conformance/cases/measure.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases {
namespace {

constexpr int width = 256;

class Example : public testing::TestWithParam<const char*> {
protected:
    scene::Scene scene_ = loadScene(examplesDirectory() / (std::string(GetParam()) + ".svg"));
    asset::View view_ = wholePicture(scene_, width);

    image::Raster reference(reference::Mode mode) const {
        reference::Options options;
        options.mode = mode;
        return reference::render(scene_, {view_.width, view_.height, view_.toPixels}, options);
    }
    asset::Asset compiled(asset::Mode mode) const {
        compiler::Options options;
        options.mode = mode;
        return compiler::compile(scene_, options).asset;
    }
};

INSTANTIATE_TEST_SUITE_P(Drawing, Example,
                         testing::Values("lighthouse", "rose_window", "gauge", "planet", "blend"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Example, ExactEnginesAgree) {
    Gl gl;
    const asset::Asset asset = compiled(asset::Mode::Exact);
    const image::Raster drawn = gl.render(asset, view_);
    EXPECT_LE(compare::compare(drawn, asset::evaluate(asset, view_)).max, assetMax);
    EXPECT_LE(compare::compare(drawn, asset::Scanner(asset).draw(view_)).max, assetMax);
    const compare::Difference d = compare::compare(drawn, reference(reference::Mode::Exact));
    EXPECT_LE(d.max, referenceMax) << "at " << d.worstX << ", " << d.worstY;
    EXPECT_LE(d.rms, referenceRms);
}

TEST_P(Example, CompatEnginesAgree) {
    Gl gl;
    const asset::Asset asset = compiled(asset::Mode::Compat);
    const image::Raster drawn = gl.render(asset, view_);
    EXPECT_LE(compare::compare(drawn, asset::evaluate(asset, view_)).max, assetMax);
    const compare::Difference d = compare::compare(drawn, reference(reference::Mode::Compat));
    EXPECT_LE(d.max, referenceMax) << "at " << d.worstX << ", " << d.worstY;
    EXPECT_LE(d.rms, referenceRms);
}

}  // namespace
}  // namespace vtm::cases
