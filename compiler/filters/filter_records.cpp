#include "compiler/filters/filter_records.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <vtm/scene/scene.hpp>
#include "asset/filters.hpp"

namespace vtm::compiler {
namespace {

using asset::FilterOp;

/// Largest magnitude of what is stored; beyond it nothing can be seen.
constexpr double largestNumber = 0x1p60;

double bounded(double v) { return std::clamp(v, -largestNumber, largestNumber); }

class Words {
public:
    explicit Words(std::vector<std::uint32_t>& words) : words_(words) {}

    void number(double v) { words_.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(bounded(v)))); }
    template <class... Numbers>
    void numbers(Numbers... values) {
        (number(double(values)), ...);
    }
    template <class Range>
    void list(const Range& values) {
        for (const float v : values)
            number(double(v));
    }
    void color(const scene::Color& c) { numbers(c.r, c.g, c.b); }

private:
    std::vector<std::uint32_t>& words_;
};

/// Stores the parameters of an operation and returns what it is.
class OperationWriter {
public:
    /// `pictures`: before this one; counted on.
    OperationWriter(Words words, std::uint32_t& pictures) : words_(words), pictures_(pictures) {}

    FilterOp operator()(const scene::BlendFilter& f) {
        words_.numbers(int(f.mode));
        return FilterOp::Blend;
    }
    FilterOp operator()(const scene::ColorMatrixFilter& f) {
        words_.list(f.matrix);
        return FilterOp::ColorMatrix;
    }
    FilterOp operator()(const scene::ComponentTransferFilter& f) {
        for (const scene::TransferFunction& function : f.functions) {
            words_.numbers(int(function.kind), function.values.size());
            words_.list(function.values);
        }
        return FilterOp::ComponentTransfer;
    }
    FilterOp operator()(const scene::CompositeFilter& f) {
        words_.numbers(int(f.op));
        words_.list(f.k);
        return FilterOp::Composite;
    }
    FilterOp operator()(const scene::ConvolveMatrixFilter& f) {
        words_.numbers(f.columns, f.rows, f.targetX, f.targetY, f.divisor, f.bias, int(f.edge),
                       int(f.preserveAlpha));
        words_.list(f.kernel);
        return FilterOp::ConvolveMatrix;
    }
    FilterOp operator()(const scene::LightingFilter& f) {
        words_.numbers(int(f.specular), f.surfaceScale, f.constant, f.exponent);
        words_.color(f.color);
        words_.numbers(f.light.index());
        std::visit([&](const auto& light) { this->light(light); }, f.light);
        return FilterOp::Lighting;
    }
    FilterOp operator()(const scene::DisplacementMapFilter& f) {
        words_.numbers(f.scale, int(f.x), int(f.y));
        return FilterOp::DisplacementMap;
    }
    FilterOp operator()(const scene::DropShadowFilter& f) {
        words_.numbers(f.dx, f.dy, f.deviationX, f.deviationY);
        words_.color(f.color);
        words_.numbers(f.color.a);
        return FilterOp::DropShadow;
    }
    FilterOp operator()(const scene::FloodFilter& f) {
        words_.color(f.color);
        words_.numbers(f.color.a);
        return FilterOp::Flood;
    }
    FilterOp operator()(const scene::GaussianBlurFilter& f) {
        words_.numbers(f.deviationX, f.deviationY);
        return FilterOp::GaussianBlur;
    }
    FilterOp operator()(const scene::PictureFilter&) {
        words_.numbers(pictures_++);
        return FilterOp::Picture;
    }
    FilterOp operator()(const scene::MergeFilter&) { return FilterOp::Merge; }
    FilterOp operator()(const scene::MorphologyFilter& f) {
        words_.numbers(f.radiusX, f.radiusY, int(f.dilate));
        return FilterOp::Morphology;
    }
    FilterOp operator()(const scene::OffsetFilter& f) {
        words_.numbers(f.dx, f.dy);
        return FilterOp::Offset;
    }
    FilterOp operator()(const scene::TileFilter&) { return FilterOp::Tile; }
    FilterOp operator()(const scene::TurbulenceFilter& f) {
        words_.numbers(f.frequencyX, f.frequencyY, f.octaves, f.seed, int(f.stitch), int(f.fractalNoise));
        return FilterOp::Turbulence;
    }

private:
    void light(const scene::DistantLight& l) { words_.numbers(l.azimuth, l.elevation, 0, 0, 0, 0, 0, 0); }
    void light(const scene::PointLight& l) {
        words_.list(l.position);
        words_.numbers(0, 0, 0, 0, 0);
    }
    void light(const scene::SpotLight& l) {
        words_.list(l.position);
        words_.list(l.pointsAt);
        words_.numbers(l.exponent, l.coneAngle);
    }

    Words words_;
    std::uint32_t& pictures_;
};

std::array<double, 4> box(scene::Point min, scene::Point max) {
    return {bounded(min.x), bounded(min.y), bounded(max.x), bounded(max.y)};
}

std::uint32_t inputWord(const scene::FilterInput& input) {
    switch (input.kind) {
        case scene::FilterInput::Kind::SourceGraphic:
            return asset::sourceGraphic;
        case scene::FilterInput::Kind::SourceAlpha:
            return asset::sourceAlpha;
        case scene::FilterInput::Kind::Result:
            break;
    }
    return asset::firstResult + static_cast<std::uint32_t>(input.result);
}

}  // namespace

std::uint32_t appendFilter(const scene::Filter& filter, const scene::Affine& toPicture, asset::Asset& asset) {
    asset::Filter record;
    const scene::Affine m = scene::compose(toPicture, filter.transform);
    record.matrix = {bounded(m[0].x), bounded(m[0].y), bounded(m[1].x),
                     bounded(m[1].y), bounded(m[2].x), bounded(m[2].y)};
    record.region = box(filter.min, filter.max);
    record.firstPrimitive = static_cast<std::uint32_t>(asset.filterPrimitives.size());
    record.primitives = static_cast<std::uint32_t>(filter.primitives.size());
    for (const scene::FilterPrimitive& primitive : filter.primitives) {
        asset::FilterPrimitive stored;
        stored.linear = primitive.linear ? 1 : 0;
        stored.region = box(primitive.min, primitive.max);
        stored.firstWord = static_cast<std::uint32_t>(asset.filterWords.size());
        for (const scene::FilterInput& input : primitive.inputs)
            asset.filterWords.push_back(inputWord(input));
        stored.inputs = static_cast<std::uint32_t>(primitive.inputs.size());
        stored.op =
            std::visit(OperationWriter(Words(asset.filterWords), record.pictures), primitive.operation);
        stored.parameters =
            static_cast<std::uint32_t>(asset.filterWords.size()) - stored.firstWord - stored.inputs;
        asset.filterPrimitives.push_back(stored);
    }
    asset.filters.push_back(record);
    return static_cast<std::uint32_t>(asset.filters.size() - 1);
}

}  // namespace vtm::compiler
