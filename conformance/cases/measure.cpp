#include "conformance/cases/measure.hpp"

#include <fmt/core.h>

namespace vtm::cases {

Measurement::Measurement(const std::string& name)
    : scene_(loadScene(sharedDirectory() / "corpus" / (name + ".svg"))),
      asset_(compiler::compile(scene_).asset) {}

image::Raster truthOf(const std::string& name, int size) {
    return compare::readPng((sharedDirectory() / fmt::format("corpus/truth/{}.{}.png", name, size)).string());
}

}  // namespace vtm::cases
