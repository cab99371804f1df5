#include "tools/src/suggest.hpp"

#include <algorithm>

namespace vtm::tools {

namespace {

/// Optimal string alignment: Damerau, A technique for computer detection and correction of spelling errors
/// (1964).
std::size_t distance(const std::string& a, const std::string& b) {
    const std::size_t columns = b.size() + 1;
    std::vector<std::size_t> costs((a.size() + 1) * columns);
    const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return costs[i * columns + j]; };
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                at(i, j) = i + j;
                continue;
            }
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    return costs.back();
}

}  // namespace

std::string nearestOf(const std::string& word, const std::vector<std::string>& known) {
    constexpr std::size_t longest = 64;  // nobody mistypes that much; the cost is the product of the lengths
    std::string nearest;
    std::size_t best = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : known)
        if (const std::size_t d = word.size() > longest ? best : distance(word, candidate); d < best) {
            best = d;
            nearest = candidate;
        }
    return nearest;
}

}  // namespace vtm::tools
