#include "text/shape.hpp"

#include <hb-ot.h>
#include <hb.h>
#include <linebreak.h>

#include <algorithm>
#include <mutex>

#include "text/shape/runs.hpp"

namespace vtm::text {
namespace {

struct DestroyBuffer {
    void operator()(hb_buffer_t* buffer) const { hb_buffer_destroy(buffer); }
};
using Buffer = std::unique_ptr<hb_buffer_t, DestroyBuffer>;

hb_direction_t directionOf(const Run& run) {
    if (run.upright)
        return HB_DIRECTION_TTB;
    return run.level % 2 == 1 ? HB_DIRECTION_RTL : HB_DIRECTION_LTR;
}

/// The run's glyphs; the text around it decides how the letters at its ends join.
Buffer shapedBuffer(const Line& line, const Run& run) {
    Buffer buffer(hb_buffer_create());
    const auto add = [&](const std::u32string& text, std::size_t first, std::size_t end) {
        hb_buffer_add_utf32(buffer.get(), reinterpret_cast<const std::uint32_t*>(text.data()),
                            static_cast<int>(text.size()), static_cast<unsigned>(first),
                            static_cast<int>(end - first));
    };
    if (run.first == 0)
        add(line.before, line.before.size(), line.before.size());
    add(line.text, run.first, run.end);
    if (run.end == line.text.size())
        add(line.after, 0, 0);
    hb_buffer_set_direction(buffer.get(), directionOf(run));
    hb_buffer_set_script(buffer.get(), static_cast<hb_script_t>(run.script));
    const Span& span = line.spans[run.span];
    hb_buffer_set_language(
        buffer.get(), hb_language_from_string(span.language.data(), static_cast<int>(span.language.size())));
    hb_buffer_set_cluster_level(buffer.get(), HB_BUFFER_CLUSTER_LEVEL_MONOTONE_GRAPHEMES);
    std::vector<hb_feature_t> features;
    for (const Feature& feature : span.features)
        features.push_back({feature.tag, feature.value, HB_FEATURE_GLOBAL_START, HB_FEATURE_GLOBAL_END});
    hb_shape(run.font->harfbuzz(), buffer.get(), features.data(), static_cast<unsigned>(features.size()));
    return buffer;
}

Glyph glyphOf(const Run& run, const hb_glyph_info_t& info, const hb_glyph_position_t& position) {
    const double em = run.font->unitsPerEm() * Font::harfbuzzScale;
    const double advance = run.upright ? -position.y_advance : position.x_advance;
    return {run.font, info.codepoint, position.x_offset / em, -position.y_offset / em, advance / em};
}

/// Letters of these join, or hang from one line.
bool isCursive(std::uint32_t script) {
    static constexpr hb_script_t cursive[]{
        HB_SCRIPT_ARABIC,  HB_SCRIPT_SYRIAC,     HB_SCRIPT_MONGOLIAN,      HB_SCRIPT_NKO,
        HB_SCRIPT_MANDAIC, HB_SCRIPT_PHAGS_PA,   HB_SCRIPT_ADLAM,          HB_SCRIPT_HANIFI_ROHINGYA,
        HB_SCRIPT_SOGDIAN, HB_SCRIPT_MANICHAEAN, HB_SCRIPT_PSALTER_PAHLAVI};
    return std::find(std::begin(cursive), std::end(cursive), static_cast<hb_script_t>(script)) !=
           std::end(cursive);
}

Cluster emptyCluster(const Line& line, const Run& run, std::size_t first) {
    Cluster cluster;
    cluster.first = first;
    cluster.level = run.level;
    cluster.sideways = line.vertical && !run.upright;
    // Spaces between the words of a cursive script are of no script themselves.
    cluster.cursive = isCursive(hb_unicode_script(hb_unicode_funcs_get_default(), line.text[first]));
    return cluster;
}

/// Glyphs that HarfBuzz gives one cluster value, in visual order, with the characters up to the next value.
void appendClusters(const Line& line, const Run& run, std::vector<Cluster>& out) {
    const Buffer buffer = shapedBuffer(line, run);
    unsigned count = 0;
    const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
    const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer.get(), nullptr);
    const std::size_t begin = out.size();
    for (unsigned i = 0; i < count; ++i) {
        if (i == 0 || infos[i].cluster != infos[i - 1].cluster)
            out.push_back(emptyCluster(line, run, infos[i].cluster));
        const Glyph glyph = glyphOf(run, infos[i], positions[i]);
        out.back().advance += glyph.advance;
        out.back().glyphs.push_back(glyph);
    }
    const bool reversed = !run.upright && run.level % 2 == 1;
    for (std::size_t i = begin; i < out.size(); ++i) {
        const bool last = reversed ? i == begin : i + 1 == out.size();
        out[i].count = (last ? run.end : out[reversed ? i - 1 : i + 1].first) - out[i].first;
    }
}

/// Characters for which there is no font.
void appendBlank(const Line& line, const Run& run, std::vector<Cluster>& out) {
    Cluster cluster = emptyCluster(line, run, run.first);
    cluster.count = run.end - run.first;
    out.push_back(std::move(cluster));
}

}  // namespace

std::vector<Cluster> shape(const Line& line, FontSet& fonts) {
    std::vector<Cluster> clusters;
    for (const Run& run : visualRuns(line, fonts))
        if (run.font)
            appendClusters(line, run, clusters);
        else
            appendBlank(line, run, clusters);
    return clusters;
}

bool hasFeature(const Font& font, Tag feature) {
    hb_face_t* const face = hb_font_get_face(font.harfbuzz());
    unsigned count = hb_ot_layout_table_get_feature_tags(face, HB_OT_TAG_GSUB, 0, nullptr, nullptr);
    std::vector<hb_tag_t> tags(count);
    hb_ot_layout_table_get_feature_tags(face, HB_OT_TAG_GSUB, 0, &count, tags.data());
    return std::find(tags.begin(), tags.end(), feature) != tags.end();
}

std::vector<bool> lineBreaks(const std::u32string& text, const std::string& language) {
    static std::once_flag once;
    std::call_once(once, init_linebreak);
    std::vector<char> breaks(text.size());
    set_linebreaks_utf32(reinterpret_cast<const utf32_t*>(text.data()), text.size(), language.c_str(),
                         breaks.data());
    std::vector<bool> allowed;
    for (const char kind : breaks)
        allowed.push_back(kind == LINEBREAK_MUSTBREAK || kind == LINEBREAK_ALLOWBREAK);
    return allowed;
}

}  // namespace vtm::text
