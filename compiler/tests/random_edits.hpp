/// \file
/// Random scenes of every kind of node, and random edits of them.
#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include <vtm/scene/scene.hpp>

namespace vtm::compiler::test {

/// A scene of 64 × 64 that is edited. Seeded: the same edits every time.
class RandomEditor {
public:
    enum class Filters { None, Some };

    RandomEditor(unsigned seed, int items, Filters filters = Filters::None)
        : random_(seed), filters_(filters) {
        for (int i = 0; i < items; ++i)
            insert();
    }

    const scene::Scene& scene() const { return scene_; }

    /// Changes the scene; returns what was done.
    std::string edit() {
        struct Edit {
            const char* name;
            void (RandomEditor::*make)();
        };
        constexpr std::array<Edit, 18> edits{{{"move", &RandomEditor::move},
                                              {"recolour", &RandomEditor::recolour},
                                              {"paint", &RandomEditor::repaint},
                                              {"part of a paint", &RandomEditor::changePaint},
                                              {"opacity", &RandomEditor::changeOpacity},
                                              {"rule", &RandomEditor::changeRule},
                                              {"stroke", &RandomEditor::changeStroke},
                                              {"path", &RandomEditor::changePath},
                                              {"insert", &RandomEditor::insert},
                                              {"remove", &RandomEditor::remove},
                                              {"swap", &RandomEditor::swapNeighbours},
                                              {"wrap", &RandomEditor::wrap},
                                              {"split", &RandomEditor::split},
                                              {"group opacity", &RandomEditor::changeGroupOpacity},
                                              {"blend", &RandomEditor::changeBlend},
                                              {"clip", &RandomEditor::changeClip},
                                              {"mask", &RandomEditor::changeMask},
                                              {"several", &RandomEditor::several}}};
        if (filters_ == Filters::Some && chance(5)) {
            changeFilter();
            return "filter";
        }
        const Edit& e = edits[below(edits.size())];
        (this->*e.make)();
        return e.name;
    }

private:
    using Item = scene::Item;
    using Group = scene::Group;

    std::size_t below(std::size_t n) { return random_() % n; }
    bool chance(unsigned oneIn) { return random_() % oneIn == 0; }
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    float tenth() { return static_cast<float>(below(11)) / 10; }
    scene::Point place() { return {uniform(-8, 72), uniform(-8, 72)}; }

    scene::Color color() { return {tenth(), tenth(), tenth(), chance(2) ? 1.0f : tenth()}; }

    std::vector<scene::GradientStop> stops() { return {{0, color()}, {0.5f, color()}, {1, color()}}; }

    std::shared_ptr<const image::Bitmap> bitmap() {
        auto bitmap = std::make_shared<image::Bitmap>();
        bitmap->width = bitmap->height = 4;
        for (int i = 0; i < 4 * 16; ++i)
            bitmap->rgba.push_back(std::uint8_t(i % 4 == 3 ? 255 : below(256)));
        return bitmap;
    }

    scene::Paint paint() {
        switch (below(9)) {
            case 8:
                return scene::ImagePaint{bitmap(), scene::ImageFilter::Trilinear, {9, 0, 0, 9, 0, 0}};
            case 0:
                return scene::LinearGradient{place(), place(), stops()};
            case 1:
                return scene::RadialGradient{{30, 30}, uniform(5, 40), {31, 32}, 0, stops()};
            case 2:
                return scene::Material{"stone", "vec4 stone(vec2 p) { return vec4(1.0); }", color()};
            case 3: {
                Group tile;
                tile.children.push_back({fill(scene::rectangle({0, 0}, {uniform(2, 9), 7}), color())});
                return scene::Pattern{{0, 0}, {11, 13}, std::make_shared<Group>(std::move(tile))};
            }
            default:
                return color();
        }
    }

    scene::Path path() {
        switch (below(3)) {
            case 0: {
                const scene::Point p = place();
                return scene::rectangle(p, p + scene::Point{uniform(1, 40), uniform(1, 40)});
            }
            case 1:
                return {scene::MoveTo{place()}, scene::CubicTo{place(), place(), place()},
                        scene::QuadTo{place(), place()}, scene::Close{}};
            default:
                return {scene::MoveTo{place()}, scene::LineTo{place()}, scene::LineTo{place()},
                        scene::LineTo{place()}, scene::Close{}};
        }
    }

    static Item fill(scene::Path path, scene::Paint paint) {
        Item item;
        item.path = std::make_shared<scene::Path>(std::move(path));
        item.geometry = scene::FillRule::NonZero;
        item.paint = std::move(paint);
        return item;
    }

    Item item() {
        Item item = fill(path(), paint());
        if (chance(4))
            item.geometry = stroke();
        if (chance(4))
            item.opacity = tenth();
        return item;
    }

    scene::StrokeStyle stroke() {
        scene::StrokeStyle style;
        style.width = uniform(0.2, 6);
        style.cap = scene::Cap::Round;
        if (chance(3))
            style.dashes = {uniform(1, 5), uniform(1, 5)};
        return style;
    }

    std::shared_ptr<const scene::Clip> clip() {
        auto clip = std::make_shared<scene::Clip>();
        for (std::size_t i = below(3); i-- > 0;)
            clip->shapes.push_back({std::make_shared<scene::Path>(path()), scene::identity,
                                    chance(2) ? scene::FillRule::NonZero : scene::FillRule::EvenOdd,
                                    nullptr});
        if (chance(4))
            clip->clip = this->clip();
        return clip;
    }

    std::shared_ptr<const Group> content() {
        auto content = std::make_shared<Group>();
        for (std::size_t i = below(4); i-- > 0;)
            content->children.emplace_back().value = item();
        return content;
    }

    scene::Select select() {
        scene::Select select;
        select.mask.path = std::make_shared<scene::Path>(path());
        select.inside = chance(4) ? nullptr : content();
        select.outside = chance(4) ? nullptr : content();
        return select;
    }

    std::shared_ptr<const scene::Mask> mask() {
        auto mask = std::make_shared<scene::Mask>();
        mask->content = content();
        mask->kind = chance(2) ? scene::MaskKind::Alpha : scene::MaskKind::Luminance;
        return mask;
    }

    scene::FilterPrimitive primitive(std::size_t number, scene::Point min, scene::Point max) {
        using namespace scene;
        const auto input = [&] {
            const std::size_t of = below(number + 1);
            return of == 0 ? FilterInput{} : FilterInput{FilterInput::Kind::Result, of - 1};
        };
        const auto size = [&] { return float(uniform(0.2, 4)); };
        switch (below(7)) {
            case 0:
                return {OffsetFilter{size(), -size()}, {input()}, min, max, chance(2)};
            case 1:
                return {DropShadowFilter{size(), size(), size(), size(), color()},
                        {input()},
                        min,
                        max,
                        chance(2)};
            case 2:
                return {MorphologyFilter{size(), size(), chance(2)}, {input()}, min, max, chance(2)};
            case 3:
                return {MergeFilter{}, {input(), input()}, min, max, chance(2)};
            case 4:
                return {FloodFilter{color()}, {}, min, max, chance(2)};
            case 5:
                return {PictureFilter{content()}, {}, min, max, chance(2)};
            default:
                return {GaussianBlurFilter{size(), size()}, {input()}, min, max, chance(2)};
        }
    }

    std::shared_ptr<const scene::Filter> filter() {
        auto filter = std::make_shared<scene::Filter>();
        filter->min = {uniform(-8, 20), uniform(-8, 20)};
        filter->max = {uniform(40, 72), uniform(40, 72)};
        if (chance(3))
            filter->transform = {0.9, 0.3, -0.3, 0.8, 4, -3};
        for (std::size_t i = 0; i < 3; ++i)
            filter->primitives.push_back(primitive(i, filter->min, filter->max));
        return filter;
    }

    // ---- places in the scene

    static void collect(Group& group, std::vector<Group*>& groups, std::vector<Item*>& items) {
        groups.push_back(&group);
        for (scene::Node& node : group.children) {
            if (auto* inner = std::get_if<Group>(&node.value))
                collect(*inner, groups, items);
            else if (auto* item = std::get_if<Item>(&node.value))
                items.push_back(item);
        }
    }

    Group& anyGroup() {
        std::vector<Group*> groups;
        std::vector<Item*> items;
        collect(scene_.root, groups, items);
        return *groups[below(groups.size())];
    }

    /// With an item in the scene, that is.
    Item& anyItem() {
        std::vector<Group*> groups;
        std::vector<Item*> items;
        collect(scene_.root, groups, items);
        if (items.empty()) {
            scene_.root.children.emplace_back().value = item();
            return std::get<Item>(scene_.root.children.back().value);
        }
        return *items[below(items.size())];
    }

    // ---- edits

    void move() {
        scene::Affine& m = anyItem().transform;
        m = scene::compose(scene::translation(uniform(-9, 9), uniform(-9, 9)), m);
    }
    void recolour() { anyItem().paint = color(); }
    void repaint() { anyItem().paint = paint(); }
    /// What a record says, which stays where it is.
    void changePaint() {
        std::visit(
            [&](auto& paint) {
                if constexpr (requires { paint.stops; })
                    paint.stops[1].color = color();
                if constexpr (requires { paint.fallback; })
                    paint.fallback = color();
                if constexpr (requires { paint.bitmap; })
                    paint.bitmap = bitmap();
            },
            anyItem().paint);
    }
    void changeOpacity() { anyItem().opacity = chance(3) ? 1 : tenth(); }
    void changeRule() {
        anyItem().geometry = chance(2) ? scene::FillRule::NonZero : scene::FillRule::EvenOdd;
    }
    void changeStroke() { anyItem().geometry = stroke(); }
    void changePath() { anyItem().path = std::make_shared<scene::Path>(path()); }

    void insert() {
        Group& group = anyGroup();
        const auto at = static_cast<std::ptrdiff_t>(below(group.children.size() + 1));
        group.children.insert(group.children.begin() + at,
                              chance(8) ? scene::Node{select()} : scene::Node{item()});
    }
    void remove() {
        Group& group = anyGroup();
        if (group.children.empty())
            return;
        const auto at = static_cast<std::ptrdiff_t>(below(group.children.size()));
        group.children.erase(group.children.begin() + at);
        if (scene_.root.children.size() < 6)
            insert(), insert(), insert();
    }
    void swapNeighbours() {
        Group& group = anyGroup();
        if (group.children.size() < 2)
            return;
        const std::size_t at = below(group.children.size() - 1);
        std::swap(group.children[at], group.children[at + 1]);
    }
    /// Puts neighbours into a group of their own.
    void wrap() {
        Group& group = anyGroup();
        if (group.children.empty())
            return;
        const std::size_t at = below(group.children.size());
        const std::size_t end = std::min(group.children.size(), at + 3);
        const auto first = group.children.begin() + static_cast<std::ptrdiff_t>(at);
        const auto last = group.children.begin() + static_cast<std::ptrdiff_t>(end);
        Group inner;
        inner.children.assign(first, last);
        group.children.erase(first, last);
        group.children.insert(group.children.begin() + static_cast<std::ptrdiff_t>(at),
                              scene::Node{std::move(inner)});
    }
    /// Makes two equal groups of a group in another.
    void split() {
        Group& parent = anyGroup();
        for (auto at = parent.children.begin(); at != parent.children.end(); ++at) {
            auto* first = std::get_if<Group>(&at->value);
            if (!first || first->children.size() < 2)
                continue;
            Group second = *first;
            const auto middle = static_cast<std::ptrdiff_t>(1 + below(first->children.size() - 1));
            first->children.erase(first->children.begin() + middle, first->children.end());
            second.children.erase(second.children.begin(), second.children.begin() + middle);
            parent.children.insert(at + 1, scene::Node{std::move(second)});
            return;
        }
    }
    void changeGroupOpacity() { anyGroup().opacity = chance(3) ? 1 : tenth(); }
    void changeBlend() { anyGroup().blend = static_cast<scene::BlendMode>(chance(2) ? 0 : below(16)); }
    void changeClip() { anyGroup().clip = chance(3) ? nullptr : clip(); }
    void changeMask() { anyGroup().mask = chance(2) ? nullptr : mask(); }
    void changeFilter() { anyGroup().filter = chance(3) ? nullptr : filter(); }
    void several() {
        for (int i = 0; i < 4; ++i)
            edit();
    }

    std::mt19937 random_;
    const Filters filters_;
    scene::Scene scene_{64, 64, {}};
};

}  // namespace vtm::compiler::test
