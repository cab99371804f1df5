/// \file
/// The comparisons, one a file.
#pragma once

#include "bench/src/files.hpp"
#include "bench/src/table.hpp"

namespace vtm::bench {

/// Encoding against one drawing by librsvg at 1024 pixels.
Report peers(const std::vector<File>& files);
/// Bytes against a flat grid of equal finest cells, on the files and on a font.
Report compression(const std::vector<File>& files, const std::string& font);
/// Recolouring and moving items in a session against encoding anew.
Report editing(const std::vector<File>& files);
/// Time, memory and bytes over the number of curves, up to `largest`.
Report scaling(std::size_t largest);
/// Bytes against fragment cost for settings of leaf size and depth.
Report sweep(const std::vector<File>& files);

/// What `drawing` compares.
struct DrawingOptions {
    int side = 1024;                 ///< pixels of the longer side
    std::string pictures;            ///< a folder for what each engine draws; empty: none are written
    std::string nodeModules;         ///< a folder that has node_modules with peers; empty: they are missing
    std::vector<std::string> peers;  ///< commands of more peer processes
};
/// Drawing under changing views against the peers, and from the file to pixels.
Report drawing(const std::vector<File>& files, const DrawingOptions& options);
/// Rows 9 to 11 of the paper: what its lookup costs in the compiled shader and on this driver.
Report paper(const DrawingOptions& options);
/// vgDrawPath under changing matrices against cairo: the Tiger or what `files` has, many paths, glyphs, an
/// edited path.
Report openvg(const std::vector<File>& files);

}  // namespace vtm::bench
