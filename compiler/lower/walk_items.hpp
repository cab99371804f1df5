/// \file
/// Walking some items of a picture in painter's order with their groups opened and closed round them.
#pragma once

#include <algorithm>
#include <vector>

#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

/// Calls, properly nested: visitor.open(group), visitor.item(item), visitor.close(group). A group is
/// opened when its first item comes; the ground (group 0) never is. A group whose mask has none of the items
/// is closed with visitor.emptyMask(group) before close.
template <class Visitor>
class ItemWalk {
public:
    ItemWalk(const LoweredScene& picture, Visitor& visitor) : picture_(picture), visitor_(visitor) {}

    void item(const LoweredItem& item) {
        closeDownTo(commonDepth(item.group));
        openUpTo(item.group);
        visitor_.item(item);
    }
    void finish() { closeDownTo(0); }

private:
    struct Open {
        std::uint32_t group;
        bool masked;
    };

    unsigned commonDepth(std::uint32_t group) const {
        while (group != 0) {
            const unsigned depth = picture_.groups[group].depth;
            if (depth <= open_.size() && open_[depth - 1].group == group)
                return depth;
            group = picture_.groups[group].parent;
        }
        return 0;
    }

    void closeDownTo(unsigned depth) {
        while (open_.size() > depth) {
            const Open top = open_.back();
            open_.pop_back();
            if (picture_.groups[top.group].mask != noIndex && !top.masked)
                visitor_.emptyMask(top.group);
            visitor_.close(top.group);
        }
    }

    void openUpTo(std::uint32_t group) {
        const std::size_t already = open_.size();
        for (; group != 0 && picture_.groups[group].depth > already; group = picture_.groups[group].parent)
            open_.push_back({group, false});
        std::reverse(open_.begin() + static_cast<std::ptrdiff_t>(already), open_.end());
        for (std::size_t i = already; i < open_.size(); ++i) {
            if (i > 0 && picture_.groups[open_[i].group].role != GroupRole::Plain)
                open_[i - 1].masked = true;
            visitor_.open(open_[i].group);
        }
    }

    const LoweredScene& picture_;
    Visitor& visitor_;
    std::vector<Open> open_;
};

}  // namespace vtm::compiler
