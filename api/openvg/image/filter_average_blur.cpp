// VG_KHR_iterative_average_blur.

#include <cmath>
#include <vector>

#include <VG/vgext.h>

#include "api/openvg/image/filter_images.hpp"

using namespace vtm::openvg;

namespace {

/// A mean over a window, taken again and again, of lines of colours.
class Averages {
public:
    /// A window of a pixel or less changes nothing.
    Averages(double window, unsigned passes) : window_(window), passes_(window > 1 ? int(passes) : 0) {
        const double radius = (window - 1) / 2;
        reach_ = int(1 + radius);
        edge_ = radius - std::floor(radius);
    }

    /// What of the line's other pixels counts, to either side.
    int margin() const { return passes_ * reach_; }

    /// Takes a line with its margins, gives it without.
    const std::vector<glm::dvec4>& of(std::vector<glm::dvec4>& line) {
        for (int i = 0; i < passes_; ++i)
            pass(line);
        return line;
    }

private:
    /// All pixels less than reach_ away count in full, those at reach_ by edge_: the sum rolls from pixel to
    /// pixel.
    void pass(std::vector<glm::dvec4>& line) {
        const auto reach = std::size_t(reach_);
        means_.clear();
        glm::dvec4 sum = edge_ * line[0];
        for (std::size_t i = 1; i < 2 * reach; ++i)
            sum += line[i];
        sum += edge_ * line[2 * reach];
        for (std::size_t x = reach;; ++x) {
            means_.push_back(sum / window_);
            if (x + reach + 1 == line.size())
                break;
            sum += (1 - edge_) * (line[x + reach] - line[x - reach + 1]) +
                   edge_ * (line[x + reach + 1] - line[x - reach]);
        }
        line.swap(means_);
    }

    double window_;
    int passes_, reach_;
    double edge_;
    std::vector<glm::dvec4> means_;
};

bool isWindow(VGfloat size) { return size >= 0 && size <= VGfloat(maxAverageBlurDimension); }

}  // namespace

void vgIterativeAverageBlurKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY, VGuint iterative,
                               VGTilingMode tilingMode) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        require(isTiling(tilingMode));
        require(isWindow(dimX) && isWindow(dimY) && iterative <= VGuint(maxAverageBlurIterations));
        const ColorSpace space = filterSpace(context.state);
        const Raster source = normalized(*images.src, space);
        const Color fill = tileFillColor(context.state, space);
        Averages across(double(dimX), iterative), up(double(dimY), iterative);
        std::vector<glm::dvec4> line;

        Raster rows(images.width(), source.height);
        for (int y = 0; y < rows.height; ++y) {
            line.clear();
            for (int x = -across.margin(); x < rows.width + across.margin(); ++x) {
                const int i = tiled(x, source.width, tilingMode);
                line.emplace_back(i < 0 ? fill : source.at(i, y));
            }
            const std::vector<glm::dvec4>& means = across.of(line);
            for (int x = 0; x < rows.width; ++x)
                rows.at(x, y) = Color(means[std::size_t(x)]);
        }
        const int height = images.height();
        Raster result(rows.width, height);
        for (int x = 0; x < rows.width; ++x) {
            line.clear();
            for (int y = -up.margin(); y < height + up.margin(); ++y) {
                const int j = tiled(y, source.height, tilingMode);
                line.emplace_back(j < 0 ? fill : rows.at(x, j));  // rows of the fill colour have it as mean
            }
            const std::vector<glm::dvec4>& means = up.of(line);
            for (int y = 0; y < height; ++y)
                result.at(x, y) = Color(means[std::size_t(y)]);
        }
        for (int y = 0; y < height; ++y)
            writeFilteredRow(context.state, *images.dst, y, result.row(y), space);
    });
}
