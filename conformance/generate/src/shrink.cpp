#include <algorithm>
#include <cmath>
#include <vector>

#include <vtm/scene/scene.hpp>
#include "conformance/generate/generate.hpp"

namespace vtm::generate {

namespace {

using namespace scene;

/// A copy of a scene and where its parts stand in it, in the order of painting. Masks and patterns are
/// kept as they are.
class Editable {
public:
    explicit Editable(const scene::Scene& original) : scene(original) { visit(scene.root); }
    Editable(const Editable&) = delete;
    Editable& operator=(const Editable&) = delete;

    scene::Scene scene;
    std::vector<scene::Group*> groups;
    std::vector<scene::Item*> items;
    std::vector<scene::Clip*> clips;
    std::vector<scene::Path*> paths;  ///< of items and clips

private:
    using SharedPath = std::shared_ptr<const scene::Path>;
    using SharedClip = std::shared_ptr<const scene::Clip>;

    void visit(scene::Group& group) {
        groups.push_back(&group);
        visit(group.clip);
        for (scene::Node& node : group.children) {
            if (auto* child = std::get_if<scene::Group>(&node.value)) {
                visit(*child);
                continue;
            }
            auto& item = std::get<scene::Item>(node.value);
            items.push_back(&item);
            visit(item.path);
        }
    }
    void visit(SharedClip& shared) {
        if (!shared)
            return;
        auto clip = std::make_shared<scene::Clip>(*shared);
        shared = clip;
        clips.push_back(clip.get());
        visit(clip->clip);
        for (scene::ClipShape& shape : clip->shapes) {
            visit(shape.path);
            visit(shape.clip);
        }
    }
    void visit(SharedPath& shared) {
        auto path = std::make_shared<scene::Path>(*shared);
        shared = path;
        paths.push_back(path.get());
    }
};

/// Every coordinate and radius of a path.
std::vector<double*> numbersOf(Path& path) {
    std::vector<double*> numbers;
    const auto add = [&](Point& p) { numbers.insert(numbers.end(), {&p.x, &p.y}); };
    for (Command& command : path)
        std::visit(
            [&](auto& c) {
                if constexpr (requires { c.control; })
                    add(c.control);
                if constexpr (requires { c.control1; })
                    add(c.control1), add(c.control2);
                if constexpr (requires { c.radii; })
                    add(c.radii);
                if constexpr (requires { c.to; })
                    add(c.to);
            },
            command);
    return numbers;
}

class Shrinker {
public:
    Shrinker(const Scene& scene, const std::function<bool(const Scene&)>& fails, int trials)
        : best_(scene), fails_(fails), trials_(trials) {}

    Scene run() {
        while (trials_ > 0 && pass()) {
        }
        return best_;
    }

private:
    /// Whether anything became smaller.
    bool pass() {
        bool any = removeNodes();
        any |= plainGroups();
        any |= removeClipShapes();
        any |= plainItems();
        any |= removeCommands();
        any |= straighten();
        any |= roundNumbers();
        return any;
    }

    /// Applies `edit` to a copy; it says whether it changed anything.
    template <class Edit>
    bool attempt(Edit&& edit) {
        if (trials_ <= 0)
            return false;
        Editable candidate(best_);
        if (!edit(candidate) || !isValid(candidate.scene))
            return false;
        --trials_;
        if (!fails_(candidate.scene))
            return false;
        best_ = candidate.scene;
        return true;
    }
    static bool isValid(const Scene& scene) {
        try {
            validate(scene);
        } catch (const InvalidScene&) {
            return false;
        }
        return true;
    }

    /// Erases ever shorter runs from the list that `listOf` finds.
    template <class ListOf>
    bool removeRuns(ListOf&& listOf) {
        bool any = false;
        Editable before(best_);
        for (std::size_t run = listOf(before)->size(); run > 0; run /= 2)
            for (std::size_t at = 0;;) {
                bool beyond = false;
                const bool erased = attempt([&](Editable& e) {
                    auto& list = *listOf(e);
                    beyond = at >= list.size();
                    if (beyond)
                        return false;
                    list.erase(list.begin() + at, list.begin() + std::min(at + run, list.size()));
                    return true;
                });
                if (beyond || trials_ <= 0)
                    break;
                any |= erased;
                at += erased ? 0 : run;
            }
        return any;
    }

    bool removeNodes() {
        bool any = false;
        for (std::size_t i = 0; i < Editable(best_).groups.size(); ++i)
            any |= removeRuns([&](Editable& e) { return &e.groups[i]->children; });
        return any;
    }
    bool removeClipShapes() {
        bool any = false;
        for (std::size_t i = 0; i < Editable(best_).clips.size(); ++i)
            any |= removeRuns([&](Editable& e) { return &e.clips[i]->shapes; });
        return any;
    }
    bool removeCommands() {
        bool any = false;
        for (std::size_t i = 0; i < Editable(best_).paths.size(); ++i)
            any |= removeRuns([&](Editable& e) { return e.paths[i]; });
        return any;
    }

    /// Sets a part to its plainest value.
    template <class Part, class Value>
    static bool set(Part& part, const Value& value) {
        if (part == value)
            return false;
        part = value;
        return true;
    }

    bool plainGroups() {
        bool any = false;
        for (std::size_t i = 0; i < Editable(best_).groups.size(); ++i) {
            any |= attempt([&](Editable& e) { return set(e.groups[i]->clip, nullptr); });
            any |= attempt([&](Editable& e) { return set(e.groups[i]->mask, nullptr); });
            any |= attempt([&](Editable& e) { return set(e.groups[i]->opacity, 1.0f); });
            any |= attempt([&](Editable& e) { return set(e.groups[i]->blend, BlendMode::Normal); });
            any |= attempt([&](Editable& e) { return dissolve(*e.groups[i]); });
        }
        for (std::size_t i = 0; i < Editable(best_).clips.size(); ++i)
            any |= attempt([&](Editable& e) { return set(e.clips[i]->clip, nullptr); });
        return any;
    }

    /// The first group among the children gives way to its own children.
    static bool dissolve(Group& group) {
        for (std::size_t i = 0; i < group.children.size(); ++i)
            if (const Group* child = std::get_if<Group>(&group.children[i].value)) {
                const std::vector<Node> inner = child->children;
                group.children.erase(group.children.begin() + i);
                group.children.insert(group.children.begin() + i, inner.begin(), inner.end());
                return true;
            }
        return false;
    }

    bool plainItems() {
        bool any = false;
        for (std::size_t i = 0; i < Editable(best_).items.size(); ++i) {
            const auto item = [i](Editable& e) -> Item& { return *e.items[i]; };
            any |= attempt([&](Editable& e) { return set(item(e).transform, identity); });
            any |= attempt([&](Editable& e) { return set(item(e).opacity, 1.0f); });
            any |= attempt([&](Editable& e) { return paintBlack(item(e)); });
            any |= attempt([&](Editable& e) { return fill(item(e)); });
            for (const auto plainer :
                 {&StrokeStyle::dashPhase, &StrokeStyle::width, &StrokeStyle::miterLimit})
                any |= attempt([&](Editable& e) {
                    auto* style = std::get_if<StrokeStyle>(&item(e).geometry);
                    return style && set(style->*plainer, StrokeStyle().*plainer);
                });
            any |= attempt([&](Editable& e) {
                auto* style = std::get_if<StrokeStyle>(&item(e).geometry);
                return style && set(style->dashes, std::vector<double>());
            });
            any |= attempt([&](Editable& e) {
                auto* style = std::get_if<StrokeStyle>(&item(e).geometry);
                return style && set(style->cap, Cap::Butt);
            });
            any |= attempt([&](Editable& e) {
                auto* style = std::get_if<StrokeStyle>(&item(e).geometry);
                return style && set(style->join, Join::Bevel);
            });
        }
        return any;
    }
    static bool paintBlack(Item& item) {
        const auto* color = std::get_if<Color>(&item.paint);
        if (color && *color == Color{})
            return false;
        item.paint = Color{};
        return true;
    }
    static bool fill(Item& item) {
        if (std::holds_alternative<FillRule>(item.geometry))
            return false;
        item.geometry = FillRule::NonZero;
        return true;
    }

    /// Lines instead of curves.
    bool straighten() {
        bool any = false;
        for (std::size_t i = 0; i < Editable(best_).paths.size(); ++i)
            for (std::size_t k = 0; k < Editable(best_).paths[i]->size(); ++k)
                any |= attempt([&](Editable& e) {
                    Command& command = (*e.paths[i])[k];
                    if (std::holds_alternative<MoveTo>(command) || std::holds_alternative<LineTo>(command) ||
                        std::holds_alternative<Close>(command))
                        return false;
                    command = LineTo{*endOf(command)};
                    return true;
                });
        return any;
    }

    /// As few digits as will do, all numbers of a path at once and then one by one.
    bool roundNumbers() {
        bool any = false;
        for (const double unit : {8.0, 1.0, 0.1, 0.01, 1e-3, 1e-4})
            for (std::size_t i = 0; i < Editable(best_).paths.size(); ++i) {
                const std::size_t count = numbersOf(*Editable(best_).paths[i]).size();
                if (attempt([&](Editable& e) { return roundAll(numbersOf(*e.paths[i]), unit); })) {
                    any = true;
                    continue;
                }
                for (std::size_t k = 0; k < count; ++k)
                    any |= attempt([&](Editable& e) { return roundAll({numbersOf(*e.paths[i])[k]}, unit); });
            }
        return any;
    }
    /// A number that is a multiple of a larger unit stays as it is.
    static bool roundAll(const std::vector<double*>& numbers, double unit) {
        bool any = false;
        for (double* number : numbers) {
            const double round = std::round(*number / unit) * unit;
            const bool shorter = std::abs(round - *number) > 1e-9 * (1 + std::abs(*number));
            if (shorter)
                *number = round;
            any |= shorter;
        }
        return any;
    }

    Scene best_;
    const std::function<bool(const Scene&)>& fails_;
    int trials_;
};

}  // namespace

Scene shrink(const Scene& scene, const std::function<bool(const Scene&)>& fails, int trials) {
    return Shrinker(scene, fails, trials).run();
}

}  // namespace vtm::generate
