/// \file
/// What draws: ours and the peers, all through one door.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>
#include <vtm/scene/scene.hpp>
#include "bench/input/files.hpp"

namespace vtm::bench {

/// A file and the scene in it.
struct LoadedFile {
    File file;
    scene::Scene scene;
};

/// Draws one picture at a time. Every function throws std::runtime_error that says what went wrong.
class Engine {
public:
    Engine(std::string name, std::string description)
        : name_(std::move(name)), description_(std::move(description)) {}
    virtual ~Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    const std::string& name() const { return name_; }                ///< a column's heading
    const std::string& description() const { return description_; }  ///< with versions

    /// Prepares a picture: everything that can be done once for all views.
    virtual void load(const LoadedFile& picture) = 0;
    /// CPU milliseconds (user and system, all threads) of drawing it on transparent black, until the pixels
    /// stand.
    virtual double draw(const asset::View& view) = 0;
    /// The same from the file, or from a file of our scene's paths for an engine that reads no others;
    /// nothing for one that reads none. What was loaded stays loaded.
    virtual std::optional<double> drawCold(const LoadedFile& picture, const asset::View& view) = 0;
    /// What draw() draws.
    virtual image::Bitmap pixels(const asset::View& view) = 0;
    /// Bytes of the largest resident set of the engine's process so far; nothing for one in this process.
    virtual std::optional<double> peakBytes() { return std::nullopt; }

private:
    std::string name_, description_;
};

using Engines = std::vector<std::unique_ptr<Engine>>;

/// Our ways to draw.
Engines glEngines();
Engines scanEngines();

/// Answers requests of that protocol from standard input, for these engines, until its end.
void serve(Engines engines);

/// cairo, given the paths of our scene; none where it is not installed, which is noted.
Engines cairoEngines(std::vector<std::string>& notes);

/// librsvg with cairo; none where it is not installed, which is noted.
Engines rsvgEngines(std::vector<std::string>& notes);

/// The engines of a child process that speaks the protocol of docs/benchmarks.md. `command` is run by the
/// shell; what it lacks is noted.
Engines childEngines(const std::string& command, std::vector<std::string>& notes);

}  // namespace vtm::bench
