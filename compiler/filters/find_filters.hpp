/// \file
/// Which parts of a scene have filters in them.
#pragma once

#include <unordered_map>

#include <vtm/scene/scene.hpp>

namespace vtm::compiler {

/// Looks at each part once, however many users it has. The scene must not change meanwhile.
class FilterFinder {
public:
    /// Whether a filter applies to the group or to anything in it, masks and patterns included.
    bool isIn(const scene::Group& group);
    bool isIn(const scene::Node& node);

private:
    bool isIn(const scene::Item& item);
    bool isIn(const scene::Select& select);

    std::unordered_map<const scene::Group*, bool> known_;
};

}  // namespace vtm::compiler
