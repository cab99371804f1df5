#include "conformance/reference/picture/layered.hpp"

#include <algorithm>

#include "conformance/reference/filter/filter.hpp"

namespace vtm::reference {
namespace {

bool hasFilters(const scene::Node& node) {
    const auto* group = std::get_if<scene::Group>(&node.value);
    return group && reference::hasFilters(*group);
}

bool blends(const scene::Node& node) {
    const auto* group = std::get_if<scene::Group>(&node.value);
    return group && group->blend != scene::BlendMode::Normal;
}

class Layers {
public:
    Layers(bool wholePixels, const DrawPlain& draw) : wholePixels_(wholePixels), draw_(draw) {}

    /// A group with all that it does to its content, on nothing. What ends at the frame: shapes by their
    /// geometry, what a filter makes by the share of each pixel.
    Pixels group(const scene::Group& g, const scene::Affine& toPixels, const Pixels& place,
                 const scene::Link<scene::Clip>& frame = {}) const {
        Pixels made = place.blank();
        if (g.filter) {
            scene::Group source;
            source.children = g.children;
            made = filtered(*g.filter, source, toPixels, place, wholePixels_,
                            [&](const scene::Group& content, const scene::Affine& to, const Pixels& at) {
                                return group(content, to, at);
                            });
            if (frame)
                cut(frame, toPixels, made);
        } else {
            children(g.children, toPixels, frame, made);
        }
        if (g.clip)
            cut(g.clip, toPixels, made);
        if (g.mask) {
            const Pixels mask = group(*g.mask->content, toPixels, place);
            made.fill([&](int x, int y) {
                const Colour m = mask.get(x, y);
                const double share =
                    g.mask->kind == scene::MaskKind::Alpha ? m.a : luminance(m, g.mask->linear);
                return made.get(x, y) * share;
            });
        }
        made.fill([&](int x, int y) { return made.get(x, y) * double(g.opacity); });
        return made;
    }

private:
    void children(const scene::NodeList& nodes, const scene::Affine& toPixels,
                  const scene::Link<scene::Clip>& frame, Pixels& on) const {
        scene::NodeList run;
        bool isBlank = true;
        const auto lay = [&](const Pixels& above, scene::BlendMode mode) {
            on.fill([&](int x, int y) { return blend(mode, on.get(x, y), above.get(x, y)); });
            isBlank = false;
        };
        const auto finish = [&] {
            if (!run.empty())
                lay(drawCut(std::exchange(run, {}), frame, toPixels, on), scene::BlendMode::Normal);
        };
        for (const scene::Node& node : nodes) {
            if (!hasFilters(node) && !(blends(node) && !isBlank)) {
                run.push_back(node);
                continue;
            }
            finish();
            const auto& g = std::get<scene::Group>(node.value);
            lay(group(g, toPixels, on, frame), g.blend);
        }
        finish();
    }

    Pixels drawCut(scene::NodeList nodes, const scene::Link<scene::Clip>& clip, const scene::Affine& toPixels,
                   const Pixels& place) const {
        if (!clip)
            return draw_(nodes, toPixels, place);
        scene::Group clipped;
        clipped.children = std::move(nodes);
        clipped.clip = clip;
        return draw_({scene::Node{std::move(clipped)}}, toPixels, place);
    }

    void cut(const scene::Link<scene::Clip>& clip, const scene::Affine& toPixels, Pixels& made) const {
        const Pixels share = drawCut({everything(toPixels, made)}, clip, toPixels, made);
        made.fill([&](int x, int y) { return made.get(x, y) * share.get(x, y).a; });
    }

    /// White on all pixels.
    static scene::Node everything(const scene::Affine& toPixels, const Pixels& place) {
        const auto path = std::make_shared<const scene::Path>(scene::rectangle(
            {place.x0 - 1, place.y0 - 1}, {place.x0 + place.width + 1, place.y0 + place.height + 1}));
        return {
            scene::Item{path, *scene::inverse(toPixels), scene::FillRule::NonZero, scene::Color{1, 1, 1, 1}}};
    }

    const bool wholePixels_;
    const DrawPlain& draw_;
};

}  // namespace

bool hasFilters(const scene::Group& group) {
    return group.filter || (group.mask && hasFilters(*group.mask->content)) ||
           std::ranges::any_of(group.children, [](const scene::Node& node) { return hasFilters(node); });
}

Pixels drawLayered(const scene::Scene& scene, const scene::Affine& toPixels, const Pixels& place,
                   bool wholePixels, const DrawPlain& draw) {
    scene::Clip frame;
    frame.shapes.push_back(
        {std::make_shared<const scene::Path>(scene::rectangle({0, 0}, {scene.width, scene.height})),
         scene::identity, scene::FillRule::NonZero, nullptr});
    return Layers(wholePixels, draw)
        .group(scene.root, toPixels, place, std::make_shared<const scene::Clip>(std::move(frame)));
}

}  // namespace vtm::reference
