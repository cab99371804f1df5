#include <vtm/authoring.hpp>

#include <atomic>
#include <vector>

namespace vtm {

Mask filled(scene::Path path, scene::FillRule rule) {
    return {std::make_shared<const scene::Path>(std::move(path)), scene::identity, rule};
}

Mask stroked(scene::Path path, scene::StrokeStyle style) {
    return {std::make_shared<const scene::Path>(std::move(path)), scene::identity, std::move(style)};
}

Vtm::Vtm(VtmNode node) : node_(std::make_shared<VtmNode>(std::move(node))) {}

Vtm Vtm::paint(scene::Paint paint, float opacity) {
    return Vtm(VtmNode(PaintNode{std::move(paint), opacity}));
}

Vtm Vtm::material(std::string name, std::string glsl, const scene::Color& fallback) {
    return paint(scene::Material{std::move(name), std::move(glsl), fallback, scene::identity});
}

Vtm Vtm::image(image::Bitmap bitmap, scene::ImageFilter filter) {
    return paint(
        scene::ImagePaint{std::make_shared<const image::Bitmap>(std::move(bitmap)), filter, scene::identity});
}

Vtm Vtm::select(Mask mask, Vtm inside, Vtm outside) {
    return Vtm(VtmNode(SelectNode{std::move(mask), std::move(inside), std::move(outside)}));
}

Vtm Vtm::over(Vtm top, Vtm below) { return layer(std::move(top), std::move(below), {}); }

Vtm Vtm::layer(Vtm top, Vtm below, Compositing how) {
    if (!top.node_ && !how.filter)
        return below;
    if (!below.node_ && how.isPlain())
        return top;
    return Vtm(VtmNode(LayerNode{std::move(top), std::move(below), std::move(how)}));
}

Vtm Vtm::placed(const scene::Affine& transform) const {
    if (!node_ || transform == scene::identity)
        return *this;
    return Vtm(VtmNode(PlacedNode{*this, transform}));
}

VtmNode::~VtmNode() {
    std::vector<std::shared_ptr<const VtmNode>> loose;
    const auto take = [&](Vtm& part) {
        if (part.node_)
            loose.push_back(std::move(part.node_));
    };
    const auto takeParts = [&](VtmNode& node) {
        if (auto* select = std::get_if<SelectNode>(&node.value))
            take(select->inside), take(select->outside);
        else if (auto* layer = std::get_if<LayerNode>(&node.value))
            take(layer->top), take(layer->below);
        else if (auto* placed = std::get_if<PlacedNode>(&node.value))
            take(placed->content);
    };
    takeParts(*this);
    while (!loose.empty()) {
        const std::shared_ptr<const VtmNode> node = std::move(loose.back());
        loose.pop_back();
        if (node.use_count() != 1)
            continue;
        // Ours alone, so nobody sees it being emptied; what other threads did with it comes before.
        std::atomic_thread_fence(std::memory_order_acquire);
        takeParts(const_cast<VtmNode&>(*node));
    }
}

compiler::Result compile(const Vtm& vtm, double width, double height, const compiler::Options& options) {
    return compiler::compile(vtm.toScene(width, height), options);
}

}  // namespace vtm
