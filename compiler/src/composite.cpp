#include "compiler/src/composite.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "compiler/compile.hpp"
#include "compiler/src/walk_items.hpp"

namespace vtm::compiler {
namespace {

using asset::Instruction;
using asset::Op;
using Color = std::array<float, 4>;
using Step = Palette::Program::value_type;

Color scaled(Color c, float by) {
    for (float& v : c)
        v *= by;
    return c;
}

/// Porter-Duff source over, premultiplied.
Color over(const Color& s, const Color& d) {
    Color r;
    for (std::size_t i = 0; i < 4; ++i)
        r[i] = s[i] + (1 - s[3]) * d[i];
    return r;
}

/// One isolated group while it is being composited: the steps that build it on transparent black.
struct Frame {
    Palette::Program steps;
    bool constant() const { return steps.empty() || (steps.size() == 1 && steps[0].first.op == Op::Solid); }
    Color color() const { return steps.empty() ? Color{} : steps[0].second; }

    void solid(const Color& s) {
        if (s[3] <= 0)
            return;
        if (s[3] >= 1)
            clear();
        if (!steps.empty() && steps.back().first.op == Op::Solid)
            steps.back().second =
                over(s, steps.back().second);  // (s over t) over rest = s over (t over rest)
        else
            steps.push_back({Instruction{Op::Solid}, s});
    }

    void source(const Step& step, bool opaque) {
        if (step.first.op == Op::Solid)
            return solid(scaled(step.second, step.first.opacity));
        if (opaque && step.first.opacity >= 1)
            clear();
        steps.push_back(step);
    }

    void clear() { steps.clear(); }

    /// Whether all layers are laid over what is there: then they may be moved onto another frame, since
    /// `over` is associative. Blend modes and masks see what is in the frame.
    bool onlyOver() const {
        unsigned depth = 0;
        return std::none_of(steps.begin(), steps.end(), [&](const Step& step) {
            depth = depthAfter(step, depth);
            return depth == 0 && isPop(step) &&
                   (step.first.op != Op::Pop || step.first.blend != asset::Blend::Normal);
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
        for (const Step& step : child.steps) {
            if (depth == 0 && step.first.op >= Op::Solid)
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
            opacity *= steps.back().first.opacity;
            steps.pop_back();
            steps.erase(steps.begin());
        }
        return opacity;
    }

private:
    static bool isPop(const Step& step) { return step.first.op > Op::Push && step.first.op < Op::Solid; }
    static unsigned depthAfter(const Step& step, unsigned depth) {
        return step.first.op == Op::Push ? depth + 1 : isPop(step) ? depth - 1 : depth;
    }

    bool isOneGroup() const {
        if (steps.size() < 2 || steps.front().first.op != Op::Push || steps.back().first.op != Op::Pop)
            return false;
        unsigned depth = 0;
        return std::none_of(steps.begin(), steps.end() - 1, [&](const Step& step) {
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
    explicit Compositor(const Picture& picture) : picture_(picture), frames_(1) {}

    void open(std::uint32_t) { frames_.emplace_back(); }

    void item(const PictureItem& item) {
        const Source& source = picture_.sources[item.source];
        Instruction instruction{source.op, asset::Blend::Normal, item.opacity, source.data};
        frames_.back().source({instruction, source.color}, source.opaque);
    }

    void emptyMask(std::uint32_t) { frames_.back().clear(); }

    void close(std::uint32_t index) {
        const PictureGroup& group = picture_.groups[index];
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
    static void blend(Frame& parent, Frame& child, const PictureGroup& group) {
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
            child.steps[0].first.opacity *= opacity;
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

    const Picture& picture_;
    std::vector<Frame> frames_;
};

void checkStack(const Palette::Program& steps) {
    unsigned depth = 1;
    for (const Step& step : steps) {
        if (step.first.op == Op::Push && ++depth > asset::maxStack)
            throw LimitError("groups that cannot be folded are nested more than " +
                             std::to_string(asset::maxStack - 1) + " deep");
        depth -= step.first.op == Op::Pop || step.first.op == Op::PopMaskAlpha ||
                 step.first.op == Op::PopMaskLinear || step.first.op == Op::PopMaskLuminance;
    }
}

template <class T>
void appendBytes(std::string& key, const T& value) {
    key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

Palette::Palette(asset::Asset& asset) : asset_(asset) { solid({0, 0, 0, 0}); }

std::uint16_t Palette::intern(const std::string& key, const asset::Paint& paint) {
    if (asset_.paints.size() > 0xFFFF)
        throw LimitError("the picture has more than 65536 distinct region paints");
    const auto id = static_cast<std::uint16_t>(asset_.paints.size());
    asset_.paints.push_back(paint);
    index_.emplace(key, id);
    return id;
}

std::uint16_t Palette::solid(const std::array<float, 4>& c) {
    std::string key;
    appendBytes(key, c);
    if (const auto found = index_.find(key); found != index_.end())
        return found->second;
    asset::Paint paint;
    std::transform(c.begin(), c.end(), paint.begin(),
                   [](float v) { return std::bit_cast<std::uint32_t>(v); });
    return intern(key, paint);
}

std::uint16_t Palette::program(const Program& steps) {
    checkStack(steps);
    std::string key(1, 'p');
    for (const Step& step : steps)
        appendBytes(key, step.first), appendBytes(key, step.second);
    if (const auto found = index_.find(key); found != index_.end())
        return found->second;

    const auto first = static_cast<std::uint32_t>(asset_.data.size());
    const auto count = static_cast<std::uint32_t>(steps.size());
    asset_.data.resize(first + count);
    for (std::uint32_t i = 0; i < count; ++i) {
        Instruction instruction = steps[i].first;
        if (instruction.op == Op::Solid) {
            instruction.argument = static_cast<std::uint32_t>(asset_.data.size());
            asset_.data.push_back(std::bit_cast<asset::Texel>(steps[i].second));
        }
        asset_.data[first + i] = std::bit_cast<asset::Texel>(instruction);
    }
    return intern(key, {first, count, 0, asset::programTag});
}

std::uint16_t composite(const Picture& picture, std::span<const std::uint32_t> items,
                        const std::vector<std::uint8_t>& inside, Palette& palette) {
    const auto in = [&](std::uint32_t layer) { return inside[layer] != 0; };
    const auto shown = [&](std::uint32_t group) {
        for (; group != none; group = picture.groups[group].parent)
            if (!insideClip(picture, picture.groups[group].clip, in))
                return false;
        return true;
    };
    Compositor compositor(picture);
    ItemWalk<Compositor> walk(picture, compositor);
    for (std::uint32_t index : items) {
        const PictureItem& item = picture.items[index];
        if (in(item.layer) && shown(item.group))
            walk.item(item);
    }
    walk.finish();
    const Frame& frame = compositor.result();
    return frame.constant() ? palette.solid(frame.color()) : palette.program(frame.steps);
}

}  // namespace vtm::compiler
