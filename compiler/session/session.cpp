#include <vtm/compiler/session.hpp>

#include "compiler/compile/settings.hpp"
#include "compiler/filters/compile_filtered.hpp"
#include "compiler/session/editor.hpp"

namespace vtm::compiler {

class Session::State {
public:
    explicit State(const Options& options) : options_(options) { checkOptions(options_); }

    void update(const scene::Scene& scene) {
        scene::validate(scene, [&](const scene::Path& path) { return kept_ && kept_->cache.knows(path); });
        if (options_.mode != asset::Mode::Exact || hasFilters(scene)) {
            result_ = compile(scene, options_);
            update_ = {.anew = true};
            kept_.reset();
            return;
        }
        std::unique_ptr<Kept> kept = std::move(kept_);  // lost if anything throws
        if (kept && (kept->width != scene.width || kept->height != scene.height))
            kept.reset();
        if (!kept || !tryEdit(*kept, scene)) {
            kept = std::make_unique<Kept>(scene.width, scene.height, options_);
            update_ = edit(*kept, result_, scene, options_);
        }
        if (!kept->isWorn())
            kept_ = std::move(kept);
    }

    const Result& result() const { return result_; }
    const Update& lastUpdate() const { return update_; }

private:
    /// What is kept counts towards limits too, used or not.
    bool tryEdit(Kept& kept, const scene::Scene& scene) {
        try {
            update_ = edit(kept, result_, scene, options_);
            return true;
        } catch (const LimitError&) {
            return false;
        }
    }

    const Options options_;
    std::unique_ptr<Kept> kept_;
    Result result_;
    Update update_;
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
const Update& Session::lastUpdate() const { return state_->lastUpdate(); }

}  // namespace vtm::compiler
