#include "text/fonts/library.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vtm::text {
namespace {

const char* text(const FcChar8* string) { return reinterpret_cast<const char*>(string); }

std::string stringOf(FcPattern* pattern, const char* object) {
    FcChar8* value = nullptr;
    return FcPatternGetString(pattern, object, 0, &value) == FcResultMatch ? text(value) : "";
}

int integerOf(FcPattern* pattern, const char* object, int fallback) {
    int value = 0;
    return FcPatternGetInteger(pattern, object, 0, &value) == FcResultMatch ? value : fallback;
}

/// A number or a range.
std::pair<double, double> rangeOf(FcPattern* pattern, const char* object, double fallback) {
    double low = fallback, high = fallback;
    FcRange* range = nullptr;
    if (FcPatternGetRange(pattern, object, 0, &range) == FcResultMatch &&
        FcRangeGetDouble(range, &low, &high))
        return {low, high};
    if (FcPatternGetDouble(pattern, object, 0, &low) == FcResultMatch)
        return {low, low};
    return {fallback, fallback};
}

FaceEntry entryOf(FcPattern* pattern) {
    FaceEntry entry;
    entry.pattern = pattern;
    entry.file = stringOf(pattern, FC_FILE);
    entry.index = static_cast<unsigned>(integerOf(pattern, FC_INDEX, 0)) & 0xffff;
    entry.family = stringOf(pattern, FC_FAMILY);
    FcBool variable = FcFalse;
    entry.variable =
        FcPatternGetBool(pattern, FC_VARIABLE, 0, &variable) == FcResultMatch && variable == FcTrue;
    const auto weight = rangeOf(pattern, FC_WEIGHT, FC_WEIGHT_REGULAR);
    entry.minWeight = FcWeightToOpenTypeDouble(weight.first);
    entry.maxWeight = FcWeightToOpenTypeDouble(weight.second);
    std::tie(entry.minStretch, entry.maxStretch) = rangeOf(pattern, FC_WIDTH, FC_WIDTH_NORMAL);
    const int slant = integerOf(pattern, FC_SLANT, FC_SLANT_ROMAN);
    entry.slant = slant == FC_SLANT_ROMAN    ? Slant::Normal
                  : slant == FC_SLANT_ITALIC ? Slant::Italic
                                             : Slant::Oblique;
    return entry;
}

/// Fonts without outlines or tables that HarfBuzz reads are left out, and so are the named instances of
/// variable fonts.
bool isUsable(FcPattern* pattern) {
    const std::string format = stringOf(pattern, FC_FONTFORMAT);
    const bool instance = integerOf(pattern, FC_INDEX, 0) >> 16 != 0;
    FcBool variable = FcFalse;
    FcPatternGetBool(pattern, FC_VARIABLE, 0, &variable);
    return (format == "TrueType" || format == "CFF") && (!instance || variable == FcTrue);
}

/// How far [low, high] is from `wanted`, and on which side: 0 where it holds it.
struct Distance {
    double below, above;
};

Distance distance(double wanted, double low, double high) {
    return {std::max(wanted - high, 0.0), std::max(low - wanted, 0.0)};
}

/// Values on the side that is not preferred come after all of the other.
constexpr double otherSide = 1e6;

double stretchRank(const FaceEntry& face, double wanted) {
    const Distance d = distance(wanted, face.minStretch, face.maxStretch);
    const bool narrowFirst = wanted <= 100;
    return narrowFirst ? d.below + d.above * otherSide : d.above + d.below * otherSide;
}

int slantRank(const FaceEntry& face, Slant wanted) {
    static constexpr int ranks[3][3]{{0, 2, 1}, {2, 0, 1}, {2, 1, 0}};  // wanted; normal, italic, oblique
    return ranks[static_cast<int>(wanted)][static_cast<int>(face.slant)];
}

double weightRank(const FaceEntry& face, double wanted) {
    const Distance d = distance(wanted, face.minWeight, face.maxWeight);
    if (wanted > 500)
        return d.above + d.below * otherSide;
    if (wanted < 400)
        return d.below + d.above * otherSide;
    // From 400 to 500: heavier up to 500 first, then lighter, then heavier.
    if (d.above > 0)
        return face.minWeight <= 500 ? d.above : d.above * otherSide * otherSide;
    return d.below * otherSide;
}

struct DestroyPattern {
    void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
};
using Pattern = std::unique_ptr<FcPattern, DestroyPattern>;

Pattern patternOf(const FontQuery& query) {
    Pattern pattern(FcPatternCreate());
    for (const std::string& family : query.families)
        FcPatternAddString(pattern.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>(family.c_str()));
    FcPatternAddDouble(pattern.get(), FC_WEIGHT, FcWeightFromOpenTypeDouble(query.weight));
    FcPatternAddDouble(pattern.get(), FC_WIDTH, query.stretch);
    FcPatternAddInteger(pattern.get(), FC_SLANT,
                        query.slant == Slant::Normal   ? FC_SLANT_ROMAN
                        : query.slant == Slant::Italic ? FC_SLANT_ITALIC
                                                       : FC_SLANT_OBLIQUE);
    if (!query.language.empty())
        FcPatternAddString(pattern.get(), FC_LANG, reinterpret_cast<const FcChar8*>(query.language.c_str()));
    return pattern;
}

using OptionsKey = std::tuple<std::vector<std::string>, bool>;

}  // namespace

bool FaceEntry::covers(std::u32string_view characters) const {
    FcCharSet* set = nullptr;
    return FcPatternGetCharSet(pattern, FC_CHARSET, 0, &set) == FcResultMatch &&
           std::all_of(characters.begin(), characters.end(),
                       [&](char32_t c) { return FcCharSetHasChar(set, c) == FcTrue; });
}

std::string familyKey(const std::string& family) {
    FcChar8* const lower = FcStrDowncase(reinterpret_cast<const FcChar8*>(family.c_str()));
    std::string key = lower ? text(lower) : family;
    FcStrFree(lower);
    return key;
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

std::shared_ptr<FontLibrary> FontLibrary::of(const FontOptions& options) {
    static std::mutex mutex;
    static std::map<OptionsKey, std::shared_ptr<FontLibrary>> libraries;
    const std::lock_guard lock(mutex);
    std::shared_ptr<FontLibrary>& library = libraries[OptionsKey(options.directories, options.systemFonts)];
    if (!library)
        library = std::make_shared<FontLibrary>(options);
    return library;
}

FontLibrary::FontLibrary(const FontOptions& options)
    : systemFonts_(options.systemFonts),
      config_(systemFonts_ ? FcInitLoadConfigAndFonts() : FcConfigCreate()) {
    for (const std::string& directory : options.directories)
        FcConfigAppFontAddDir(config_, reinterpret_cast<const FcChar8*>(directory.c_str()));
    list(FcConfigGetFonts(config_, FcSetApplication));
    if (systemFonts_)
        list(FcConfigGetFonts(config_, FcSetSystem));
}

FontLibrary::~FontLibrary() { FcConfigDestroy(config_); }

void FontLibrary::list(FcFontSet* set) {
    std::vector<std::unique_ptr<const FaceEntry>> listed;
    for (int i = 0; set && i < set->nfont; ++i)
        if (isUsable(set->fonts[i]))
            listed.push_back(std::make_unique<const FaceEntry>(entryOf(set->fonts[i])));
    std::sort(listed.begin(), listed.end(), [](const auto& a, const auto& b) {
        // A variable face first, so that it stands for the file's default instance.
        return std::tuple(a->family, a->file, a->index, !a->variable) <
               std::tuple(b->family, b->file, b->index, !b->variable);
    });
    for (auto& entry : listed) {
        if (!byFile_.try_emplace({entry->file, entry->index}, entry.get()).second)
            continue;
        FcChar8* name = nullptr;
        for (int n = 0; FcPatternGetString(entry->pattern, FC_FAMILY, n, &name) == FcResultMatch; ++n) {
            auto& faces = families_[familyKey(text(name))];
            if (faces.empty() || faces.back() != entry.get())
                faces.push_back(entry.get());
        }
        entries_.push_back(std::move(entry));
    }
}

const std::vector<const FaceEntry*>& FontLibrary::family(const std::string& name) const {
    static const std::vector<const FaceEntry*> none;
    const auto found = families_.find(familyKey(name));
    return found == families_.end() ? none : found->second;
}

std::vector<const FaceEntry*> FontLibrary::substitutes(const FontQuery& query) const {
    std::vector<const FaceEntry*> found;
    if (!systemFonts_) {
        for (const auto& entry : entries_)
            found.push_back(entry.get());
        return found;
    }
    const Pattern pattern = patternOf(query);
    const std::lock_guard lock(mutex_);
    FcConfigSubstitute(config_, pattern.get(), FcMatchPattern);
    FcDefaultSubstitute(pattern.get());
    FcResult result = FcResultNoMatch;
    FcFontSet* const sorted = FcFontSort(config_, pattern.get(), FcFalse, nullptr, &result);
    for (int i = 0; sorted && i < sorted->nfont; ++i) {
        const FaceEntry entry = entryOf(sorted->fonts[i]);
        const auto known = byFile_.find({entry.file, entry.index});
        if (known != byFile_.end())
            found.push_back(known->second);
    }
    if (sorted)
        FcFontSetSortDestroy(sorted);
    return found;
}

std::shared_ptr<const Face> FontLibrary::open(const FaceEntry& entry) {
    const std::lock_guard lock(mutex_);
    std::weak_ptr<const Face>& known = faces_[&entry];
    std::shared_ptr<const Face> face = known.lock();
    if (face)
        return face;
    const std::unique_ptr<hb_blob_t, void (*)(hb_blob_t*)> bytes(
        hb_blob_create_from_file_or_fail(entry.file.c_str()), hb_blob_destroy);
    if (bytes)
        face = openFace(bytes.get(), entry.index, entry.family);
    known = face;
    return face;
}

}  // namespace vtm::text
