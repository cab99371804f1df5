// What is read is valid, and is written as a text that reads back as the same scene.
#include <cstdlib>

#include <vtm/vtmtree.hpp>

namespace {

std::span<const std::uint8_t> bytesOf(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    vtm::Tree tree;
    std::string text;
    try {
        tree = vtm::readTree({data, size});
        text = vtm::writeTree(tree);  // refused where relative coordinates add up to more than 1e30
    } catch (const vtm::TreeError&) {
        return 0;
    }
    const vtm::Tree back = vtm::readTree(bytesOf(text));
    if (vtm::scene::dump(back.toScene()) != vtm::scene::dump(tree.toScene()) || vtm::writeTree(back) != text)
        std::abort();
    return 0;
}
