#include "text/fonts/library.hpp"

#include <algorithm>
#include <mutex>
#include <tuple>
#include <utility>

#include "text/fonts/pattern.hpp"

namespace vtm::text {
namespace {

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
    if (systemFonts_) {
        const FcPatternOwner pattern = patternOf(query);
        FcConfigSubstitute(config_.get(), pattern.get(), FcMatchPattern);
        FcDefaultSubstitute(pattern.get());
        return sorted(pattern.get());
    }
    std::vector<const FaceEntry*> all;
    for (const auto& entry : entries_)
        all.push_back(entry.get());
    return all;
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
