// Statements and VTMs.

#include <algorithm>

#include <fmt/format.h>

#include "api/src/scene_conversion.hpp"
#include "api/tree/keywords.hpp"
#include "api/tree/reader.hpp"

namespace vtm {

TreeError::TreeError(const std::string& file, const limits::Place& where, const std::string& cause)
    : Error(fmt::format("{}:{}:{}: {}", file, where.line, where.column, cause)), where_(where) {}

bool isTree(std::span<const std::uint8_t> bytes) {
    return leadingWord(skipBlank({reinterpret_cast<const char*>(bytes.data()), bytes.size()})) == "vtmtree";
}

Tree readTree(std::span<const std::uint8_t> bytes, const TreeOptions& options) {
    const limits::Stage stage("reading");
    if (bytes.size() > TreeLimits::maxBytes)
        throw TreeError(fmt::format("{}: more than {} bytes", options.fileName, TreeLimits::maxBytes));
    return TreeReader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, options).run();
}

TreeReader::Level::Level(TreeReader& reader) : reader_(reader) {
    if (reader_.depth_ >= TreeLimits::maxDepth)
        reader_.in_.fail(reader_.in_.rest(), fmt::format("nested more than {} levels deep; give parts names",
                                                         TreeLimits::maxDepth));
    ++reader_.depth_;
}

Tree TreeReader::run() {
    readHead();
    while (in_.peek() == "shape" || in_.peek() == "clip" || in_.peek() == "image" || in_.peek() == "vtm")
        define();
    if (in_.peek() != "draw")
        in_.failExpecting("a definition (shape, clip, image, vtm) or 'draw'");
    const std::string_view draw = in_.rest();
    in_.next();
    tree_.vtm = vtm().part;
    if (!in_.atEnd())
        in_.failExpecting("the end of the file, since 'draw' is the last statement");
    obey(draw, [&] { scene::validate(tree_.toScene()); });
    return std::move(tree_);
}

void TreeReader::readHead() {
    in_.expect("vtmtree");
    const std::string_view version = in_.rest();
    if (in_.number("the version, 1") != 1)
        in_.fail(version, "the version of the format is not 1");
    in_.expect("size");
    const std::string_view size = in_.rest();
    tree_.width = in_.number("the width");
    tree_.height = in_.number("the height");
    obey(size, [&] { scene::validate(tree_.toScene()); });
}

void TreeReader::define() {
    limits::check();
    const std::string_view kind = in_.next(), name = newName();
    in_.expect("=");
    names_.emplace(name, definition(kind));
}

std::string_view TreeReader::newName() {
    const std::string_view name = in_.word("a name");
    if (std::ranges::count(keywords::reserved, name) != 0)
        in_.fail(name, fmt::format("'{}' is a word of the format and cannot be a name", name));
    if (svg::namedColor(name))
        in_.fail(name, fmt::format("'{}' is a colour and cannot be a name", name));
    if (names_.contains(name))
        in_.fail(name, fmt::format("'{}' is defined twice", name));
    return name;
}

TreeReader::Definition TreeReader::definition(std::string_view kind) {
    if (kind == "shape")
        return shape();
    if (kind == "clip")
        return clip();
    if (kind == "image")
        return bitmap();
    return vtm();
}

template <class Kind>
const Kind& TreeReader::named(std::string_view what) {
    if (leadingWord(in_.rest()).empty())
        in_.failExpecting(what);
    const std::string_view name = in_.next();
    const auto found = names_.find(name);
    if (found == names_.end())
        in_.fail(name, fmt::format("expected {}; '{}' is not defined above", what, name));
    const Kind* value = std::get_if<Kind>(&found->second);
    if (value == nullptr) {
        constexpr std::string_view kinds[] = {"a shape", "a clip", "an image", "a VTM"};
        in_.fail(name, fmt::format("expected {}; '{}' is {}", what, name, kinds[found->second.index()]));
    }
    return *value;
}

// Used by the other files of the reader.
template const TreeReader::CountedShape& TreeReader::named(std::string_view what);
template const TreeReader::CountedClip& TreeReader::named(std::string_view what);
template const TreeReader::Bitmap& TreeReader::named(std::string_view what);

TreeReader::CountedVtm TreeReader::vtm() {
    const Level level(*this);
    if (in_.accept("select"))
        return select();
    return in_.peek() == "layer" ? layer({}) : part();
}

/// A VTM over what stands before it in its block.
TreeReader::CountedVtm TreeReader::over(const CountedVtm& below) {
    if (in_.peek() == "layer")
        return layer(below);
    const CountedVtm top = vtm();
    return {Vtm::over(top.part, below.part), sum(top.nodes, below.nodes)};
}

TreeReader::CountedVtm TreeReader::select() {
    const CountedShape mask = shape();
    const CountedVtm inside = vtm();
    const CountedVtm outside = in_.accept("else") ? vtm() : CountedVtm();
    return {Vtm::select(mask.part, inside.part, outside.part),
            sum(mask.nodes, sum(inside.nodes, outside.nodes))};
}

TreeReader::CountedVtm TreeReader::layer(const CountedVtm& below) {
    const Level level(*this);
    in_.expect("layer");
    std::size_t nodes = 1;
    Compositing how = compositing(nodes);
    const CountedVtm top = vtm();
    return {Vtm::layer(top.part, below.part, std::move(how)), sum(nodes, sum(top.nodes, below.nodes))};
}

TreeReader::CountedVtm TreeReader::part() {
    std::optional<CountedVtm> value = in_.peek() == "{" ? block() : paint();
    if (!value)
        value = named<CountedVtm>("a VTM");
    while (in_.accept("placed"))
        *value = {value->part.placed(transform()), sum(value->nodes, 1)};
    return *value;
}

TreeReader::CountedVtm TreeReader::block() {
    in_.expect("{");
    CountedVtm all;
    while (!in_.accept("}")) {
        limits::check();
        if (in_.atEnd())
            in_.failExpecting("a VTM or '}'");
        all = over(all);
    }
    return all;
}

std::size_t TreeReader::sum(std::size_t a, std::size_t b) {
    if (a + b > TreeLimits::maxNodes)
        in_.fail(in_.rest(), fmt::format("the picture has more than {} parts", TreeLimits::maxNodes));
    return a + b;
}

scene::Link<scene::Group> TreeReader::group(const CountedVtm& content, scene::Point min, scene::Point max) {
    const VtmNode* node = content.part.node();
    if (const auto known = unframed_.find(node); known != unframed_.end())
        return known->second.group;
    Content& known = framed_[{node, min.x, min.y, max.x, max.y}];
    if (known.group)
        return known.group;
    contentNodes_ = sum(contentNodes_, content.nodes);
    obey(in_.rest(), [&] {
        FramedGroup made = toGroup(content.part, min, max);
        known = {content.part, std::make_shared<const scene::Group>(std::move(made.group))};
        if (!made.fillsFrame)
            unframed_.emplace(node, known);
    });
    return known.group;
}

}  // namespace vtm
