/// \file
/// Cascade layers. Source: CSS Cascade 5 section 6.4.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace vtm::svg {

/// The layers of all sheets of a document: a tree, because layers hold layers. What is in no layer is in the
/// root, whose id is 0. Names must outlive it.
class Layers {
public:
    /// The layer `a.b` in another one, made where it is not there yet.
    std::size_t find(std::size_t parent, std::string_view name);
    /// A new one without a name.
    std::size_t add(std::size_t parent, std::string_view name = {});
    /// By id: the higher one wins. Layers yield to what stands beside them in their parent.
    std::vector<std::size_t> ranks() const;

private:
    struct Layer {
        std::string_view name;
        std::vector<std::size_t> children;
    };
    std::vector<Layer> layers_{1};
};

}  // namespace vtm::svg
