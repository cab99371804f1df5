/// \file
/// One encoder a format, of sizes and options that makeEncoder() has checked.
#pragma once

#include <memory>

#include <vtm/image/encode.hpp>

namespace vtm::image {

std::unique_ptr<Encoder> makePngEncoder(int width, int height, int depth);
std::unique_ptr<Encoder> makeJpegEncoder(int width, int height, int quality);
/// Without a quality every pixel is kept.
std::unique_ptr<Encoder> makeWebpEncoder(int width, int height, std::optional<int> quality);

}  // namespace vtm::image
