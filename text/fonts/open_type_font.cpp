#include "text/fonts/open_type_font.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include <hb-ot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <vtm/scene/path.hpp>
#include "text/color/color_glyph.hpp"

namespace vtm::text {
namespace {

// ---- Bold faces made from regular ones. Source: CSS Fonts 4 section 6 -----------------------------------

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

/// The outline grown by half of `strength` on every side; commands stay what they are. Outlines that
/// FreeType cannot hold, of more than 32767 points, stay as they are.
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

// ---- The font -----------------------------------------------------------------------------------------

/// CSS Fonts 4 section 2.4: the slant of an oblique face that is made from an upright one.
const float obliqueSlant = static_cast<float>(std::tan(14 * std::numbers::pi / 180));

struct OutlineBuilder {
    scene::Path path;

    static scene::Point point(float x, float y) {
        return {x / double(Font::harfbuzzScale), -y / double(Font::harfbuzzScale)};
    }
};

hb_draw_funcs_t* makeDrawFunctions() {
    const auto builder = [](void* data) -> scene::Path& { return static_cast<OutlineBuilder*>(data)->path; };
    hb_draw_funcs_t* const functions = hb_draw_funcs_create();
    static const auto into = builder;
    hb_draw_funcs_set_move_to_func(
        functions,
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float x, float y, void*) {
            into(data).push_back(scene::MoveTo{OutlineBuilder::point(x, y)});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_line_to_func(
        functions,
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float x, float y, void*) {
            into(data).push_back(scene::LineTo{OutlineBuilder::point(x, y)});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_quadratic_to_func(
        functions,
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float cx, float cy, float x, float y, void*) {
            into(data).push_back(scene::QuadTo{OutlineBuilder::point(cx, cy), OutlineBuilder::point(x, y)});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_cubic_to_func(
        functions,
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, float ax, float ay, float bx, float by, float x,
           float y, void*) {
            into(data).push_back(scene::CubicTo{OutlineBuilder::point(ax, ay), OutlineBuilder::point(bx, by),
                                                OutlineBuilder::point(x, y)});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_close_path_func(
        functions,
        [](hb_draw_funcs_t*, void* data, hb_draw_state_t*, void*) { into(data).push_back(scene::Close{}); },
        nullptr, nullptr);
    hb_draw_funcs_make_immutable(functions);
    return functions;
}

/// Made once and kept.
hb_draw_funcs_t* drawFunctions() {
    static hb_draw_funcs_t* const functions = makeDrawFunctions();
    return functions;
}

bool isFinite(const scene::Path& path) {
    return std::all_of(path.begin(), path.end(), [](const scene::Command& command) {
        const auto end = scene::endOf(command);
        return !end || (std::isfinite(end->x) && std::isfinite(end->y));
    });
}

}  // namespace

OpenTypeFont::OpenTypeFont(std::shared_ptr<const Face> face, Instance instance)
    : face_(std::move(face)),
      font_(hb_font_create(face_->harfbuzz())),
      unitsPerEm_(hb_face_get_upem(face_->harfbuzz())),
      instance_(std::move(instance)) {
    const int steps = static_cast<int>(unitsPerEm_) * harfbuzzScale;
    hb_font_set_scale(font_.get(), steps, steps);
    std::vector<hb_variation_t> axes;
    for (const auto& [axis, value] : instance_.axes)
        axes.push_back({axis, value});
    hb_font_set_variations(font_.get(), axes.data(), static_cast<unsigned>(axes.size()));
    if (instance_.oblique)
        hb_font_set_synthetic_slant(font_.get(), obliqueSlant);
    hb_font_make_immutable(font_.get());
    metrics_ = readMetrics();
}

std::optional<GlyphId> OpenTypeFont::glyphOf(char32_t character, char32_t variationSelector) const {
    hb_codepoint_t glyph = 0;
    const bool found = variationSelector
                           ? hb_font_get_variation_glyph(font_.get(), character, variationSelector, &glyph)
                           : hb_font_get_nominal_glyph(font_.get(), character, &glyph);
    return found ? std::optional(glyph) : std::nullopt;
}

std::string OpenTypeFont::familyName() const {
    std::array<char, 256> name{};
    auto length = static_cast<unsigned>(name.size());
    hb_ot_name_get_utf8(face_->harfbuzz(), HB_OT_NAME_ID_FONT_FAMILY, HB_LANGUAGE_INVALID, &length,
                        name.data());
    return name.data();
}

GlyphId OpenTypeFont::glyphCount() const { return hb_face_get_glyph_count(face_->harfbuzz()); }

std::vector<char32_t> OpenTypeFont::characters() const {
    const HbSet set(hb_set_create());
    hb_face_collect_unicodes(face_->harfbuzz(), set.get());
    std::vector<char32_t> characters;
    for (hb_codepoint_t c = HB_SET_VALUE_INVALID; hb_set_next(set.get(), &c);)
        characters.push_back(c);
    return characters;
}

double OpenTypeFont::advanceOf(GlyphId glyph) const {
    return hb_font_get_glyph_h_advance(font_.get(), glyph) / double(Font::harfbuzzScale);
}

std::shared_ptr<const scene::Path> OpenTypeFont::outlineOf(GlyphId glyph) const {
    const std::lock_guard lock(mutex_);
    const auto [found, fresh] = outlines_.try_emplace(glyph);
    if (fresh) {
        scene::Path path = readOutline(glyph);
        if (!path.empty() && isFinite(path))
            found->second = std::make_shared<const scene::Path>(std::move(path));
    }
    return found->second;
}

scene::Path OpenTypeFont::readOutline(GlyphId glyph) const {
    // FreeType's own strength, which Cairo takes, too.
    constexpr double boldStrength = 1.0 / 24;
    OutlineBuilder builder;
    if (!face_->isTooLarge(glyph))
        hb_font_get_glyph_shape(font_.get(), glyph, drawFunctions(), &builder);
    return instance_.bold ? emboldened(std::move(builder.path), boldStrength * unitsPerEm_)
                          : std::move(builder.path);
}

std::optional<Font::ColorGlyph> OpenTypeFont::colorGlyphOf(GlyphId glyph, const scene::Color& foreground,
                                                           const scene::Affine& transform) const {
    if (!face_->hasColor())
        return std::nullopt;
    const auto plain = face_->font({instance_.axes});
    const scene::Affine slant{1, 0, instance_.oblique ? -obliqueSlant : 0, 1, 0, 0};
    const ColorSource source{*plain, foreground, scene::compose(transform, slant)};
    if (auto group = paintsOf(source, glyph))
        return group;
    if (auto group = layersOf(source, glyph))
        return group;
    if (auto document = svgOf(face_->harfbuzz(), glyph))
        return document;
    return bitmapOf(source, glyph);
}

std::optional<double> OpenTypeFont::metric(std::uint32_t tag) const {
    hb_position_t position = 0;
    if (!hb_ot_metrics_get_position(font_.get(), static_cast<hb_ot_metrics_tag_t>(tag), &position))
        return std::nullopt;
    return position / double(Font::harfbuzzScale);
}

double OpenTypeFont::heightOf(char32_t character, double fallback) const {
    const auto glyph = glyphOf(character, 0);
    hb_glyph_extents_t extents;
    if (!glyph || !hb_font_get_glyph_extents(font_.get(), *glyph, &extents) || extents.y_bearing <= 0)
        return fallback;
    return extents.y_bearing / double(Font::harfbuzzScale);
}

FontMetrics OpenTypeFont::readMetrics() const {
    // Shares of the em for what a font does not say.
    constexpr double ascent = 0.8, descent = 0.2, xHeight = 0.5, capHeight = 0.7, thickness = 0.05,
                     underline = 0.1, subscript = 0.2, superscript = 0.4;
    const auto positive = [&](std::uint32_t tag, double fallback) {
        const auto value = metric(tag);
        return value && *value > 0 ? *value : fallback;
    };
    const double em = unitsPerEm_;
    FontMetrics made{};
    made.ascent = metric(HB_OT_METRICS_TAG_HORIZONTAL_ASCENDER).value_or(0);
    made.descent = -metric(HB_OT_METRICS_TAG_HORIZONTAL_DESCENDER).value_or(0);
    if (!(made.ascent + made.descent > 0)) {
        made.ascent = ascent * em;
        made.descent = descent * em;
    }
    made.xHeight = positive(HB_OT_METRICS_TAG_X_HEIGHT, heightOf('x', xHeight * em));
    made.capHeight = positive(HB_OT_METRICS_TAG_CAP_HEIGHT, heightOf('H', capHeight * em));
    // post and OS/2 give the lines' upper edges. CSS leaves `auto` positions open; lines are centred there,
    // as the SVG test suite has them.
    made.underlineThickness = positive(HB_OT_METRICS_TAG_UNDERLINE_SIZE, thickness * em);
    made.underlineOffset = -metric(HB_OT_METRICS_TAG_UNDERLINE_OFFSET).value_or(-underline * em);
    made.strikeoutThickness = positive(HB_OT_METRICS_TAG_STRIKEOUT_SIZE, made.underlineThickness);
    made.strikeoutOffset = positive(HB_OT_METRICS_TAG_STRIKEOUT_OFFSET, made.xHeight / 2);
    made.subscriptOffset = positive(HB_OT_METRICS_TAG_SUBSCRIPT_EM_Y_OFFSET, subscript * em);
    made.superscriptOffset = positive(HB_OT_METRICS_TAG_SUPERSCRIPT_EM_Y_OFFSET, superscript * em);
    return made;
}

}  // namespace vtm::text
