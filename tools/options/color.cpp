#include <algorithm>
#include <cctype>
#include <variant>

#include <fmt/core.h>

#include <vtm/scene/scene.hpp>
#include <vtm/svg/load.hpp>
#include "tools/options/options.hpp"
#include "tools/process/errors.hpp"

namespace vtm::tools {

namespace {

/// What a colour is made of: nothing that could end the attribute it is put into.
bool plain(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string_view("#(),.%/ -+").find(char(c)) != std::string_view::npos;
    });
}

/// Asks the importer, so that the command knows exactly the colours that the files may use. An
/// invalid fill falls back to the inherited `none`, which leaves no item behind.
const scene::Item* filledItem(const scene::Group& group) {
    for (const scene::Node& node : group.children) {
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return item;
        if (const auto* inner = filledItem(std::get<scene::Group>(node.value)))
            return inner;
    }
    return nullptr;
}

}  // namespace

scene::Color parseColor(const std::string& text) {
    if (text == "transparent" || text == "none")
        return {0, 0, 0, 0};
    if (plain(text)) {
        const std::string document = fmt::format(
            R"(<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1" fill="none"><path d="M0 0H1V1Z" fill="{}"/></svg>)",
            text);
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(document.data());
        const svg::Document loaded = svg::load({bytes, document.size()});
        if (const scene::Item* item = filledItem(loaded.scene.root)) {
            scene::Color color = std::get<scene::Color>(item->paint);
            color.a *= item->opacity;
            return color;
        }
    }
    throw UsageError(fmt::format("--background: '{}' is not a colour", text));
}

}  // namespace vtm::tools
