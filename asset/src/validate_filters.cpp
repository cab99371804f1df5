// Filters: what a renderer may rely on when it runs them.

#include <algorithm>
#include <bit>
#include <cmath>

#include "asset/filters.hpp"
#include "asset/src/validate.hpp"

namespace vtm::asset {

namespace {

/// Largest magnitude of a filter's numbers: they stay finite in products with a view's.
constexpr double largestNumber = 0x1p60;
constexpr float largestParameter = 0x1p60f;

bool isBox(const std::array<double, 4>& box) {
    return std::ranges::all_of(box, [](double v) { return std::abs(v) <= largestNumber; }) &&
           box[0] <= box[2] && box[1] <= box[3];
}

/// The parameters of one primitive, checked one after the other.
class Checked {
public:
    Checked(const AssetView& asset, const FilterPrimitive& primitive, std::size_t index)
        : parameters_(parametersOf(asset, primitive)), index_(index) {}

    float number() {
        check(next_ < parameters_.size(), "has too few parameters");
        const float value = parameters_[next_++];
        check(std::abs(value) <= largestParameter, "parameter is out of range");
        return value;
    }
    float atLeast(float least) {
        const float value = number();
        check(value >= least, "parameter is too small");
        return value;
    }
    std::size_t count(std::size_t largest) {
        const float value = number();
        check(value >= 0 && value <= float(largest) && value == std::floor(value),
              "parameter is not one of its numbers");
        return std::size_t(value);
    }
    void numbers(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            number();
    }
    void color(int channels) {
        for (int i = 0; i < channels; ++i)
            check(isShare(number()), "colour is out of range");
    }
    std::size_t left() const { return parameters_.size() - next_; }
    void end() const { check(left() == 0, "has too many parameters"); }
    void check(bool holds, const char* fault) const { require(holds, "filter primitives", index_, fault); }

private:
    const FilterParameters parameters_;
    const std::size_t index_;
    std::size_t next_ = 0;
};

void validateTransfer(Checked& in) {
    for (int channel = 0; channel < 4; ++channel) {
        const auto kind = TransferKind(in.count(std::size_t(TransferKind::Gamma)));
        const std::size_t values = in.count(in.left());
        in.check(kind != TransferKind::Linear || values == 2, "has too few parameters");
        in.check(kind != TransferKind::Gamma || values == 3, "has too few parameters");
        in.numbers(values);
    }
}

void validateKernel(Checked& in) {
    const std::size_t columns = in.count(maxKernel), rows = in.count(maxKernel);
    in.check(columns > 0 && rows > 0 && columns * rows <= maxKernel, "kernel is too large or empty");
    in.check(in.count(maxKernel) < columns && in.count(maxKernel) < rows, "target is not in the kernel");
    in.check(in.number() != 0, "divisor is zero");
    in.number();
    in.count(std::size_t(FilterEdge::None));
    in.count(1);
    in.numbers(columns * rows);
}

void validateLighting(Checked& in) {
    in.count(1);
    in.number();
    in.atLeast(0);
    in.number();
    in.color(3);
    in.count(std::size_t(LightKind::Spot));
    in.numbers(8);
}

void validateParameters(const AssetView& asset, const Filter& filter, const FilterPrimitive& primitive,
                        std::size_t index) {
    Checked in(asset, primitive, index);
    switch (primitive.op) {
        case FilterOp::Blend:
            in.count(std::size_t(Blend::PlusLighter));
            break;
        case FilterOp::ColorMatrix:
            in.numbers(20);
            break;
        case FilterOp::ComponentTransfer:
            validateTransfer(in);
            break;
        case FilterOp::Composite:
            in.count(std::size_t(CompositeOp::Arithmetic));
            in.numbers(4);
            break;
        case FilterOp::ConvolveMatrix:
            validateKernel(in);
            break;
        case FilterOp::Lighting:
            validateLighting(in);
            break;
        case FilterOp::DisplacementMap:
            in.number();
            in.count(3);
            in.count(3);
            break;
        case FilterOp::DropShadow:
            in.numbers(2);
            in.atLeast(0);
            in.atLeast(0);
            in.color(4);
            break;
        case FilterOp::Flood:
            in.color(4);
            break;
        case FilterOp::GaussianBlur:
            in.atLeast(0);
            in.atLeast(0);
            break;
        case FilterOp::Picture:
            in.check(in.count(maxPictures) < filter.pictures, "refers to a missing picture");
            break;
        case FilterOp::Morphology:
            in.atLeast(0);
            in.atLeast(0);
            in.count(1);
            break;
        case FilterOp::Offset:
            in.numbers(2);
            break;
        case FilterOp::Turbulence:
            in.atLeast(0);
            in.atLeast(0);
            in.count(maxOctaves);
            in.number();
            in.count(1);
            in.count(1);
            break;
        case FilterOp::Merge:
        case FilterOp::Tile:
            break;
    }
    in.end();
}

/// How many inputs an operation has; Merge may have any number.
bool isInputCount(FilterOp op, std::uint32_t inputs) {
    switch (op) {
        case FilterOp::Merge:
            return true;
        case FilterOp::Flood:
        case FilterOp::Picture:
        case FilterOp::Turbulence:
            return inputs == 0;
        case FilterOp::Blend:
        case FilterOp::Composite:
        case FilterOp::DisplacementMap:
            return inputs == 2;
        default:
            return inputs == 1;
    }
}

/// `number`: of the primitive in its filter. `nextWord`: where its words must begin; moved behind them.
void validatePrimitive(const AssetView& asset, const Filter& filter, std::uint32_t number,
                       std::size_t& nextWord) {
    const std::size_t index = std::size_t(filter.firstPrimitive) + number;
    const FilterPrimitive& primitive = asset.filterPrimitives[index];
    const auto check = [&](bool holds, const char* fault) {
        require(holds, "filter primitives", index, fault);
    };
    check(primitive.op <= FilterOp::Turbulence, "operation is unknown");
    check(primitive.linear <= 1, "colour space is unknown");
    check(primitive.unused == 0, "unused word is not zero");
    check(isBox(primitive.region), "region is out of range");
    const std::size_t words = asset.filterWords.size();
    check(primitive.firstWord == nextWord && primitive.inputs <= words - primitive.firstWord &&
              primitive.parameters <= words - primitive.firstWord - primitive.inputs,
          "words do not follow those of the primitive before");
    nextWord += std::size_t(primitive.inputs) + primitive.parameters;
    check(isInputCount(primitive.op, primitive.inputs), "has the wrong number of inputs");
    for (const std::uint32_t input : inputsOf(asset, primitive))
        check(input < firstResult + number, "reads the result of a later primitive");
    validateParameters(asset, filter, primitive, index);
}

}  // namespace

/// Nothing is shared, so that the work is that of the file's length.
void validateFilters(const AssetView& asset) {
    std::size_t nextPrimitive = 0, nextWord = 0;
    for (std::size_t i = 0; i < asset.filters.size(); ++i) {
        const Filter& filter = asset.filters[i];
        const auto check = [&](bool holds, const char* fault) { require(holds, "filters", i, fault); };
        check(std::ranges::all_of(filter.matrix, [](double v) { return std::abs(v) <= largestNumber; }),
              "matrix is out of range");
        check(isBox(filter.region), "region is out of range");
        check(filter.unused == 0, "unused word is not zero");
        check(filter.pictures >= 1 && filter.pictures < maxPictures, "number of pictures is out of range");
        check(filter.primitives >= 1 && filter.primitives <= maxFilterPrimitives &&
                  filter.firstPrimitive == nextPrimitive &&
                  filter.primitives <= asset.filterPrimitives.size() - nextPrimitive,
              "primitives do not follow those of the filter before");
        for (std::uint32_t p = 0; p < filter.primitives; ++p)
            validatePrimitive(asset, filter, p, nextWord);
        nextPrimitive += filter.primitives;
    }
    require(nextPrimitive == asset.filterPrimitives.size(), "filter primitives", nextPrimitive,
            "is in no filter");
    require(nextWord == asset.filterWords.size(), "filter words", nextWord, "is in no primitive");
}

}  // namespace vtm::asset
