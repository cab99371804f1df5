#include "conformance/cases/measure.hpp"

#include <fmt/core.h>

#include "asset/evaluate.hpp"
#include "asset/scan.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases {

Measurement::Measurement(const std::string& name)
    : name_(name),
      scene_(loadScene(sharedDirectory() / "corpus" / (name + ".svg"))),
      asset_(compiler::compile(scene_).asset) {}

compare::Difference Measurement::glToTruth(Gl& gl, int size) const {
    return compare::compare(asWritten(gl.render(asset_, wholePicture(scene_, size))), truthOf(name_, size));
}

compare::Difference Measurement::glToAsset(Gl& gl, int size) const {
    const asset::View view = wholePicture(scene_, size);
    return compare::compare(gl.render(asset_, view), asset::evaluate(asset_, view));
}

compare::Difference Measurement::glToReference(Gl& gl, int size) const {
    const asset::View view = wholePicture(scene_, size);
    const reference::View same{view.width, view.height, view.toPixels};
    return compare::compare(gl.render(asset_, view), reference::render(scene_, same));
}

compare::Difference Measurement::scanToGl(Gl& gl, int size) const {
    const asset::View view = wholePicture(scene_, size);
    return compare::compare(asset::Scanner(asset_).draw(view), gl.render(asset_, view));
}

image::Raster truthOf(const std::string& name, int size) {
    return compare::readPng((sharedDirectory() / fmt::format("corpus/truth/{}.{}.png", name, size)).string());
}

}  // namespace vtm::cases
