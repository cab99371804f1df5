#include "text/fonts/pattern.hpp"

#include <tuple>
#include <utility>

namespace vtm::text {
namespace {

std::string stringOf(FcPattern* pattern, const char* object, int n = 0) {
    FcChar8* value = nullptr;
    const bool found = FcPatternGetString(pattern, object, n, &value) == FcResultMatch;
    return found ? reinterpret_cast<const char*>(value) : "";
}

int integerOf(FcPattern* pattern, const char* object, int fallback) {
    int value = 0;
    return FcPatternGetInteger(pattern, object, 0, &value) == FcResultMatch ? value : fallback;
}

bool isTrue(FcPattern* pattern, const char* object) {
    FcBool value = FcFalse;
    return FcPatternGetBool(pattern, object, 0, &value) == FcResultMatch && value == FcTrue;
}

/// A number or a range.
std::pair<double, double> rangeOf(FcPattern* pattern, const char* object, double fallback) {
    std::pair<double, double> range{fallback, fallback};
    FcRange* found = nullptr;
    if (FcPatternGetRange(pattern, object, 0, &found) == FcResultMatch)
        FcRangeGetDouble(found, &range.first, &range.second);
    else if (FcPatternGetDouble(pattern, object, 0, &range.first) == FcResultMatch)
        range.second = range.first;
    return range;
}

Slant slantOf(FcPattern* pattern) {
    const int slant = integerOf(pattern, FC_SLANT, FC_SLANT_ROMAN);
    if (slant == FC_SLANT_ROMAN)
        return Slant::Normal;
    return slant == FC_SLANT_ITALIC ? Slant::Italic : Slant::Oblique;
}

int slantValue(Slant slant) {
    if (slant == Slant::Normal)
        return FC_SLANT_ROMAN;
    return slant == Slant::Italic ? FC_SLANT_ITALIC : FC_SLANT_OBLIQUE;
}

std::shared_ptr<FcCharSet> charactersOf(FcPattern* pattern) {
    FcCharSet* found = nullptr;
    const bool known = FcPatternGetCharSet(pattern, FC_CHARSET, 0, &found) == FcResultMatch;
    return {known ? FcCharSetCopy(found) : FcCharSetCreate(), FcCharSetDestroy};
}

// fontconfig's index: the face below, the named instance above.
constexpr int instanceShift = 16, faceMask = 0xffff;

}  // namespace

bool isUsable(FcPattern* pattern) {
    const std::string format = stringOf(pattern, FC_FONTFORMAT);
    const bool isInstance =
        integerOf(pattern, FC_INDEX, 0) >> instanceShift != 0 && !isTrue(pattern, FC_VARIABLE);
    return (format == "TrueType" || format == "CFF") && !isInstance;
}

FaceEntry entryOf(FcPattern* pattern) {
    FaceEntry entry;
    entry.file = stringOf(pattern, FC_FILE);
    entry.index = static_cast<unsigned>(integerOf(pattern, FC_INDEX, 0) & faceMask);
    entry.family = stringOf(pattern, FC_FAMILY);
    entry.variable = isTrue(pattern, FC_VARIABLE);
    entry.color = isTrue(pattern, FC_COLOR);
    const auto weight = rangeOf(pattern, FC_WEIGHT, FC_WEIGHT_REGULAR);
    entry.minWeight = FcWeightToOpenTypeDouble(weight.first);
    entry.maxWeight = FcWeightToOpenTypeDouble(weight.second);
    std::tie(entry.minStretch, entry.maxStretch) = rangeOf(pattern, FC_WIDTH, FC_WIDTH_NORMAL);
    entry.slant = slantOf(pattern);
    entry.characters = charactersOf(pattern);
    return entry;
}

std::vector<std::string> familiesOf(FcPattern* pattern) {
    std::vector<std::string> families;
    FcChar8* name = nullptr;
    for (int n = 0; FcPatternGetString(pattern, FC_FAMILY, n, &name) == FcResultMatch; ++n)
        families.emplace_back(reinterpret_cast<const char*>(name));
    return families;
}

FcPatternOwner patternOf(const FontQuery& query) {
    FcPatternOwner pattern(FcPatternCreate());
    for (const std::string& family : query.families)
        FcPatternAddString(pattern.get(), FC_FAMILY, fcString(family));
    FcPatternAddDouble(pattern.get(), FC_WEIGHT, FcWeightFromOpenTypeDouble(query.weight));
    FcPatternAddDouble(pattern.get(), FC_WIDTH, query.stretch);
    FcPatternAddInteger(pattern.get(), FC_SLANT, slantValue(query.slant));
    if (!query.language.empty())
        FcPatternAddString(pattern.get(), FC_LANG, fcString(query.language));
    return pattern;
}

}  // namespace vtm::text
