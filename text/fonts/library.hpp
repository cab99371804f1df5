/// \file
/// The font files of a FontOptions as fontconfig lists them. Source: CSS Fonts 4 section 5.2 for the choice
/// within a family.
#pragma once

#include <fontconfig/fontconfig.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "text/font_set.hpp"
#include "text/fonts/open_type_font.hpp"

namespace vtm::text {

/// A face of a file with what it can be: a variable one has ranges.
struct FaceEntry {
    FcPattern* pattern = nullptr;  ///< owned by the library's configuration
    std::string file;
    unsigned index = 0;
    std::string family;
    double minWeight = 400, maxWeight = 400, minStretch = 100, maxStretch = 100;
    Slant slant = Slant::Normal;
    bool variable = false;

    bool covers(std::u32string_view characters) const;
};

/// The key of a family's name: case does not matter.
std::string familyKey(const std::string& family);

/// The best of a family's faces for the query, by stretch, then slant, then weight; null for no faces.
const FaceEntry* bestFace(const std::vector<const FaceEntry*>& faces, const FontQuery& query);

/// Shared by all font sets of equal options. Thread-safe.
class FontLibrary {
public:
    /// The library of these options; made where there is none yet.
    static std::shared_ptr<FontLibrary> of(const FontOptions& options);

    explicit FontLibrary(const FontOptions& options);
    ~FontLibrary();
    FontLibrary(const FontLibrary&) = delete;
    FontLibrary& operator=(const FontLibrary&) = delete;

    /// Empty where there is no such family.
    const std::vector<const FaceEntry*>& family(const std::string& name) const;
    /// What fontconfig puts in the place of families that are not there, best first; every face of the
    /// library where it knows no system fonts, in an order that only depends on the files.
    std::vector<const FaceEntry*> substitutes(const FontQuery& query) const;
    /// Null where the file cannot be used.
    std::shared_ptr<const Face> open(const FaceEntry& entry);

private:
    void list(FcFontSet* set);

    bool systemFonts_;
    FcConfig* config_;
    std::vector<std::unique_ptr<const FaceEntry>> entries_;
    std::unordered_map<std::string, std::vector<const FaceEntry*>> families_;
    std::map<std::pair<std::string, unsigned>, const FaceEntry*> byFile_;
    mutable std::mutex mutex_;
    std::map<const FaceEntry*, std::weak_ptr<const Face>> faces_;
};

}  // namespace vtm::text
