#include <memory>
#include <stdexcept>

#include <vtm/limits/limits.hpp>
#include "conformance/reference/coverage/bands.hpp"
#include "conformance/reference/coverage/coverage.hpp"
#include "conformance/reference/coverage/rows.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::reference {
namespace {

void store(std::span<const Colour> row, float* out) {
    for (const Colour& colour : row)
        for (int c = 0; c < 4; ++c)
            *out++ = float(colour[c]);
}

/// Renders band by band; each thread has the rows renderer that `makeRows` makes.
template <class MakeRows>
image::Raster renderRows(const FlatScene& picture, const MakeRows& makeRows) {
    image::Raster raster(picture.width, picture.height);
    forEachBand(picture.height, [&] {
        return [&, rows = makeRows(), parts = std::vector<EdgePart>(), colours = std::vector<Colour>()](
                   int first, int end) mutable {
            const std::vector<Edge> edges = edgesOfBand(picture.edges, first, end);
            for (int y = first; y < end; ++y) {
                limits::check();
                parts.clear();
                cutToRow(edges, y, parts);
                colours.assign(std::size_t(picture.width), Colour(0));
                rows->render(parts, y, colours.data());
                store(colours, raster.pixel(0, y));
            }
        };
    });
    return raster;
}

}  // namespace

image::Raster render(const scene::Scene& scene, const View& view, const Options& options) {
    checkView(view);
    scene::validate(scene);
    const limits::Stage stage("rendering");
    if (options.samples < 1 || options.samples > 256)
        throw std::invalid_argument("reference: " + std::to_string(options.samples) + " samples");
    if (!(options.flatness > 0))
        throw std::invalid_argument("reference: flatness must be > 0");
    if (options.mode == Mode::Compat) {
        const FlatScene picture =
            flattenScene(scene, view, options.flatness, Patterns::Sampled, options.materials);
        return renderRows(picture, [&] { return std::make_unique<CompatRows>(picture); });
    }
    const FlatScene picture =
        flattenScene(scene, view, options.flatness, Patterns::LaidOut, options.materials);
    return renderRows(picture, [&] { return std::make_unique<ExactRows>(picture, options.samples); });
}

}  // namespace vtm::reference
