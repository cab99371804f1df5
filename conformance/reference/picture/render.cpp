#include <memory>
#include <stdexcept>

#include <vtm/limits/limits.hpp>
#include "conformance/reference/coverage/bands.hpp"
#include "conformance/reference/coverage/coverage.hpp"
#include "conformance/reference/coverage/rows.hpp"
#include "conformance/reference/picture/layered.hpp"
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

image::Raster renderFlat(const View& view, const Options& options, const auto& flatten) {
    const bool isCompat = options.mode == Mode::Compat;
    const FlatScene picture =
        flatten(view, options.flatness, isCompat ? Patterns::Sampled : Patterns::LaidOut, options.materials);
    if (isCompat)
        return renderRows(picture, [&] { return std::make_unique<CompatRows>(picture); });
    return renderRows(picture, [&] { return std::make_unique<ExactRows>(picture, options.samples); });
}

Pixels drawNodes(const scene::NodeList& nodes, const Affine& toPixels, const Pixels& place,
                 const Options& options) {
    Pixels drawn = place.blank();
    if (place.width == 0 || place.height == 0)
        return drawn;
    scene::Group group;
    group.children = nodes;
    View view{place.width, place.height, toPixels};
    view.toPixels[2] -= glm::dvec2(place.x0, place.y0);
    const image::Raster raster =
        renderFlat(view, options, [&](const auto&... how) { return flattenGroup(group, how...); });
    drawn.fill([&](int x, int y) {
        const float* p = raster.pixel(x - place.x0, y - place.y0);
        return Colour(p[0], p[1], p[2], p[3]);
    });
    return drawn;
}

image::Raster renderFiltered(const scene::Scene& scene, const View& view, const Options& options) {
    const Pixels drawn =
        drawLayered(scene, view.toPixels, Pixels(0, 0, view.width, view.height), options.mode == Mode::Compat,
                    [&](const scene::NodeList& nodes, const Affine& toPixels, const Pixels& place) {
                        return drawNodes(nodes, toPixels, place, options);
                    });
    image::Raster raster(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            for (int c = 0; c < 4; ++c)
                raster.pixel(x, y)[c] = float(drawn.get(x, y)[c]);
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
    return hasFilters(scene.root)
               ? renderFiltered(scene, view, options)
               : renderFlat(view, options, [&](const auto&... how) { return flattenScene(scene, how...); });
}

}  // namespace vtm::reference
