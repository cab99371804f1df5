#include "api/openvg/gl/filters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "api/openvg/gl/layer_blocks.hpp"
#include "api/openvg/gl/texture_copy.hpp"

namespace vtm::openvg::gl {

namespace {

using Filter = ProgramKey::Filter;

/// Where absolute weights sum up to this, at most 1024 floats of [0, 1] are summed within 100 · 2^-24 ·
/// √1024, a twentieth of a 255th, of the sum in doubles.
constexpr double maxWeight = 100;
/// A tenth of a second of a GPU that reads 20 texels in a nanosecond: drivers end what takes seconds.
constexpr double maxFetches = 2e9;

double sumOfSizes(const std::vector<double>& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0,
                           [](double sum, double w) { return sum + std::abs(w); });
}

RampRow rowOf(const std::vector<double>& weights) {
    RampRow row;
    for (const double w : weights)
        row.emplace_back(float(w), 0, 0, 0);
    return row;
}

class FilterDraw {
public:
    FilterDraw(Device& device, Image& to, const Image& from, const ImageFilter& filter)
        : device_(device),
          to_(to),
          from_(from),
          filter_(filter),
          size_(std::min(to.width(), from.width()), std::min(to.height(), from.height())) {}

    bool draw(const MatrixFilter& what) {
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                if (!std::isfinite(what.matrix[c][r]) || !std::isfinite(what.added[r]))
                    return false;
        Draw draw = drawFor(Filter::matrix);
        for (int c = 0; c < 4; ++c)
            draw.block.matrix[c] = what.matrix[c];
        draw.block.added = what.added;
        return setSource(draw) && store(draw, {0, 0});
    }

    bool draw(const TableFilter& what) {
        // Between two entries a rounding would be a step.
        const PixelFormat& format = from_.format();
        const bool hasAlpha = format.alpha.bits != 0;
        if (format.space.linear != filter_.input.linear ||
            (hasAlpha && format.space.premultiplied != filter_.input.premultiplied))
            return false;
        Draw draw = drawFor(what.channel < 0 ? Filter::tables : Filter::table);
        if (what.channel >= 0)
            draw.block.scale[what.channel] = 1;
        const RampRow row(what.entries.begin(), what.entries.end());
        return setSource(draw) && store(draw, {0, 0}, &row);
    }

    bool draw(const SumFilter& what) {
        if (!isWithin(what, sumOfSizes(what.weights), what.weights.size()))
            return false;
        Draw draw = drawFor(Filter::sums);
        setSums(draw, what, what.columns, int(what.weights.size()) / what.columns);
        const RampRow row = rowOf(what.weights);
        return setSource(draw) && store(draw, what.first, &row);
    }

    bool draw(const SeparableFilter& what) {
        const double across = sumOfSizes(what.across);
        if (!device_.abilities().drawsFloats ||
            !isWithin(what, across * sumOfSizes(what.up), what.across.size() + what.up.size()))
            return false;
        // Sums of all rows of the source, from which those up are made.
        const glm::ivec2 size(size_.x, from_.height());
        const TexturePointer sums = device_.makeTexture(GL_RGBA32F, size.x, size.y);
        Draw first = drawFor(Filter::sums);
        first.key.writesSums = true;
        setSums(first, {what.first, what.tiling, what.fill}, int(what.across.size()), 1);
        if (!sums || !setSource(first))
            return false;
        first.target = sums;
        first.block.frame = {size, 0, 0};
        first.block.texels[0].base = {what.first.x, 0, 0, 0};
        const RampRow acrossRow = rowOf(what.across), upRow = rowOf(what.up);
        device_.draw(first, oneTile({0, 0, size.x, size.y}), Color(0), &acrossRow);

        Draw second = drawFor(Filter::sums);
        second.key.readsSums = true;
        setSums(second, what, 1, int(what.up.size()));
        second.texels[0] = sums;
        second.block.texels[0].area = {0, 0, size};
        second.block.texels[0].fill *= float(std::accumulate(what.across.begin(), what.across.end(), 0.0));
        return store(second, {0, what.first.y}, &upRow);
    }

private:
    Draw drawFor(Filter filter) const {
        Draw draw;
        draw.key.task = ProgramKey::Task::filter;
        draw.key.filter = filter;
        draw.block.transform = {filter_.input.linear, filter_.input.premultiplied, filter_.output.linear,
                                filter_.output.premultiplied};
        return draw;
    }

    bool isWithin(const Weighted& what, double weight, std::size_t texels) const {
        return texels <= std::size_t(rampColumns) && weight * std::abs(double(what.scale)) <= maxWeight &&
               std::isfinite(what.bias) && double(texels) * size_.x * from_.height() <= maxFetches;
    }

    static void setSums(Draw& draw, const Weighted& what, int columns, int rows) {
        draw.block.ramp.y = columns;
        draw.block.ramp.z = rows;
        draw.block.scale = glm::vec4(what.scale);
        draw.block.bias = glm::vec4(what.bias);
        draw.block.texels[0].how.x = int(what.tiling);
        draw.block.texels[0].fill = what.fill;
    }

    bool setSource(Draw& draw) const {
        TexelBlock& block = draw.block.texels[0];
        block.area = {from_.area.x0, from_.area.y0, from_.width(), from_.height()};
        block.how.z = !from_.format().space.premultiplied;
        block.levels = levelsOf(from_.format());
        draw.block.conversion.x = from_.format().space.linear;
        draw.texels[0] = readTexture(device_, from_.storage->pixels);
        return draw.texels[0] != nullptr;
    }

    /// Into the image. `first`: from its pixels to the source's first.
    bool store(Draw& draw, glm::ivec2 first, const RampRow* row = nullptr) {
        StoredPixels& pixels = to_.storage->pixels;
        if (!readTexture(device_, pixels))
            return false;
        const Rectangle area{to_.area.x0, to_.area.y0, to_.area.x0 + size_.x, to_.area.y0 + size_.y};
        draw.target = writeTexture(device_, pixels);
        setSurface(draw.block, pixels.format(), pixels.width(), pixels.height());
        draw.block.texels[0].base = {first - glm::ivec2(area.x0, area.y0), 0, 0};
        draw.block.ramp.w = int(filter_.channels);
        draw.key.isMasked = pixels.format().grey.bits == 0 && (filter_.channels & allChannels) != allChannels;
        draw.readsTarget = draw.key.isMasked;
        if (draw.texels[0] == draw.target)
            draw.read = {from_.area, area};
        device_.draw(draw, oneTile(area), Color(0), row);
        return true;
    }

    Device& device_;
    Image& to_;
    const Image& from_;
    const ImageFilter& filter_;
    const glm::ivec2 size_;
};

}  // namespace

bool filterImage(Device& device, Image& to, const Image& from, const ImageFilter& filter) {
    return std::visit([&](const auto& what) { return FilterDraw(device, to, from, filter).draw(what); },
                      filter.arithmetic);
}

}  // namespace vtm::openvg::gl
