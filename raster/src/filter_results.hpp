/// \file
/// What filters made of their inputs under one view, kept for boxes that are drawn later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/asset/difference.hpp>
#include <vtm/raster/pixel_box.hpp>
#include <vtm/raster/view.hpp>
#include "raster/src/canvas.hpp"

namespace vtm::asset {

/// The first of the commands pushes a filter's first input: those up to the filter.
std::span<const Command> filteredBy(const AssetView& asset, std::span<const Command> commands);

/// Of the filters that are in no other: those of pictures that are seen under the view itself. Safe to use
/// from several threads at once, except for update().
class FilterResults {
public:
    /// Nothing is kept yet.
    FilterResults(const AssetView& asset, const View& view);

    /// Goes on to the next asset; the last one may be gone. Results whose filters and inputs stayed are kept.
    /// Where a single map changed, that of its filter is kept but for the areas of the difference.
    void update(const AssetView& asset, const Difference& difference);

    bool isOf(const View& view) const;
    const View& view() const { return view_; }

    /// What a box of the view shows of the result of commands, under the view of that box; nothing where that
    /// is not known. `first`: their number.
    std::optional<Canvas> find(std::size_t first, const PixelBox& box, const View& below) const;
    /// Keeps a result, which is under the view of a box. `shown`: all that the view shows of it; beyond the
    /// box that must be there already.
    void put(std::size_t first, const PixelBox& shown, const PixelBox& box, const Canvas& result);

private:
    /// All that a result depends on but the maps' contents.
    struct Origin {
        std::string records;
        std::vector<std::uint32_t> maps;
    };
    struct Result {
        PixelBox box;
        std::vector<Float4> pixels;  ///< of the box, row by row
        std::vector<PixelBox> stale;
    };

    static Origin originOf(const AssetView& asset, std::span<const Command> commands);
    static std::map<std::size_t, Origin> originsOf(const AssetView& asset);
    bool isOneEdit(const Difference& difference) const;
    static void copy(const Canvas& from, const PixelBox& box, Result& to);

    View view_;
    mutable std::mutex mutex_;               ///< guards what follows
    std::map<std::size_t, Origin> origins_;  ///< by the first command
    std::map<std::size_t, Result> results_;
    std::size_t mapCount_ = 0;
    std::size_t pixels_ = 0;  ///< of the results
};

}  // namespace vtm::asset
