/// \file
/// What is asked of a report.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vtm::bench {

struct Options {
    bool quick = false;     ///< fewer files and rounds: all reports together in ten minutes on two cores
    bool examples = false;  ///< our own drawings only, not the corpus
    bool wall = false;      ///< time is wall time, for drivers that do not work on the CPU
    std::string only;       ///< this file only; empty: all
    std::vector<std::string> files;  ///< SVG files that are measured instead; empty: ours and the corpus
    std::string filter = ".";  ///< regular expression: Google Benchmark's cases in `micro` and `pipeline`
    std::string font;          ///< whose glyphs are compressed; empty: a DejaVu Sans, if there is one
    std::size_t largest = 1'000'000;  ///< curves of the largest scene of `scaling`
    int side = 1024;                  ///< pixels of the longer side
    std::string pictures;             ///< a folder for what is drawn; empty: none is written
    std::string nodeModules;          ///< a folder that has node_modules with peers; empty: they are missing
    std::vector<std::string> peers;   ///< commands of more peer processes
    std::string program;              ///< this program's file, for what needs a process of its own
};

/// CPU milliseconds for one thing that is measured.
struct Budget {
    double usual, quick;

    double of(const Options& options) const { return options.quick ? quick : usual; }
};

}  // namespace vtm::bench
