/// \file
/// The font files of a FontOptions as fontconfig lists them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "text/fonts/face_entry.hpp"
#include "text/fonts/handles.hpp"

namespace vtm::text {

/// The key of a family's name: case does not matter.
std::string familyKey(const std::string& family);

/// Shared by all font sets of equal directories. Immutable.
class FontLibrary {
public:
    /// The library of these options; made where there is none yet.
    static std::shared_ptr<const FontLibrary> of(const FontOptions& options);

    explicit FontLibrary(const FontOptions& options);
    FontLibrary(const FontLibrary&) = delete;
    FontLibrary& operator=(const FontLibrary&) = delete;

    /// Faces of the directories before those of the system; empty where there is no such family.
    const std::vector<const FaceEntry*>& family(const std::string& name) const;
    /// The faces of the first family that fontconfig's rules hold equal to this one, as Liberation Sans to
    /// Helvetica, or prefer for this generic name; empty where there is none.
    std::vector<const FaceEntry*> aliasOf(const std::string& name) const;
    /// What fontconfig puts in the place of families that are not there, best first; every face of the
    /// library where it knows no system fonts, by family, file and index.
    std::vector<const FaceEntry*> substitutes(const FontQuery& query) const;

private:
    void list(const FcFontSet* set);
    std::vector<const FaceEntry*> sorted(FcPattern* pattern) const;

    bool systemFonts_;
    FcConfiguration config_;
    std::vector<std::unique_ptr<const FaceEntry>> entries_;
    std::unordered_map<std::string, std::vector<const FaceEntry*>> families_;
    std::map<std::pair<std::string, unsigned>, const FaceEntry*> byFile_;
};

}  // namespace vtm::text
