// Engines of ours and libraries as a peer process of their own: the other end of engine_child.cpp.

#include <algorithm>
#include <iostream>
#include <sstream>

#include <fmt/format.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/image/codec.hpp>
#include "bench/engines/engine.hpp"
#include "bench/measure/measure.hpp"

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
        if (verb == "load" || verb == "cold") {
            double width = 0, height = 0;  // the scene has them
            in >> width >> height;
        }
        const asset::View view = verb == "load" ? asset::View() : readView(in);
        std::string path;
        std::getline(in >> std::ws, path);
        const File file{"", path};
        if (verb == "draw")
            return std::to_string(engine.draw(view));
        if (verb == "cold")
            return std::to_string(engine.drawCold({file, {}, {}}, view).value());
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

    static void load(Engine& engine, const File& file) {
        CompiledFile picture{file, bench::load(file), {}};
        picture.asset = compiler::compile(picture.scene).asset;
        engine.load(picture);
    }

    static asset::View readView(std::istream& in) {
        asset::View view;
        in >> view.width >> view.height;
        for (int column = 0; column < 3; ++column)
            in >> view.toPixels[column].x >> view.toPixels[column].y;
        return view;
    }

    Engines engines_;
};

}  // namespace

void serve(Engines engines) {
    for (const auto& engine : engines)
        std::cout << "engine " << engine->name() << " file " << engine->description() << "\n";
    std::cout << "ready" << std::endl;
    Server server(std::move(engines));
    for (std::string line; std::getline(std::cin, line);) {
        try {
            const std::string reply = server.answer(line);  // may throw, before "ok" is said
            std::cout << "ok " << reply << std::endl;
        } catch (const std::exception& error) {
            std::cout << "error " << error.what() << std::endl;
        }
    }
}

}  // namespace vtm::bench
