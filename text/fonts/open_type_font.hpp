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
#include "text/fonts/face.hpp"

namespace vtm::text {

class OpenTypeFont final : public Font {
public:
    OpenTypeFont(std::shared_ptr<const Face> face, Instance instance);

    const std::string& family() const override { return face_->family(); }
    double unitsPerEm() const override { return unitsPerEm_; }
    const FontMetrics& metrics() const override { return metrics_; }
    std::string familyName() const override;
    GlyphId glyphCount() const override;
    std::vector<char32_t> characters() const override;
    std::optional<GlyphId> glyphOf(char32_t character, char32_t variationSelector) const override;
    double advanceOf(GlyphId glyph) const override;
    std::shared_ptr<const scene::Path> outlineOf(GlyphId glyph) const override;
    std::optional<ColorGlyph> colorGlyphOf(GlyphId glyph, const scene::Color& foreground,
                                           const scene::Affine& transform) const override;
    hb_font_t* harfbuzz() const override { return font_.get(); }

private:
    scene::Path readOutline(GlyphId glyph) const;
    FontMetrics readMetrics() const;
    /// A metric in font units; nothing where the font does not say.
    std::optional<double> metric(std::uint32_t tag) const;
    /// The height of a character's outline, else `fallback`.
    double heightOf(char32_t character, double fallback) const;

    std::shared_ptr<const Face> face_;
    HbFont font_;
    double unitsPerEm_;
    Instance instance_;
    mutable std::mutex mutex_;  ///< guards outlines_
    mutable std::unordered_map<GlyphId, std::shared_ptr<const scene::Path>> outlines_;
    FontMetrics metrics_{};
};

}  // namespace vtm::text
