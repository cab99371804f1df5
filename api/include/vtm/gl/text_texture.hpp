/// \file
/// Pages of text as textures in the caller's own programs: a font's maps once, and of each page a table of
/// one byte a character in cells, or eight bytes anywhere. Source: Ray et al. 2005, section 5 (font engine).
/// docs/fonts.md.
///
///     vtm::gl::TextTexture book(font.asset(), {page});
///     const std::string source = "#version 300 es\n" + vtm::gl::textInclude() + yourShader;
///     book.bind(program, "page", 0, 0);
///     // uniform Vtm page;  ...  color = vtm_sample(page, st);
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>

#include <vtm/asset/text_page.hpp>
#include <vtm/gl/sampled_texture.hpp>

#pragma GCC visibility push(default)

namespace vtm::gl {

/// As sampleInclude() for these assets, and for pages of text.
std::string textInclude(std::initializer_list<asset::AssetView> others = {});

/// A font and pages over it, in one texture of records. Needs the context that was current when it was made,
/// or one that shares textures and samplers with it, for its whole life.
class TextTexture {
public:
    /// `font`: with maps that the pages' symbols name (vtm::font::FontMaps::asset); not needed afterwards,
    /// but for update(). Both must be valid. Leaves GL's state as it was. Throws GlError as SampledTexture
    /// does, std::invalid_argument for a page that is not valid.
    TextTexture(const asset::AssetView& font, std::span<const asset::TextPage> pages);
    TextTexture(const asset::AssetView& font, std::initializer_list<asset::TextPage> pages);
    ~TextTexture();
    TextTexture(TextTexture&&) noexcept;
    TextTexture& operator=(TextTexture&&) noexcept;

    std::size_t pages() const;
    /// Of a page's table, without the font and the pyramid of means.
    std::size_t bytes(std::size_t page) const;
    /// Of the font's maps.
    std::size_t fontBytes() const;

    /// Replaces a page. Sends its table only, if it has room for as many texels as before, and if `font` has
    /// no more maps; everything otherwise. `pixels` selects who makes its pyramid of means, as for
    /// SampledTexture::update. Throws as the constructor does, and std::out_of_range.
    void update(std::size_t page, const asset::TextPage& text, const asset::AssetView& font,
                Pixels pixels = Pixels::Automatic);

    static constexpr unsigned units = 2;  ///< texture units that bind() uses
    /// As SampledTexture::bind, with (0, 0) to (1, 1) over the page. The first time after a page was made or
    /// changed, its pyramid of means is made. Throws std::out_of_range too.
    void bind(unsigned program, const std::string& name, unsigned firstUnit, std::size_t page,
              Wrapping wrapping = {});

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

#pragma GCC visibility pop
