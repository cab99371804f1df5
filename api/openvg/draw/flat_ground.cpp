#include "api/openvg/draw/flat_ground.hpp"

#include "api/openvg/image/pixels.hpp"

namespace vtm::openvg {

std::size_t FlatGround::draw(std::uint8_t* corner, std::ptrdiff_t stride, std::span<const EdgePixel> edges,
                             EdgePixel* others) const {
    std::size_t count = 0;
    for (const EdgePixel& edge : edges) {
        std::uint8_t* const p = edge.in(corner, stride);
        if (wordAt(p, 4) == ground_)
            setWordAt(p, 4, words_[edge.share >> stepBits]);
        else
            others[count++] = edge;
    }
    return count;
}

void FlatGround::count(const Color& color, std::uint32_t ground, std::size_t pixels) {
    if (color != nextColor_ || ground != nextGround_)
        mixed_ = 0;
    nextColor_ = color;
    nextGround_ = ground;
    mixed_ += pixels;
    if (mixed_ > words_.size())
        make();
}

void FlatGround::make() {
    const OpaqueMixer mixer(nextColor_);
    for (std::size_t i = 0; i < words_.size(); ++i) {
        words_[i] = nextGround_;
        mixer(reinterpret_cast<std::uint8_t*>(&words_[i]), unsigned(i << stepBits) + (1 << stepBits) / 2);
    }
    color_ = nextColor_;
    ground_ = nextGround_;
    mixed_ = 0;
}

}  // namespace vtm::openvg
