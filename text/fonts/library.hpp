/// \file
/// The font files of a FontOptions as fontconfig lists them.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "text/font.hpp"
#include "text/fonts/face_entry.hpp"
#include "text/fonts/handles.hpp"

namespace vtm::text {

/// The key of a family's name: case does not matter.
std::string familyKey(const std::string& family);

/// Answers to what was asked before, by any thread.
template <class Key>
class FaceAnswers {
public:
    using Faces = std::vector<const FaceEntry*>;

    /// find(): finds those that are not known.
    template <class Find>
    Faces get(const Key& key, Find&& find) {
        {
            const std::lock_guard lock(mutex_);
            if (const auto known = answers_.find(key); known != answers_.end())
                return known->second;
        }
        Faces found = find();
        const std::lock_guard lock(mutex_);
        if (answers_.size() == most)
            answers_.clear();
        return answers_.try_emplace(key, std::move(found)).first->second;
    }

private:
    static constexpr std::size_t most = 256;  // a process may go through many documents

    std::mutex mutex_;
    std::map<Key, Faces> answers_;
};

/// Shared by all font sets of equal directories. Immutable, but for what it remembers of fontconfig's
/// answers, since rules and sorting take longer than most documents' texts, and of fonts.
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

    /// Keeps the last few fonts of its files open, for the next documents.
    void keepOpen(std::shared_ptr<const Font> font) const;

private:
    void list(const FcFontSet* set);
    std::vector<const FaceEntry*> sorted(FcPattern* pattern) const;

    std::vector<const FaceEntry*> findAlias(const std::string& name) const;
    std::vector<const FaceEntry*> findSubstitutes(const FontQuery& query) const;

    /// What patternOf() takes of a query.
    using PatternKey = std::tuple<std::vector<std::string>, double, double, Slant, std::string>;

    bool systemFonts_;
    FcConfiguration config_;
    std::vector<std::unique_ptr<const FaceEntry>> entries_;
    std::unordered_map<std::string, std::vector<const FaceEntry*>> families_;
    std::map<std::pair<std::string, unsigned>, const FaceEntry*> byFile_;
    mutable FaceAnswers<std::string> aliases_;
    mutable FaceAnswers<PatternKey> substitutes_;
    mutable std::mutex openMutex_;  ///< guards open_
    mutable std::vector<std::shared_ptr<const Font>> open_;
};

}  // namespace vtm::text
