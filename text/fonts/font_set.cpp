#include "text/font_set.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "text/character_ranges.hpp"
#include "text/fonts/document_fonts.hpp"
#include "text/fonts/face_entry.hpp"
#include "text/fonts/library.hpp"

namespace vtm::text {
namespace {

/// Emoji without being asked for. Source: UTS 51, Emoji_Presentation of Unicode 15.0.
constexpr CharacterRange emoji[]{
    {0x231a, 0x231b},   {0x23e9, 0x23ec},   {0x23f0, 0x23f0},   {0x23f3, 0x23f3},   {0x25fd, 0x25fe},
    {0x2614, 0x2615},   {0x2648, 0x2653},   {0x267f, 0x267f},   {0x2693, 0x2693},   {0x26a1, 0x26a1},
    {0x26aa, 0x26ab},   {0x26bd, 0x26be},   {0x26c4, 0x26c5},   {0x26ce, 0x26ce},   {0x26d4, 0x26d4},
    {0x26ea, 0x26ea},   {0x26f2, 0x26f3},   {0x26f5, 0x26f5},   {0x26fa, 0x26fa},   {0x26fd, 0x26fd},
    {0x2705, 0x2705},   {0x270a, 0x270b},   {0x2728, 0x2728},   {0x274c, 0x274c},   {0x274e, 0x274e},
    {0x2753, 0x2755},   {0x2757, 0x2757},   {0x2795, 0x2797},   {0x27b0, 0x27b0},   {0x27bf, 0x27bf},
    {0x2b1b, 0x2b1c},   {0x2b50, 0x2b50},   {0x2b55, 0x2b55},   {0x1f004, 0x1f004}, {0x1f0cf, 0x1f0cf},
    {0x1f18e, 0x1f18e}, {0x1f191, 0x1f19a}, {0x1f1e6, 0x1f1ff}, {0x1f201, 0x1f201}, {0x1f21a, 0x1f21a},
    {0x1f22f, 0x1f22f}, {0x1f232, 0x1f236}, {0x1f238, 0x1f23a}, {0x1f250, 0x1f251}, {0x1f300, 0x1f320},
    {0x1f32d, 0x1f335}, {0x1f337, 0x1f37c}, {0x1f37e, 0x1f393}, {0x1f3a0, 0x1f3ca}, {0x1f3cf, 0x1f3d3},
    {0x1f3e0, 0x1f3f0}, {0x1f3f4, 0x1f3f4}, {0x1f3f8, 0x1f43e}, {0x1f440, 0x1f440}, {0x1f442, 0x1f4fc},
    {0x1f4ff, 0x1f53d}, {0x1f54b, 0x1f54e}, {0x1f550, 0x1f567}, {0x1f57a, 0x1f57a}, {0x1f595, 0x1f596},
    {0x1f5a4, 0x1f5a4}, {0x1f5fb, 0x1f64f}, {0x1f680, 0x1f6c5}, {0x1f6cc, 0x1f6cc}, {0x1f6d0, 0x1f6d2},
    {0x1f6d5, 0x1f6d7}, {0x1f6dc, 0x1f6df}, {0x1f6eb, 0x1f6ec}, {0x1f6f4, 0x1f6fc}, {0x1f7e0, 0x1f7eb},
    {0x1f7f0, 0x1f7f0}, {0x1f90c, 0x1f93a}, {0x1f93c, 0x1f945}, {0x1f947, 0x1f9ff}, {0x1fa70, 0x1fa7c},
    {0x1fa80, 0x1fa88}, {0x1fa90, 0x1fabd}, {0x1fabf, 0x1fac5}, {0x1face, 0x1fadb}, {0x1fae0, 0x1fae8},
    {0x1faf0, 0x1faf8}};

bool isEmojiByDefault(char32_t character) { return contains(emoji, character); }

auto keyOf(const FontQuery& query) {
    std::vector<std::pair<Tag, float>> variations;
    for (const Variation& variation : query.variations)
        variations.emplace_back(variation.axis, variation.value);
    return std::tuple(query.families, query.weight, query.stretch, query.slant, std::move(variations),
                      query.language, query.opticalSize, query.synthesizeWeight, query.synthesizeSlant);
}

/// A generic family of CSS.
struct Generic {
    std::string_view name;
    std::string FontOptions::*option;  ///< the family that it stands for
    const char* base;                  ///< fontconfig's name
};

constexpr Generic generics[]{{"serif", &FontOptions::serifFamily, "serif"},
                             {"sans-serif", &FontOptions::sansSerifFamily, "sans-serif"},
                             {"cursive", &FontOptions::cursiveFamily, "cursive"},
                             {"fantasy", &FontOptions::fantasyFamily, "fantasy"},
                             {"monospace", &FontOptions::monospaceFamily, "monospace"},
                             {"ui-serif", &FontOptions::serifFamily, "serif"},
                             {"ui-sans-serif", &FontOptions::sansSerifFamily, "sans-serif"},
                             {"ui-monospace", &FontOptions::monospaceFamily, "monospace"},
                             {"system-ui", &FontOptions::sansSerifFamily, "sans-serif"}};

/// The presentation that a cluster's variation selector asks for (UTS 51 section 2): true for colour.
std::optional<bool> askedColor(std::u32string_view cluster) {
    constexpr std::u32string_view selectors = U"\ufe0e\ufe0f";
    const std::size_t at = cluster.find_first_of(selectors);
    return at == std::u32string_view::npos ? std::nullopt : std::optional(cluster[at] == selectors[1]);
}

using Faces = std::vector<const FaceEntry*>;

/// What was found for a query.
struct Answer {
    bool hasPrimary = false;
    std::shared_ptr<const Font> primary;
    std::map<std::u32string, std::shared_ptr<const Font>, std::less<>> covering;  ///< by cluster
    std::map<const FaceEntry*, std::shared_ptr<const Font>> fonts;
};

}  // namespace

class FontSet::Implementation {
public:
    explicit Implementation(const FontOptions& options)
        : options_(options), library_(FontLibrary::of(options)) {}

    /// Of the family, or else of one that stands for it.
    const Faces& facesOf(const std::string& family) {
        const Generic* const named = generic(family);
        if (!named && !own_.family(family).empty())
            return own_.family(family);
        const std::string& name = named ? options_.*named->option : family;
        const Faces& installed = library_->family(name);
        if (!installed.empty())
            return installed;
        const auto [at, isNew] = aliases_.try_emplace(familyKey(family));
        if (isNew)
            at->second = library_->aliasOf(named ? named->base : family);
        return at->second;
    }

    void add(const FontFace& face, std::span<const std::uint8_t> bytes) {
        own_.add(face, bytes);
        answers_.clear();
        fallbacks_.clear();
    }

    bool hasFamily(const std::string& family) const { return generic(family) || isNamed(family); }

    std::shared_ptr<const Font> primary(const FontQuery& query) {
        if (query.families.empty())
            return primary(withDefault(query));
        Answer& answer = answers_[keyOf(query)];
        if (!std::exchange(answer.hasPrimary, true))
            answer.primary = findPrimary(query, answer);
        return answer.primary;
    }

    std::shared_ptr<const Font> covering(const FontQuery& query, std::u32string_view cluster) {
        if (query.families.empty())
            return covering(withDefault(query), cluster);
        Answer& answer = answers_[keyOf(query)];
        const auto known = answer.covering.find(cluster);
        if (known != answer.covering.end())
            return known->second;
        auto font = findCovering(query, cluster, answer);
        if (!font && cluster.size() > 1)
            font = findCovering(query, cluster.substr(0, 1), answer);
        return answer.covering[std::u32string(cluster)] = font;
    }

private:
    /// Null for names that are not generic.
    static const Generic* generic(const std::string& family) {
        const std::string key = familyKey(family);
        const auto found = std::ranges::find(generics, key, &Generic::name);
        return found == std::end(generics) ? nullptr : found;
    }

    FontQuery withDefault(FontQuery query) const {
        query.families = {options_.defaultFamily};
        return query;
    }

    std::shared_ptr<const Font> findPrimary(const FontQuery& query, Answer& answer) {
        return find(query, answer, false, [](Faces faces) {
            std::erase_if(faces, [](const FaceEntry* face) { return !face->forSpace; });
            return faces;
        });
    }

    std::shared_ptr<const Font> findCovering(const FontQuery& query, std::u32string_view cluster,
                                             Answer& answer) {
        const auto asked = askedColor(cluster);
        const bool color = asked.value_or(isEmojiByDefault(cluster.front()));
        const auto covered = [&](const Faces& faces) { return text::covering(faces, cluster); };
        if (asked)  // of the families that are named, too
            if (auto font = find(query, answer, color,
                                 [&](const Faces& faces) { return ofColor(covered(faces), color); }))
                return font;
        return find(query, answer, color, covered);
    }

    static Faces ofColor(Faces faces, bool color) {
        std::erase_if(faces, [&](const FaceEntry* face) { return face->color != color; });
        return faces;
    }

    /// The first family with faces that pass. Of families that stand in for others, those in colour are for
    /// emoji: they have figures and spaces, too.
    template <class Filter>
    std::shared_ptr<const Font> find(const FontQuery& query, Answer& answer, bool color,
                                     const Filter& filter) {
        for (const std::string& family : query.families) {
            const Faces faces = filter(facesOf(family));
            if (auto font =
                    open(bestFace(isNamed(family) ? faces : ofColor(faces, color), query), query, answer))
                return font;
        }
        Faces others;
        for (const Faces& family : fallback(query)) {
            const Faces faces = filter(family);
            if (auto font = open(bestFace(ofColor(faces, color), query), query, answer))
                return font;
            others.push_back(bestFace(faces, query));
        }
        for (const FaceEntry* face : others)
            if (auto font = open(face, query, answer))
                return font;
        return nullptr;
    }

    /// No other family stands for it.
    bool isNamed(const std::string& family) const {
        return !generic(family) && (!own_.family(family).empty() || !library_->family(family).empty());
    }

    /// The families to try after those of the query, each with all its faces. With system fonts fontconfig
    /// says which; without, the default one and those of `serif` and `sans-serif` go first.
    const std::vector<Faces>& fallback(const FontQuery& query) {
        const auto [at, isNew] = fallbacks_.try_emplace(
            std::tuple(query.families, query.weight, query.stretch, query.slant, query.language));
        if (isNew)
            at->second = findFallback(query);
        return at->second;
    }

    std::vector<Faces> findFallback(const FontQuery& query) {
        std::vector<Faces> fallback;
        std::set<std::string> seen;
        const auto append = [&](const std::string& family) {
            if (seen.insert(familyKey(family)).second && !facesOf(family).empty())
                fallback.push_back(facesOf(family));
        };
        if (!options_.systemFonts)
            for (const std::string& family :
                 {options_.defaultFamily, options_.serifFamily, options_.sansSerifFamily})
                append(family);
        for (const FaceEntry* face : library_->substitutes(withGenerics(query, options_)))
            append(face->family);
        return fallback;
    }

    /// A generic name is what the option says, and else what fontconfig says.
    static FontQuery withGenerics(FontQuery query, const FontOptions& options) {
        std::vector<std::string> families;
        for (const std::string& family : query.families)
            if (const Generic* const named = generic(family))
                families.insert(families.end(), {options.*named->option, named->base});
            else
                families.push_back(family);
        query.families = std::move(families);
        return query;
    }

    /// Null for no face, and where the file has gone or is broken.
    std::shared_ptr<const Font> open(const FaceEntry* entry, const FontQuery& query, Answer& answer) {
        if (!entry)
            return nullptr;
        const auto [at, isNew] = answer.fonts.try_emplace(entry);
        if (isNew)
            at->second = makeFont(*entry, query);
        return at->second;
    }

    std::shared_ptr<const Font> makeFont(const FaceEntry& entry, const FontQuery& query) {
        const auto face = entry.ownFace ? entry.ownFace : openFace(entry.file, entry.index, entry.family);
        if (!face)
            return nullptr;
        auto font = face->font(instanceOf(*face, entry, query));
        if (!entry.ownFace)
            library_->keepOpen(font);
        return font;
    }

    const FontOptions options_;
    const std::shared_ptr<const FontLibrary> library_;
    DocumentFonts own_;
    std::map<std::string, Faces> aliases_;  ///< by familyKey
    std::map<decltype(keyOf({})), Answer> answers_;
    std::map<std::tuple<std::vector<std::string>, double, double, Slant, std::string>, std::vector<Faces>>
        fallbacks_;
};

FontSet::FontSet(const FontOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}
FontSet::~FontSet() = default;

void FontSet::add(const FontFace& face, std::span<const std::uint8_t> bytes) {
    implementation_->add(face, bytes);
}

bool FontSet::hasFamily(const std::string& family) const { return implementation_->hasFamily(family); }

std::shared_ptr<const Font> FontSet::primary(const FontQuery& query) {
    return implementation_->primary(query);
}

std::shared_ptr<const Font> FontSet::covering(const FontQuery& query, std::u32string_view characters) {
    return implementation_->covering(query, characters);
}

}  // namespace vtm::text
