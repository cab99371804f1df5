// Prints the figures of the whole corpus: GL against the truth, the CPU evaluator and the reference.
// conformance_table [NAME...]

#include <algorithm>
#include <chrono>
#include <exception>

#include <fmt/core.h>

#include "conformance/cases/measure.hpp"

namespace {

using namespace vtm;
using namespace vtm::cases;

std::string truthColumns(const Measurement& measured, Gl& gl, const CorpusFile& file, int size) {
    for (const CorpusFile::Limit& limit : file.limits)
        if (limit.size == size) {
            const compare::Difference d = measured.glToTruth(gl, size);
            return fmt::format("{:8.4f} {:8.4f} {:6.1f}", d.mean, limit.mean(), d.p999);
        }
    return fmt::format("{:>8} {:>8} {:>6}", "-", "-", "-");
}

void printRow(const CorpusFile& file, Gl& gl) {
    const auto start = std::chrono::steady_clock::now();
    const Measurement measured(file.name);
    const std::chrono::duration<double, std::milli> compiled = std::chrono::steady_clock::now() - start;
    for (const int size : {1024, 64}) {
        const compare::Difference twin = measured.glToAsset(gl, size),
                                  exact = measured.glToReference(gl, size);
        fmt::print("{:<14} {:>5} {} {:7.2f} {:7.2f} {:7.3f} {:9.0f}  {}\n", file.name, size,
                   truthColumns(measured, gl, file, size), twin.max, exact.max, exact.rms, compiled.count(),
                   file.expectedFailure);
    }
}

void printTable(const std::vector<std::string>& names) {
    Gl gl;
    fmt::print("{}\n{:<14} {:>5} {:>8} {:>8} {:>6} {:>7} {:>7} {:>7} {:>9}\n", gl.context.renderer(),
               "errors in 1/255", "px", "truth", "limit", "p99.9", "asset", "ref max", "ref rms",
               "compile ms");
    for (const CorpusFile& file : corpusFiles())
        if (names.empty() || std::find(names.begin(), names.end(), file.name) != names.end())
            printRow(file, gl);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        printTable({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        fmt::print(stderr, "conformance_table: {}\n", error.what());
        return 1;
    }
    return 0;
}
