/// \file
/// The only kind of Font: an OpenType face read by HarfBuzz.
#pragma once

#include <hb.h>

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "text/font.hpp"

namespace vtm::text {

/// A face as its file holds it, before axes are chosen. Shared by all fonts made from it.
struct Face {
    std::shared_ptr<hb_face_t> face;
    std::string family;
};

/// Null where the bytes hold no face of that index with glyphs.
std::shared_ptr<const Face> openFace(hb_blob_t* bytes, unsigned index, std::string family);

/// What an OpenType font is made of besides its face.
struct Instance {
    std::vector<hb_variation_t> variations;
    bool bold = false, oblique = false;  ///< synthesised
};

class OpenTypeFont final : public Font {
public:
    OpenTypeFont(std::shared_ptr<const Face> face, Instance instance);

    const std::string& family() const override { return face_->family; }
    double unitsPerEm() const override { return unitsPerEm_; }
    const FontMetrics& metrics() const override { return metrics_; }
    std::optional<GlyphId> glyphOf(char32_t character, char32_t variationSelector) const override;
    double advanceOf(GlyphId glyph) const override;
    std::shared_ptr<const scene::Path> outlineOf(GlyphId glyph) const override;
    std::optional<ColorGlyph> colorGlyphOf(GlyphId glyph, const scene::Color& foreground) const override;
    hb_font_t* harfbuzz() const override { return font_.get(); }

private:
    FontMetrics readMetrics() const;
    /// A metric in font units; nothing where the font does not say.
    std::optional<double> metric(std::uint32_t tag) const;
    /// The height of a character's outline, else `fallback`.
    double heightOf(char32_t character, double fallback) const;

    std::shared_ptr<const Face> face_;
    std::shared_ptr<hb_font_t> font_;
    double unitsPerEm_;
    Instance instance_;
    mutable std::mutex mutex_;  ///< guards outlines_
    mutable std::unordered_map<GlyphId, std::shared_ptr<const scene::Path>> outlines_;
    FontMetrics metrics_{};
};

}  // namespace vtm::text
