#include "text/fonts/library.hpp"

#include <algorithm>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "text/fonts/face_entry.hpp"
#include "text/fonts/handles.hpp"

namespace vtm::text {
namespace {

// ---- fontconfig's patterns in the terms of CSS ---------------------------------------------------------

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

/// Fonts that HarfBuzz cannot read are left out, and so are the named instances of variable fonts.
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

/// In all languages.
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

// ---- The library --------------------------------------------------------------------------------------

/// The configuration without system fonts: only where fontconfig keeps what it has read of directories.
constexpr const char* cacheOnly = R"(<fontconfig><cachedir prefix="xdg">fontconfig</cachedir></fontconfig>)";

FcConfiguration configurationOf(const FontOptions& options) {
    FcConfiguration config(options.systemFonts ? FcInitLoadConfigAndFonts() : FcConfigCreate());
    if (!config)
        throw FontError("fontconfig cannot be initialised");
    if (!options.systemFonts)
        FcConfigParseAndLoadFromMemory(config.get(), fcString(cacheOnly), FcFalse);
    for (const std::string& directory : options.directories)
        FcConfigAppFontAddDir(config.get(), fcString(directory));
    return config;
}

/// A variable face goes before its default instance, for which it stands, too.
bool comesBefore(const FaceEntry& a, const FaceEntry& b) {
    return std::tuple(familyKey(a.family), a.file, a.index, !a.variable) <
           std::tuple(familyKey(b.family), b.file, b.index, !b.variable);
}

/// What the listed faces depend on.
using Key = std::pair<bool, std::vector<std::string>>;

}  // namespace

std::string familyKey(const std::string& family) {
    const std::unique_ptr<FcChar8, Release<FcStrFree>> lower(FcStrDowncase(fcString(family)));
    return lower ? reinterpret_cast<const char*>(lower.get()) : family;
}

std::shared_ptr<const FontLibrary> FontLibrary::of(const FontOptions& options) {
    constexpr std::size_t maxKept = 8;  // a process that goes through many folders does not keep them all
    static std::mutex mutex;
    static std::vector<std::pair<Key, std::shared_ptr<const FontLibrary>>> kept;
    const std::lock_guard lock(mutex);
    const Key key(options.systemFonts, options.directories);
    const auto known = std::find_if(kept.begin(), kept.end(), [&](const auto& k) { return k.first == key; });
    if (known != kept.end())
        return known->second;
    auto made = std::make_shared<const FontLibrary>(options);
    if (kept.size() == maxKept)
        kept.erase(kept.begin());
    return kept.emplace_back(key, std::move(made)).second;
}

FontLibrary::FontLibrary(const FontOptions& options)
    : systemFonts_(options.systemFonts), config_(configurationOf(options)) {
    list(FcConfigGetFonts(config_.get(), FcSetApplication));
    if (systemFonts_)
        list(FcConfigGetFonts(config_.get(), FcSetSystem));
}

void FontLibrary::list(const FcFontSet* set) {
    std::vector<std::pair<FaceEntry, FcPattern*>> listed;
    for (int i = 0; set && i < set->nfont; ++i)
        if (isUsable(set->fonts[i]))
            listed.emplace_back(entryOf(set->fonts[i]), set->fonts[i]);
    std::sort(listed.begin(), listed.end(),
              [](const auto& a, const auto& b) { return comesBefore(a.first, b.first); });
    for (auto& [entry, pattern] : listed) {
        const FaceEntry*& known = byFile_[{entry.file, entry.index}];
        if (known)
            continue;
        known = entries_.emplace_back(std::make_unique<const FaceEntry>(std::move(entry))).get();
        for (const std::string& name : familiesOf(pattern)) {
            auto& faces = families_[familyKey(name)];
            if (faces.empty() || faces.back() != known)
                faces.push_back(known);
        }
    }
}

const std::vector<const FaceEntry*>& FontLibrary::family(const std::string& name) const {
    static const std::vector<const FaceEntry*> none;
    const auto found = families_.find(familyKey(name));
    return found == families_.end() ? none : found->second;
}

std::vector<const FaceEntry*> FontLibrary::aliasOf(const std::string& name) const {
    if (!systemFonts_)
        return {};
    return aliases_.get(familyKey(name), [&] { return findAlias(name); });
}

std::vector<const FaceEntry*> FontLibrary::findAlias(const std::string& name) const {
    // Rules put families that are equal or preferred next to the name and others at the end, behind `last`.
    const std::string last = "vtm-last-family";
    FontQuery query;
    query.families = {name, last};
    const FcPatternOwner pattern = patternOf(query);
    FcConfigSubstitute(config_.get(), pattern.get(), FcMatchPattern);
    for (const std::string& alias : familiesOf(pattern.get())) {
        if (alias == last)
            break;
        if (const auto& faces = family(alias); !faces.empty())
            return faces;
    }
    return {};
}

std::vector<const FaceEntry*> FontLibrary::substitutes(const FontQuery& query) const {
    if (systemFonts_)
        return substitutes_.get({query.families, query.weight, query.stretch, query.slant, query.language},
                                [&] { return findSubstitutes(query); });
    std::vector<const FaceEntry*> all;
    for (const auto& entry : entries_)
        all.push_back(entry.get());
    return all;
}

std::vector<const FaceEntry*> FontLibrary::findSubstitutes(const FontQuery& query) const {
    const FcPatternOwner pattern = patternOf(query);
    FcConfigSubstitute(config_.get(), pattern.get(), FcMatchPattern);
    FcDefaultSubstitute(pattern.get());
    return sorted(pattern.get());
}

void FontLibrary::keepOpen(std::shared_ptr<const Font> font) const {
    constexpr std::size_t most = 8;
    const std::lock_guard lock(openMutex_);
    std::erase(open_, font);
    if (open_.size() == most)
        open_.erase(open_.begin());
    open_.push_back(std::move(font));
}

std::vector<const FaceEntry*> FontLibrary::sorted(FcPattern* pattern) const {
    FcResult result = FcResultNoMatch;
    const FcFontSetOwner fonts(FcFontSort(config_.get(), pattern, FcFalse, nullptr, &result));
    std::vector<const FaceEntry*> found;
    for (int i = 0; fonts && i < fonts->nfont; ++i) {
        const FaceEntry entry = entryOf(fonts->fonts[i]);
        const auto known = byFile_.find({entry.file, entry.index});
        if (known != byFile_.end())
            found.push_back(known->second);
    }
    return found;
}

}  // namespace vtm::text
