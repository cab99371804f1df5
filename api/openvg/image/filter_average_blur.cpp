// VG_KHR_iterative_average_blur.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <VG/vgext.h>

#include "api/openvg/image/filter_images.hpp"

using namespace vtm::openvg;

namespace {

/// A mean over a window, taken again and again, along lines of places with `width` numbers each.
template <std::size_t width>
class Averages {
public:
    using Line = std::vector<std::array<double, width>>;

    /// A window of a pixel or less changes nothing.
    Averages(double window, unsigned passes) : scale_(1 / window), passes_(window > 1 ? int(passes) : 0) {
        const double radius = (window - 1) / 2;
        reach_ = int(1 + radius);
        edge_ = radius - std::floor(radius);
    }

    /// What of the line's other places counts, to either side.
    int margin() const { return passes_ * reach_; }

    /// Takes a line with its margins, leaves it without.
    void apply(Line& line) {
        for (int i = 0; i < passes_; ++i)
            pass(line);
    }

private:
    /// All places less than reach_ away count in full, those at reach_ by edge_: the sum rolls from place to
    /// place.
    void pass(Line& line) {
        const auto reach = std::size_t(reach_), count = line.size() - 2 * reach;
        const double inner = 1 - edge_, edge = edge_, scale = scale_;
        means_.resize(count);
        std::array<double, width> sum;
        for (std::size_t c = 0; c < width; ++c)
            sum[c] = edge * (line[0][c] + line[2 * reach][c]);
        for (std::size_t i = 1; i < 2 * reach; ++i)
            for (std::size_t c = 0; c < width; ++c)
                sum[c] += line[i][c];
        for (std::size_t x = 0;; ++x) {
            for (std::size_t c = 0; c < width; ++c)
                means_[x][c] = sum[c] * scale;
            if (x + 1 == count)
                break;
            const auto *outOf = &line[x], *in = &line[x + 2 * reach];
            for (std::size_t c = 0; c < width; ++c)
                sum[c] += inner * (in[0][c] - outOf[1][c]) + edge * (in[1][c] - outOf[0][c]);
        }
        line.swap(means_);
    }

    double scale_;
    int passes_, reach_;
    double edge_;
    Line means_;
};

/// Along rows, and along columns, four at a time: what is read of a row is in one place.
constexpr std::size_t colorChannels = 4, columnsAtOnce = 4;
using AveragesAcross = Averages<colorChannels>;
using AveragesUp = Averages<columnsAtOnce * colorChannels>;

void averageRow(AveragesAcross& across, std::span<const Color> row, const std::vector<int>& places,
                Color fill, std::span<Color> means) {
    thread_local AveragesAcross::Line line;
    line.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Color color = places[i] < 0 ? fill : row[std::size_t(places[i])];
        line[i] = {color.r, color.g, color.b, color.a};
    }
    across.apply(line);
    for (std::size_t x = 0; x < means.size(); ++x)
        means[x] = Color(line[x][0], line[x][1], line[x][2], line[x][3]);
}

/// Columns from `first` on, or as many as there are.
void averageColumns(AveragesUp& up, const Raster& rows, const std::vector<int>& places, Color fill, int first,
                    Raster& means) {
    thread_local AveragesUp::Line line;
    line.resize(places.size());
    const int count = std::min(int(columnsAtOnce), rows.width - first);
    const auto value = [](auto& place, int column, std::size_t channel) -> double& {
        return place[std::size_t(column) * colorChannels + channel];
    };
    for (std::size_t i = 0; i < places.size(); ++i)
        for (int x = 0; x < count; ++x)
            for (std::size_t c = 0; c < colorChannels; ++c)
                value(line[i], x, c) = (places[i] < 0 ? fill : rows.at(first + x, places[i]))[int(c)];
    up.apply(line);
    for (int y = 0; y < means.height; ++y)
        for (int x = 0; x < count; ++x)
            for (std::size_t c = 0; c < colorChannels; ++c)
                means.at(first + x, y)[int(c)] = float(value(line[std::size_t(y)], x, c));
}

bool isWindow(VGfloat size) { return size >= 0 && size <= VGfloat(maxAverageBlurDimension); }

}  // namespace

void vgIterativeAverageBlurKHR(VGImage dst, VGImage src, VGfloat dimX, VGfloat dimY, VGuint iterative,
                               VGTilingMode tilingMode) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        require(isTiling(tilingMode));
        require(isWindow(dimX) && isWindow(dimY) && iterative <= VGuint(maxAverageBlurIterations));
        const ColorSpace space = filterSpace(context.state);
        Raster source = normalized(*images.src, space);
        const Color fill = tileFillColor(context.state, space);
        const int height = images.height();
        AveragesAcross across(double(dimX), iterative);
        AveragesUp up(double(dimY), iterative);
        Raster rows(images.width(), source.height), result(rows.width, height);
        const std::vector<int> columns = tiledPlaces(-across.margin(), rows.width + across.margin(),
                                                     source.width, tilingMode),
                               lines =
                                   tiledPlaces(-up.margin(), height + up.margin(), source.height, tilingMode);
        for (int y = 0; y < rows.height; ++y)
            averageRow(across, source.row(y), columns, fill, rows.row(y));
        // Rows of the fill colour have it as mean.
        for (int x = 0; x < rows.width; x += int(columnsAtOnce))
            averageColumns(up, rows, lines, fill, x, result);
        for (int y = 0; y < height; ++y)
            writeFilteredRow(context.state, *images.dst, y, result.row(y), space);
    });
}
