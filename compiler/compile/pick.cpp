#include <vtm/compiler/pick.hpp>

#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include <vtm/raster/paint_at.hpp>

namespace vtm::compiler {

namespace {

using scene::Color;
using scene::Group;
using scene::Item;
using scene::Node;

/// 24 bits in three bytes; 0 is no item.
Color colorOf(std::uint32_t number) {
    const auto byte = [&](unsigned shift) { return float(number >> shift & 255u) / 255.0f; };
    return {byte(16), byte(8), byte(0), 1};
}

/// Masks multiply by a sum of weights that may be off 1 by rounding.
std::optional<std::uint32_t> numberOf(const asset::Paint& paint) {
    constexpr float rounding = 1e-3f;  // of a byte's step
    std::uint32_t number = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const float value = std::bit_cast<float>(paint[c]) * 255.0f, whole = std::round(value);
        if (!(std::abs(value - whole) <= rounding) || whole < 0 || whole > 255)
            return std::nullopt;
        number = number << 8 | std::uint32_t(whole);
    }
    return number;
}

float alphaOf(const scene::Paint& paint) {
    const auto* color = std::get_if<Color>(&paint);
    return color == nullptr ? 1 : color->a;
}

bool isBlack(const scene::Paint& paint) {
    const auto* color = std::get_if<Color>(&paint);
    return color != nullptr && color->r == 0 && color->g == 0 && color->b == 0;
}

class Rewriting {
public:
    Group numbered(const Group& group) {
        Group result = frameOf(group);
        limits::check();
        for (const Node& node : group.children)
            result.children.push_back(
                std::visit([&](const auto& value) { return numberedNode(value); }, node.value));
        return result;
    }
    std::vector<const Item*> takeItems() { return std::move(items_); }

private:
    /// What of a group is geometry.
    static Group frameOf(const Group& group) {
        Group result;
        result.clip = group.clip;
        if (group.mask)
            result.mask = std::make_shared<const scene::Mask>(scene::Mask{
                std::make_shared<const Group>(blackAndWhite(*group.mask->content, group.mask->kind)),
                group.mask->kind, false});
        return result;
    }

    Node numberedNode(const Item& item) {
        if (items_.size() == maxPickItems)
            throw LimitError("the picture has more than " + std::to_string(maxPickItems) + " items to pick");
        items_.push_back(&item);
        Item result = item;
        result.opacity = 1;
        result.paint = colorOf(std::uint32_t(items_.size()));
        return {std::move(result)};
    }
    Node numberedNode(const Group& group) { return {numbered(group)}; }
    Node numberedNode(const scene::Select& select) {
        const auto side = [&](const std::shared_ptr<const Group>& group) {
            return group ? std::make_shared<const Group>(numbered(*group)) : nullptr;
        };
        scene::Select result;
        result.mask = select.mask;
        result.inside = side(select.inside);
        result.outside = side(select.outside);
        return {std::move(result)};
    }

    /// A mask's content: what lets something through white, what does not black, nothing in between.
    static Group blackAndWhite(const Group& group, scene::MaskKind kind) {
        Group result = frameOf(group);
        if (group.opacity == 0)
            return result;
        limits::check();
        for (const Node& node : group.children)
            if (const auto* item = std::get_if<Item>(&node.value)) {
                if (item->opacity * alphaOf(item->paint) == 0)
                    continue;
                Item plain = *item;
                plain.opacity = 1;
                const float light = kind == scene::MaskKind::Luminance && isBlack(item->paint) ? 0 : 1;
                plain.paint = Color{light, light, light, 1};
                result.children.push_back({std::move(plain)});
            } else if (const auto* inner = std::get_if<Group>(&node.value)) {
                result.children.push_back({blackAndWhite(*inner, kind)});
            } else {
                const auto& select = std::get<scene::Select>(node.value);
                const auto side = [&](const std::shared_ptr<const Group>& g) {
                    return g ? std::make_shared<const Group>(blackAndWhite(*g, kind)) : nullptr;
                };
                result.children.push_back(
                    {scene::Select{select.mask, side(select.inside), side(select.outside)}});
            }
        return result;
    }

    std::vector<const Item*> items_;
};

}  // namespace

PickMap compilePickMap(const scene::Scene& scene, const Options& options) {
    if (options.mode != asset::Mode::Exact)
        throw std::invalid_argument("a pick map must be compiled in exact mode");
    scene::validate(scene);
    Rewriting rewriting;
    const scene::Scene rewritten{scene.width, scene.height, rewriting.numbered(scene.root)};
    PickMap map;
    map.asset = compile(rewritten, options).asset;
    map.items = rewriting.takeItems();
    for (const asset::Paint& paint : map.asset.paints) {
        const std::optional<std::uint32_t> number = asset::isProgram(paint) ? std::nullopt : numberOf(paint);
        const bool known = number && *number > 0 && *number <= map.items.size();
        map.itemOfPaint.push_back(known ? std::optional(*number - 1) : std::nullopt);
    }
    return map;
}

std::optional<std::uint32_t> itemAt(const PickMap& map, glm::dvec2 point) {
    return map.itemOfPaint[asset::paintAt(map.asset, point)];
}

}  // namespace vtm::compiler
