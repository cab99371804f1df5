#include "backend_gl/upload/upload.hpp"

#include "backend_gl/core/constants.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Texel;

constexpr std::uint32_t mapsPerRow = placementColumns * sizeof(Texel) / sizeof(Placement);

/// The trees themselves stay behind: instances stand for them, and tiles for the leaves of sums of maps.
std::vector<Texel> joinedTexels(const AssetView& asset, std::span<const Texel> imageList,
                                Sections& sections) {
    std::vector<Texel> texels;
    if (!isSumOfMaps(asset)) {
        sections.leaves = appendTexels(texels, asset.leaves);
        sections.pieces = appendTexels(texels, asset.pieces);
    }
    sections.paints = appendTexels(texels, asset.paints);
    sections.data = appendTexels(texels, asset.data);
    sections.images = appendTexels<Texel>(texels, imageList);
    sections.rampSums = appendTexels<Texel>(texels, rampSums(asset));
    sections.filterWords = appendTexels(texels, asset.filterWords);
    return texels;
}

BufferHandle uploadInstances(const std::vector<Instance>& instances) {
    BufferHandle buffer = makeBuffer();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(instances.size() * sizeof(Instance)), instances.data(),
                 GL_STATIC_DRAW);
    checkErrors("instances");
    return buffer;
}

}  // namespace

UploadedAsset::UploadedAsset(const AssetView& asset, unsigned materials, std::uint32_t maxTurns,
                             FilterEngine filterEngine)
    : maps(asset.maps.begin(), asset.maps.end()),
      commands(asset.commands.begin(), asset.commands.end()),
      list(asset::isSumOfMaps(asset) ? InstanceList{} : makeInstances(asset)),
      features(featuresOf(asset)),
      materialSet(materials),
      paints(asset.paints.begin(), asset.paints.end()),
      finestPixel(asset.finestPixel),
      isSumOfMaps(asset::isSumOfMaps(asset)) {
    if (!asset.filters.empty() && filterEngine == FilterEngine::Cpu) {
        filtered.emplace(asset);
        return;
    }
    filters.mode = asset.mode;
    filters.filters.assign(asset.filters.begin(), asset.filters.end());
    filters.filterPrimitives.assign(asset.filterPrimitives.begin(), asset.filterPrimitives.end());
    filters.filterWords.assign(asset.filterWords.begin(), asset.filterWords.end());
    if (asset.mode == asset::Mode::Exact) {
        kept = keptOf(asset);
        for (const asset::Command& command : asset.commands)
            if (command.kind == asset::Command::Kind::DrawMap)
                atlases.emplace_back(kept, command.map, command.paint, maxTurns);
    }
    ImageTexels pictures = imageTexels(asset);
    records = RecordTexture(joinedTexels(asset, pictures.list, sections));
    images = imageTexture(std::move(pictures.rgba));
    instances = uploadInstances(list.instances);
    list.instances = {};
    placements.resize((maps.size() / mapsPerRow + 1) * mapsPerRow);
    placementTexels = makeTexture(GL_RGBA32F, placementColumns, int(placements.size() / mapsPerRow));
}

bool UploadedAsset::canUpdate(const AssetView& asset, const asset::Difference& difference) const {
    return !difference.everything && !difference.images && isSumOfMaps && asset::isSumOfMaps(asset) &&
           asset.maps.size() == 1 && atlases.size() == 1 && asset.instances.empty() && asset.images.empty() &&
           asset.materials.empty();
}

std::size_t UploadedAsset::update(const AssetView& asset, const asset::Difference& difference) {
    atlases[0].stopAhead();  // which reads what is kept
    maps.assign(asset.maps.begin(), asset.maps.end());
    finestPixel = asset.finestPixel;
    if (scanner)
        scanner->update(asset, difference);
    std::size_t sent = 0;
    if (difference.paints) {
        features = featuresOf(asset);
        paints.assign(asset.paints.begin(), asset.paints.end());
        sent += records.update(joinedTexels(asset, {}, sections));
    }
    const PaintUpdate changed = vtm::gl::update(kept, asset, difference);
    return sent + atlases[0].update(difference, changed);
}

void UploadedAsset::uploadPlacements(std::uint32_t first, std::uint32_t last) {
    const std::uint32_t firstRow = first / mapsPerRow, rows = last / mapsPerRow - firstRow + 1;
    glBindTexture(GL_TEXTURE_2D, placementTexels.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, GLint(firstRow), placementColumns, GLsizei(rows), GL_RGBA, GL_FLOAT,
                    &placements[firstRow * mapsPerRow]);
}

Texture::Texture(std::unique_ptr<Impl> impl, Renderer& renderer)
    : renderer_(&renderer), impl_(std::move(impl)) {}

Texture::Texture(const asset::AssetView& asset, const RendererOptions& options)
    : own_(std::make_unique<Renderer>(options)),
      renderer_(own_.get()),
      impl_(std::move(own_->upload(asset).impl_)) {}

Texture::~Texture() = default;
Texture::Texture(Texture&&) noexcept = default;

Texture& Texture::operator=(Texture&& other) noexcept {
    impl_ = std::move(other.impl_);  // the old one before its renderer
    own_ = std::move(other.own_);
    renderer_ = other.renderer_;
    return *this;
}

void Texture::draw(const asset::View& view, const Output& output) const {
    renderer_->draw(*this, view, output);
}

std::size_t Texture::update(const asset::AssetView& asset, const asset::Difference& difference) {
    return renderer_->update(*this, asset, difference);
}

std::optional<double> Texture::finestPixel() const { return impl_->finestPixel; }

}  // namespace vtm::gl
