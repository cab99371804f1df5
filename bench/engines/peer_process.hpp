/// \file
/// The peers' end of the protocol of docs/benchmarks.md: requests from standard input, a line for each.
#pragma once

#include <functional>
#include <iostream>
#include <istream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include <vtm/image/bitmap.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/raster/view.hpp>
#include "bench/measure/measure.hpp"

namespace vtm::bench {

/// Until the input's end. `answer` returns what stands behind "ok ", or throws what stands behind "error ".
inline void answerRequests(const std::function<std::string(const std::string&)>& answer) {
    std::cout << "ready" << std::endl;
    for (std::string line; std::getline(std::cin, line);) {
        try {
            const std::string reply = answer(line);  // may throw, before "ok" is said
            std::cout << "ok " << reply << std::endl;
        } catch (const std::exception& error) {
            std::cout << "error " << error.what() << std::endl;
        }
    }
}

/// Of a request: the raster's sides and the matrix.
inline asset::View readView(std::istream& request) {
    asset::View view;
    request >> view.width >> view.height;
    for (int column = 0; column < 3; ++column)
        request >> view.toPixels[column].x >> view.toPixels[column].y;
    return view;
}

/// The rest of a request, which may contain spaces.
inline std::string readPath(std::istream& request) {
    std::string path;
    std::getline(request >> std::ws, path);
    return path;
}

/// A file as an engine has read it.
class Document {
public:
    virtual ~Document() = default;
    /// On transparent black, until the pixels stand.
    virtual void draw(const asset::View& view) = 0;
};

/// An engine of a peer process: what its documents draw on. It outlives them.
class Peer {
public:
    virtual ~Peer() = default;
    /// A file whose picture is `width` by `height` user units.
    virtual std::unique_ptr<Document> read(const std::string& path, double width, double height) = 0;
    /// What was drawn last.
    virtual image::Bitmap pixels() const = 0;
};

/// Introduces engines, then times what it is asked for.
class PeerProcess {
public:
    /// The name has no spaces; `takes` is a word of the protocol.
    void add(const std::string& name, const std::string& takes, const std::string& description,
             std::unique_ptr<Peer> peer) {
        std::cout << "engine " << name << " " << takes << " " << description << "\n";
        engines_[name].peer = std::move(peer);
    }

    void run() {
        answerRequests([&](const std::string& line) { return answer(line); });
    }

private:
    struct Engine {
        std::unique_ptr<Peer> peer;
        std::unique_ptr<Document> loaded = nullptr;
    };

    std::string answer(const std::string& line) {
        std::istringstream request(line);
        std::string verb, name;
        request >> verb >> name;
        Engine& engine = find(name);
        if (verb == "peak")
            return std::to_string(peakBytes());
        double width = 0, height = 0;
        if (verb == "load" || verb == "cold")
            request >> width >> height;
        const asset::View view = verb == "load" ? asset::View() : readView(request);
        const std::string path = readPath(request);
        if (verb == "load") {
            engine.loaded = nullptr;  // also where the next one cannot be read
            engine.loaded = engine.peer->read(path, width, height);
        } else if (verb == "draw") {
            return std::to_string(spentTime([&] { loadedBy(engine).draw(view); }));
        } else if (verb == "cold") {
            std::unique_ptr<Document> document;  // outlives the clock
            return std::to_string(spentTime([&] {
                document = engine.peer->read(path, width, height);
                document->draw(view);
            }));
        } else if (verb == "picture") {
            loadedBy(engine).draw(view);
            image::writeFile(path, image::encodePng(engine.peer->pixels()));
        } else {
            throw std::runtime_error(verb + " is no request");
        }
        return "";
    }

    Engine& find(const std::string& name) {
        const auto found = engines_.find(name);
        if (found == engines_.end())
            throw std::runtime_error(name + " is no engine");
        return found->second;
    }

    static Document& loadedBy(const Engine& engine) {
        if (!engine.loaded)
            throw std::runtime_error("nothing is loaded");
        return *engine.loaded;
    }

    std::map<std::string, Engine> engines_;
};

}  // namespace vtm::bench
