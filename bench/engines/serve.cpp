// Engines of ours and libraries as a peer process of their own: the other end of engine_child.cpp.

#include <algorithm>
#include <iostream>
#include <sstream>

#include <fmt/format.h>

#include <vtm/image/codec.hpp>
#include "bench/engines/engine.hpp"
#include "bench/engines/peer_process.hpp"

namespace vtm::bench {
namespace {

class Server {
public:
    explicit Server(Engines engines) : engines_(std::move(engines)) {}

    std::string answer(const std::string& line) {
        std::istringstream in(line);
        std::string verb, name;
        in >> verb >> name;
        if (verb == "peak")
            return std::to_string(peakBytes());
        Engine& engine = find(name);
        scene::Scene scene;  // of its size alone, which some engines ask for
        if (verb == "load" || verb == "cold")
            in >> scene.width >> scene.height;
        const asset::View view = verb == "load" ? asset::View() : readView(in);
        const std::string path = readPath(in);
        const File file{"", path};
        if (verb == "draw")
            return std::to_string(engine.draw(view));
        if (verb == "cold")
            return std::to_string(engine.drawCold({file, std::move(scene)}, view).value());
        if (verb == "load")
            load(engine, file);
        else if (verb == "picture")
            image::writeFile(path, image::encodePng(engine.pixels(view)));
        else
            throw std::runtime_error(verb + " is no request");
        return "";
    }

private:
    Engine& find(const std::string& name) {
        const auto found = std::ranges::find(engines_, name, [](const auto& e) { return e->name(); });
        if (found == engines_.end())
            throw std::runtime_error(name + " is no engine");
        return **found;
    }

    static void load(Engine& engine, const File& file) { engine.load({file, bench::load(file)}); }

    Engines engines_;
};

}  // namespace

void serve(Engines engines) {
    for (const auto& engine : engines)
        std::cout << "engine " << engine->name() << " file " << engine->description() << "\n";
    Server server(std::move(engines));
    answerRequests([&](const std::string& line) { return server.answer(line); });
}

}  // namespace vtm::bench
