#include "text/color/color_glyph.hpp"

#include <hb-ot.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vtm/image/codec.hpp>

#include "text/color/gradients.hpp"
#include "text/fonts/handles.hpp"
#include "text/fonts/table_cursor.hpp"

namespace vtm::text {
namespace {

constexpr unsigned foregroundIndex = 0xffff;
constexpr double maxByte = 255;

hb_face_t* faceOf(const ColorSource& source) { return hb_font_get_face(source.outlines.harfbuzz()); }

std::vector<hb_ot_color_layer_t> readLayers(hb_face_t* face, GlyphId glyph) {
    std::vector<hb_ot_color_layer_t> layers(hb_ot_color_glyph_get_layers(face, glyph, 0, nullptr, nullptr));
    auto count = static_cast<unsigned>(layers.size());
    hb_ot_color_glyph_get_layers(face, glyph, 0, &count, layers.data());
    layers.resize(count);
    return layers;
}

bool hasTable(hb_face_t* face, Tag tag) {
    const HbBlob table(hb_face_reference_table(face, tag));
    return hb_blob_get_length(table.get()) > 0;
}

/// Null for what is no picture.
std::shared_ptr<const image::Bitmap> decoded(hb_blob_t* png) {
    try {
        return std::make_shared<const image::Bitmap>(image::decode(bytesOf(png)));
    } catch (const image::CodecError&) {
        return nullptr;
    }
}

/// Where bitmaps are placed from. CoreText, which sbix comes from, counts from the lower left corner of the
/// glyph's outline, where it has one.
scene::Point bitmapOrigin(const ColorSource& source, GlyphId glyph) {
    const auto path = source.outlines.outlineOf(glyph);
    if (!path || !hasTable(faceOf(source), HB_TAG('s', 'b', 'i', 'x')))
        return {0, 0};
    const Extent bounds = boundsOf(*path, scene::identity);
    return {bounds.min.x, bounds.max.y};
}

}  // namespace

scene::Color ColorSource::color(unsigned index, double alpha) const {
    scene::Color color = foreground;
    unsigned count = 1;
    hb_color_t entry = 0;
    hb_ot_color_palette_get_colors(faceOf(*this), 0, index, &count, &entry);
    if (index != foregroundIndex && count == 1)
        color = {float(hb_color_get_red(entry) / maxByte), float(hb_color_get_green(entry) / maxByte),
                 float(hb_color_get_blue(entry) / maxByte), float(hb_color_get_alpha(entry) / maxByte)};
    color.a *= float(std::clamp(alpha, 0.0, 1.0));
    return color;
}

bool hasColorTables(hb_face_t* face) {
    static constexpr Tag tags[]{HB_TAG('C', 'O', 'L', 'R'), HB_TAG('S', 'V', 'G', ' '),
                                HB_TAG('C', 'B', 'D', 'T'), HB_TAG('s', 'b', 'i', 'x')};
    return std::any_of(std::begin(tags), std::end(tags), [&](Tag tag) { return hasTable(face, tag); });
}

scene::Item filled(std::shared_ptr<const scene::Path> path, const scene::Affine& transform,
                   scene::Paint paint) {
    scene::Item item;
    item.path = std::move(path);
    item.transform = transform;
    item.geometry = scene::FillRule::NonZero;
    item.paint = std::move(paint);
    return item;
}

std::optional<scene::Group> layersOf(const ColorSource& source, GlyphId glyph) {
    const std::vector<hb_ot_color_layer_t> layers = readLayers(faceOf(source), glyph);
    if (layers.empty())
        return std::nullopt;
    scene::Group group;
    for (const hb_ot_color_layer_t& layer : layers)
        if (auto path = source.outlines.outlineOf(layer.glyph))
            group.children.push_back({filled(path, source.transform, source.color(layer.color_index, 1))});
    return group;
}

std::optional<scene::Group> bitmapOf(const ColorSource& source, GlyphId glyph) {
    hb_font_t* const font = source.outlines.harfbuzz();
    const HbBlob png(hb_ot_color_glyph_reference_png(font, glyph));
    hb_glyph_extents_t extents;
    if (hb_blob_get_length(png.get()) == 0 || !hb_font_get_glyph_extents(font, glyph, &extents))
        return std::nullopt;
    const auto bitmap = decoded(png.get());
    if (!bitmap || extents.width <= 0 || extents.height >= 0)
        return std::nullopt;
    const scene::Point min =
        bitmapOrigin(source, glyph) +
        scene::Point(extents.x_bearing, -extents.y_bearing) / double(Font::harfbuzzScale);
    const scene::Point size = scene::Point(extents.width, -extents.height) / double(Font::harfbuzzScale);
    const scene::Affine place = scene::compose(
        scene::translation(min.x, min.y), scene::scaling(size.x / bitmap->width, size.y / bitmap->height));
    scene::Group group;
    group.children.push_back(
        {filled(std::make_shared<const scene::Path>(scene::rectangle(min, min + size)), source.transform,
                scene::ImagePaint{.bitmap = bitmap, .transform = place})});
    return group;
}

std::optional<SvgGlyph> svgOf(hb_face_t* face, GlyphId glyph) {
    const HbBlob document(hb_ot_color_glyph_reference_svg(face, glyph));
    const std::span<const std::uint8_t> bytes = bytesOf(document.get());
    if (bytes.empty())
        return std::nullopt;
    return SvgGlyph{{bytes.begin(), bytes.end()}};
}

}  // namespace vtm::text
