/// \file
/// The reports, one a file.
#pragma once

#include <span>

#include "bench/measure/options.hpp"
#include "bench/measure/table.hpp"

namespace vtm::bench {

/// Single steps, by Google Benchmark: nanoseconds for a curve, a piece, a pixel.
Report micro(const Options& options);
/// From the file to the first frame, step by step, by Google Benchmark.
Report pipeline(const Options& options);
/// Encoding against one drawing by librsvg at 1024 pixels.
Report peers(const Options& options);
/// Drawing under changing views against the peers, and from the file to pixels.
Report drawing(const Options& options);
/// The same pictures against exact truth.
Report error(const Options& options);
/// Peak memory from the file to pixels, every engine in a process of its own.
Report memory(const Options& options);
/// Drawing over the number of pixels, 64² to 8192².
Report sides(const Options& options);
/// Pictures as textures, beside mip-mapped bitmaps: flat, far away, in perspective.
Report texture(const Options& options);
/// Frames by shaders as users wait for them: GPU and wall time, turning, zooming, as textures.
Report frames(const Options& options);
/// Pages of text from the file to pixels, beside the peers.
Report text(const Options& options);
/// Pictures with filters from the file to pixels, beside the peers.
Report filters(const Options& options);
/// Pages of text as textures, beside a bitmap of one.
Report pages(const Options& options);
/// Context, programs, first frame, in fresh processes with a cold and a warm cache of shaders.
Report startup(const Options& options);
/// Bytes against a flat grid of equal finest cells, on the files and on a font.
Report compression(const Options& options);
/// What trees and instances save against a flat grid, and cost.
Report recursion(const Options& options);
/// Recolouring and moving items in a session against encoding anew.
Report editing(const Options& options);
/// Rows 5 to 13 of the paper: what its lookup costs in the compiled shader and on this driver.
Report paper(const Options& options);
/// vgDrawPath under changing matrices against cairo: the Tiger or the file named, many paths, glyphs, an
/// edited path.
Report openvg(const Options& options);
/// Frames on windows of every format, by OpenVG.
Report windows(const Options& options);
/// Time, memory and bytes over the number of curves, up to the largest.
Report scaling(const Options& options);
/// Wall time with one thread against all processors: compiling, drawing once, drawing again.
Report threads(const Options& options);
/// Time and memory of drawing once what is quadratic, from 10^2 to 10^5 shapes.
Report traps(const Options& options);
/// Bytes against fragment cost for settings of leaf size and depth.
Report sweep(const Options& options);

/// A fresh process's part of `startup`: prints its times as one line of JSON. `cache`: a folder for programs,
/// or empty.
void startOnce(const std::string& cache, const Options& options);

}  // namespace vtm::bench
