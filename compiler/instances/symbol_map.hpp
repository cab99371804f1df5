/// \file
/// A run of layers in, the map of its regions out: what is placed wherever the run stands in the picture.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include "compiler/lower/lower.hpp"
#include "compiler/tree/tree.hpp"

namespace vtm::compiler {

/// Sets of layers (ascending), each with a number; the empty one is 0. Used by several threads at once.
class LayerSets {
public:
    LayerSets() { add({}); }

    std::uint32_t add(const std::vector<std::uint32_t>& set);
    std::size_t size() const { return sets_.size(); }
    const std::vector<std::uint32_t>& operator[](std::size_t number) const { return *sets_[number]; }

private:
    std::mutex mutex_;
    std::map<std::vector<std::uint32_t>, std::uint32_t> numbers_;
    std::vector<const std::vector<std::uint32_t>*> sets_;
};

struct SymbolMap {
    asset::Asset asset;  ///< with one map, and trees; paints are numbers
    double error = 0;    ///< no boundary is farther off, in sides of its square
};

/// Makes maps of one run of layers.
class SymbolMaker {
public:
    /// In a square with that corner. `share`: of the longer side of the picture, that the square's side takes
    /// where it is largest.
    SymbolMaker(std::span<const LayerOrigin> run, scene::Point corner, double side, double share,
                const Options& options);

    /// The regions are the sets of layers that lie over them. Nothing if it could not be proven.
    std::optional<SymbolMap> bySets(LayerSets& sets) const;
    /// The regions are classes of sets: classes[i] of set i.
    std::optional<SymbolMap> byClasses(LayerSets& sets, std::span<const std::uint32_t> classes) const;

private:
    std::optional<SymbolMap> make(LayerSets& sets, std::span<const std::uint32_t> classes) const;

    Options options_;
    double side_, share_;
    std::unique_ptr<Lattice> lattice_;
    LoweredScene lowered_;
};

}  // namespace vtm::compiler
