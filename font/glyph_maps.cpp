#include "font/glyph_maps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/limits/limits.hpp>
#include "asset/place.hpp"
#include "font/tag.hpp"
#include "geometry/cubic.hpp"

namespace vtm::font {
namespace {

using asset::Asset;
using glm::dvec2;
using scene::Path;
using text::GlyphId;

constexpr const char* familyName = "font";  // in a set of its own

/// FNV-1a.
class Hash {
public:
    void add(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes)
            value_ = (value_ ^ byte) * 0x100000001B3u;
    }
    void add(std::uint64_t word) {
        for (int i = 0; i < 64; i += 8)
            value_ = (value_ ^ ((word >> i) & 0xFFu)) * 0x100000001B3u;
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325u;
};

std::uint64_t keyOf(std::span<const std::uint8_t> file, const Options& options) {
    Hash hash;
    hash.add(file);
    hash.add(options.face);
    for (const Variation& variation : options.variations) {
        hash.add(tagOf(variation.axis));
        hash.add(std::bit_cast<std::uint32_t>(variation.value));
    }
    hash.add(std::bit_cast<std::uint64_t>(options.tolerance));
    hash.add(std::bit_cast<std::uint64_t>(options.nanosecondsPerByte));
    return hash.value();
}

text::FontOptions noFonts() {
    text::FontOptions options;
    options.systemFonts = false;
    return options;
}

/// Glyphs have no arcs.
geometry::Box boundsOf(const Path& path) {
    geometry::Box box;
    dvec2 at(0);
    for (const scene::Command& command : path) {
        if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            box.add(geometry::bounds(geometry::raised(at, quad->control, quad->to)));
        else if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
            box.add(geometry::bounds({at, cubic->control1, cubic->control2, cubic->to}));
        if (const std::optional<dvec2> end = scene::endOf(command)) {
            at = *end;
            box.add(at);
        }
    }
    return box;
}

/// One map: what lies within `clip` of the outline, in the smallest square around that, which is where the
/// map says.
Asset compiledOutline(const Path& path, const Options& how, const geometry::Box* clip = nullptr) {
    geometry::Box box = boundsOf(path);
    if (clip)
        box = box.intersection(*clip);
    constexpr double smallestSide = 0x1p-10;  // of outlines without area
    const double side = std::max({box.width(), box.height(), smallestSide});
    const dvec2 corner = 0.5 * (box.min + box.max) - 0.5 * side;
    scene::Scene scene;
    scene.width = scene.height = side;
    scene::Item item;
    item.path = std::make_shared<const Path>(mapped(path, 1, -corner));
    scene.root.children.push_back({std::move(item)});
    if (clip) {
        scene::ClipShape shape;
        shape.path = std::make_shared<const Path>(scene::rectangle(clip->min - corner, clip->max - corner));
        scene.root.clip = std::make_shared<const scene::Clip>(scene::Clip{{shape}, {}});
    }
    compiler::Options options;
    options.instances = false;
    options.tolerance = std::clamp(how.tolerance / side, 0x1p-24, 0x1p-6);
    options.nanosecondsPerByte = how.nanosecondsPerByte;
    Asset asset = compiler::compile(scene, options).asset;
    asset.maps.front().x += corner.x;
    asset.maps.front().y += corner.y;
    return asset;
}

}  // namespace

// ---- Growing --------------------------------------------------------------------------------------

GlyphMaps::GlyphMaps(std::span<const std::uint8_t> file, const Options& how)
    : options(how), key(keyOf(file, how)), fonts(noFonts()) {
    if (!(options.tolerance >= 0x1p-22 && options.tolerance <= 0x1p-8))
        throw std::invalid_argument("font: tolerance must be in [2^-22, 2^-8]");
    if (!(options.nanosecondsPerByte >= 1 && options.nanosecondsPerByte <= 1e6))
        throw std::invalid_argument("font: nanosecondsPerByte must be in [1, 1e6]");
    text::FontFace face;
    face.family = familyName;
    face.maxWeight = 1000;
    face.minWeight = 1;
    face.index = options.face;
    try {
        fonts.add(face, file);
    } catch (const text::FontError& error) {
        throw FontError(error.what());
    }
    query.families = {familyName};
    query.synthesizeWeight = query.synthesizeSlant = false;
    for (const Variation& variation : options.variations)
        query.variations.push_back({tagOf(variation.axis), variation.value});
    font = fonts.primary(query);
    if (!font)
        throw FontError("the font has no glyphs");
    compiled.maps = {{0, 0, 1, asset::Entry::make(asset::Entry::Kind::Solid, 0), 0}};
    constexpr asset::Paint black{0, 0, 0, std::bit_cast<std::uint32_t>(1.0f)};
    compiled.paints = {asset::Paint{}, black};                      // of the specimen
    compiled.finestPixel = options.tolerance / asset::finestShare;  // what is proven of each part
}

std::shared_ptr<const Path> GlyphMaps::outlineOf(GlyphId glyph) const {
    std::shared_ptr<const Path> outline = font->outlineOf(glyph);
    return outline && outline->empty() ? nullptr : outline;
}

std::uint32_t GlyphMaps::append(const asset::AssetView& map) {
    try {
        const std::uint16_t index = asset::appendMap(map, compiled);
        compiled.finestPixel = std::max(*compiled.finestPixel, map.finestPixel.value_or(0));
        compiled.fallbackLeaves += map.fallbackLeaves;
        return index;
    } catch (const asset::TooManyInstances&) {
        throw FontError("the font has more than 65535 outlines");
    }
}

std::vector<std::vector<asset::GlyphPart>> GlyphMaps::compile(const std::vector<Path>& outlines) {
    std::vector<std::vector<Part>> parts(outlines.size());
    const auto inParallel = [&](std::size_t count, const auto& work) {
        tbb::parallel_for(std::size_t{0}, count, [&, holding = limits::current()](std::size_t i) {
            const limits::Scope scope(holding);
            work(i);
        });
    };
    inParallel(outlines.size(), [&](std::size_t i) { parts[i] = font::partsOf(outlines[i], em()); });
    std::vector<std::pair<PartKey, const Part*>> missing;
    for (const std::vector<Part>& ofOne : parts)
        for (const Part& part : ofOne)
            if (PartKey found = part.key(); maps_.try_emplace(found, 0).second)
                missing.emplace_back(std::move(found), &part);
    std::vector<Asset> made(missing.size());
    inParallel(missing.size(), [&](std::size_t i) {
        made[i] = compiledOutline(mapped(missing[i].second->path, 1 / em(), dvec2(0)), options);
    });
    for (std::size_t i = 0; i < missing.size(); ++i)
        maps_[missing[i].first] = append(made[i]);
    std::vector<std::vector<asset::GlyphPart>> result(outlines.size());
    for (std::size_t i = 0; i < outlines.size(); ++i)
        for (const Part& part : parts[i]) {
            const dvec2 at = part.at / em();
            result[i].push_back({maps_.at(part.key()), float(at.x), float(at.y), 0});
        }
    return result;
}

void GlyphMaps::add(std::span<const GlyphId> wanted) {
    std::vector<GlyphId> missing;
    for (const GlyphId glyph : wanted)
        if (!glyphs.contains(glyph))
            missing.push_back(glyph);
    std::ranges::sort(missing);
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    std::vector<Path> outlines;
    for (const GlyphId glyph : missing) {
        const auto outline = outlineOf(glyph);
        outlines.push_back(outline ? *outline : Path());
    }
    auto made = compile(outlines);
    for (std::size_t i = 0; i < missing.size(); ++i)
        glyphs[missing[i]] = {0, std::move(made[i])};
}

const std::vector<asset::GlyphPart>& GlyphMaps::partsOf(GlyphId glyph) {
    add(std::span(&glyph, 1));
    return glyphs.at(glyph).parts;
}

const std::vector<asset::GlyphPart>& GlyphMaps::partsOf(const std::vector<GlyphAt>& group) {
    const auto known = groups_.find(group);
    if (known != groups_.end())
        return known->second;
    Path all;
    for (const GlyphAt& glyph : group)
        if (const auto outline = outlineOf(glyph.id)) {
            const Path moved = mapped(*outline, 1, glyph.at);
            all.insert(all.end(), moved.begin(), moved.end());
        }
    return groups_[group] = compile({all}).front();
}

const std::vector<asset::GlyphPart>& GlyphMaps::clippedPartsOf(GlyphId glyph, const geometry::Box& box) {
    const auto [known, isNew] = clipped_.try_emplace({glyph, box.min.x, box.min.y, box.max.x, box.max.y});
    const auto outline = outlineOf(glyph);
    if (!isNew || !outline)
        return known->second;
    const Path path = mapped(*outline, 1 / em(), dvec2(0));
    if (!boundsOf(path).intersection(box).empty())
        known->second = {{append(compiledOutline(path, options, &box)), 0, 0, 0}};
    return known->second;
}

void GlyphMaps::take(const asset::AssetView& made, const asset::Glyph& glyph) {
    const auto outline = outlineOf(glyph.id);
    const std::vector<Part> parts = outline ? font::partsOf(*outline, em()) : std::vector<Part>();
    if (glyphs.contains(glyph.id) || parts.size() != glyph.partCount())
        return;
    Glyph taken{glyph.character, {}};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        asset::GlyphPart part = made.glyphParts[glyph.firstPart() + i];
        const auto [known, isNew] = maps_.try_emplace(parts[i].key(), 0);
        if (isNew)
            known->second = append(asset::extractMap(made, part.map));
        part.map = known->second;
        taken.parts.push_back(part);
    }
    glyphs[glyph.id] = std::move(taken);
}

}  // namespace vtm::font
