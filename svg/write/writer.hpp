/// \file
/// From the scene to elements. One class, because groups, patterns, clips and masks contain each other; its
/// chapters are the files named below each heading.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <vtm/scene/scene.hpp>
#include <vtm/svg/write.hpp>
#include "geometry/box.hpp"
#include "svg/write/definitions.hpp"

namespace vtm::svg {

class Writer {
public:
    explicit Writer(const WriteOptions& options) : options_(options) {}

    std::string run(const scene::Scene& scene);

private:
    using Box = geometry::Box;

    /// Elements, and the box in which they draw, not cut by clips and masks.
    struct Part {
        std::string text;
        Box box;
    };
    /// What `write` appends, by itself.
    template <class Function>
    Part aside(Function write) {
        Part outer = std::exchange(part_, {});
        write();
        return std::exchange(part_, std::move(outer));
    }
    void append(const std::string& start, const Part& part, const std::string& end);

    /// One level further in for as long as it lives; throws WriteError where that is too deep.
    class Level {
    public:
        explicit Level(Writer& writer);
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
        ~Level() { --writer_.depth_; }

    private:
        Writer& writer_;
    };

    // write.cpp: groups and items
    void content(const scene::Group& group);
    const Part& shared(const std::shared_ptr<const scene::Group>& content);
    void group(const scene::Group& group);
    void children(const scene::Group& group);
    std::string groupAttributes(const scene::Group& group);
    bool areOneShape(const scene::Item& a, const scene::Item& b);
    void item(const scene::Item& item, const scene::Item* above);
    std::optional<std::string> paintAttributes(const scene::Item& item);
    const std::string& outline(const std::shared_ptr<const scene::Path>& path);

    // paint.cpp: values of fill and stroke; nothing where nothing is painted
    std::optional<std::string> paint(const scene::Paint& paint);
    std::optional<std::string> value(const scene::Color& color);
    std::optional<std::string> value(const scene::LinearGradient& gradient);
    std::optional<std::string> value(const scene::RadialGradient& gradient);
    std::optional<std::string> value(const scene::Pattern& pattern);
    std::optional<std::string> value(const scene::ImagePaint& image);
    std::optional<std::string> value(const scene::Material& material);

    // paint.cpp: items that are painted with bitmaps
    void image(const scene::Item& item, const scene::ImagePaint& paint);
    std::string cutAttribute(const scene::Item& item, const scene::ImagePaint& paint);
    const std::string& picture(const std::shared_ptr<const image::Bitmap>& bitmap);

    // filter.cpp: an attribute for a filter; a group with it
    std::string filter(const scene::Filter& filter);
    Part filtered(const scene::Filter& made, const Part& source);

    // effects.cpp: ids of clips and masks; selections
    const std::string& clip(const std::shared_ptr<const scene::Clip>& shapes);
    std::string clipShape(const scene::ClipShape& shape);
    const std::string& mask(const std::shared_ptr<const scene::Mask>& made);
    void select(const scene::Select& selection);
    void side(const std::shared_ptr<const scene::Group>& content, const std::string& attributes);
    std::string insideAttribute(const scene::Shape& shape);
    std::string outsideAttribute(const scene::Shape& shape, const Box& content);
    std::string maskAttribute(scene::Group content, scene::MaskKind kind);

    const WriteOptions& options_;
    Part part_;  ///< what is being written
    Definitions definitions_;
    int depth_ = 0;

    /// What was made of shared parts, which are kept, so that no other part gets their addresses.
    template <class Shared>
    using Known = std::unordered_map<std::shared_ptr<const Shared>, std::string>;
    Known<scene::Path> outlines_;
    Known<image::Bitmap> pictures_;
    Known<scene::Clip> clips_;
    Known<scene::Mask> masks_;
    std::unordered_map<std::shared_ptr<const scene::Group>, Part> contents_;
};

/// Whether what is mapped by it is not seen.
bool isFlat(const scene::Affine& map);

/// The keyword of `mix-blend-mode`.
const char* nameOf(scene::BlendMode mode);

/// ` NAME="url(#ID)"`.
std::string reference(std::string_view name, const std::string& id);

}  // namespace vtm::svg
