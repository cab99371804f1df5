#include <cstdio>

#include <vtm/vtm.hpp>

int main(int, char** arguments) try {
    const auto picture = vtm::Picture::load(arguments[1]);
    picture.render({.width = 80}).save(arguments[2]);
} catch (const vtm::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
