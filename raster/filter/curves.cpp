#include "raster/filter/curves.hpp"

namespace vtm::asset {

Curve::Curve(double (*function)(double)) {
    for (std::size_t i = 0; i < table_.size(); ++i) {
        const double root = double(i) / double(steps);
        table_[i] = float(function(root * root));
    }
}

const Curve& decodingCurve() {
    static const Curve curve(
        [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); });
    return curve;
}

const Curve& encodingCurve() {
    static const Curve curve(
        [](double x) { return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055; });
    return curve;
}

}  // namespace vtm::asset
