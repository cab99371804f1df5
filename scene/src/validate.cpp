// Walks the scene and asks of each node whether its values are allowed (validate_values.cpp).
//
// Shared parts are checked once, whatever the number of their users: a scene is a directed acyclic
// graph, and walking it as a tree may take exponential time. What is kept of a part is its height, so
// that the limit on nesting holds on every way through it.

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include <vtm/scene/scene.hpp>
#include "scene/src/validate_values.hpp"

namespace vtm::scene {

namespace {

class Validator {
public:
    explicit Validator(const std::function<bool(const Path&)>& isKnown) : isKnown_(isKnown) {}

    void scene(const Scene& s) {
        report(fault(s));
        enter("root");
        group(s.root);
    }

private:
    /// Levels of groups and clips below a part, itself included.
    using Height = int;

    /// A part by its name, or by its number among others.
    struct Step {
        const char* name;
        std::size_t number = 0;

        std::string text() const { return name ? name : std::to_string(number); }
    };

    void enter(const char* name) { position_.push_back({name}); }
    void enter(std::size_t number) { position_.push_back({nullptr, number}); }
    void leave() { position_.pop_back(); }

    void report(const std::string& what) const {
        if (!what.empty())
            throw InvalidScene(where() + ": " + what);
    }

    /// Of a chain of a thousand groups the ends say enough.
    std::string where() const {
        constexpr std::size_t shown = 12;
        const std::size_t n = position_.size();
        std::string text = n == 0 ? "scene" : position_.front().text();
        if (n > 2 * shown)
            text += "/...";
        for (std::size_t i = n > 2 * shown ? n - shown : 1; i < n; ++i)
            text += "/" + position_[i].text();
        return text;
    }

    void checkLevel(Height height) const {
        if (level_ + height > maxNesting)
            report(fmt::format("is nested more than {} levels deep", maxNesting));
    }

    /// The height of a shared part: looked up, or found by `check`.
    template <class Part, class Check>
    Height shared(const std::shared_ptr<const Part>& part, Check check) {
        if (!part)
            report("is missing");
        const auto done = heights_.find(part.get());
        if (done == heights_.end()) {
            const Height height = check(*part);
            heights_.emplace(part.get(), height);
            return height;
        }
        checkLevel(done->second);
        return done->second;
    }

    Height group(const Group& g) {
        checkLevel(1);
        ++level_;
        report(fault(g));
        Height height = g.clip ? clip(g.clip) : 0;
        if (g.mask)
            height = std::max(height, mask(*g.mask));
        if (g.filter)
            height = std::max(height, filter(*g.filter));
        for (std::size_t i = 0; i < g.children.size(); ++i) {
            enter(i);
            height = std::max(height, node(g.children[i]));
            leave();
        }
        --level_;
        return height + 1;
    }

    Height node(const Node& n) {
        limits::check();
        return std::visit([this](const auto& value) { return check(value); }, n.value);
    }

    Height check(const Group& g) { return group(g); }
    Height check(const Item& i) { return item(i); }

    Height check(const Select& s) {
        checkLevel(1);
        ++level_;
        path(s.mask.path);
        report(fault(s.mask));
        Height height = s.inside ? content("inside", s.inside) : 0;
        if (s.outside)
            height = std::max(height, content("outside", s.outside));
        --level_;
        return height + 1;
    }

    Height item(const Item& i) {
        path(i.path);
        report(fault(i));
        if (const auto* procedural = std::get_if<Material>(&i.paint))
            material(*procedural);
        const auto* tiled = std::get_if<Pattern>(&i.paint);
        return tiled ? content("pattern", tiled->content) : 0;
    }

    void material(const Material& m) {
        const auto known = texts_.emplace(m.name, &m.glsl).first;
        if (*known->second != m.glsl)
            report("material '" + m.name + "' has another text than before");
    }

    void path(const std::shared_ptr<const Path>& shape) {
        if (shape && isKnown_(*shape))
            return;
        enter("path");
        shared(shape, [&](const Path& p) {
            report(fault(p));
            return 0;
        });
        leave();
    }

    Height content(const char* name, const std::shared_ptr<const Group>& part) {
        enter(name);
        const Height height = shared(part, [&](const Group& g) { return group(g); });
        leave();
        return height;
    }

    Height clip(const std::shared_ptr<const Clip>& part) {
        enter("clip");
        const Height height = shared(part, [&](const Clip& c) { return clipShapes(c); });
        leave();
        return height;
    }

    Height clipShapes(const Clip& c) {
        checkLevel(1);
        ++level_;
        Height height = c.clip ? clip(c.clip) : 0;
        for (std::size_t i = 0; i < c.shapes.size(); ++i) {
            limits::check();
            enter(i);
            path(c.shapes[i].path);
            report(fault(c.shapes[i]));
            if (c.shapes[i].clip)
                height = std::max(height, clip(c.shapes[i].clip));
            leave();
        }
        --level_;
        return height + 1;
    }

    Height mask(const Mask& m) {
        enter("mask");
        report(fault(m));
        leave();
        return content("mask", m.content);
    }

    Height filter(const Filter& f) {
        enter("filter");
        report(fault(f));
        Height height = 0;
        for (const FilterPrimitive& primitive : f.primitives)
            if (const auto* picture = std::get_if<PictureFilter>(&primitive.operation))
                height = std::max(height, content("picture", picture->content));
        leave();
        return height;
    }

    const std::function<bool(const Path&)>& isKnown_;
    std::vector<Step> position_;
    int level_ = 0;
    std::unordered_map<const void*, Height> heights_;
    std::unordered_map<std::string, const std::string*> texts_;  ///< of materials, by name
};

}  // namespace

void validate(const Scene& scene) {
    validate(scene, [](const Path&) { return false; });
}

void validate(const Scene& scene, const std::function<bool(const Path&)>& isKnown) {
    Validator(isKnown).scene(scene);
}

}  // namespace vtm::scene
