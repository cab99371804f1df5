#include "compiler/filters/find_filters.hpp"

#include <vtm/limits/limits.hpp>

namespace vtm::compiler {

bool FilterFinder::isIn(const scene::Group& group) {
    if (const auto known = known_.find(&group); known != known_.end())
        return known->second;
    limits::check();
    bool found = group.filter || (group.mask && isIn(*group.mask->content));
    for (std::size_t i = 0; i < group.children.size() && !found; ++i)
        found = isIn(group.children[i]);
    return known_[&group] = found;
}

bool FilterFinder::isIn(const scene::Node& node) {
    return std::visit([this](const auto& value) { return isIn(value); }, node.value);
}

bool FilterFinder::isIn(const scene::Item& item) {
    const auto* pattern = std::get_if<scene::Pattern>(&item.paint);
    return pattern && isIn(*pattern->content);
}

bool FilterFinder::isIn(const scene::Select& select) {
    return (select.inside && isIn(*select.inside)) || (select.outside && isIn(*select.outside));
}

}  // namespace vtm::compiler
