// From a tree to the text of a .vtmtree file.

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include <vtm/image/codec.hpp>
#include <vtm/svg/write.hpp>
#include <vtm/vtmtree.hpp>
#include "api/tree/keywords.hpp"
#include "api/tree/survey.hpp"
#include "api/tree/write_values.hpp"
#include "svg/notation.hpp"

namespace vtm {

namespace {

using namespace treetext;

template <class Part>
using Names = std::unordered_map<const Part*, std::string>;

class TreeWriter {
public:
    explicit TreeWriter(const Tree& tree) : tree_(tree), survey_(tree.vtm) {}

    std::string run() {
        text_ = fmt::format("vtmtree 1\nsize {} {}\n\n", svg::number(tree_.width), svg::number(tree_.height));
        define();
        text_ += "draw ";
        vtm(tree_.vtm.node(), Place::Free);
        return std::move(text_) + "\n";
    }

private:
    /// Where a VTM is written: a part needs braces round selections and layers.
    enum class Place { Free, Part };

    void define() {
        for (const scene::Path* path : survey_.sharedPaths())
            define(paths_, path, "shape", 's', [&] { text_ += inQuotes(svg::pathData(*path)); });
        for (const scene::Clip* clip : survey_.clips())
            define(clips_, clip, "clip", 'c', [&] { clipBlock(*clip); });
        for (const image::Bitmap* bitmap : survey_.sharedBitmaps())
            define(bitmaps_, bitmap, "image", 'i', [&] { text_ += encoded(*bitmap); });
        for (const VtmNode* node : survey_.namedNodes())
            define(nodes_, node, "vtm", 'v', [&] { vtm(node, Place::Free); });
    }

    /// `write` writes the value, in which the part has no name yet.
    template <class Part, class Write>
    void define(Names<Part>& names, const Part* part, const char* kind, char letter, Write write) {
        limits::check();
        const std::string name = fmt::format("{}{}", letter, names.size() + 1);
        text_ += fmt::format("{} {} = ", kind, name);
        write();
        text_ += "\n";
        names.emplace(part, name);
    }

    // ---- VTMs ---------------------------------------------------------------------------------------

    void vtm(const Vtm& vtm, Place place) { this->vtm(vtm.node(), place); }

    void vtm(const VtmNode* node, Place place) {
        limits::check();
        std::vector<ChainLayer> layers;
        const VtmNode* bottom = node;
        while (bottom != nullptr && !nodes_.contains(bottom)) {
            const auto layer = survey_.chainLayer(*bottom);
            if (!layer)
                break;
            layers.push_back(*layer);
            bottom = layer->below->node();
        }
        std::ranges::reverse(layers);
        if (layers.empty())
            single(bottom, place);
        else if (layers.size() == 1 && bottom == nullptr && place == Place::Free)
            layer(layers[0]);
        else
            block(bottom, layers);
    }

    void block(const VtmNode* bottom, const std::vector<ChainLayer>& layers) {
        text_ += "{";
        ++depth_;
        if (bottom != nullptr) {
            newLine();
            single(bottom, Place::Free);
        }
        for (const ChainLayer& each : layers) {
            newLine();
            layer(each);
        }
        --depth_;
        newLine();
        text_ += "}";
    }

    void newLine() { text_ += "\n" + std::string(std::size_t(4 * depth_), ' '); }

    void layer(const ChainLayer& layer) {
        const bool isPlain = layer.how->isPlain();
        if (!isPlain)
            compositing(*layer.how);
        if (layer.mask)
            select(*layer.mask, *layer.top, {});
        else
            // Without braces the layers of the top would be layers of this chain.
            vtm(*layer.top, isPlain && !isSelect(*layer.top) ? Place::Part : Place::Free);
    }

    static bool isSelect(const Vtm& vtm) { return std::holds_alternative<SelectNode>(vtm.node()->value); }

    /// A VTM that is no chain of layers.
    void single(const VtmNode* node, Place place) {
        if (node == nullptr)
            text_ += "{}";
        else if (const auto name = nodes_.find(node); name != nodes_.end())
            text_ += name->second;
        else if (const auto* select = std::get_if<SelectNode>(&node->value))
            this->select(*select, place);
        else if (const auto* placed = std::get_if<PlacedNode>(&node->value))
            this->placed(*placed);
        else
            paint(std::get<PaintNode>(node->value));
    }

    void select(const SelectNode& node, Place place) {
        if (place == Place::Part)
            text_ += "{ ";
        select(node.mask, node.inside, node.outside);
        if (place == Place::Part)
            text_ += " }";
    }

    void select(const Mask& mask, const Vtm& inside, const Vtm& outside) {
        text_ += "select ";
        shape(mask.path, mask.geometry, mask.transform);
        text_ += " ";
        vtm(inside, Place::Part);
        if (outside.node() == nullptr)
            return;
        text_ += " else ";
        vtm(outside, Place::Free);
    }

    void placed(const PlacedNode& node) {
        vtm(node.content, Place::Part);
        text_ += " placed " + transform(node.transform);
    }

    void compositing(const Compositing& how) {
        text_ += "layer ";
        if (how.opacity != 1)
            text_ += fmt::format("opacity {} ", svg::number(how.opacity));
        if (how.blend != scene::BlendMode::Normal)
            text_ += fmt::format("blend {} ", keywords::blends[std::size_t(how.blend)]);
        if (how.filter)
            throw TreeError("a filter cannot be written as a tree");
        if (how.clip)
            text_ += fmt::format("clip {} ", clips_.at(how.clip.get()));
        if (how.mask)
            mask(*how.mask);
    }

    void mask(const scene::Mask& mask) {
        const std::size_t kind = mask.kind == scene::MaskKind::Alpha ? 1 : mask.linear ? 2 : 0;
        text_ += fmt::format("mask {} ", keywords::masks[kind]);
        vtm(survey_.content(mask.content), Place::Part);
        text_ += " ";
    }

    // ---- Shapes and clips ---------------------------------------------------------------------------

    template <class Geometry>
    void shape(const std::shared_ptr<const scene::Path>& path, const Geometry& how,
               const scene::Affine& map) {
        const auto name = paths_.find(path.get());
        text_ += name != paths_.end() ? name->second : inQuotes(svg::pathData(*path));
        text_ += treetext::geometry(how);
        if (map != scene::identity)
            text_ += " placed " + transform(map);
    }

    void clipBlock(const scene::Clip& clip) {
        text_ += "{";
        for (const scene::ClipShape& each : clip.shapes) {
            text_ += " ";
            shape(each.path, each.rule, each.transform);
            within(each.clip);
        }
        text_ += " }";
        within(clip.clip);
    }

    void within(const scene::Link<scene::Clip>& clip) {
        if (clip)
            text_ += " within " + clips_.at(clip.get());
    }

    // ---- Paints -------------------------------------------------------------------------------------

    void paint(const PaintNode& node) {
        std::visit([&](const auto& paint) { value(paint); }, node.paint);
        if (node.opacity != 1)
            text_ += " opacity " + svg::number(node.opacity);
    }

    void value(const scene::Color& paint) { text_ += color(paint); }
    void value(const scene::LinearGradient& paint) { text_ += gradient(paint); }
    void value(const scene::RadialGradient& paint) { text_ += gradient(paint); }

    void value(const scene::Pattern& paint) {
        text_ += fmt::format("pattern({}, {}){} ", svg::pair(paint.min), svg::pair(paint.max),
                             paintTransform(paint.transform));
        const Vtm& content = survey_.content(paint.content);
        const bool isBlock = content.node() == nullptr ||
                             (!nodes_.contains(content.node()) && survey_.chainLayer(*content.node()));
        text_ += isBlock ? "" : "{ ";
        vtm(content, isBlock ? Place::Part : Place::Free);
        text_ += isBlock ? "" : " }";
    }

    void value(const scene::ImagePaint& paint) {
        const auto name = bitmaps_.find(paint.bitmap.get());
        text_ += "image " + (name != bitmaps_.end() ? name->second : encoded(*paint.bitmap));
        if (paint.filter != scene::ImageFilter::Trilinear)
            text_ += fmt::format(" {}", keywords::filters[std::size_t(paint.filter)]);
        text_ += paintTransform(paint.transform);
    }

    void value(const scene::Material& paint) {
        text_ += fmt::format("material {} {}{} {}", paint.name, color(paint.fallback),
                             paintTransform(paint.transform), inQuotes(paint.glsl));
    }

    static std::string encoded(const image::Bitmap& bitmap) {
        return inQuotes(svg::dataUrl("image/png", image::encodePng(bitmap)));
    }

    const Tree& tree_;
    const TreeSurvey survey_;
    std::string text_;
    int depth_ = 0;
    Names<scene::Path> paths_;
    Names<scene::Clip> clips_;
    Names<image::Bitmap> bitmaps_;
    Names<VtmNode> nodes_;
};

}  // namespace

std::string writeTree(const Tree& tree) {
    const limits::Stage stage("writing");
    try {
        return TreeWriter(tree).run();
    } catch (const svg::WriteError&) {
        throw TreeError("a number is not finite or beyond 1e30");
    }
}

}  // namespace vtm
