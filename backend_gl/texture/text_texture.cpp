#include <vtm/gl/text_texture.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/texture/page_texels.hpp"
#include "backend_gl/texture/prefilter_texture.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "backend_gl/texture/vtm_uniform.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Texel;
using asset::TextPage;

/// Rows of text that a page of this many glyphs has, more or less: a letter is half as wide as high.
double rowsOf(const TextPage& page) {
    if (page.cells)
        return page.cells->rows * page.height / (page.cells->size.y * page.cells->rows);
    return std::sqrt(0.5 * double(page.glyphs.size() + 1) * page.height / page.width);
}

/// Two texels a row: the prefilter begins where a row is a pixel high.
asset::PrefilterOptions prefilterOptions(const TextPage& page) {
    const double side = 2 * rowsOf(page) * std::max(1.0, page.width / page.height);
    asset::PrefilterOptions options;
    options.largestSide = std::uint32_t(std::clamp(side, 4.0, 1024.0));
    return options;
}

struct Page {
    TextPage text;
    GLuint first = 0;        ///< texel
    std::size_t texels = 0;  ///< that it takes
    std::size_t room = 0;    ///< that it may take
    asset::PyramidSize prefilterSize;
    TextureHandle prefilter;          ///< 0: to be made
    Pixels pixels = Pixels::Scanned;  ///< who makes it: the CPU where programs would be compiled for one page
};

}  // namespace

struct TextTexture::Impl {
    Impl(const AssetView& of, std::vector<TextPage> texts) : font(asset::toAsset(of)) {
        for (TextPage& text : texts) {
            pages.emplace_back();
            pages.back().text = std::move(text);
        }
        send();
    }

    /// All records, in a new texture.
    void send() {
        const StateContract contract;
        const StateGuard guard(contract, true, Touched::uploads());
        std::vector<Texel> texels = recordTexels(font, {}, parts);
        fontTexels = texels.size();
        for (Page& page : pages) {
            asset::validate(page.text, font);
            page.first = GLuint(texels.size());
            const std::vector<Texel> own = pageTexels(page.text, font, page.first);
            page.texels = page.room = own.size();
            texels.insert(texels.end(), own.begin(), own.end());
        }
        records = texelTexture(std::move(texels));
    }

    void update(Page& page, const TextPage& text, const AssetView& of, Pixels pixels) {
        asset::validate(text, of);
        const bool grew = of.maps.size() != font.maps.size();
        const std::vector<Texel> own = pageTexels(text, of, page.first);
        page.text = text;
        page.pixels = pixels;
        page.prefilter = TextureHandle();
        if (grew)
            font = asset::toAsset(of);
        if (grew || own.size() > page.room)
            return send();
        page.texels = own.size();
        const StateContract contract;
        const StateGuard guard(contract, true, Touched::uploads());
        updateTexels(records.get(), page.first, own);
        checkErrors("update of a page");
    }

    void makePrefilter(Page& page) {
        const asset::Asset asset = asset::pageAsset(page.text, font);
        const StateContract contract;
        const StateGuard guard(contract, true, Touched::picture(false));
        PrefilterTexture made =
            maker.make(asset, prefilterOptions(page.text), page.pixels, uniformOf(page), records.get());
        page.prefilterSize = made.size;
        page.prefilter = std::move(made.texture);
    }

    VtmUniform uniformOf(const Page& page) const {
        VtmUniform uniform;
        uniform.parts = parts;
        uniform.width = page.text.width;
        uniform.height = page.text.height;
        uniform.map = {0, 0, std::max(page.text.width, page.text.height), {}, 0};
        uniform.flags = samplingFlags({}, {0, true});
        uniform.prefilterSize = page.prefilterSize;
        uniform.page = page.first;
        return uniform;
    }

    Page& at(std::size_t page) {
        if (page >= pages.size())
            throw std::out_of_range(fmt::format("page {}: there are {}", page, pages.size()));
        return pages[page];
    }

    asset::Asset font;
    Parts parts;
    std::size_t fontTexels = 0;
    std::vector<Page> pages;
    TextureHandle records;
    PrefilterMaker maker{{}, {0, true}};
    Samplers samplers;
};

std::string textInclude(std::initializer_list<AssetView> others) {
    return includeFor(std::span(others.begin(), others.size()), true);
}

TextTexture::TextTexture(const AssetView& font, std::span<const TextPage> pages) {
    requireCurrentContext();
    checkErrors("something before this texture was made");
    impl_ = std::make_unique<Impl>(font, std::vector<TextPage>(pages.begin(), pages.end()));
}
TextTexture::TextTexture(const AssetView& font, std::initializer_list<TextPage> pages)
    : TextTexture(font, std::span(pages.begin(), pages.size())) {}
TextTexture::~TextTexture() = default;
TextTexture::TextTexture(TextTexture&&) noexcept = default;
TextTexture& TextTexture::operator=(TextTexture&&) noexcept = default;

std::size_t TextTexture::pages() const { return impl_->pages.size(); }
std::size_t TextTexture::bytes(std::size_t page) const { return impl_->at(page).texels * sizeof(Texel); }
std::size_t TextTexture::fontBytes() const { return impl_->fontTexels * sizeof(Texel); }

void TextTexture::update(std::size_t page, const TextPage& text, const AssetView& font, Pixels pixels) {
    impl_->update(impl_->at(page), text, font, pixels);
}

void TextTexture::bind(unsigned program, const std::string& name, unsigned firstUnit, std::size_t page,
                       Wrapping wrapping) {
    Page& bound = impl_->at(page);
    if (bound.prefilter.get() == 0)
        impl_->makePrefilter(bound);
    const Binding binding(program, name, firstUnit, units);
    impl_->uniformOf(bound).set(program, name, wrapping);
    binding.texture("texels", 0, impl_->records.get(), 0);
    binding.texture("prefilter", 1, bound.prefilter.get(), impl_->samplers.of(wrapping));
    binding.unused("images", 1);
    checkErrors("binding a page");
}

}  // namespace vtm::gl
