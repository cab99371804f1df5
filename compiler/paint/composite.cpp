#include "compiler/paint/composite.hpp"

#include <algorithm>

#include <vtm/limits/limits.hpp>
#include "compiler/lower/walk_items.hpp"

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

// The asset's modes are numbered like the scene's: they are cast, not looked up.
static_assert(static_cast<int>(asset::Blend::PlusLighter) ==
                  static_cast<int>(scene::BlendMode::PlusLighter) &&
              static_cast<int>(asset::Blend::HardLight) == static_cast<int>(scene::BlendMode::HardLight));

/// Luminance of a premultiplied colour, W3C masking level 1 section 7.10.1.
float luminance(const Color& c) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

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
        if (normal && child.constant()) {
            parent.solid(scaled(child.color(), opacity));
        } else if (normal && child.steps.size() == 1) {
            child.steps[0].instruction.opacity *= opacity;
            parent.source(child.steps[0], false);
        } else if (normal && opacity >= 1 && child.onlyOver()) {
            parent.laid(child);
        } else {
            parent.nested(child, Op::Pop,
                          normal ? asset::Blend::Normal : static_cast<asset::Blend>(group.blend), opacity);
        }
    }

    static void mask(Frame& parent, const Frame& child, GroupRole role) {
        if (child.steps.empty())
            return parent.clear();
        if (parent.steps.empty())
            return;
        if (parent.constant() && child.constant() && role != GroupRole::LinearMask) {
            const float m = role == GroupRole::AlphaMask ? child.color()[3] : luminance(child.color());
            const Color masked = scaled(parent.color(), m);
            parent.clear();
            return parent.solid(masked);
        }
        parent.nested(child,
                      role == GroupRole::AlphaMask       ? Op::PopMaskAlpha
                      : role == GroupRole::LuminanceMask ? Op::PopMaskLuminance
                                                         : Op::PopMaskLinear,
                      asset::Blend::Normal, 1);
    }

    const LoweredScene& picture_;
    std::vector<Frame> frames_;
};

}  // namespace

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
    limits::check();
    Compositor compositor(picture);
    ItemWalk<Compositor> walk(picture, compositor);
    for (std::uint32_t index : items)
        walk.item(picture.items[index]);
    walk.finish();
    return compositor.result().steps;
}

}  // namespace vtm::compiler
