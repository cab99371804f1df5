#include "compiler/paint/composite.hpp"

#include <algorithm>

#include <vtm/limits/limits.hpp>
#include "compiler/lower/walk_items.hpp"
#include "raster/blend.hpp"

namespace vtm::compiler {
namespace {

using asset::Instruction;
using asset::Op;

Color scaled(Color c, float by) {
    for (float& v : c)
        v *= by;
    return c;
}

/// One isolated group while it is being composited: the steps that build it on transparent black.
struct Frame {
    PaintProgram steps;

    bool constant() const { return Palette::isConstant(steps); }
    Color color() const { return Palette::colorOf(steps); }

    void solid(const Color& s) {
        if (s[3] <= 0)
            return;
        if (s[3] >= 1)
            clear();
        if (!steps.empty() && steps.back().instruction.op == Op::Solid)
            steps.back().color = over(s, steps.back().color);  // (s over t) over rest = s over (t over rest)
        else
            steps.push_back({Instruction{Op::Solid}, s});
    }

    void source(const PaintStep& step, bool opaque) {
        if (step.instruction.op == Op::Solid)
            return solid(scaled(step.color, step.instruction.opacity));
        if (opaque && step.instruction.opacity >= 1)
            clear();
        steps.push_back(step);
    }

    void clear() { steps.clear(); }

    void become(const Color& color) {
        clear();
        solid(color);
    }

    /// Whether all layers are laid over what is there: then they may be moved onto another frame, since
    /// `over` is associative. Blend modes and masks see what is in the frame.
    bool onlyOver() const {
        unsigned depth = 0;
        return std::none_of(steps.begin(), steps.end(), [&](const PaintStep& step) {
            depth = depthAfter(step, depth);
            return depth == 0 && isPop(step) &&
                   (step.instruction.op != Op::Pop || step.instruction.blend != asset::Blend::Normal);
        });
    }

    void nested(const Frame& child, Op pop, asset::Blend blend, float opacity) {
        steps.push_back({Instruction{Op::Push}, {}});
        steps.insert(steps.end(), child.steps.begin(), child.steps.end());
        steps.push_back({Instruction{pop, blend, opacity, 0}, {}});
    }

    /// The child's layers, one by one; it has onlyOver.
    void laid(const Frame& child) {
        unsigned depth = 0;
        for (const PaintStep& step : child.steps) {
            if (depth == 0 && step.instruction.op >= Op::Solid)
                source(step, false);
            else
                steps.push_back(step);
            depth = depthAfter(step, depth);
        }
    }

    /// While the frame is a single group, laid on nothing, that group gives way to its content. Returns its
    /// opacity.
    float unwrap() {
        float opacity = 1;
        while (isOneGroup()) {
            opacity *= steps.back().instruction.opacity;
            steps.pop_back();
            steps.erase(steps.begin());
        }
        return opacity;
    }

private:
    static bool isPop(const PaintStep& step) {
        return step.instruction.op > Op::Push && step.instruction.op < Op::Solid;
    }
    static unsigned depthAfter(const PaintStep& step, unsigned depth) {
        return step.instruction.op == Op::Push ? depth + 1 : isPop(step) ? depth - 1 : depth;
    }

    bool isOneGroup() const {
        if (steps.size() < 2 || steps.front().instruction.op != Op::Push ||
            steps.back().instruction.op != Op::Pop)
            return false;
        unsigned depth = 0;
        return std::none_of(steps.begin(), steps.end() - 1, [&](const PaintStep& step) {
            depth = depthAfter(step, depth);
            return depth == 0;
        });
    }
};

/// Of a mask.
Op popOf(GroupRole role) {
    return role == GroupRole::AlphaMask       ? Op::PopMaskAlpha
           : role == GroupRole::LuminanceMask ? Op::PopMaskLuminance
                                              : Op::PopMaskLinear;
}

glm::vec4 vectorOf(const Color& c) { return {c[0], c[1], c[2], c[3]}; }

Color blended(asset::Blend mode, const Color& source, const Color& backdrop) {
    const glm::vec4 c = asset::blend(mode, vectorOf(source), vectorOf(backdrop));
    return {c[0], c[1], c[2], c[3]};
}

/// Runs the items over one region.
class Compositor {
public:
    explicit Compositor(const LoweredScene& picture) : picture_(picture), frames_(1) {}

    void open(std::uint32_t) { frames_.emplace_back(); }

    void item(const LoweredItem& item) {
        const Source& source = picture_.sources[item.source];
        Instruction instruction{source.op, asset::Blend::Normal, item.opacity, source.data};
        frames_.back().source({instruction, source.color}, source.opaque);
    }

    void emptyMask(std::uint32_t) { frames_.back().clear(); }

    void close(std::uint32_t index) {
        const LoweredGroup& group = picture_.groups[index];
        Frame child = std::move(frames_.back());
        frames_.pop_back();
        Frame& parent = frames_.back();
        if (group.role == GroupRole::Plain)
            blend(parent, child, group);
        else
            mask(parent, child, group.role);
    }

    const Frame& result() const { return frames_.front(); }

private:
    static void blend(Frame& parent, Frame& child, const LoweredGroup& group) {
        if (child.steps.empty())
            return;
        const float opacity = group.opacity * child.unwrap();
        if (parent.steps.empty() && opacity >= 1) {  // nothing below: blending changes nothing
            parent = std::move(child);
            return;
        }
        const bool normal = group.blend == scene::BlendMode::Normal || parent.steps.empty();
        const auto mode = normal ? asset::Blend::Normal : blendOf(group.blend);
        if (normal && child.constant()) {
            parent.solid(scaled(child.color(), opacity));
        } else if (child.constant() && parent.constant()) {
            parent.become(blended(mode, scaled(child.color(), opacity), parent.color()));
        } else if (normal && child.steps.size() == 1) {
            child.steps[0].instruction.opacity *= opacity;
            parent.source(child.steps[0], false);
        } else if (normal && opacity >= 1 && child.onlyOver()) {
            parent.laid(child);
        } else {
            parent.nested(child, Op::Pop, mode, opacity);
        }
    }

    static void mask(Frame& parent, const Frame& child, GroupRole role) {
        if (child.steps.empty())
            return parent.clear();
        if (parent.steps.empty())
            return;
        const Op pop = popOf(role);
        if (parent.constant() && child.constant())
            return parent.become(scaled(parent.color(), asset::maskFactor(pop, vectorOf(child.color()))));
        parent.nested(child, pop, asset::Blend::Normal, 1);
    }

    const LoweredScene& picture_;
    std::vector<Frame> frames_;
};

/// The same where all items are colours.
class ColorCompositor {
public:
    explicit ColorCompositor(const LoweredScene& picture) : picture_(picture), frames_(1) {}

    void open(std::uint32_t) { frames_.emplace_back(0); }
    void item(const LoweredItem& item) {
        frames_.back() =
            asset::over(item.opacity * vectorOf(picture_.sources[item.source].color), frames_.back());
    }
    void emptyMask(std::uint32_t) { frames_.back() = glm::vec4(0); }
    void close(std::uint32_t index) {
        const LoweredGroup& group = picture_.groups[index];
        const glm::vec4 child = frames_.back();
        frames_.pop_back();
        glm::vec4& parent = frames_.back();
        if (group.role != GroupRole::Plain)
            parent *= maskFactor(group.role, child);
        else if (group.blend == scene::BlendMode::Normal)
            parent = asset::over(group.opacity * child, parent);
        else
            parent = asset::blend(blendOf(group.blend), group.opacity * child, parent);
    }

    const glm::vec4& result() const { return frames_.front(); }

private:
    const LoweredScene& picture_;
    std::vector<glm::vec4> frames_;
};

template <class C>
C composited(const LoweredScene& picture, std::span<const std::uint32_t> items) {
    limits::check();
    C compositor(picture);
    ItemWalk<C> walk(picture, compositor);
    for (std::uint32_t index : items)
        walk.item(picture.items[index]);
    walk.finish();
    return compositor;
}

// The asset's modes are numbered like the scene's: they are cast, not looked up.
static_assert(static_cast<int>(asset::Blend::PlusLighter) ==
                  static_cast<int>(scene::BlendMode::PlusLighter) &&
              static_cast<int>(asset::Blend::HardLight) == static_cast<int>(scene::BlendMode::HardLight));

}  // namespace

float maskFactor(GroupRole role, const glm::vec4& mask) { return asset::maskFactor(popOf(role), mask); }

asset::Blend blendOf(scene::BlendMode mode) { return static_cast<asset::Blend>(mode); }

std::vector<std::uint8_t> clippedGroups(const LoweredScene& picture) {
    std::vector<std::uint8_t> clipped(picture.groups.size());
    for (std::size_t g = 0; g < clipped.size(); ++g) {  // parents come first
        const LoweredGroup& group = picture.groups[g];
        clipped[g] = group.clip != noIndex || (group.parent != noIndex && clipped[group.parent]);
    }
    return clipped;
}

PaintId composite(const LoweredScene& picture, std::span<const std::uint32_t> items,
                  const std::vector<std::uint8_t>& inside, Palette& palette) {
    const auto in = [&](std::uint32_t layer) { return inside[layer] != 0; };
    Compositor compositor(picture);
    ItemWalk<Compositor> walk(picture, compositor);
    for (std::uint32_t index : items) {
        limits::check();
        const LoweredItem& item = picture.items[index];
        if (in(item.layer) && insideClips(picture, item.group, in))
            walk.item(item);
    }
    walk.finish();
    const Frame& frame = compositor.result();
    return palette.add(frame.steps);
}

PaintProgram compositeItems(const LoweredScene& picture, std::span<const std::uint32_t> items) {
    return composited<Compositor>(picture, items).result().steps;
}

glm::vec4 compositeColors(const LoweredScene& picture, std::span<const std::uint32_t> items) {
    return composited<ColorCompositor>(picture, items).result();
}

}  // namespace vtm::compiler
