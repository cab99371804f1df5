#include "backend_gl/upload/asset_texels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/turns.hpp"
#include "image/levels.hpp"

namespace vtm::gl {

namespace {

/// Of a texture with so many texels, at least one.
std::size_t rowsOf(std::size_t texels, unsigned columnsLog2) {
    const std::size_t columns = std::size_t(1) << columnsLog2;
    const std::size_t rows = (std::max<std::size_t>(texels, 1) + columns - 1) / columns;
    if (rows > std::size_t(std::numeric_limits<GLsizei>::max()))
        throw GlError("the asset is too large for a texture");
    return rows;
}

/// `items` grows to whole rows.
template <class Items>
TextureHandle layOut(Items items, std::size_t itemsPerTexel, unsigned columnsLog2, GLenum format,
                     GLenum layout, GLenum type) {
    const std::size_t columns = std::size_t(1) << columnsLog2;
    const std::size_t rows = rowsOf(items.size() / itemsPerTexel, columnsLog2);
    TextureHandle texture = makeTexture(format, int(columns), int(rows));
    items.resize(rows * columns * itemsPerTexel);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, GLsizei(columns), GLsizei(rows), layout, type, items.data());
    checkErrors("upload");
    return texture;
}

}  // namespace

ImageTexels imageTexels(const asset::AssetView& asset) {
    const std::vector<bool> withLevels = asset::imagesWithLevels(asset);
    ImageTexels texels;
    const auto append = [&](std::span<const std::uint8_t> rgba) {
        texels.rgba.insert(texels.rgba.end(), rgba.begin(), rgba.end());
    };
    for (std::size_t i = 0; i < asset.images.size(); ++i) {
        const image::Bitmap& bitmap = asset.images[i];
        texels.list.push_back({std::uint32_t(texels.rgba.size() / 4), std::uint32_t(bitmap.width),
                               std::uint32_t(bitmap.height), 0});
        append(bitmap.rgba);
        if (withLevels[i])
            for (const image::Level& level : image::levelsOf(bitmap))
                append(level.rgba);
    }
    return texels;
}

TextureHandle texelTexture(std::vector<asset::Texel> texels) {
    return layOut(std::move(texels), 1, texelColumnsLog2, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
}

namespace {

TextureData wholeRows(std::string name, TextureData::Format format, std::span<const std::byte> bytes,
                      std::size_t bytesPerTexel, unsigned columnsLog2) {
    const std::size_t rows = rowsOf(bytes.size() / bytesPerTexel, columnsLog2);
    TextureData data{std::move(name), format, 1u << columnsLog2, unsigned(rows), 1, false, {}};
    data.bytes.resize(rows * bytesPerTexel << columnsLog2);
    if (!bytes.empty())
        std::memcpy(data.bytes.data(), bytes.data(), bytes.size());
    return data;
}

}  // namespace

TextureData texelData(std::string name, std::span<const asset::Texel> texels) {
    return wholeRows(std::move(name), TextureData::Format::Rgba32ui, std::as_bytes(texels),
                     sizeof(asset::Texel), texelColumnsLog2);
}

TextureData imageData(std::string name, std::span<const std::uint8_t> rgba) {
    return wholeRows(std::move(name), TextureData::Format::Rgba8, std::as_bytes(rgba), 4, imageColumnsLog2);
}

void updateTexels(GLuint texture, std::size_t first, std::span<const asset::Texel> texels) {
    constexpr std::size_t columns = std::size_t(1) << texelColumnsLog2;
    glBindTexture(GL_TEXTURE_2D, texture);
    while (!texels.empty()) {
        const std::size_t column = first % columns;
        // The rest of a row that is begun, else all whole rows at once, else the start of a last row.
        const std::size_t rows = column == 0 ? std::max<std::size_t>(1, texels.size() / columns) : 1;
        const std::size_t width = std::min(texels.size(), columns - column);
        glTexSubImage2D(GL_TEXTURE_2D, 0, GLint(column), GLint(first / columns), GLsizei(width),
                        GLsizei(rows), GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels.data());
        first += width * rows;
        texels = texels.subspan(width * rows);
    }
}

namespace {

/// Whole rows.
std::size_t roomOf(std::size_t texels) {
    constexpr std::size_t columns = std::size_t(1) << texelColumnsLog2;
    return std::max<std::size_t>(1, (texels + columns - 1) / columns) * columns;
}

/// Where `next` differs from `before`, [first, end); what lies closely together is one range, as each is a
/// call.
std::vector<std::pair<std::size_t, std::size_t>> changedRanges(std::span<const asset::Texel> before,
                                                               std::span<const asset::Texel> next) {
    constexpr std::size_t gap = 32;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    for (std::size_t i = 0; i < next.size(); ++i) {
        if (i < before.size() && before[i] == next[i])
            continue;
        if (!ranges.empty() && i - ranges.back().second < gap)
            ranges.back().second = i + 1;
        else
            ranges.emplace_back(i, i + 1);
    }
    return ranges;
}

}  // namespace

RecordTexture::RecordTexture(std::vector<asset::Texel> records) : room_(roomOf(records.size())) {
    texture_ = texelTexture(std::move(records));
}

std::size_t RecordTexture::update(std::vector<asset::Texel> next) {
    std::size_t sent = 0;
    if (next.size() > room_) {
        room_ = roomOf(next.size());
        texture_ = texelTexture(next);
        sent = next.size();
    } else {
        for (const auto& [first, end] : changedRanges(records_, next)) {
            updateTexels(texture_.get(), first, std::span(next).subspan(first, end - first));
            sent += end - first;
        }
        checkErrors("update of a texture");
    }
    records_ = std::move(next);
    return sent * sizeof(asset::Texel);
}

TextureHandle imageTexture(std::vector<std::uint8_t> rgba) {
    return layOut(std::move(rgba), 4, imageColumnsLog2, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
}

namespace {

using asset::Instruction;
using asset::Op;
using asset::Texel;

/// Calls visit(first texel of the stops, their number) for every gradient with many.
template <class Visit>
void forEachLongRamp(const asset::AssetView& asset, Visit&& visit) {
    constexpr std::size_t head = sizeof(asset::Gradient) / sizeof(Texel);
    for (const asset::Paint& paint : asset.paints)
        for (std::uint32_t i = 0; asset::isProgram(paint) && i < paint[1]; ++i) {
            const auto in = std::bit_cast<Instruction>(asset.data[paint[0] + i]);
            if (in.op != Op::Linear && in.op != Op::Radial)
                continue;
            if (const std::uint32_t count = asset.data[in.argument + 1][3]; count > longRamp)
                visit(in.argument + head, count);
        }
}

using Channels = std::array<double, 4>;

/// Straight, in [0, 1].
Channels colorOf(const Texel& stop) {
    Channels color;
    for (unsigned c = 0; c < 4; ++c)
        color[c] = double(stop[1 + c / 2] >> c % 2 * 16 & 0xFFFF) / 65535;
    return color;
}

/// Of a·c from one stop to the next, both straight lines between stops: Simpson's rule is exact.
Channels integral(const Texel& from, const Texel& to) {
    const double width = double(std::bit_cast<float>(to[0])) - double(std::bit_cast<float>(from[0]));
    const Channels a = colorOf(from), b = colorOf(to);
    Channels sum;
    for (unsigned c = 0; c < 4; ++c) {
        const auto at = [&](double t) {
            const double alpha = a[3] + t * (b[3] - a[3]);
            return c == 3 ? alpha : alpha * (a[c] + t * (b[c] - a[c]));
        };
        sum[c] = width / 6 * (at(0) + 4 * at(0.5) + at(1));
    }
    return sum;
}

std::uint32_t steps(double integral) {
    constexpr double oneStep = 0x1p31;
    return std::uint32_t(std::uint64_t(std::llround(integral * oneStep)));
}

}  // namespace

bool hasLongRamps(const asset::AssetView& asset) {
    bool found = false;
    forEachLongRamp(asset, [&](std::size_t, std::uint32_t) { found = true; });
    return found;
}

std::vector<Texel> rampSums(const asset::AssetView& asset) {
    // Gradients of hostile files may overlap: from where on texels follow each other as stops of one is what
    // matters, and is found once.
    std::vector<std::size_t> ends;
    forEachLongRamp(asset, [&](std::size_t first, std::uint32_t count) {
        ends.resize(asset.data.size());
        ends[first] = std::max(ends[first], first + count);
    });
    std::vector<Texel> sums(ends.size());
    Channels sum{};
    std::size_t end = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (i < end) {
            const Channels more = integral(asset.data[i - 1], asset.data[i]);
            for (unsigned c = 0; c < 4; ++c)
                sums[i][c] = steps(sum[c] += more[c]);
        } else {
            sum = {};
        }
        end = std::max(end, ends[i]);
    }
    return sums;
}

}  // namespace vtm::gl
