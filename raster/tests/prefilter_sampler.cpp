#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "raster/testing_prefilter.hpp"

namespace vtm::asset {

namespace {

using glm::ivec2;
using glm::vec2;
using glm::vec4;

int wrapped(int i, int size, Wrap wrap) {
    if (wrap == Wrap::Clamp)
        return std::clamp(i, 0, size - 1);
    if (wrap == Wrap::Border)
        return i;
    const int period = wrap == Wrap::Mirror ? 2 * size : size, within = (i % period + period) % period;
    return within < size ? within : period - 1 - within;
}

class Pyramid {
public:
    Pyramid(const PrefilterView& prefilter, Wrap wrap) : prefilter_(prefilter), wrap_(wrap) {
        for (unsigned l = 0; l <= prefilter.size.levels(); ++l)
            first_.push_back(prefilter.size.texelsBefore(l));
    }

    /// Bilinear in two levels, linear between them.
    vec4 trilinear(vec2 st, float lod) const {
        const float last = float(prefilter_.size.levels() - 1);
        const float clamped = std::clamp(lod, 0.0f, last);
        const float fine = std::floor(clamped);
        const vec4 color = bilinear(st, unsigned(fine));
        return clamped == fine ? color : glm::mix(color, bilinear(st, unsigned(fine) + 1), clamped - fine);
    }

private:
    vec4 bilinear(vec2 st, unsigned level) const {
        const PyramidSize size = prefilter_.size.level(level);
        const vec2 extent(size.width, size.height);
        if (wrap_ == Wrap::Repeat)
            st -= glm::floor(st);
        if (wrap_ == Wrap::Mirror)
            st = 1.0f - glm::abs(1.0f - (st - 2.0f * glm::floor(0.5f * st)));
        // Keeps the conversion to int defined, for what is not a number too.
        const vec2 p(std::fmax(-2.0f, std::fmin(st.x * extent.x - 0.5f, extent.x + 1)),
                     std::fmax(-2.0f, std::fmin(st.y * extent.y - 0.5f, extent.y + 1)));
        const vec2 corner = glm::floor(p), f = p - corner;
        const ivec2 i(corner);
        return glm::mix(glm::mix(texel(level, size, i), texel(level, size, i + ivec2(1, 0)), f.x),
                        glm::mix(texel(level, size, i + ivec2(0, 1)), texel(level, size, i + 1), f.x), f.y);
    }

    vec4 texel(unsigned level, PyramidSize size, ivec2 i) const {
        const int width = int(size.width), height = int(size.height);
        i = {wrapped(i.x, width, wrap_), wrapped(i.y, height, wrap_)};
        if (i.x < 0 || i.y < 0 || i.x >= width || i.y >= height)
            return vec4(0);
        const Rgba8& t = prefilter_.texels[first_[level] + std::size_t(i.y) * size.width + std::size_t(i.x)];
        return vec4(t[0], t[1], t[2], t[3]) / 255.0f;
    }

    const PrefilterView& prefilter_;
    Wrap wrap_;
    std::vector<std::size_t> first_;
};

/// Taps along one axis of the footprint: `count` of them, `spacing` axes apart.
struct Taps {
    int count;
    float spacing;

    float at(int i) const { return (float(i) - 0.5f * float(count - 1)) * spacing; }
};

/// A box of length L has the second moment L²/12. Taps d apart have d² (n² - 1)/12; texels of width h add
/// h²/12 and the linear interpolation between them h²/6. Evenly spaced, d = L/n, the filter is wider than
/// the footprint and blurs; with d² (n² - 1) = L² - 3 h² it has the footprint's moment, but tails for it.
/// Halfway, L² - 2 h², is the best of the three (docs/prefilter.md).
Taps tapsOver(float length, int count, float texel) {
    const float left = length * length - 2 * texel * texel;
    return {count, left > 0 && count > 1 ? std::sqrt(left / float(count * count - 1)) / length : 0};
}

/// A footprint in texels of the base, cut into sub-footprints across its longer side.
struct Footprint {
    float u, v;                ///< lengths of its sides
    int across = 1, down = 1;  ///< sub-footprints along u, along v

    Footprint(const glm::mat2& sides, PyramidSize base)
        : u(glm::length(sides[0] * vec2(base.width, base.height))),
          v(glm::length(sides[1] * vec2(base.width, base.height))) {
        if (u > v)
            across = partsOf(u / v);
        else if (v > u)
            down = partsOf(v / u);
    }
    /// Longer side of a sub-footprint.
    float side() const { return std::max(u / float(across), v / float(down)); }

private:
    static int partsOf(float ratio) { return int(std::min(std::round(ratio), float(maxAnisotropy))); }
};

int tapsOf(Minification filter) {
    return filter == Minification::Trilinear ? 1 : filter == Minification::Taps2 ? 2 : 4;
}

}  // namespace

vec4 samplePrefilter(const AssetView& asset, vec2 st, const glm::mat2& footprint, Minification filter,
                     Wrap wrap) {
    if (asset.prefilter.size.empty())
        return vec4(0);
    const Pyramid pyramid(asset.prefilter, wrap);
    const Footprint texels(footprint, asset.prefilter.size);
    const int nu = tapsOf(filter) * texels.across, nv = tapsOf(filter) * texels.down;
    const float level = std::max(0.0f, std::log2(texels.side() / float(tapsOf(filter))));
    const float lod = filter == Minification::Trilinear ? level : std::floor(level + 0.2f);
    const Taps across = tapsOver(texels.u, nu, std::exp2(lod)), down = tapsOver(texels.v, nv, std::exp2(lod));
    vec4 sum(0);
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i)
            sum += pyramid.trilinear(st + across.at(i) * footprint[0] + down.at(j) * footprint[1], lod);
    return sum / float(nu * nv);
}

float prefilterShare(const AssetView& asset, const glm::mat2& footprint) {
    if (asset.prefilter.size.empty())
        return 0;
    const float octaves = std::log2(Footprint(footprint, asset.prefilter.size).side() / fadeFrom);
    return std::clamp(std::max(0.0f, octaves) / std::log2(fadeTo / fadeFrom), 0.0f, 1.0f);
}

}  // namespace vtm::asset
