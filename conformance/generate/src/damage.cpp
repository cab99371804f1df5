#include "conformance/generate/damage.hpp"

namespace vtm::generate {

std::vector<std::uint8_t> damaged(std::vector<std::uint8_t> bytes, std::mt19937_64& random) {
    constexpr int places = 8;
    const auto at = [&] { return std::ptrdiff_t(random() % bytes.size()); };
    for (int i = 0; i < places && !bytes.empty(); ++i) {
        const std::ptrdiff_t place = at();
        switch (random() % 8) {
            case 0:
                bytes.erase(bytes.begin() + place);
                break;
            case 1:
                bytes.insert(bytes.begin() + place, bytes[std::size_t(at())]);
                break;
            default:
                bytes[std::size_t(place)] =
                    std::uint8_t(random() % 2 == 0 ? '0' + random() % 10 : random() % 256);
        }
    }
    if (random() % 8 == 0 && !bytes.empty())
        bytes.resize(std::size_t(at()));
    return bytes;
}

}  // namespace vtm::generate
