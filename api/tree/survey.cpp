#include "api/tree/survey.hpp"

#include <algorithm>

#include <vtm/limits/limits.hpp>
#include "api/src/scene_conversion.hpp"

namespace vtm {

namespace {

/// Operands in each other that are written without names; the reader takes TreeLimits::maxDepth levels, of
/// which an operand takes three at most.
constexpr int maxHeight = 64;

const scene::Pattern* patternOf(const VtmNode& node) {
    const auto* paint = as<PaintNode>(&node);
    return paint ? std::get_if<scene::Pattern>(&paint->paint) : nullptr;
}

/// As a VTM that comes back as it is when the text is read: groups without effect are left out.
Vtm normalized(const scene::Group& group) {
    return fromGroup(toGroup(fromGroup(group), scene::Point(0), scene::Point(0)).group);
}

}  // namespace

TreeSurvey::TreeSurvey(const Vtm& root) {
    if (root.node() == nullptr)
        return;
    countParts(root.node());
    countOperands(root.node());
    order(root.node());
}

bool TreeSurvey::isNamed(const VtmNode* node) const {
    const auto info = infos_.find(node);
    return info != infos_.end() && info->second.isNamed;
}

std::optional<ChainLayer> TreeSurvey::chainLayer(const VtmNode& node) const {
    if (const auto* layer = as<LayerNode>(&node))
        return ChainLayer{nullptr, &layer->top, &layer->how, &layer->below};
    const auto* select = as<SelectNode>(&node);
    const auto* inside = select ? as<LayerNode>(select->inside.node()) : nullptr;
    if (!inside || !select->outside.node() || inside->below != select->outside ||
        parents_.at(select->inside.node()) != 1)
        return std::nullopt;
    return ChainLayer{&select->mask, &inside->top, &inside->how, &inside->below};
}

const Vtm& TreeSurvey::content(const std::shared_ptr<const scene::Group>& group) const {
    return contents_.at(group.get());
}

void TreeSurvey::addContent(const std::shared_ptr<const scene::Group>& group) {
    if (!contents_.contains(group.get()))
        contents_.emplace(group.get(), normalized(*group));
}

void TreeSurvey::addContents(const VtmNode& node) {
    if (const scene::Pattern* pattern = patternOf(node))
        addContent(pattern->content);
    else if (const auto* layer = as<LayerNode>(&node); layer && layer->how.mask)
        addContent(layer->how.mask->content);
}

/// As they are held.
std::vector<const VtmNode*> TreeSurvey::parts(const VtmNode& node) const {
    std::vector<const VtmNode*> all;
    if (const auto* select = as<SelectNode>(&node))
        all = {select->inside.node(), select->outside.node()};
    else if (const auto* placed = as<PlacedNode>(&node))
        all = {placed->content.node()};
    else if (const auto* layer = as<LayerNode>(&node))
        all = {layer->top.node(), layer->below.node(),
               layer->how.mask ? content(layer->how.mask->content).node() : nullptr};
    else if (const scene::Pattern* pattern = patternOf(node))
        all = {content(pattern->content).node()};
    std::erase(all, nullptr);
    return all;
}

/// As they are written.
std::vector<TreeSurvey::Operand> TreeSurvey::operands(const VtmNode& node) const {
    std::vector<Operand> all;
    if (const auto layer = chainLayer(node)) {
        const bool isSelect = !layer->mask && as<SelectNode>(layer->top->node());
        all = {{layer->below->node(), 0}, {layer->top->node(), isSelect ? 0 : 1}};
        if (layer->how->mask)
            all.push_back({content(layer->how->mask->content).node(), 1});
        std::erase_if(all, [](const Operand& operand) { return operand.node == nullptr; });
        return all;
    }
    for (const VtmNode* part : parts(node))
        all.push_back({part, 1});
    return all;
}

void TreeSurvey::countParts(const VtmNode* root) {
    std::vector<const VtmNode*> open{root};
    while (!open.empty()) {
        limits::check();
        const VtmNode& node = *open.back();
        open.pop_back();
        addContents(node);
        for (const VtmNode* part : parts(node))
            if (parents_[part]++ == 0)
                open.push_back(part);
    }
}

void TreeSurvey::countOperands(const VtmNode* root) {
    std::vector<const VtmNode*> open{root};
    while (!open.empty()) {
        limits::check();
        const VtmNode& node = *open.back();
        open.pop_back();
        addShapes(node);
        for (const Operand& operand : operands(node))
            if (infos_[operand.node].uses++ == 0)
                open.push_back(operand.node);
    }
}

void TreeSurvey::addShapes(const VtmNode& node) {
    const auto layer = chainLayer(node);
    if (layer && layer->how->clip)
        addClip(layer->how->clip);
    if (const auto* select = as<SelectNode>(&node))
        paths_.add(select->mask.path.get());
    if (const auto* paint = as<PaintNode>(&node))
        if (const auto* image = std::get_if<scene::ImagePaint>(&paint->paint))
            bitmaps_.add(image->bitmap.get());
}

/// Behind those that it is made of.
void TreeSurvey::addClip(const std::shared_ptr<const scene::Clip>& root) {
    std::vector<const scene::Clip*> open{root.get()};
    while (!open.empty()) {
        const scene::Clip* clip = open.back();
        const auto [known, isNew] = clipsDone_.emplace(clip, false);
        if (isNew) {
            for (const scene::ClipShape& shape : clip->shapes) {
                paths_.add(shape.path.get());
                if (shape.clip)
                    open.push_back(shape.clip.get());
            }
            if (clip->clip)
                open.push_back(clip->clip.get());
            continue;
        }
        open.pop_back();
        if (!std::exchange(known->second, true))
            clips_.push_back(clip);
    }
}

/// Parts before what contains them.
void TreeSurvey::order(const VtmNode* root) {
    struct Visit {
        const VtmNode* node;
        bool isOpen;
    };
    std::vector<Visit> stack{{root, false}};
    while (!stack.empty()) {
        auto& [node, isOpen] = stack.back();
        const VtmNode& current = *node;
        if (infos_[node].isDone || isOpen) {
            stack.pop_back();
            finish(current);
            continue;
        }
        isOpen = true;
        for (const Operand& operand : operands(current))
            stack.push_back({operand.node, false});
    }
}

void TreeSurvey::finish(const VtmNode& node) {
    Info& info = infos_[&node];
    if (std::exchange(info.isDone, true))
        return;
    for (const auto& [operand, levels] : operands(node)) {
        if (infos_[operand].height + levels > maxHeight)
            name(operand);
        info.height = std::max(info.height, infos_[operand].height + levels);
    }
    if (info.uses > 1)
        name(&node);
}

void TreeSurvey::name(const VtmNode* node) {
    infos_[node].isNamed = true;
    infos_[node].height = 0;
    namedNodes_.push_back(node);
}

}  // namespace vtm
