#include "text/fonts/synthesis.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <cmath>
#include <limits>
#include <vector>

namespace vtm::text {
namespace {

/// FreeType's coordinates to a font unit.
constexpr double scale = 64;

/// The command's points in their order, on-curve points last.
template <typename Visit>
void visitPoints(scene::Command& command, Visit visit) {
    if (auto* move = std::get_if<scene::MoveTo>(&command))
        visit(move->to, FT_CURVE_TAG_ON);
    if (auto* line = std::get_if<scene::LineTo>(&command))
        visit(line->to, FT_CURVE_TAG_ON);
    if (auto* quad = std::get_if<scene::QuadTo>(&command)) {
        visit(quad->control, FT_CURVE_TAG_CONIC);
        visit(quad->to, FT_CURVE_TAG_ON);
    }
    if (auto* cubic = std::get_if<scene::CubicTo>(&command)) {
        visit(cubic->control1, FT_CURVE_TAG_CUBIC);
        visit(cubic->control2, FT_CURVE_TAG_CUBIC);
        visit(cubic->to, FT_CURVE_TAG_ON);
    }
}

struct Outline {
    std::vector<FT_Vector> points;
    std::vector<char> tags;
    std::vector<short> ends;  ///< the last point of each contour

    explicit Outline(scene::Path& path) {
        for (scene::Command& command : path) {
            if (std::holds_alternative<scene::MoveTo>(command))
                endContour();
            visitPoints(command, [&](const scene::Point& point, int tag) {
                points.push_back({std::lround(point.x * scale), std::lround(point.y * scale)});
                tags.push_back(static_cast<char>(tag));
            });
        }
        endContour();
    }

    void endContour() {
        if (!points.empty())
            ends.push_back(static_cast<short>(points.size() - 1));
    }
    bool fits() const { return points.size() <= std::size_t(std::numeric_limits<short>::max()); }
    bool embolden(double strength) {
        FT_Outline outline{static_cast<short>(ends.size()),
                           static_cast<short>(points.size()),
                           points.data(),
                           tags.data(),
                           ends.data(),
                           FT_OUTLINE_NONE};
        return FT_Outline_Embolden(&outline, std::lround(strength * scale)) == 0;
    }
};

}  // namespace

scene::Path emboldened(scene::Path path, double strength) {
    Outline outline(path);
    if (!outline.fits() || !outline.embolden(strength))
        return path;
    std::size_t next = 0;
    for (scene::Command& command : path)
        visitPoints(command, [&](scene::Point& point, int) {
            // FreeType keeps the lower left corner in its place.
            const FT_Vector& moved = outline.points[next++];
            point = scene::Point(double(moved.x), double(moved.y)) / scale - strength / 2;
        });
    return path;
}

}  // namespace vtm::text
