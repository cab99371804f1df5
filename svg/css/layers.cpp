#include "svg/css/layers.hpp"

#include <algorithm>

#include "svg/css/cursor.hpp"

namespace vtm::svg {

std::size_t Layers::find(std::size_t parent, std::string_view name) {
    for (Cursor cursor(name); !cursor.atEnd();) {
        const std::string_view part = trim(cursor.until('.'));
        const std::vector<std::size_t>& children = layers_[parent].children;
        const auto found =
            std::ranges::find_if(children, [&](std::size_t child) { return layers_[child].name == part; });
        parent = found == children.end() ? add(parent, part) : *found;
    }
    return parent;
}

std::size_t Layers::add(std::size_t parent, std::string_view name) {
    layers_.push_back({name, {}});
    layers_[parent].children.push_back(layers_.size() - 1);
    return layers_.size() - 1;
}

std::vector<std::size_t> Layers::ranks() const {
    std::vector<std::size_t> ranks(layers_.size()), path{0}, next(layers_.size(), 0);
    for (std::size_t rank = 0; !path.empty();) {
        const std::size_t layer = path.back();
        if (next[layer] < layers_[layer].children.size()) {
            path.push_back(layers_[layer].children[next[layer]++]);
        } else {
            ranks[layer] = rank++;
            path.pop_back();
        }
    }
    return ranks;
}

}  // namespace vtm::svg
