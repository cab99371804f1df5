// bench_encode FILE [TIMES]: reads a drawing and compiles it with the default options, for
// bench/instructions.py.

#include <cstdio>
#include <cstdlib>
#include <exception>

#include <tbb/parallel_for.h>

#include <vtm/asset/asset.hpp>
#include <vtm/compiler/compile.hpp>
#include "bench/input/files.hpp"

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("bench_encode FILE [TIMES]\n", stderr);
        return 2;
    }
    try {
        const vtm::scene::Scene scene = vtm::bench::load({"", argv[1]});
        // oneTBB reads what the system says of its processors, once: that is not the compiler's work.
        tbb::parallel_for(0, 2, [](int) {});
        std::size_t pieces = 0;
        for (int i = argc > 2 ? std::atoi(argv[2]) : 1; i > 0; --i)
            pieces = vtm::compiler::compile(scene).asset.pieces.size();
        std::printf("%zu pieces\n", pieces);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_encode: %s\n", error.what());
        return 1;
    }
}
