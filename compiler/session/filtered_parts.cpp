#include "compiler/session/filtered_parts.hpp"

#include <utility>
#include <variant>

#include <vtm/scene/affine.hpp>
#include "compiler/compile/settings.hpp"
#include "compiler/containers/hash.hpp"
#include "compiler/filters/compile_filtered.hpp"
#include "compiler/session/same_nodes.hpp"

namespace vtm::compiler {
namespace {

/// The first item in the nodes, if there is one.
const scene::Item* firstItem(const scene::NodeList& nodes) {
    for (const scene::Node& node : nodes)
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return item;
        else if (const auto* group = std::get_if<scene::Group>(&node.value))
            if (const scene::Item* first = firstItem(group->children))
                return first;
    return nullptr;
}

bool isSameExcerpt(const Excerpt& a, const Excerpt& b) {
    return a.fromScene == b.fromScene && a.width == b.width && a.height == b.height && a.isPart == b.isPart;
}

}  // namespace

/// By where its first item begins: parts that are the same have the same, others seldom.
std::size_t FilteredParts::keyOf(const scene::NodeList& nodes) {
    const scene::Item* item = firstItem(nodes);
    if (!item || item->path->empty())
        return 0;
    const scene::Point begin = scene::apply(item->transform, std::get<scene::MoveTo>(item->path->front()).to);
    return hashCombine(hashCombine(bits(begin.x), bits(begin.y)), item->path->size());
}

Result FilteredParts::compile(const scene::Scene& scene, const Options& options) {
    Parts before = std::exchange(parts_, {});  // lost if anything throws
    compiled_ = 0;
    const CompilePlain plain = [](const scene::Scene& part, const Excerpt& excerpt, const Options& how) {
        return compileExcerpt(part, excerpt, how);
    };
    const CompilePlain known = [&](const scene::Scene& part, const Excerpt& excerpt, const Options& how) {
        const scene::NodeList& nodes = part.root.children;
        const std::size_t key = keyOf(nodes);
        auto [candidate, end] = before.equal_range(key);
        for (; candidate != end; ++candidate) {
            const Part& old = candidate->second;
            if (old.tolerance == how.tolerance && isSameExcerpt(old.excerpt, excerpt) &&
                areSame(old.nodes, nodes))
                return parts_.insert(before.extract(candidate))->second.result;
        }
        ++compiled_;
        Result made = plain(part, excerpt, how);
        Result& kept = parts_.emplace(key, Part{nodes, excerpt, how.tolerance, made})->second.result;
        for (StageTime& stage : kept.stages)
            stage.milliseconds = 0;
        return made;
    };
    return compileFiltered(scene, wholeOf(scene), options, plain, known);
}

}  // namespace vtm::compiler
