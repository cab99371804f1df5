#include "compiler/paint/region_paints.hpp"

#include <algorithm>

#include "compiler/paint/composite.hpp"

namespace vtm::compiler {

void RegionPaints::enter(std::span<const Layer> layers) {
    states_.clear();
    cornerSum_ = cornerKey_ = 0;
    for (const Layer& layer : layers) {
        const State state{layer.corner, layer.corner, layer.rule == scene::FillRule::NonZero ? ~0 : 1,
                          layer.name};
        states_.push_back(state);
        cornerSum_ += static_cast<std::uint64_t>(std::int64_t{layer.corner}) * layer.name;
        cornerKey_ ^= layer.name & -std::uint64_t{state.isInside()};
    }
    sum_ = cornerSum_;
    key_ = cornerKey_;
    find();
}

void RegionPaints::toCorner() {
    for (State& s : states_)
        s.winding = s.corner;
    sum_ = cornerSum_;
    key_ = cornerKey_;
}

void RegionPaints::find() {
    lastKey_ = key_;
    PaintId& paint = known_[key_];
    if (paint == NumberMap::unknown)
        paint = compute();
    last_ = paint;
}

namespace {

std::uint64_t bitOf(std::uint32_t name) { return std::uint64_t{1} << name % 64; }

/// The colour between constant paints; of others, the middle one.
PaintProgram meanOf(const std::vector<PaintProgram>& programs) {
    Color sum{};
    for (const PaintProgram& p : programs) {
        if (!Palette::isConstant(p))
            return programs[programs.size() / 2];
        const Color color = Palette::colorOf(p);
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += color[c] / static_cast<float>(programs.size());
    }
    return {{asset::Instruction{asset::Op::Solid}, sum}};
}

PaintProgram programOf(const LoweredScene& picture, const LayerNames& names, const Stack& stack) {
    std::vector<PaintProgram> programs;
    std::vector<std::uint32_t> items;
    for (std::size_t i = 0; i <= stack.size(); ++i) {
        if (i < stack.size() && stack[i] != noIndex) {
            items.push_back(picture.itemOfLayer[names.layers()[stack[i]]]);
            continue;
        }
        programs.push_back(compositeItems(picture, items));
        items.clear();
    }
    return programs.size() == 1 ? std::move(programs[0]) : meanOf(programs);
}

}  // namespace

PaintId StackPaints::use(const Stack& stack) {
    const auto [found, isNew] = index_.try_emplace(stack, 0);
    if (isNew) {
        if (free_.empty()) {
            free_.push_back(static_cast<PaintId>(entries_.size()));
            entries_.emplace_back();
        }
        found->second = free_.back();
        free_.pop_back();
        Entry& entry = entries_[found->second];
        entry.stack = &found->first;
        entry.isNew = true;
        for (std::uint32_t name : stack)
            entry.names |= bitOf(name);
    }
    ++entries_[found->second].users;
    return found->second;
}

void StackPaints::release(PaintId id) {
    Entry& entry = entries_[id];
    if (--entry.users > 0)
        return;
    programsChanged_ |= !Palette::isConstant(entry.program);
    index_.erase(index_.find(*entry.stack));
    entry = {};
    free_.push_back(id);
}

std::size_t StackPaints::update(const LoweredScene& picture, const LayerNames& names,
                                const std::vector<std::uint8_t>& changed) {
    std::uint64_t bits = 0;
    for (std::uint32_t name = 0; name < changed.size(); ++name)
        bits |= changed[name] ? bitOf(name) : 0;
    const auto holdsChanged = [&](const Stack& stack) {
        return std::any_of(stack.begin(), stack.end(),
                           [&](std::uint32_t name) { return name != noIndex && changed[name]; });
    };
    std::size_t count = 0;
    for (Entry& entry : entries_) {
        if (!entry.isNew && !((entry.names & bits) != 0 && holdsChanged(*entry.stack)))
            continue;
        const bool wasConstant = Palette::isConstant(entry.program);
        entry.program = programOf(picture, names, *entry.stack);
        programsChanged_ |= !wasConstant || !Palette::isConstant(entry.program);
        entry.isNew = false;
        entry.isChanged = true;
        ++count;
    }
    return count;
}

std::vector<std::uint8_t> StackPaints::changed() const {
    if (std::ranges::none_of(entries_, &Entry::isChanged))
        return {};
    std::vector<std::uint8_t> changed;
    for (const Entry& entry : entries_)
        changed.push_back(entry.isChanged || entries_.size() > maxPaints);  // colours are merged anew then
    return changed;
}

bool StackPaints::encode(const LoweredScene& picture, bool dataChanged, const asset::Asset& before,
                         asset::Asset& after, float& error) {
    error = 0;
    bool moved = false;
    if (dataChanged || programsChanged_ || entries_.size() > maxPaints) {
        moved = encodeAll(picture, after, error);
    } else {
        after.data = before.data;
        after.paints = before.paints;
        after.paints.resize(entries_.size());
        for (auto i = static_cast<PaintId>(indices_.size()); i < entries_.size(); ++i)
            indices_.push_back(static_cast<std::uint16_t>(i));
        for (PaintId i = 0; i < entries_.size(); ++i)
            if (entries_[i].isChanged)
                after.paints[i] = encodePaint(entries_[i].program, after.data);
    }
    for (Entry& entry : entries_)
        entry.isChanged = false;
    programsChanged_ = false;
    return moved;
}

bool StackPaints::encodeAll(const LoweredScene& picture, asset::Asset& after, float& error) {
    after.data = picture.data;
    std::vector<std::uint16_t> indices;
    if (entries_.size() > maxPaints) {  // not every stack can have a place of its own
        Palette palette;
        std::vector<PaintId> ids;
        for (const Entry& entry : entries_)
            ids.push_back(palette.add(entry.program));
        const std::vector<std::uint16_t> encoded = encodePalette(palette, after, error);
        for (PaintId id : ids)
            indices.push_back(encoded[id]);
    } else {
        for (const Entry& entry : entries_) {
            indices.push_back(static_cast<std::uint16_t>(after.paints.size()));
            after.paints.push_back(encodePaint(entry.program, after.data));
        }
    }
    const std::size_t common = std::min(indices.size(), indices_.size());
    const bool moved =
        !std::equal(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(common), indices_.begin());
    indices_ = std::move(indices);
    return moved;
}

}  // namespace vtm::compiler
