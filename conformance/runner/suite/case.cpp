#include "conformance/runner/suite/case.hpp"

#include <stdexcept>

namespace vtm::conformance {

std::string_view nameOf(Engine engine) {
    constexpr std::string_view names[] = {"gl", "asset", "scan", "reference"};
    return names[std::size_t(engine)];
}

Engine engineOf(std::string_view name) {
    for (const Engine engine : allEngines)
        if (nameOf(engine) == name)
            return engine;
    throw std::runtime_error("no engine is called '" + std::string(name) + "'");
}

}  // namespace vtm::conformance
