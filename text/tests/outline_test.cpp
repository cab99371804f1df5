// Outlines beside those that FreeType reads from the same file.
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "text/tests/sfnt.hpp"
#include "text/tests/support.hpp"

namespace vtm::text {
namespace {

class FreeType {
public:
    explicit FreeType(const std::filesystem::path& path) {
        EXPECT_EQ(FT_Init_FreeType(&library_), 0);
        EXPECT_EQ(FT_New_Face(library_, path.c_str(), 0, &face_), 0);
    }
    ~FreeType() {
        FT_Done_Face(face_);
        FT_Done_FreeType(library_);
    }
    FT_Face face() const { return face_; }

    /// In font units, y down, contours closed as ours are.
    scene::Path outline(GlyphId glyph) const {
        FT_Outline_Funcs functions{};
        functions.move_to = [](const FT_Vector* to, void* path) {
            return add(path, scene::MoveTo{point(to)});
        };
        functions.line_to = [](const FT_Vector* to, void* path) {
            return add(path, scene::LineTo{point(to)});
        };
        functions.conic_to = [](const FT_Vector* c, const FT_Vector* to, void* path) {
            return add(path, scene::QuadTo{point(c), point(to)});
        };
        functions.cubic_to = [](const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* path) {
            return add(path, scene::CubicTo{point(a), point(b), point(to)});
        };
        scene::Path path;
        EXPECT_EQ(FT_Load_Glyph(face_, glyph, FT_LOAD_NO_SCALE), 0);
        FT_Outline_Decompose(&face_->glyph->outline, &functions, &path);
        return path;
    }

private:
    static scene::Point point(const FT_Vector* v) { return {double(v->x), -double(v->y)}; }
    static int add(void* path, const scene::Command& command) {
        static_cast<scene::Path*>(path)->push_back(command);
        return 0;
    }

    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

/// Signed areas between curves and the axis, which do not depend on where a contour starts.
double area(const scene::Path& path) {
    double sum = 0;
    scene::Point from{}, start{};
    const auto chord = [&](scene::Point a, scene::Point b) { sum += (a.x * b.y - b.x * a.y) / 2; };
    for (const scene::Command& command : path) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command)) {
            chord(from, start);
            start = from = move->to;
        }
        if (const auto* quad = std::get_if<scene::QuadTo>(&command)) {
            // A parabola's segment is two thirds of the triangle of its points.
            const scene::Point a = quad->control - from, b = quad->to - from;
            sum += (a.x * b.y - a.y * b.x) / 3;
            chord(from, quad->to);
            from = quad->to;
        }
        if (const auto* line = std::get_if<scene::LineTo>(&command)) {
            chord(from, line->to);
            from = line->to;
        }
    }
    chord(from, start);
    return sum;
}

std::vector<scene::Point> points(const scene::Path& path) {
    std::vector<scene::Point> points;
    for (const scene::Command& command : path) {
        if (const auto end = scene::endOf(command))
            points.push_back(*end);
        if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            points.push_back(quad->control);
    }
    return points;
}

/// Of the lines that join the points.
double length(const scene::Path& path) {
    const std::vector<scene::Point> joined = points(path);
    double sum = 0;
    for (std::size_t i = 1; i < joined.size(); ++i)
        sum += glm::distance(joined[i - 1], joined[i]);
    return sum;
}

/// Each of the points is within a unit of one of the others.
bool areAmong(const std::vector<scene::Point>& points, const std::vector<scene::Point>& others) {
    return std::all_of(points.begin(), points.end(), [&](scene::Point p) {
        return std::any_of(others.begin(), others.end(), [&](scene::Point o) {
            return std::abs(o.x - p.x) <= 1 && std::abs(o.y - p.y) <= 1;
        });
    });
}

TEST(Outline, EveryGlyphOfDejaVuSansIsFreeTypes) {
    const FreeType freeType(dejavu / "DejaVuSans.ttf");
    FontSet set(optionsOf(dejavu));
    const auto font = set.primary(family("DejaVu Sans"));
    ASSERT_GT(freeType.face()->num_glyphs, 5000);
    for (GlyphId glyph = 0; glyph < GlyphId(freeType.face()->num_glyphs); ++glyph) {
        const scene::Path expected = freeType.outline(glyph);
        const auto path = font->outlineOf(glyph);
        ASSERT_EQ(path == nullptr, expected.empty()) << glyph;
        if (!path)
            continue;
        ASSERT_TRUE(areAmong(points(*path), points(expected))) << glyph;
        ASSERT_TRUE(areAmong(points(expected), points(*path))) << glyph;
        // Points that move by a unit change the area by less than the length of what joins them.
        ASSERT_NEAR(area(*path), area(expected), 1 + length(expected)) << glyph;
        ASSERT_EQ(std::lround(font->advanceOf(glyph)), freeType.face()->glyph->metrics.horiAdvance) << glyph;
    }
}

/// A family whose only face is DejaVu Sans.
class OneFace : public testing::Test {
protected:
    OneFace() {
        FontFace face;
        face.family = "Mine";
        set.add(face, bytesOf(dejavu / "DejaVuSans.ttf"));
    }
    const scene::Path& outline(const FontQuery& query, char32_t character) {
        const auto font = set.primary(query);
        return *font->outlineOf(font->glyphOf(character).value());
    }
    double areaAt(double weight, bool synthesize = true) {
        FontQuery query = family("Mine", weight);
        query.synthesizeWeight = synthesize;
        return std::abs(area(outline(query, U'I')));
    }

    FontSet set{optionsOf("/nowhere/at/all")};
};

TEST_F(OneFace, IsMadeBold) {
    EXPECT_GT(areaAt(700), 1.2 * areaAt(400));
    EXPECT_EQ(areaAt(700, false), areaAt(400));
    EXPECT_EQ(areaAt(500), areaAt(400)) << "bold begins at 600";
}
TEST_F(OneFace, GrowsByAFortyEighthOfAnEmOnEverySide) {
    const auto bounds = [](const scene::Path& path) {
        scene::Point min(HUGE_VAL), max(-HUGE_VAL);
        for (const scene::Point& p : points(path)) {
            min = {std::min(min.x, p.x), std::min(min.y, p.y)};
            max = {std::max(max.x, p.x), std::max(max.y, p.y)};
        }
        return std::pair(min, max);
    };
    const auto [min, max] = bounds(outline(family("Mine"), U'l'));
    const auto [boldMin, boldMax] = bounds(outline(family("Mine", 700), U'l'));
    const double grown = 2048.0 / 48;
    EXPECT_NEAR(boldMin.x, min.x - grown, 1);
    EXPECT_NEAR(boldMin.y, min.y - grown, 1);
    EXPECT_NEAR(boldMax.x, max.x + grown, 1);
    EXPECT_NEAR(boldMax.y, max.y + grown, 1);
}
TEST_F(OneFace, IsMadeOblique) {
    FontQuery query = family("Mine");
    const auto upright = set.primary(query);
    query.slant = Slant::Italic;
    const std::vector<scene::Point> from = points(outline(family("Mine"), U'I')),
                                    to = points(outline(query, U'I'));
    ASSERT_EQ(from.size(), to.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
        EXPECT_NEAR(to[i].x, from[i].x - from[i].y * std::tan(14 * std::numbers::pi / 180), 0.1);
        EXPECT_EQ(to[i].y, from[i].y);
    }
    query.synthesizeSlant = false;
    EXPECT_EQ(set.primary(query), upright);
}

}  // namespace
}  // namespace vtm::text
