#include <vtm/raster/view.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

namespace vtm::asset {

void validate(const View& view) {
    if (view.width < 0 || view.height < 0 || view.width > maxViewSide || view.height > maxViewSide ||
        static_cast<long long>(view.width) * view.height > maxViewPixels)
        throw std::length_error("view: raster of " + std::to_string(view.width) + " x " +
                                std::to_string(view.height) + " pixels exceeds the limits");
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 2; ++row)
            if (!(std::abs(view.toPixels[column][row]) <= maxViewNumber))
                throw std::length_error("view: a coefficient of its matrix exceeds the limit");
}

}  // namespace vtm::asset
