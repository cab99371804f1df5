#include "bench/reports/openvg_shaders.hpp"

#include <algorithm>
#include <vector>

#include <VG/openvg.h>

#include "bench/measure/measure.hpp"

namespace vtm::bench {

void addShaderColumns(const std::function<void(int i)>& draw, double spend, Json& row) {
    constexpr std::size_t minimum = 5, maximum = 50;
    draw(0);  // compiles programs and paths
    vgFinish();
    std::vector<double> all, own;
    for (double spent = 0; own.size() < minimum || (spent < spend && own.size() < maximum);
         spent += all.back()) {
        const double allStart = spentMilliseconds(), ownStart = threadMilliseconds();
        draw(int(own.size()) + 1);
        own.push_back(threadMilliseconds() - ownStart);
        vgFinish();
        all.push_back(spentMilliseconds() - allStart);
    }
    row["by shaders ms"] = median(all);
    row["of these, own thread"] = median(own);
}

}  // namespace vtm::bench
