#include "text/font_set.hpp"

#include <hb-ot.h>

#include <algorithm>
#include <map>

#include "text/fonts/library.hpp"

namespace vtm::text {
namespace {

constexpr Tag tag(char a, char b, char c, char d) { return HB_TAG(a, b, c, d); }

/// The axes of a variable face that stand for properties, then those that the author sets.
std::vector<hb_variation_t> variationsOf(const Face& face, const FontQuery& query) {
    std::vector<hb_variation_t> variations{{tag('w', 'g', 'h', 't'), static_cast<float>(query.weight)},
                                           {tag('w', 'd', 't', 'h'), static_cast<float>(query.stretch)}};
    if (query.slant == Slant::Italic)
        variations.push_back({tag('i', 't', 'a', 'l'), 1});
    if (query.slant != Slant::Normal)
        variations.push_back({tag('s', 'l', 'n', 't'), -14});
    if (query.opticalSize > 0)
        variations.push_back({tag('o', 'p', 's', 'z'), static_cast<float>(query.opticalSize)});
    for (const Variation& variation : query.variations)
        variations.push_back({variation.axis, variation.value});
    std::erase_if(variations, [&](const hb_variation_t& variation) {
        hb_ot_var_axis_info_t axis;
        return !hb_ot_var_find_axis_info(face.face.get(), variation.tag, &axis);
    });
    return variations;
}

bool hasSlantAxis(const Face& face) {
    hb_ot_var_axis_info_t axis;
    return hb_ot_var_find_axis_info(face.face.get(), tag('s', 'l', 'n', 't'), &axis) ||
           hb_ot_var_find_axis_info(face.face.get(), tag('i', 't', 'a', 'l'), &axis);
}

}  // namespace

class FontSet::Implementation {
public:
    explicit Implementation(const FontOptions& options)
        : options_(options), library_(FontLibrary::of(options)) {}

    bool hasFamily(const std::string& family) const {
        return generic(family) || !library_->family(family).empty();
    }

    std::shared_ptr<const Font> primary(const FontQuery& query) {
        const auto known = std::find_if(primaries_.begin(), primaries_.end(),
                                        [&](const auto& entry) { return entry.first == query; });
        if (known != primaries_.end())
            return known->second;
        return primaries_.emplace_back(query, findPrimary(query)).second;
    }

    std::shared_ptr<const Font> covering(const FontQuery& query, std::u32string_view characters) {
        for (const std::u32string_view wanted : {characters, characters.substr(0, 1)})
            if (auto font = findCovering(query, wanted))
                return font;
        return nullptr;
    }

private:
    /// The option that a generic name stands for; null for other names.
    const std::string* generic(const std::string& family) const {
        const std::pair<const char*, const std::string*> names[]{{"serif", &options_.serifFamily},
                                                                 {"sans-serif", &options_.sansSerifFamily},
                                                                 {"cursive", &options_.cursiveFamily},
                                                                 {"fantasy", &options_.fantasyFamily},
                                                                 {"monospace", &options_.monospaceFamily},
                                                                 {"ui-serif", &options_.serifFamily},
                                                                 {"ui-sans-serif", &options_.sansSerifFamily},
                                                                 {"ui-monospace", &options_.monospaceFamily},
                                                                 {"system-ui", &options_.sansSerifFamily}};
        const std::string key = familyKey(family);
        for (const auto& [name, option] : names)
            if (key == name)
                return option;
        return nullptr;
    }

    const std::vector<const FaceEntry*>& facesOf(const std::string& family) const {
        const std::string* const named = generic(family);
        return library_->family(named ? *named : family);
    }

    /// The query's families, the default one after them.
    std::vector<std::string> familiesOf(const FontQuery& query) const {
        std::vector<std::string> families = query.families;
        families.push_back(options_.defaultFamily);
        return families;
    }

    std::shared_ptr<const Font> findPrimary(const FontQuery& query) {
        for (const std::string& family : familiesOf(query)) {
            if (const FaceEntry* face = bestFace(facesOf(family), query))
                if (auto font = instance(*face, query))
                    return font;
        }
        return substitute(query, U"");
    }

    std::shared_ptr<const Font> findCovering(const FontQuery& query, std::u32string_view characters) {
        for (const std::string& family : familiesOf(query)) {
            std::vector<const FaceEntry*> faces = facesOf(family);
            std::erase_if(faces, [&](const FaceEntry* face) { return !face->covers(characters); });
            if (const FaceEntry* face = bestFace(faces, query))
                if (auto font = instance(*face, query))
                    return font;
        }
        return substitute(query, characters);
    }

    /// The best face of the first family among fontconfig's proposals that has the characters. Without system
    /// fonts the family for `serif` goes first.
    std::shared_ptr<const Font> substitute(const FontQuery& query, std::u32string_view characters) {
        FontQuery asked = query;
        asked.families.push_back(options_.defaultFamily);
        asked.families.push_back("serif");
        for (const std::string& family : {std::string("serif"), std::string("sans-serif")})
            for (const FaceEntry* face : facesOf(family))
                if (!options_.systemFonts && face->covers(characters))
                    return instance(*bestFace(facesOf(family), query), query);
        for (const FaceEntry* proposed : library_->substitutes(asked)) {
            if (!proposed->covers(characters))
                continue;
            std::vector<const FaceEntry*> faces = library_->family(proposed->family);
            std::erase_if(faces, [&](const FaceEntry* face) { return !face->covers(characters); });
            const FaceEntry* const best = bestFace(faces, query);
            if (auto font = instance(best ? *best : *proposed, query))
                return font;
        }
        return nullptr;
    }

    std::shared_ptr<const Font> instance(const FaceEntry& entry, const FontQuery& query) {
        const std::shared_ptr<const Face> face = library_->open(entry);
        return face ? instance(face, entry.maxWeight, entry.slant, query) : nullptr;
    }

    std::shared_ptr<const Font> instance(const std::shared_ptr<const Face>& face, double maxWeight,
                                         Slant slant, const FontQuery& query) {
        // CSS Fonts 4 section 2.7: bold is made from faces below this weight for weights from it on.
        constexpr double boldWeight = 600;
        Instance made{variationsOf(*face, query),
                      query.synthesizeWeight && query.weight >= boldWeight && maxWeight < boldWeight,
                      query.synthesizeSlant && query.slant != Slant::Normal && slant == Slant::Normal &&
                          !hasSlantAxis(*face)};
        for (const Made& known : made_)
            if (known.face == face && known.instance.bold == made.bold &&
                known.instance.oblique == made.oblique && equal(known.instance.variations, made.variations))
                return known.font;
        auto font = std::make_shared<const OpenTypeFont>(face, made);
        made_.push_back({face, std::move(made), font});
        return font;
    }

    static bool equal(const std::vector<hb_variation_t>& a, const std::vector<hb_variation_t>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [](const auto& x, const auto& y) { return x.tag == y.tag && x.value == y.value; });
    }

    struct Made {
        std::shared_ptr<const Face> face;
        Instance instance;
        std::shared_ptr<const Font> font;
    };

    const FontOptions options_;
    const std::shared_ptr<FontLibrary> library_;
    std::vector<std::pair<FontQuery, std::shared_ptr<const Font>>> primaries_;
    std::vector<Made> made_;
};

FontSet::FontSet(const FontOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}
FontSet::~FontSet() = default;

bool FontSet::hasFamily(const std::string& family) const { return implementation_->hasFamily(family); }

std::shared_ptr<const Font> FontSet::primary(const FontQuery& query) {
    return implementation_->primary(query);
}

std::shared_ptr<const Font> FontSet::covering(const FontQuery& query, std::u32string_view characters) {
    return implementation_->covering(query, characters);
}

}  // namespace vtm::text
