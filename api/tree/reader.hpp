/// \file
/// From the text of a .vtmtree file to a tree, by recursive descent. docs/vtmtree.md has the grammar.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vtm/vtmtree.hpp>
#include "api/tree/scanner.hpp"

namespace vtm {

class TreeReader {
public:
    TreeReader(std::string_view text, const TreeOptions& options)
        : in_(text, options.fileName), options_(options) {}

    Tree run();

private:
    using Bitmap = std::shared_ptr<const image::Bitmap>;

    /// A part, and its number of nodes as TreeLimits::maxNodes counts them.
    template <class Part>
    struct Counted {
        Part part{};
        std::size_t nodes = 0;
    };
    using CountedVtm = Counted<Vtm>;
    using CountedShape = Counted<Mask>;
    using CountedClip = Counted<scene::Link<scene::Clip>>;
    using Definition = std::variant<CountedShape, CountedClip, Bitmap, CountedVtm>;

    // read.cpp: statements and VTMs
    void readHead();
    void define();
    std::string_view newName();
    Definition definition(std::string_view kind);
    CountedVtm vtm();
    CountedVtm over(const CountedVtm& below);
    CountedVtm select();
    CountedVtm layer(const CountedVtm& below);
    CountedVtm part();
    CountedVtm block();
    std::size_t sum(std::size_t a, std::size_t b);
    /// A VTM as the content of a mask or a pattern, whose paints over the whole plane fill the rectangle.
    scene::Link<scene::Group> group(const CountedVtm& content, scene::Point min, scene::Point max);
    template <class Kind>
    const Kind& named(std::string_view what);

    // read_paint.cpp
    std::optional<CountedVtm> paint();
    std::optional<Counted<scene::Paint>> plainPaint();
    std::optional<scene::Color> color();
    scene::Color needColor();
    scene::Color colorFunction();
    Counted<scene::Paint> linear();
    Counted<scene::Paint> radial();
    template <class Gradient>
    Counted<scene::Paint> withStops(Gradient gradient);
    Counted<scene::Paint> pattern();
    Counted<scene::Paint> image();
    Counted<scene::Paint> material();
    Bitmap bitmap();
    Bitmap decoded(const std::string& href);
    void paintTransform(scene::Affine& transform);

    // read_shape.cpp: shapes, clips, compositing, transforms, lists of numbers
    CountedShape shape();
    CountedShape outline();
    scene::Path pathData();
    CountedShape stroked(CountedShape shape, std::string_view at);
    std::vector<double> dashes();
    CountedClip clip();
    CountedClip clipBlock();
    scene::ClipShape clipShape(std::size_t& nodes);
    scene::Link<scene::Clip> within(std::size_t& nodes);
    Compositing compositing(std::size_t& nodes);
    scene::Link<scene::Mask> mask(std::size_t& nodes);
    scene::Affine transform();
    bool isTransformNext();
    float unit(std::string_view what);
    template <std::size_t count>
    std::array<double, count> numbers();

    /// Whether the word comes next, which is stepped over; it must not be among those `given` before.
    bool attribute(std::string_view word, std::vector<std::string_view>& given);
    /// Throws TreeError for `at` where the item breaks a rule of scenes.
    void check(std::string_view at, scene::Item item);
    template <class Check>
    void obey(std::string_view at, Check check);
    /// The value whose word in the list comes next.
    template <class Value, std::size_t count>
    Value keyword(const std::array<std::string_view, count>& words);
    template <class Value, std::size_t count>
    Value keywordOr(const std::array<std::string_view, count>& words, Value otherwise);

    class Level;
    Scanner in_;
    const TreeOptions& options_;
    Tree tree_;
    std::unordered_map<std::string_view, Definition> names_;
    std::unordered_map<std::string, std::string> materials_;  ///< texts by name
    std::unordered_map<std::string, Bitmap> bitmaps_;         ///< by reference
    std::int64_t pixels_ = 0;                                 ///< of all of them
    /// Contents of masks and patterns by VTM, and by rectangle where that matters, so that what shares a name
    /// shares them.
    struct Content {
        Vtm vtm;
        scene::Link<scene::Group> group;
    };
    std::map<std::tuple<const VtmNode*, double, double, double, double>, Content> framed_;
    std::unordered_map<const VtmNode*, Content> unframed_;
    std::size_t contentNodes_ = 0;
    std::map<std::pair<const scene::Group*, int>, scene::Link<scene::Mask>> masks_;
    int depth_ = 0;
};

/// One level further in for as long as it lives.
class TreeReader::Level {
public:
    explicit Level(TreeReader& reader);
    ~Level() { --reader_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

private:
    TreeReader& reader_;
};

template <class Check>
void TreeReader::obey(std::string_view at, Check check) {
    try {
        check();
    } catch (const scene::InvalidScene& error) {
        // Behind the node's position in the scene.
        const std::string_view what = error.what();
        const std::size_t colon = what.find(": ");
        in_.fail(at, std::string(what.substr(colon == what.npos ? 0 : colon + 2)));
    }
}

template <class Value, std::size_t count>
Value TreeReader::keyword(const std::array<std::string_view, count>& words) {
    const auto word = std::ranges::find(words, in_.peek());
    if (word == words.end())
        in_.failExpecting(fmt::format("{}", fmt::join(words, ", ")));
    in_.next();
    return Value(int(word - words.begin()));
}

template <class Value, std::size_t count>
Value TreeReader::keywordOr(const std::array<std::string_view, count>& words, Value otherwise) {
    return std::ranges::count(words, in_.peek()) != 0 ? keyword<Value>(words) : otherwise;
}

template <std::size_t count>
std::array<double, count> TreeReader::numbers() {
    std::array<double, count> values;
    in_.expect("(");
    for (double& value : values)
        value = in_.number("a number");
    in_.expect(")");
    return values;
}

}  // namespace vtm
