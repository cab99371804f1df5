#include <vtm/compiler/session.hpp>

#include <memory>
#include <utility>
#include <vector>

#include "compiler/compile/settings.hpp"
#include "compiler/filters/compile_filtered.hpp"
#include "compiler/session/edited_picture.hpp"
#include "compiler/session/filtered_parts.hpp"

namespace vtm::compiler {

class Session::State {
public:
    explicit State(const Options& options) : options_(options) { checkOptions(options_); }

    void update(const scene::Scene& scene) {
        std::vector<const scene::Path*> paths;
        scene::validate(scene, [&](const scene::Path& path) {
            if (plain_)
                return plain_->knows(path);
            paths.push_back(&path);
            return filtered_ && filtered_->knows(path);
        });
        const bool isFiltered = hasFilters(scene);
        if (options_.mode != asset::Mode::Exact || (isFiltered && options_.filterPixels > 0))
            follow(plain_, [&](EditedPicture& next) { next.compile(scene, wholeOf(scene), options_); });
        else if (isFiltered)
            follow(filtered_, [&](FilteredParts& next) { next.update(scene, std::move(paths), options_); });
        else
            follow(plain_, [&](EditedPicture& next) { next.update(scene, wholeOf(scene), options_); });
    }

    const Result& result() const { return filtered_ ? filtered_->result() : plain_->result(); }
    const Edited& report() const { return filtered_ ? filtered_->report() : plain_->report(); }

private:
    /// Calls update(picture) with the picture or, if it is of another kind than the last scene's, a new one.
    template <class Picture, class Update>
    void follow(std::unique_ptr<Picture>& picture, Update&& update) {
        if (picture)
            return update(*picture);
        auto next = std::make_unique<Picture>();
        update(*next);
        plain_.reset();
        filtered_.reset();
        picture = std::move(next);
    }

    const Options options_;
    // One of them, when there is a result.
    std::unique_ptr<EditedPicture> plain_;
    std::unique_ptr<FilteredParts> filtered_;
};

Session::Session(const scene::Scene& scene, const Options& options)
    : state_(std::make_unique<State>(options)) {
    update(scene);
}

Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

const Result& Session::update(const scene::Scene& scene) {
    state_->update(scene);
    return state_->result();
}

const Result& Session::result() const { return state_->result(); }
const Update& Session::lastUpdate() const { return state_->report().update; }
const asset::Difference& Session::difference() const { return state_->report().difference; }

}  // namespace vtm::compiler
