#include "tools/engines/automatic_engine.hpp"

#include <vtm/raster/scan.hpp>
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

bool scannerDraws(const Source& source) {
    return source.asset && asset::isSumOfMaps(*source.asset) && source.asset->materials.empty();
}

}  // namespace

AutomaticEngine::AutomaticEngine(asset::Mode mode, const std::string& programCache)
    : gl_(programCache),
      scanner_(makeEngine("cpu", mode)),
      twin_(makeEngine("asset", mode)),
      drawing_(scanner_.get()) {}

void AutomaticEngine::draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
                           const image::RowSink& sink) {
    drawing_ = &engineFor(source);
    drawing_->draw(source, view, writer, sink);
}

Engine& AutomaticEngine::engineFor(Source& source) {
    const bool scans = scannerDraws(source);
    Engine& onCpu = scans ? *scanner_ : *twin_;
    if (driver(source) == gl::Driver::None || (scans && driver(source) == gl::Driver::Software))
        return onCpu;
    if (!startsGl(source))
        return onCpu;
    return scans && gl_.isSoftware() ? onCpu : gl_;
}

gl::Driver AutomaticEngine::driver(Source& source) {
    if (!driver_) {
        driver_ = timed(source.stages, "start", [] { return gl::likelyDriver(); });
        if (driver_ == gl::Driver::None)
            doWithoutGl("EGL has no driver");
    }
    return *driver_;
}

bool AutomaticEngine::startsGl(Source& source) {
    try {
        gl_.start(source.stages);
        return true;
    } catch (const gl::GlError& error) {
        doWithoutGl(error.what());
        return false;
    }
}

void AutomaticEngine::doWithoutGl(const std::string& why) {
    driver_ = gl::Driver::None;
    warn("vtm: " + why + "; drawing on the CPU");
}

}  // namespace vtm::tools
