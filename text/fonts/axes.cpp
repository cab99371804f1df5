#include "text/fonts/axes.hpp"

#include <algorithm>

namespace vtm::text {
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
