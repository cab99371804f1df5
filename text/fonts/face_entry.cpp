#include "text/fonts/face_entry.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace vtm::text {
namespace {

/// Which is tried first: the lower side, then the lower distance.
using Rank = std::pair<int, double>;
enum Side { inside, preferred, other, last };

/// Of a face's range [low, high].
Rank rankOf(double wanted, double low, double high, bool aboveFirst) {
    if (wanted < low)
        return {aboveFirst ? preferred : other, low - wanted};
    if (wanted > high)
        return {aboveFirst ? other : preferred, wanted - high};
    return {inside, 0};
}

Rank stretchRank(const FaceEntry& face, double wanted) {
    constexpr double normal = 100;
    return rankOf(wanted, face.minStretch, face.maxStretch, wanted > normal);
}

int slantRank(const FaceEntry& face, Slant wanted) {
    static constexpr int ranks[3][3]{{0, 2, 1}, {2, 0, 1}, {2, 1, 0}};  // wanted; normal, italic, oblique
    return ranks[static_cast<int>(wanted)][static_cast<int>(face.slant)];
}

/// From 400 to 500: heavier up to 500 first, then lighter, then heavier.
Rank weightRank(const FaceEntry& face, double wanted) {
    constexpr double regular = 400, medium = 500;
    const Rank rank = rankOf(wanted, face.minWeight, face.maxWeight, wanted >= regular);
    const bool isMiddle = wanted >= regular && wanted <= medium;
    return isMiddle && face.minWeight > medium ? Rank{last, rank.second} : rank;
}

/// Default_Ignorable_Code_Point of Unicode 15, and controls.
bool isIgnorable(char32_t c) {
    struct Range {
        char32_t first, last;
    };
    static constexpr Range ranges[]{
        {0x0000, 0x001f}, {0x007f, 0x009f},   {0x00ad, 0x00ad},   {0x034f, 0x034f},  {0x061c, 0x061c},
        {0x115f, 0x1160}, {0x17b4, 0x17b5},   {0x180b, 0x180f},   {0x200b, 0x200f},  {0x2028, 0x202e},
        {0x2060, 0x206f}, {0x3164, 0x3164},   {0xfe00, 0xfe0f},   {0xfeff, 0xfeff},  {0xffa0, 0xffa0},
        {0xfff0, 0xfff8}, {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}};
    return std::any_of(std::begin(ranges), std::end(ranges),
                       [c](const Range& range) { return range.first <= c && c <= range.last; });
}

}  // namespace

bool FaceEntry::covers(std::u32string_view cluster) const {
    return std::all_of(cluster.begin(), cluster.end(), [&](char32_t c) {
        return isIgnorable(c) || FcCharSetHasChar(characters.get(), c) == FcTrue;
    });
}

const FaceEntry* bestFace(const std::vector<const FaceEntry*>& faces, const FontQuery& query) {
    const auto rank = [&](const FaceEntry* face) {
        return std::tuple(stretchRank(*face, query.stretch), slantRank(*face, query.slant),
                          weightRank(*face, query.weight));
    };
    const auto best =
        std::min_element(faces.begin(), faces.end(),
                         [&](const FaceEntry* a, const FaceEntry* b) { return rank(a) < rank(b); });
    return best == faces.end() ? nullptr : *best;
}

std::vector<const FaceEntry*> covering(std::vector<const FaceEntry*> faces, std::u32string_view cluster) {
    std::erase_if(faces, [&](const FaceEntry* face) { return !face->covers(cluster); });
    return faces;
}

namespace {

constexpr Tag italicAxis = HB_TAG('i', 't', 'a', 'l'), slantAxis = HB_TAG('s', 'l', 'n', 't'),
              weightAxis = HB_TAG('w', 'g', 'h', 't'), widthAxis = HB_TAG('w', 'd', 't', 'h'),
              sizeAxis = HB_TAG('o', 'p', 's', 'z');

/// The axis counts degrees counterclockwise. CSS Fonts 4 section 2.4: `oblique` is 14 degrees clockwise.
constexpr float obliqueAngle = -14;

class Axes {
public:
    explicit Axes(const Face& face) : face_(face) {}

    void set(Tag axis, double value) {
        if (!face_.hasAxis(axis))
            return;
        const auto known =
            std::find_if(list.begin(), list.end(), [&](auto& set) { return set.first == axis; });
        if (known == list.end())
            list.emplace_back(axis, float(value));
        else
            known->second = float(value);
    }

    std::vector<std::pair<Tag, float>> list;

private:
    const Face& face_;
};

void setSlant(Axes& axes, const Face& face, Slant slant) {
    if (slant == Slant::Normal)
        return;
    if (slant == Slant::Italic && face.hasAxis(italicAxis))
        axes.set(italicAxis, 1);
    else
        axes.set(slantAxis, obliqueAngle);
}

Axes axesOf(const Face& face, const FaceEntry& entry, const FontQuery& query) {
    Axes axes(face);
    axes.set(weightAxis, std::clamp(query.weight, entry.minWeight, entry.maxWeight));
    axes.set(widthAxis, std::clamp(query.stretch, entry.minStretch, entry.maxStretch));
    if (entry.slant == Slant::Normal)
        setSlant(axes, face, query.slant);
    if (query.opticalSize > 0)
        axes.set(sizeAxis, query.opticalSize);
    for (const Variation& variation : query.variations)
        axes.set(variation.axis, variation.value);
    return axes;
}

/// CSS Fonts 4 section 2.7: bold is made from faces below this weight for weights from it on.
constexpr double boldWeight = 600;

}  // namespace

Instance instanceOf(const Face& face, const FaceEntry& entry, const FontQuery& query) {
    Instance instance;
    instance.axes = axesOf(face, entry, query).list;
    instance.bold = query.synthesizeWeight && query.weight >= boldWeight && entry.maxWeight < boldWeight;
    instance.oblique = query.synthesizeSlant && query.slant != Slant::Normal &&
                       entry.slant == Slant::Normal && !face.hasAxis(slantAxis) && !face.hasAxis(italicAxis);
    return instance;
}

}  // namespace vtm::text
