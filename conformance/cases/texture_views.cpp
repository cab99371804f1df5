#include "conformance/cases/texture_views.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>

#include <vtm/raster/evaluate.hpp>

namespace vtm::cases {

namespace {

using glm::dmat2;
using glm::dvec2;
using image::Raster;

dmat2 rotation(double angle) { return {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle)}; }

asset::View centred(int raster, const dmat2& linear, dvec2 centre) {
    return {raster, raster, {linear[0], linear[1], dvec2(raster * 0.5) - linear * centre}};
}

Raster difference(const Raster& a, const Raster& b) {
    Raster result(a.width, a.height);
    std::ranges::transform(a.rgba, b.rgba, result.rgba.begin(), std::minus());
    return result;
}

double rms(const Raster& raster) {
    double sum = 0;
    for (const float v : raster.rgba)
        sum += double(v) * v;
    return 255 * std::sqrt(sum / double(raster.rgba.size()));
}

/// What a frame centred on the same point shows after it has grown by `factor`: nearest pixels.
Raster grown(const Raster& frame, double factor) {
    Raster result(frame.width, frame.height);
    const double centre = frame.width * 0.5;
    const auto from = [&](int i) {
        return std::clamp(int(std::floor(centre + (i + 0.5 - centre) / factor)), 0, frame.width - 1);
    };
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            std::copy_n(frame.pixel(from(x), from(y)), 4, result.pixel(x, y));
    return result;
}

/// The pixel nearest the middle that differs from its neighbours, as an offset from the middle.
dvec2 nearestEdge(const Raster& raster) {
    const auto differs = [&](int x, int y) {
        const float *p = raster.pixel(x, y), *right = raster.pixel(x + 1, y), *below = raster.pixel(x, y + 1);
        double maximum = 0;
        for (int c = 0; c < 4; ++c)
            maximum =
                std::max({maximum, std::abs(double(p[c]) - right[c]), std::abs(double(p[c]) - below[c])});
        return maximum > 0.15;
    };
    dvec2 nearest(0);
    double distance = raster.width;
    for (int y = 0; y + 1 < raster.height; ++y)
        for (int x = 0; x + 1 < raster.width; ++x) {
            const dvec2 offset = dvec2(x + 0.5, y + 0.5) - raster.width * 0.5;
            if (glm::length(offset) < distance && differs(x, y)) {
                nearest = offset;
                distance = glm::length(offset);
            }
        }
    return nearest;
}

/// A point on an outline, to a fraction of a pixel of the largest picture.
dvec2 pointOnOutline(dvec2 picture, double largest, const Draw& exact) {
    dvec2 point = picture * dvec2(0.43, 0.41);
    for (double pixels = 64; pixels <= 2 * largest; pixels *= 4) {
        const double zoom = pixels / std::max(picture.x, picture.y);
        point += nearestEdge(exact(centred(64, dmat2(zoom), point))) / zoom;
    }
    return point;
}

double contrastOf(const Raster& raster) {
    double maximum = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        float low = 1, high = 0;
        for (std::size_t i = c; i < raster.rgba.size(); i += 4) {
            low = std::min(low, raster.rgba[i]);
            high = std::max(high, raster.rgba[i]);
        }
        maximum = std::max(maximum, double(high) - low);
    }
    return maximum;
}

}  // namespace

asset::View turned(dvec2 picture, int raster, double pixels, double angle) {
    const double zoom = pixels / std::max(picture.x, picture.y);
    return centred(raster, rotation(angle) * zoom, picture * 0.5);
}

asset::View stretched(dvec2 picture, int raster, double pixels, double ratio, double angle, double axis) {
    const dmat2 shrink(1 / ratio, 0, 0, 1);
    const dmat2 linear = rotation(axis) * shrink * rotation(angle) * (pixels / picture.x);
    return centred(raster, linear, picture * 0.5);
}

/// With z = y + horizon, s = 1/2 + b (x - width/2) / z and t = a / z: a pixel spans b / z of s and a / z² of
/// t.
glm::dmat3 Floor::toPicture(int samples) const {
    const double b = 0.9 / width * (horizon + height), a = b * ratio * horizon, k = samples;
    return {{b / k, 0, 0}, {0.5 / k, 0, 1 / k}, {0.5 * horizon - b * width / 2, a, horizon}};
}

bool hasPrograms(const asset::Asset& asset) { return std::ranges::any_of(asset.paints, asset::isProgram); }

Raster exactMeans(const asset::Asset& asset, const asset::View& view) {
    constexpr int finer = 4;
    if (!hasPrograms(asset))
        return asset::evaluate(asset, view);
    return averaged(
        asset::evaluate(asset, {view.width * finer, view.height * finer, view.toPixels * double(finer)}),
        finer);
}

Raster averaged(const Raster& raster, int k) {
    Raster result(raster.width / k, raster.height / k);
    for (int y = 0; y < result.height * k; ++y)
        for (int x = 0; x < result.width * k; ++x)
            for (int c = 0; c < 4; ++c)
                result.pixel(x / k, y / k)[c] += raster.pixel(x, y)[c] / float(k * k);
    return result;
}

std::vector<ZoomFrame> zoomed(dvec2 picture, const Draw& texture, const Draw& exact) {
    constexpr int raster = 96, stepsPerOctave = 8;
    constexpr double from = 16, to = 65536, angle = 0.3;
    const dvec2 point = pointOnOutline(picture, to, exact);
    std::vector<ZoomFrame> frames;
    Raster before(raster, raster);
    for (int step = 0; from * std::exp2(double(step) / stepsPerOctave) <= to; ++step) {
        const double pixels = from * std::exp2(double(step) / stepsPerOctave);
        const asset::View view =
            centred(raster, rotation(angle) * (pixels / std::max(picture.x, picture.y)), point);
        const Raster truth = exact(view), error = difference(texture(view), truth);
        const double change =
            step == 0 ? 0 : rms(difference(error, grown(before, std::exp2(1.0 / stepsPerOctave))));
        frames.push_back({pixels, rms(error), contrastOf(truth), change});
        before = error;
    }
    return frames;
}

}  // namespace vtm::cases
