#include "trace/src/palette.hpp"
#include <vtm/limits/limits.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace vtm::trace {
namespace {

using glm::dmat3;
using glm::dvec3;

// ---- OKLab ------------------------------------------------------------------------------------

double toLinear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double fromLinear(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

/// Linear sRGB to cone responses, and their cube roots to lightness and two opponent axes; by rows, as
/// published.
const dmat3 toCones = glm::transpose(dmat3(0.4122214708, 0.5363325363, 0.0514459929,  //
                                           0.2119034982, 0.6806995451, 0.1073969566,  //
                                           0.0883024619, 0.2817188376, 0.6299787005));
const dmat3 toLab = glm::transpose(dmat3(0.2104542553, 0.7936177850, -0.0040720468,  //
                                         1.9779984951, -2.4285922050, 0.4505937099,  //
                                         0.0259040371, 0.7827717662, -0.8086757660));

dvec3 labOf(const Rgb& c) {
    const dvec3 linear{toLinear(c[0] / 255.0), toLinear(c[1] / 255.0), toLinear(c[2] / 255.0)};
    const dvec3 cones = toCones * linear;
    return toLab * dvec3(std::cbrt(cones.x), std::cbrt(cones.y), std::cbrt(cones.z));
}

Rgb rgbOf(const dvec3& lab) {
    const dvec3 roots = glm::inverse(toLab) * lab;
    const dvec3 linear = glm::inverse(toCones) * (roots * roots * roots);
    Rgb rgb;
    for (int i = 0; i < 3; ++i)
        rgb[std::size_t(i)] = std::uint8_t(std::lround(255 * std::clamp(fromLinear(linear[i]), 0.0, 1.0)));
    return rgb;
}

// ---- clusters ---------------------------------------------------------------------------------

/// A colour of the picture and how many pixels have it.
struct Sample {
    Rgb rgb;
    dvec3 lab;
    double weight;
};

std::uint32_t keyOf(const std::uint8_t* p) { return p[0] | p[1] << 8 | p[2] << 16; }

std::vector<Sample> samplesOf(const image::Bitmap& bitmap) {
    std::unordered_map<std::uint32_t, std::size_t> places;
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < bitmap.rgba.size(); i += 4) {
        const std::uint8_t* p = &bitmap.rgba[i];
        if (p[3] < minAlpha)
            continue;
        const auto [place, isNew] = places.try_emplace(keyOf(p), samples.size());
        if (isNew)
            samples.push_back({{p[0], p[1], p[2]}, labOf({p[0], p[1], p[2]}), 0});
        ++samples[place->second].weight;
    }
    return samples;
}

/// Part of the samples, and how far they lie apart.
struct Box {
    std::span<Sample> samples;
    dvec3 mean{0}, variance{0};  ///< the variance not divided by the weight

    explicit Box(std::span<Sample> inside) : samples(inside) {
        double weight = 0;
        for (const Sample& s : samples)
            mean += s.weight * s.lab, weight += s.weight;
        mean /= weight;
        for (const Sample& s : samples)
            variance += s.weight * (s.lab - mean) * (s.lab - mean);
    }
    int widestAxis() const {
        const int axis = variance.y > variance.x ? 1 : 0;
        return variance.z > variance[axis] ? 2 : axis;
    }
    double spread() const { return variance[widestAxis()]; }
};

/// Boxes are cut at their mean, across the axis on which they vary most, the widest box first.
std::vector<dvec3> medianCut(std::vector<Sample>& samples, int count) {
    std::vector<Box> boxes{Box(samples)};
    while (int(boxes.size()) < count) {
        const auto widest = std::ranges::max_element(boxes, {}, &Box::spread);
        const int axis = widest->widestAxis();
        const double at = widest->mean[axis];
        const std::span<Sample> inside = widest->samples;
        const auto upper =
            std::partition(inside.begin(), inside.end(), [&](const Sample& s) { return s.lab[axis] < at; });
        const auto below = std::size_t(upper - inside.begin());
        if (below == 0 || below == inside.size())
            break;
        *widest = Box(inside.first(below));
        boxes.push_back(Box(inside.subspan(below)));
    }
    std::vector<dvec3> centres;
    for (const Box& box : boxes)
        centres.push_back(box.mean);
    return centres;
}

std::size_t nearest(const std::vector<dvec3>& centres, const dvec3& lab) {
    std::size_t best = 0;
    double minimum = HUGE_VAL;
    for (std::size_t i = 0; i < centres.size(); ++i)
        if (const dvec3 d = centres[i] - lab; glm::dot(d, d) < minimum)
            minimum = glm::dot(d, d), best = i;
    return best;
}

/// Rounds of k-means; more change little.
constexpr int rounds = 16;

void improve(std::vector<dvec3>& centres, const std::vector<Sample>& samples) {
    for (int round = 0; round < rounds; ++round) {
        limits::check();
        std::vector<dvec3> sums(centres.size(), dvec3(0));
        std::vector<double> weights(centres.size());
        for (const Sample& s : samples) {
            const std::size_t k = nearest(centres, s.lab);
            sums[k] += s.weight * s.lab;
            weights[k] += s.weight;
        }
        for (std::size_t k = 0; k < centres.size(); ++k)
            if (weights[k] > 0)
                centres[k] = sums[k] / weights[k];
    }
}

}  // namespace

Palette quantise(const image::Bitmap& bitmap, int count) {
    Palette palette;
    std::vector<Sample> samples = samplesOf(bitmap);
    if (samples.empty()) {
        palette.indices.assign(bitmap.rgba.size() / 4, -1);
        return palette;
    }
    std::vector<dvec3> centres = medianCut(samples, count);
    improve(centres, samples);
    std::ranges::sort(centres, std::ranges::greater(), &dvec3::x);  // by lightness

    std::unordered_map<std::uint32_t, int> indices;
    std::vector<int> places(centres.size(), -1);
    for (const Sample& s : samples)
        indices[keyOf(s.rgb.data())] = int(nearest(centres, s.lab));
    for (const auto& [key, index] : indices)
        places[std::size_t(index)] = 0;
    for (std::size_t k = 0; k < centres.size(); ++k)  // only those that a pixel has
        if (places[k] == 0) {
            places[k] = int(palette.colors.size());
            palette.colors.push_back(rgbOf(centres[k]));
        }
    for (std::size_t i = 0; i < bitmap.rgba.size(); i += 4) {
        const std::uint8_t* p = &bitmap.rgba[i];
        palette.indices.push_back(p[3] < minAlpha ? -1 : places[std::size_t(indices[keyOf(p)])]);
    }
    return palette;
}

}  // namespace vtm::trace
