// Section 12: filters that change pixels one by one.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "api/openvg/image/filter_images.hpp"

using namespace vtm::openvg;

namespace {

/// Replaces each row of the destination by what `change` makes of the source's, normalized.
template <class Change>
void filterRows(const Context& context, const FilterImages& images, ColorSpace output, Change&& change) {
    const ColorSpace space = filterSpace(context.state);
    std::vector<Color> row(std::size_t(images.src->width()));
    const std::span<Color> colors = std::span(row).first(std::size_t(images.width()));
    for (int y = 0; y < images.height(); ++y) {
        normalizedRow(*images.src, y, space, row);
        for (Color& color : colors)
            color = change(color);
        writeFilteredRow(context.state, *images.dst, y, colors, output);
    }
}

/// Numbers of [0, 1] for table entries.
using UnitTable = std::array<float, 256>;
const UnitTable& unitBytes() {
    static const UnitTable values = [] {
        UnitTable v;
        for (std::size_t i = 0; i < v.size(); ++i)
            v[i] = float(i) / 255;
        return v;
    }();
    return values;
}

std::size_t tableIndex(float channel) { return std::size_t(std::clamp(channel, 0.0f, 1.0f) * 255 + 0.5f); }

}  // namespace

void vgColorMatrix(VGImage dst, VGImage src, const VGfloat* matrix) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        require(matrix != nullptr && isAligned(matrix));
        glm::mat4 m;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                m[c][r] = matrix[4 * c + r];
        const Color added(matrix[16], matrix[17], matrix[18], matrix[19]);
        const ColorSpace space = filterSpace(context.state);
        if (!areFilteredInTextures(context, images, space, MatrixFilter{m, added}))
            filterRows(context, images, space, [&](Color c) { return m * c + added; });
    });
}

void vgLookup(VGImage dst, VGImage src, const VGubyte* redLUT, const VGubyte* greenLUT,
              const VGubyte* blueLUT, const VGubyte* alphaLUT, VGboolean outputLinear,
              VGboolean outputPremultiplied) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        for (const VGubyte* table : {redLUT, greenLUT, blueLUT, alphaLUT})
            require(table != nullptr);
        const ColorSpace output{outputLinear != VG_FALSE, outputPremultiplied != VG_FALSE, false};
        const UnitTable& units = unitBytes();
        TableFilter table{{}, -1};
        for (int i = 0; i < 256; ++i)
            table.entries.emplace_back(units[redLUT[i]], units[greenLUT[i]], units[blueLUT[i]],
                                       units[alphaLUT[i]]);
        if (areFilteredInTextures(context, images, output, table))
            return;
        filterRows(context, images, output, [&](Color c) {
            return Color(table.entries[tableIndex(c.r)].r, table.entries[tableIndex(c.g)].g,
                         table.entries[tableIndex(c.b)].b, table.entries[tableIndex(c.a)].a);
        });
    });
}

void vgLookupSingle(VGImage dst, VGImage src, const VGuint* lookupTable, VGImageChannel sourceChannel,
                    VGboolean outputLinear, VGboolean outputPremultiplied) {
    call([&](Context& context) {
        const FilterImages images(context, dst, src);
        require(lookupTable != nullptr && isAligned(lookupTable));
        const PixelFormat& format = images.src->format();
        int channel = 0;
        if (format.grey.bits == 0 && format.red.bits == 0) {
            channel = 3;
        } else if (format.grey.bits == 0) {
            require(sourceChannel == VG_RED || sourceChannel == VG_GREEN || sourceChannel == VG_BLUE ||
                    sourceChannel == VG_ALPHA);
            channel = sourceChannel == VG_RED     ? 0
                      : sourceChannel == VG_GREEN ? 1
                      : sourceChannel == VG_BLUE  ? 2
                                                  : 3;
        }
        const ColorSpace output{outputLinear != VG_FALSE, outputPremultiplied != VG_FALSE, false};
        const UnitTable& units = unitBytes();
        TableFilter table{{}, channel};
        for (const VGuint entry : std::span(lookupTable, 256))
            table.entries.emplace_back(units[entry >> 24], units[entry >> 16 & 255], units[entry >> 8 & 255],
                                       units[entry & 255]);
        if (!areFilteredInTextures(context, images, output, table))
            filterRows(context, images, output,
                       [&](Color c) { return table.entries[tableIndex(c[channel])]; });
    });
}
